#include "pipeline/curve_mesh.hpp"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <lamina/error.hpp>

#include "core/lexicographic_order.hpp"
#include "mesh/cell_lattice.hpp"
#include "pipeline/assemble.hpp"
#include "pipeline/close_sheets.hpp"

namespace lamina::pipeline {

namespace {

using surface::CurvedEdge;

constexpr const char* sheets_are_straight = "sheets have straight cells: leave --order out";

/// The curves of walls, by whether the mesh follows them.
struct CurvesByEdges {
    std::vector<mesh::WallCurve> walls;  ///< the stretches of curves between the vertices of the mesh
    std::vector<std::size_t> straight;   ///< numbers of edges between two vertices, of which a part is beside the curve
};

/// Finds the edges of the mesh between two points of the same curve.
CurvesByEdges curves_by_edges(const surface::WallCurves& curves, const mesh::CellOrder& order, const Mesh& mesh) {
    constexpr double rounding = 1e-9;
    const core::LexicographicOrder precedes;
    const std::span<const CurvedEdge> edges = curves.edges();
    std::vector<double> followed(edges.size());
    std::vector<Point> vertices;
    CurvesByEdges by_edges;
    for (const Marker& marker : mesh.markers) {
        if (marker.kind != MarkerKind::wall) continue;
        for (const Segment& edge : marker.edges) {
            // The body is on the left of its outline, and the mesh on that of the marker.
            const Point begin = mesh.points[edge.b.index()], end = mesh.points[edge.a.index()];
            vertices.insert(vertices.end(), {begin, end});
            const std::optional<surface::CurveStretch> stretch = curves.between(begin, end);
            if (!stretch) continue;
            followed[static_cast<std::size_t>(stretch->edge - edges.data())] += stretch->to - stretch->from;
            mesh::WallCurve& wall = by_edges.walls.emplace_back(mesh::WallCurve{edge, {}});
            for (unsigned k = 2 * order.order - 1; k > 0; --k)
                wall.between.push_back(stretch->at(mesh::half_step_on_edge(order.order, k, order.distribution)));
        }
    }
    // Edges below a line of symmetry are in no mesh, nor are those whose ends were moved back to given points.
    std::sort(vertices.begin(), vertices.end(), precedes);
    const auto is_vertex = [&](Point p) { return std::binary_search(vertices.begin(), vertices.end(), p, precedes); };
    for (std::size_t e = 0; e < edges.size(); ++e)
        if (followed[e] < 1 - rounding && curves.bend(e) > 0 && is_vertex(edges[e].begin) && is_vertex(edges[e].end))
            by_edges.straight.push_back(e);
    return by_edges;
}

/// Returns the number of the edges of elements: other walls are the ground, and lines with two sides.
std::size_t edges_of_elements(const Geometry& geometry, const Mesh& mesh) {
    std::vector<std::string> names = base_marker_names(geometry);
    for (const Element& element : geometry.elements) {
        names.push_back(element.name);
        for (const WallPart& part : element.parts) names.push_back(part.name);
    }
    std::size_t edges = 0;
    for (const Marker& marker : mesh.markers)
        if (std::find(names.begin(), names.end(), marker.name) != names.end()) edges += marker.edges.size();
    return edges;
}

/// Counts the edges with straight parts beside the curve among those of smaller bend, and warns of them.
void report_straight_edges(const surface::WallCurves& curves, std::span<const std::size_t> straight,
                           MeshResult& result) {
    if (straight.empty()) return;
    const std::size_t worst = *std::max_element(straight.begin(), straight.end(), [&](std::size_t a, std::size_t b) {
        return curves.bend(a) < curves.bend(b);
    });
    const Point at = midpoint(curves.edges()[worst].begin, curves.edges()[worst].end);
    result.curving.reduced_edges += straight.size();
    result.curving.reduced_distance = std::max(result.curving.reduced_distance, curves.bend(worst));
    result.warnings.push_back(
        {.code = WarningCode::surface_not_as_asked,
         .at = at,
         .number = static_cast<double>(straight.size()),
         .unit = "wall edges",
         .message =
             fmt::format("{} divided beside the curve of the wall, lest walls cross: the parts are straight, up to "
                         "{:.2g} off it (at "
                         "({:.6g}, {:.6g})): --surface resample or more --surface-points make edges short enough",
                         straight.size() == 1 ? "1 wall edge was" : fmt::format("{} wall edges were", straight.size()),
                         curves.bend(worst), at.x, at.y)});
}

}  // namespace

void validate_order(const CaseOptions& options) {
    const auto refuse = [](const char* reason) { throw OptionError("order", reason); };
    if (options.order == 1 && options.node_distribution != NodeDistribution::equidistant)
        throw OptionError("node_distribution", "straight cells have no nodes: give an --order");
    if (options.order == 1) return;
    if (options.layer.enabled && options.layer.topology == LayerTopology::delaunay)
        refuse("curved cells stand in columns: take --layer-topology quads or layered");
    if (options.far_field.pitch)
        refuse("the borders of a row of blades match with straight cells alone: leave --order out");
    if (!options.geometry.sheets.empty()) refuse(sheets_are_straight);
}

void refuse_curved_sheets(unsigned order, const Geometry& geometry) {
    if (order > 1 && has_sheets(geometry)) throw OptionError("order", sheets_are_straight);
}

void curve_mesh(const mesh::CellOrder& order, const surface::WallCurves& curves, MeshResult& result) {
    if (result.layer_grid_refused)
        throw MeshError("the cells of the layer form no columns, which curved cells need: leave the order out");
    const CurvesByEdges by_edges = curves_by_edges(curves, order, result.mesh);
    mesh::CurvedCells curved = mesh::curve_cells(result.mesh, order, by_edges.walls, {result.columns});
    result.curved = std::move(curved.nodes);
    result.curving = curved.summary;
    result.curved_check = std::move(curved.check);
    result.curving.wall_edges = edges_of_elements(result.geometry, result.mesh);
    report_straight_edges(curves, by_edges.straight, result);
}

}  // namespace lamina::pipeline
