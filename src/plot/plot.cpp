// Pictures of meshes by Cairo.
#include <cairo.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

#include <lamina/error.hpp>
#include <lamina/plot.hpp>

#include "mesh/periodic.hpp"
#include "plot/canvas.hpp"
#include "plot/color.hpp"
#include "plot/color_scale.hpp"
#include "plot/decorations.hpp"
#include "plot/drawn_edges.hpp"
#include "plot/picture_file.hpp"
#include "plot/view.hpp"

namespace lamina::plot {

namespace fs = std::filesystem;

namespace {

constexpr Color background{0.88, 0.89, 0.90};
constexpr Color wall_edge{0.72, 0.08, 0.12};

// Thicknesses in pixels.
constexpr double min_outlined_thickness = 0.5;  ///< thinner cells are filled instead of outlined
constexpr double min_drawn_thickness = 1;       ///< in vector graphics, many thinner cells become part of an image
constexpr std::size_t many_cells = 1000;

/// The widths of lines in pixels.
struct LineWidths {
    double edge, wall, far;
};

// --- Drawing

/// Returns the widths of lines, which follow the zoom: lines are wider where edges are long.
LineWidths line_widths(const std::vector<VisibleCell>& cells, const PictureView& view) {
    std::vector<double> lengths;
    for (const VisibleCell& cell : cells)
        if (cell.thickness() * view.scale >= min_outlined_thickness)
            lengths.push_back(distance(cell.corner[0], cell.corner[1]) * view.scale);
    const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
    std::nth_element(lengths.begin(), middle, lengths.end());
    // Large pictures are looked at from farther away.
    const double unit = std::max(1.0, std::max(view.width, view.height) / 1600);
    const double edge = unit * std::clamp(0.012 * (lengths.empty() ? 50.0 : *middle), 0.45, 1.5);
    return {edge, std::clamp(3.3 * edge, 1.6 * unit, 4 * unit), 2 * edge};
}

/// Returns the share of its full width and ink that an edge keeps where the thinner one of its cells is so thin: as
/// much as lets the edges of many such cells side by side cover half of the paper, however thin they are.
double kept_share(double thickness, double width) { return std::min(1.0, 0.5 * thickness / width); }

/// Returns the share of a thin cell that its edges would cover. Half of each is the neighbour's.
double covered_share(const VisibleCell& cell, const PictureView& view, double width) {
    double length = 0;
    for (std::size_t i = 0; i < cell.corners; ++i)
        length += distance(cell.corner[i], cell.corner[(i + 1) % cell.corners]);
    const double drawn = width * kept_share(cell.thickness() * view.scale, width) / view.scale;
    return cell.area() > 0 ? std::min(0.5 * length * drawn / cell.area(), 1.0) : 0;
}

/// Returns the border of a cell, counter-clockwise.
std::vector<Point> border_of(const VisibleCell& cell, const DrawnEdges& edges) {
    std::vector<Point> border;
    for (std::size_t i = 0; i < cell.corners; ++i) {
        const DrawnEdge edge = edges.of_cell(cell, i);
        border.insert(border.end(), edge.line().begin(), edge.line().end() - 1);
    }
    return border;
}

void stroke_edge(Canvas& canvas, const DrawnEdge& edge, Color color, double alpha, double width) {
    for (std::size_t k = 0; k + 1 < edge.count; ++k)
        canvas.stroke(edge.points[k], edge.points[k + 1], color, alpha, width);
}

/// Cells that are drawn in the same way.
struct DrawnCells {
    std::vector<VisibleCell> cells;
    std::vector<Color> colors;
};

/// Fills the cells. If with_grey is set, cells so thin that their edges would merge into a blot get the grey of the ink
/// that their edges have on the whole, so that no pale line lies between them and thicker ones.
void draw_cells(Canvas& canvas, const DrawnCells& drawn, const DrawnEdges& edges, const PictureView& view,
                bool with_grey, double width) {
    for (std::size_t i = 0; i < drawn.cells.size(); ++i) {
        const VisibleCell& cell = drawn.cells[i];
        const Color color = drawn.colors[i];
        const bool too_thin = with_grey && cell.thickness() * view.scale < min_outlined_thickness;
        canvas.fill(border_of(cell, edges), too_thin ? mix(color, ink, covered_share(cell, view, width)) : color);
    }
}

/// Draws each edge once, and fainter where the cells beside it are thin.
void draw_edges(Canvas& canvas, const DrawnEdges& drawn, const std::vector<VisibleCell>& cells, const PictureView& view,
                double width, double max_alpha) {
    struct VisibleEdge {
        Segment ends;
        float thickness;  ///< of the thinner one of its cells, in pixels
        unsigned edge;    ///< of the cell
        std::size_t cell;
    };
    std::vector<VisibleEdge> edges;
    for (std::size_t c = 0; c < cells.size(); ++c) {
        const VisibleCell& cell = cells[c];
        const auto thickness = static_cast<float>(cell.thickness() * view.scale);
        if (thickness < min_outlined_thickness) continue;
        for (unsigned i = 0; i < cell.corners; ++i) {
            const VertexId a = cell.vertex[i], b = cell.vertex[(i + 1) % cell.corners];
            edges.push_back({{std::min(a, b), std::max(a, b)}, thickness, i, c});
        }
    }
    std::sort(edges.begin(), edges.end(), [](const VisibleEdge& e, const VisibleEdge& f) {
        return std::tie(e.ends, e.thickness, e.cell) < std::tie(f.ends, f.thickness, f.cell);
    });
    for (std::size_t i = 0; i < edges.size(); ++i) {
        if (i > 0 && edges[i].ends == edges[i - 1].ends) continue;
        const double alpha = max_alpha * kept_share(edges[i].thickness, width);
        stroke_edge(canvas, drawn.of_cell(cells[edges[i].cell], edges[i].edge), ink, alpha, width);
    }
}

void draw_markers(Canvas& canvas, const Mesh& mesh, const DrawnEdges& edges, const LineWidths& widths) {
    std::size_t number = 0;
    for (const Marker& marker : mesh.markers) {
        const bool far = marker.kind == MarkerKind::far_field;
        for (const Segment& edge : marker.edges)
            stroke_edge(canvas, edges.of_marker(edge, number++), far ? ink : wall_edge, 1,
                        far ? widths.far : widths.wall);
    }
}

/// Draws a dot at each vertex of outlines without cells that is not too near to the one before.
void draw_dots(Canvas& canvas, const Mesh& mesh, const PictureView& view, double radius) {
    for (const Marker& marker : mesh.markers) {
        std::optional<Point> last;
        for (const Segment& edge : marker.edges) {
            const Point at = mesh.points[edge.a.index()];
            if (last && distance(at, *last) * view.scale < 2.5 * radius) continue;
            canvas.dot(at, radius, ink);
            last = at;
        }
    }
}

/// Takes the cells away that are too small to be told apart, if there are many of them.
DrawnCells take_small_cells(DrawnCells& drawn, const PictureView& view) {
    DrawnCells small, large;
    for (std::size_t i = 0; i < drawn.cells.size(); ++i) {
        DrawnCells& part = drawn.cells[i].thickness() * view.scale < min_drawn_thickness ? small : large;
        part.cells.push_back(drawn.cells[i]);
        part.colors.push_back(drawn.colors[i]);
    }
    if (small.cells.size() < many_cells) return {};
    drawn = std::move(large);
    return small;
}

void draw_drawn_cells(Canvas& canvas, const DrawnEdges& edges, const DrawnCells& drawn, const PictureView& view,
                      bool colored, double edge_width) {
    draw_cells(canvas, drawn, edges, view, !colored, edge_width);
    draw_edges(canvas, edges, drawn.cells, view, edge_width, colored ? 0.45 : 1);
}

void draw(cairo_surface_t* surface, const Mesh& mesh, const CurvedNodes& nodes, const PictureView& view,
          const PlotOptions& options) {
    const DrawnEdges edges(mesh, nodes);
    const std::vector<VisibleCell> cells = visible_cells(mesh, view.window, nodes);
    const CellColors colors = color_cells(mesh, cells, options.color);
    const LineWidths widths = line_widths(cells, view);
    const bool colored = options.color != PlotColor::none;
    const bool has_cells = !mesh.triangles.empty() || !mesh.quads.empty();
    Canvas canvas(surface, view);
    canvas.paint(has_cells ? background : paper);
    DrawnCells drawn{cells, colors.colors};
    if (cairo_surface_get_type(surface) != CAIRO_SURFACE_TYPE_IMAGE)
        if (const DrawnCells small = take_small_cells(drawn, view); !small.cells.empty())
            draw_on_image(canvas, view,
                          [&](Canvas& image) { draw_drawn_cells(image, edges, small, view, colored, widths.edge); });
    draw_drawn_cells(canvas, edges, drawn, view, colored, widths.edge);
    draw_markers(canvas, mesh, edges, widths);
    if (!has_cells) draw_dots(canvas, mesh, view, 1.2 * widths.wall);
    draw_decorations(canvas, view, colors, options);
}

}  // namespace

}  // namespace lamina::plot

namespace lamina {

using namespace plot;

void plot_mesh(const Mesh& mesh, const fs::path& file, const PlotOptions& options) {
    plot_mesh(mesh, {}, file, options);
}

void plot_mesh(const Mesh& one, const CurvedNodes& nodes, const fs::path& file, const PlotOptions& options) {
    validate(options);
    if (nodes.order > 1 && options.repeat > 1) throw UsageError("option repeat: curved cells are drawn once");
    check_picture_format(file, options.format);
    const Mesh copies = options.repeat > 1 ? mesh::joined_copies(one, options.repeat) : Mesh{};
    const Mesh& mesh = options.repeat > 1 ? copies : one;
    const PictureView view = make_view(mesh, options);
    write_picture(file, options.format, view.width, view.height,
                  [&](cairo_surface_t* surface) { draw(surface, mesh, nodes, view, options); });
}

}  // namespace lamina
