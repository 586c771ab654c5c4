// Charts: curves over two axes with numbers.
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <tuple>
#include <vector>

#include <lamina/plot.hpp>

#include "plot/canvas.hpp"
#include "plot/color.hpp"
#include "plot/picture_file.hpp"
#include "plot/round_numbers.hpp"
#include "plot/view.hpp"

namespace lamina::plot {

namespace {

constexpr double grid_alpha = 0.15;

// Lengths in pixels, for a picture of 1200 pixels.
constexpr double letter_height = 20, left_margin = 90, right_margin = 30, top_margin = 55, bottom_margin = 80;
constexpr double curve_width = 2.2, axis_width = 1.2, mark_size = 30, line_spacing = 1.5;

/// An interval with round numbers in it.
struct Axis {
    double lower, upper, step;
    double share(double value) const { return (value - lower) / (upper - lower); }
};

/// Returns the interval, enlarged to multiples of a step of 1, 2 or 5 times a power of ten, of which it holds 4 to 12.
Axis make_axis(double lower, double upper) {
    const double range = std::max(upper - lower, 1e-12 * std::max({std::abs(lower), std::abs(upper), 1e-200}));
    const double step = round_step(range, 4);
    return {step * std::floor(lower / step), step * std::ceil(upper / step), step};
}

/// The place of the axes in the picture, in pixels, y upwards.
struct Frame {
    Box area;
    Axis x, y;
    bool y_downwards;

    Point place(Point p) const {
        const double up = y_downwards ? 1 - y.share(p.y) : y.share(p.y);
        return area.lower + Point{x.share(p.x) * area.width(), up * area.height()};
    }
};

Frame make_frame(std::span<const ChartCurve> curves, const ChartOptions& options, double unit, double width,
                 double height) {
    Box range;
    for (const ChartCurve& curve : curves)
        for (const Point p : curve.points) range.include(p);
    if (options.y_range)
        std::tie(range.lower.y, range.upper.y) = std::tie((*options.y_range)[0], (*options.y_range)[1]);
    return {{{left_margin * unit, bottom_margin * unit}, {width - right_margin * unit, height - top_margin * unit}},
            make_axis(range.lower.x, range.upper.x),
            make_axis(range.lower.y, range.upper.y),
            options.y_downwards};
}

/// Calls mark(number, text) for the round numbers of an axis.
template <class F>
void for_each_number(const Axis& axis, F&& mark) {
    const double count = std::round((axis.upper - axis.lower) / axis.step);
    for (double i = 0; i <= count; ++i) {
        const double number = axis.lower + i * axis.step;
        mark(number, step_text(number, axis.step));
    }
}

void draw_axes(Canvas& canvas, const Frame& frame, const ChartOptions& options, double unit) {
    const double height = letter_height * unit;
    for_each_number(frame.x, [&](double number, const std::string& text) {
        const double x = frame.place({number, frame.y.lower}).x;
        canvas.stroke({x, frame.area.lower.y}, {x, frame.area.upper.y}, ink, grid_alpha, axis_width * unit);
        canvas.write({x, frame.area.lower.y - height}, text, height, ink, 0.5);
    });
    for_each_number(frame.y, [&](double number, const std::string& text) {
        const double y = frame.place({frame.x.lower, number}).y;
        canvas.stroke({frame.area.lower.x, y}, {frame.area.upper.x, y}, ink, number == 0 ? 1 : grid_alpha,
                      axis_width * unit);
        canvas.write({frame.area.lower.x - 0.5 * height, y}, text, height, ink, 1);
    });
    const auto corners = frame.area.corners();
    for (std::size_t i = 0; i < 4; ++i) canvas.stroke(corners[i], corners[(i + 1) % 4], ink, 1, axis_width * unit);
    canvas.write({frame.area.center().x, frame.area.lower.y - 2.6 * height}, options.x_label, height, ink, 0.5);
    canvas.write({0.5 * height, frame.area.upper.y + 1.2 * height}, options.y_label, height, ink, 0);
}

void draw_curves(Canvas& canvas, const Frame& frame, std::span<const ChartCurve> curves, double unit) {
    const double height = letter_height * unit;
    for (std::size_t i = 0; i < curves.size(); ++i) {
        const Color color = mix(distinct_color(static_cast<std::uint32_t>(i)), ink, 0.35);
        const double y = frame.area.upper.y - (1 + line_spacing * static_cast<double>(i)) * height;
        const double x = frame.area.upper.x - (mark_size + letter_height) * unit;
        canvas.stroke({x, y}, {x + mark_size * unit, y}, color, 1, curve_width * unit);
        canvas.write({x - 0.5 * height, y}, curves[i].name, height, ink, 1);
    }
    canvas.restrict_to(frame.area);
    for (std::size_t i = 0; i < curves.size(); ++i) {
        const Color color = mix(distinct_color(static_cast<std::uint32_t>(i)), ink, 0.35);
        const std::vector<Point>& points = curves[i].points;
        for (std::size_t k = 0; k + 1 < points.size(); ++k)
            canvas.stroke(frame.place(points[k]), frame.place(points[k + 1]), color, 1, curve_width * unit);
    }
}

}  // namespace

}  // namespace lamina::plot

namespace lamina {

using namespace plot;

void plot_chart(std::span<const ChartCurve> curves, const std::filesystem::path& file, const ChartOptions& options) {
    const double width = options.width_px, height = std::round(width * 2 / 3), unit = width / 1200;
    const Frame frame = make_frame(curves, options, unit, width, height);
    write_picture(file, options.format, width, height, [&](cairo_surface_t* surface) {
        Canvas canvas(surface, {{{0, 0}, {width, height}}, 1, width, height});
        canvas.paint(paper);
        draw_axes(canvas, frame, options, unit);
        draw_curves(canvas, frame, curves, unit);
    });
}

}  // namespace lamina
