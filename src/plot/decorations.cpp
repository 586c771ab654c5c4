#include "plot/decorations.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "plot/round_numbers.hpp"

namespace lamina::plot {

namespace {

constexpr double card_alpha = 0.85;

/// Calls mark(number, text) for the multiples of a step in an interval.
template <class F>
void for_each_multiple(double lower, double upper, double step, F&& mark) {
    for (double i = std::ceil(lower / step - 1e-9); i * step <= upper + 1e-9 * step; ++i)
        mark(i * step, step_text(i * step, step));
}

/// A rectangle with its upper right corner, or its lower right one, at a distance from that of the area.
struct Card {
    Box box;
    Point at(double px, double py, double scale) const { return box.lower + Point{px / scale, py / scale}; }
};

Card make_card(Canvas& canvas, const PictureView& view, double width, double height, double gap, bool at_top) {
    const double s = view.scale;
    const double right = view.area.upper.x - gap / s;
    const double lower = at_top ? view.area.upper.y - (gap + height) / s : view.area.lower.y + gap / s;
    const Card card{{{right - width / s, lower}, {right, lower + height / s}}};
    canvas.fill(card.box, paper, card_alpha);
    return card;
}

void draw_axes(Canvas& canvas, const PictureView& view, double text_height) {
    const Box& area = view.area;
    // The picture has whole pixels, and may reach beyond the window.
    const Point more{2 / view.scale, 2 / view.scale};
    const Box all{view.window.lower - more, view.window.upper + more};
    for (const Box& margin : {Box{all.lower, {area.lower.x, all.upper.y}}, Box{{area.upper.x, all.lower.y}, all.upper},
                              Box{all.lower, {all.upper.x, area.lower.y}}, Box{{all.lower.x, area.upper.y}, all.upper}})
        canvas.fill(margin, paper, 1);
    const double line = std::max(1.0, text_height / 16), tick = 0.4 * text_height / view.scale;
    const auto corners = area.corners();
    for (std::size_t i = 0; i < 4; ++i) canvas.stroke(corners[i], corners[(i + 1) % 4], ink, 1, line);
    // Long numbers need room beside each other.
    const double parts = std::clamp(area.width() * view.scale / (9 * text_height), 1.0, 8.0);
    for_each_multiple(area.lower.x, area.upper.x, round_step(area.width(), parts),
                      [&](double x, const std::string& text) {
                          canvas.stroke({x, area.lower.y}, {x, area.lower.y - tick}, ink, 1, line);
                          canvas.write({x, area.lower.y - 1.2 * text_height / view.scale}, text, text_height, ink, 0.5);
                      });
    const double rows = std::clamp(area.height() * view.scale / (4 * text_height), 1.0, 8.0);
    for_each_multiple(area.lower.y, area.upper.y, round_step(area.height(), rows),
                      [&](double y, const std::string& text) {
                          canvas.stroke({area.lower.x, y}, {area.lower.x - tick, y}, ink, 1, line);
                          canvas.write({area.lower.x - 0.6 * text_height / view.scale, y}, text, text_height, ink, 1);
                      });
}

void draw_scale_bar(Canvas& canvas, const PictureView& view, double text_height) {
    const double longest = std::min(0.2 * view.area.width(), 12 * text_height / view.scale);
    const double length = round_step(longest, 1), width = length * view.scale;
    const double inset = 0.7 * text_height, tick = 0.3 * text_height, line = std::max(1.5, text_height / 9);
    const double card_width = std::max(width, 5 * text_height) + 2 * inset;
    const Card card = make_card(canvas, view, card_width, 2.2 * text_height, inset, false);
    const auto at = [&](double px, double py) { return card.at(px, py, view.scale); };
    const double from = 0.5 * (card_width - width), to = from + width, y = 0.55 * text_height;
    canvas.stroke(at(from, y), at(to, y), ink, 1, line);
    for (const double end : {from, to}) canvas.stroke(at(end, y - tick), at(end, y + tick), ink, 1, line);
    canvas.write(at(0.5 * card_width, 1.5 * text_height), step_text(length, length), text_height, ink, 0.5);
}

void draw_color_bar(Canvas& canvas, const PictureView& view, const CellColors& colors, double text_height) {
    if (colors.quantity.empty()) return;
    constexpr int steps = 64, numbers = 4;
    const double inset = 0.7 * text_height, width = 17 * text_height, height = 3.8 * text_height;
    const Card card = make_card(canvas, view, width, height, inset, true);
    const auto at = [&](double px, double py) { return card.at(px, py, view.scale); };
    const double from = 1.8 * text_height, room = width - 3.6 * text_height;
    canvas.write(at(0.5 * width, height - 0.8 * text_height), colors.quantity, text_height, ink, 0.5);
    for (int i = 0; i < steps; ++i)
        canvas.fill(
            Box{at(from + room * i / steps, 1.35 * text_height), at(from + room * (i + 1) / steps, 2.35 * text_height)},
            viridis((i + 0.5) / steps), 1);
    for (int i = 0; i <= numbers; ++i) {
        const double value = colors.low + (colors.high - colors.low) * i / numbers;
        const std::string text =
            colors.logarithmic ? fmt::format("{:.1e}", std::pow(10, value)) : fmt::format("{:.3g}", value);
        canvas.write(at(from + room * i / numbers, 0.75 * text_height), text, 0.7 * text_height, ink, 0.5);
    }
}

}  // namespace

void draw_decorations(Canvas& canvas, const PictureView& view, const CellColors& colors, const PlotOptions& options) {
    const double text = text_height(options.width_px);
    if (options.axes) draw_axes(canvas, view, text);
    if (options.scale_bar) draw_scale_bar(canvas, view, text);
    if (options.color_bar) draw_color_bar(canvas, view, colors, text);
}

}  // namespace lamina::plot
