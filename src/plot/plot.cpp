// Pictures of meshes by Cairo.
#include <cairo.h>

#include <algorithm>
#include <cmath>
#include <tuple>
#include <vector>

#include <lamina/plot.hpp>

#include "mesh/quality.hpp"
#include "plot/canvas.hpp"
#include "plot/color.hpp"
#include "plot/picture_file.hpp"
#include "plot/view.hpp"

namespace lamina::plot {

namespace fs = std::filesystem;

namespace {

constexpr Color background{0.88, 0.89, 0.90};
constexpr Color white{1, 1, 1};
constexpr Color layer_tint{0.86, 0.92, 0.99};
constexpr Color thin_edge{0.13, 0.16, 0.22};
constexpr Color wall_edge{0.72, 0.08, 0.12};
constexpr Color far_edge{0.13, 0.16, 0.22};

// Widths and thicknesses in pixels.
constexpr double edge_width = 0.6;
constexpr double wall_width = 2.0;
constexpr double far_width = 1.2;
constexpr double min_outlined_thickness = 0.5;  ///< thinner cells are filled instead of outlined

// --- Colours of cells

/// Returns the logarithm of the side of a square with the area of the cell.
double log_size(const VisibleCell& c) { return 0.5 * std::log10(std::max(c.area(), 1e-300)); }

double min_angle_deg(const VisibleCell& c) {
    return c.corners == 3 ? core::measure_triangle(c.corner[0], c.corner[1], c.corner[2]).min_angle_deg
                          : mesh::measure_quad(c.corner[0], c.corner[1], c.corner[2], c.corner[3]).min_angle_deg;
}

void scale_to_range(std::vector<double>& values) {
    if (values.empty()) return;
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    const double from = *low, range = std::max(*high - *low, 1e-9);
    for (double& v : values) v = (v - from) / range;
}

/// Returns for each cell its position on the scale of colours, from 0 to 1. The scales of size and layer span the cells
/// in view.
std::vector<double> scale_positions(const Mesh& mesh, const std::vector<VisibleCell>& cells, PlotColor by) {
    std::vector<double> values(cells.size(), 0.0);
    for (std::size_t i = 0; i < cells.size(); ++i) {
        if (by == PlotColor::size) values[i] = log_size(cells[i]);
        if (by == PlotColor::layer && !mesh.layer.empty()) values[i] = mesh.layer[cells[i].cell];
        // Angles of isotropic triangles reach 60 degrees, which is the end of the scale; squares look alike.
        if (by == PlotColor::quality) values[i] = min_angle_deg(cells[i]) / 60;
    }
    if (by == PlotColor::size) scale_to_range(values);
    if (by == PlotColor::layer && !values.empty()) {
        const double layers = std::max(1.0, *std::max_element(values.begin(), values.end()));
        for (double& v : values) v /= layers;
    }
    return values;
}

Color cell_color(const Mesh& mesh, std::size_t cell, PlotColor by, double position) {
    switch (by) {
        case PlotColor::quality:
        case PlotColor::size:
            return viridis(position);
        case PlotColor::piece:
            return mesh.piece.empty() ? white : distinct_color(mesh.piece[cell]);
        case PlotColor::layer:
            return position == 0 ? white : viridis(position);
        case PlotColor::none:
            break;
    }
    return !mesh.region.empty() && mesh.region[cell] == Region::layer ? layer_tint : white;
}

std::vector<Color> cell_colors(const Mesh& mesh, const std::vector<VisibleCell>& cells, PlotColor by) {
    const std::vector<double> positions = scale_positions(mesh, cells, by);
    std::vector<Color> colors;
    colors.reserve(cells.size());
    for (std::size_t i = 0; i < cells.size(); ++i) colors.push_back(cell_color(mesh, cells[i].cell, by, positions[i]));
    return colors;
}

// --- Drawing

/// Fills the cells. If with_grey is set, cells so thin that their edges would merge into a blot get the grey into which
/// edges fade.
void draw_cells(Canvas& canvas, const std::vector<VisibleCell>& cells, const std::vector<Color>& colors,
                const PictureView& view, bool with_grey) {
    for (std::size_t i = 0; i < cells.size(); ++i) {
        const bool too_thin = with_grey && cells[i].thickness() * view.scale < min_outlined_thickness;
        canvas.fill(cells[i], too_thin ? mix(colors[i], thin_edge, 0.4) : colors[i]);
    }
}

/// Draws each edge once, and fainter where the cells beside it are thin.
void draw_edges(Canvas& canvas, const Mesh& mesh, const std::vector<VisibleCell>& cells, const PictureView& view,
                double max_alpha) {
    struct VisibleEdge {
        Segment ends;
        float thickness;  ///< of the thinner one of its cells, in pixels
    };
    std::vector<VisibleEdge> edges;
    for (const VisibleCell& cell : cells) {
        const auto thickness = static_cast<float>(cell.thickness() * view.scale);
        if (thickness < min_outlined_thickness) continue;
        for (std::size_t i = 0; i < cell.corners; ++i) {
            const VertexId a = cell.vertex[i], b = cell.vertex[(i + 1) % cell.corners];
            edges.push_back({{std::min(a, b), std::max(a, b)}, thickness});
        }
    }
    std::sort(edges.begin(), edges.end(), [](const VisibleEdge& e, const VisibleEdge& f) {
        return std::tie(e.ends, e.thickness) < std::tie(f.ends, f.thickness);
    });
    for (std::size_t i = 0; i < edges.size(); ++i) {
        if (i > 0 && edges[i].ends == edges[i - 1].ends) continue;
        const auto [a, b] = edges[i].ends;
        const double alpha = max_alpha * std::min(1.0, 0.5 * edges[i].thickness / edge_width);
        canvas.stroke(mesh.points[a.index()], mesh.points[b.index()], thin_edge, alpha, edge_width);
    }
}

void draw_markers(Canvas& canvas, const Mesh& mesh) {
    for (const Marker& marker : mesh.markers) {
        const bool far = marker.kind == MarkerKind::far_field;
        for (const Segment& edge : marker.edges)
            canvas.stroke(mesh.points[edge.a.index()], mesh.points[edge.b.index()], far ? far_edge : wall_edge, 1,
                          far ? far_width : wall_width);
    }
}

void draw(cairo_surface_t* surface, const Mesh& mesh, const PictureView& view, PlotColor by) {
    const std::vector<VisibleCell> cells = visible_cells(mesh, view.window);
    const bool colored = by != PlotColor::none;
    Canvas canvas(surface, view);
    canvas.paint(background);
    draw_cells(canvas, cells, cell_colors(mesh, cells, by), view, !colored);
    draw_edges(canvas, mesh, cells, view, colored ? 0.45 : 1);
    draw_markers(canvas, mesh);
}

}  // namespace

}  // namespace lamina::plot

namespace lamina {

using namespace plot;

void plot_mesh(const Mesh& mesh, const fs::path& file, const PlotOptions& options) {
    validate(options);
    check_picture_format(file, options.format);
    const PictureView view = make_view(mesh, options);
    write_picture(file, options.format, view.width, view.height,
                  [&](cairo_surface_t* surface) { draw(surface, mesh, view, options.color); });
}

}  // namespace lamina
