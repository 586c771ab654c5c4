// Pictures of numbers at the vertices of a mesh.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

#include <lamina/error.hpp>
#include <lamina/plot.hpp>

#include "plot/canvas.hpp"
#include "plot/color.hpp"
#include "plot/color_scale.hpp"
#include "plot/decorations.hpp"
#include "plot/picture_file.hpp"
#include "plot/view.hpp"

namespace lamina::plot {

namespace {

/// Colours change from one part of a triangle to the next, whose edges are this long, in pixels.
constexpr double part_size = 3;
constexpr int most_parts = 64;  // per edge
constexpr double line_width = 1.5;

/// A triangle with a number at each corner.
struct ValuedTriangle {
    std::array<Point, 3> corner;
    std::array<double, 3> value;
};

/// Returns the triangles in view, and halves of quads.
std::vector<ValuedTriangle> valued_triangles(const Mesh& mesh, const std::vector<VisibleCell>& cells,
                                             const std::vector<double>& values) {
    std::vector<ValuedTriangle> triangles;
    for (const VisibleCell& cell : cells)
        for (std::size_t second = 1; second + 1 < cell.corners; ++second) {
            ValuedTriangle& t = triangles.emplace_back();
            const std::array<std::size_t, 3> corners{0, second, second + 1};
            for (std::size_t k = 0; k < 3; ++k) {
                t.corner[k] = mesh.points[cell.vertex[corners[k]].index()];
                t.value[k] = values[cell.vertex[corners[k]].index()];
            }
        }
    return triangles;
}

CellColors scale_of(const PlotField& field, const std::vector<ValuedTriangle>& triangles) {
    CellColors scale;
    scale.quantity = field.name;
    scale.low = HUGE_VAL;
    scale.high = -HUGE_VAL;
    for (const ValuedTriangle& t : triangles)
        for (const double value : t.value) {
            scale.low = std::min(scale.low, value);
            scale.high = std::max(scale.high, value);
        }
    if (!(scale.high > scale.low)) scale = {{}, field.name, 0, 1};
    return scale;
}

/// Fills a triangle in parts, in each of which the number is that of its middle.
void fill(Canvas& canvas, const ValuedTriangle& t, const CellColors& scale, double pixels_per_unit) {
    double longest = 0;
    for (std::size_t k = 0; k < 3; ++k)
        longest = std::max(longest, distance(t.corner[k], t.corner[(k + 1) % 3]) * pixels_per_unit);
    const int parts =
        static_cast<int>(std::clamp(std::ceil(longest / part_size), 1.0, static_cast<double>(most_parts)));
    const auto at = [&](double i, double j) {
        const double u = i / parts, v = j / parts;
        return t.corner[0] + u * (t.corner[1] - t.corner[0]) + v * (t.corner[2] - t.corner[0]);
    };
    const auto fill_part = [&](double i, double j,
                               double step) {  // the middle is a third of a step away from the corner
        const double u = (i + step / 3) / parts, v = (j + step / 3) / parts;
        const double value = t.value[0] + u * (t.value[1] - t.value[0]) + v * (t.value[2] - t.value[0]);
        const VisibleCell part{0, 3, {}, {at(i, j), at(i + step, j), at(i, j + step), {}}};
        canvas.fill({part.corner.begin(), part.corner.begin() + static_cast<long>(part.corners)},
                    viridis((value - scale.low) / (scale.high - scale.low)));
    };
    for (int i = 0; i < parts; ++i)
        for (int j = 0; i + j < parts; ++j) {
            fill_part(i, j, 1);
            if (i + j + 1 < parts) fill_part(i + 1, j + 1, -1);
        }
}

/// Draws the edges of a triangle, since pixels where many triangles meet may lie in none.
void underlay(Canvas& canvas, const ValuedTriangle& t, const CellColors& scale) {
    const double mean = (t.value[0] + t.value[1] + t.value[2]) / 3;
    for (std::size_t k = 0; k < 3; ++k)
        canvas.stroke(t.corner[k], t.corner[(k + 1) % 3], viridis((mean - scale.low) / (scale.high - scale.low)), 1, 1);
}

/// Draws the part of a line of one value within a triangle.
void stroke_line(Canvas& canvas, const ValuedTriangle& t, double value, double width) {
    std::vector<Point> ends;
    for (std::size_t k = 0; k < 3; ++k) {
        const double a = t.value[k], b = t.value[(k + 1) % 3];
        if ((a < value) == (b < value)) continue;
        ends.push_back(t.corner[k] + (value - a) / (b - a) * (t.corner[(k + 1) % 3] - t.corner[k]));
    }
    if (ends.size() == 2) canvas.stroke(ends[0], ends[1], ink, 1, width);
}

/// Draws the edges that belong to one cell alone.
void stroke_boundary(Canvas& canvas, const Mesh& mesh, const std::vector<VisibleCell>& cells, double width) {
    std::vector<Segment> edges;
    for (const VisibleCell& cell : cells)
        for (std::size_t k = 0; k < cell.corners; ++k) {
            const VertexId a = cell.vertex[k], b = cell.vertex[(k + 1) % cell.corners];
            edges.push_back({std::min(a, b), std::max(a, b)});
        }
    std::sort(edges.begin(), edges.end());
    for (std::size_t i = 0; i < edges.size(); ++i) {
        const bool is_shared =
            (i > 0 && edges[i - 1] == edges[i]) || (i + 1 < edges.size() && edges[i + 1] == edges[i]);
        if (!is_shared) canvas.stroke(mesh.points[edges[i].a.index()], mesh.points[edges[i].b.index()], ink, 1, width);
    }
}

void draw(cairo_surface_t* surface, const Mesh& mesh, const PlotField& field, const PictureView& view,
          const PlotOptions& options) {
    const std::vector<VisibleCell> cells = visible_cells(mesh, view.window);
    const std::vector<ValuedTriangle> triangles = valued_triangles(mesh, cells, field.values);
    const CellColors scale = scale_of(field, triangles);
    Canvas canvas(surface, view);
    canvas.paint(paper);
    const auto fill_all = [&](Canvas& on) {
        for (const ValuedTriangle& t : triangles) underlay(on, t, scale);
        for (const ValuedTriangle& t : triangles) fill(on, t, scale, view.scale);
    };
    if (cairo_surface_get_type(surface) == CAIRO_SURFACE_TYPE_IMAGE)
        fill_all(canvas);
    else
        draw_on_image(canvas, view, fill_all);
    const double width = line_width * std::max(1.0, options.width_px / 1600.0);
    if (field.line)
        for (const ValuedTriangle& t : triangles) stroke_line(canvas, t, *field.line, width);
    stroke_boundary(canvas, mesh, cells, width);
    draw_decorations(canvas, view, scale, options);
}

}  // namespace

}  // namespace lamina::plot

namespace lamina {

using namespace plot;

void plot_field(const Mesh& mesh, const PlotField& field, const std::filesystem::path& file,
                const PlotOptions& options) {
    validate(options);
    check_picture_format(file, options.format);
    if (field.values.size() != mesh.points.size()) throw UsageError("a field has one number per vertex of the mesh");
    const PictureView view = make_view(mesh, options);
    write_picture(file, options.format, view.width, view.height,
                  [&](cairo_surface_t* surface) { draw(surface, mesh, field, view, options); });
}

}  // namespace lamina
