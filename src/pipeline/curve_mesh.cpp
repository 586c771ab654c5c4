#include "pipeline/curve_mesh.hpp"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <lamina/error.hpp>

#include "core/lexicographic_order.hpp"
#include "core/segments.hpp"
#include "mesh/curve_cells.hpp"
#include "pipeline/assemble.hpp"
#include "pipeline/close_sheets.hpp"

namespace lamina::pipeline {

namespace {

using surface::CurvedEdge;

constexpr const char* sheets_are_straight = "sheets have straight cells";

/// The curves of walls, by whether the mesh has their edges.
struct CurvesByEdges {
    std::vector<mesh::WallCurve> walls;      ///< the curves of edges of the mesh
    std::vector<const CurvedEdge*> divided;  ///< those whose ends alone are in it: they were divided afterwards
};

/// Finds the edges of the mesh that stand between the same two points as an edge that has a curve.
CurvesByEdges curves_by_edges(std::span<const CurvedEdge> given, const Mesh& mesh) {
    std::vector<const CurvedEdge*> curves;
    for (const CurvedEdge& edge : given) curves.push_back(&edge);
    const core::LexicographicOrder precedes;
    const auto less = [&](const CurvedEdge* a, const CurvedEdge* b) {
        return a->begin == b->begin ? precedes(a->end, b->end) : precedes(a->begin, b->begin);
    };
    std::sort(curves.begin(), curves.end(), less);
    std::vector<bool> is_found(curves.size());
    std::vector<Point> vertices;
    CurvesByEdges by_edges;
    for (const Marker& marker : mesh.markers) {
        if (marker.kind != MarkerKind::wall) continue;
        for (const Segment& edge : marker.edges) {
            // The body is on the left of its outline, and the mesh on that of the marker.
            const CurvedEdge wanted{mesh.points[edge.b.index()], mesh.points[edge.a.index()], {}};
            vertices.insert(vertices.end(), {wanted.begin, wanted.end});
            const auto found = std::lower_bound(curves.begin(), curves.end(), &wanted, less);
            if (found == curves.end() || less(&wanted, *found)) continue;
            is_found[static_cast<std::size_t>(found - curves.begin())] = true;
            by_edges.walls.push_back({edge, {(*found)->between.rbegin(), (*found)->between.rend()}});
        }
    }
    // Edges below a line of symmetry are in no mesh, nor are those whose ends were moved back to given points.
    std::sort(vertices.begin(), vertices.end(), precedes);
    const auto is_vertex = [&](Point p) { return std::binary_search(vertices.begin(), vertices.end(), p, precedes); };
    for (std::size_t c = 0; c < curves.size(); ++c)
        if (!is_found[c] && is_vertex(curves[c]->begin) && is_vertex(curves[c]->end))
            by_edges.divided.push_back(curves[c]);
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

/// Returns how far a curve is off its chord; 0 where that is rounding alone.
double bend_of(const CurvedEdge& edge) {
    double bend = 0;
    for (const Point p : edge.between) bend = std::max(bend, core::distance_to_segment(p, edge.begin, edge.end));
    return bend > 0x1p-48 * (length(edge.begin) + length(edge.end)) ? bend : 0;
}

/// Counts the edges that were divided among those of smaller bend, since their parts are straight, and warns of them.
void report_divided_edges(std::span<const CurvedEdge* const> divided, MeshResult& result) {
    std::size_t count = 0;
    double largest = 0;
    Point at{};
    for (const CurvedEdge* edge : divided) {
        const double bend = bend_of(*edge);
        count += bend > 0;
        if (bend <= largest) continue;
        largest = bend;
        at = midpoint(edge->begin, edge->end);
    }
    if (count == 0) return;
    result.curving.reduced_edges += count;
    result.curving.reduced_distance = std::max(result.curving.reduced_distance, largest);
    result.warnings.push_back(
        {.code = WarningCode::surface_not_as_asked,
         .at = at,
         .number = static_cast<double>(count),
         .unit = "wall edges",
         .message = fmt::format(
             "{} divided after the walls were prepared: the parts are straight, up to {:.2g} off the curve (at "
             "({:.6g}, {:.6g})): --surface resample or more --surface-points make edges short enough",
             count == 1 ? "1 wall edge was" : fmt::format("{} wall edges were", count), largest, at.x, at.y)});
}

}  // namespace

void validate_order(const CaseOptions& options) {
    const auto refuse = [](const char* reason) { throw OptionError("order", reason); };
    if (options.order == 1) return;
    if (options.layer.enabled && options.layer.topology == LayerTopology::delaunay)
        refuse("curved cells stand in columns: take --layer-topology quads or layered");
    if (options.far_field.pitch) refuse("the borders of a row of blades match with straight cells alone");
    if (!options.geometry.sheets.empty()) refuse(sheets_are_straight);
}

void refuse_curved_sheets(unsigned order, const Geometry& geometry) {
    if (order > 1 && has_sheets(geometry)) throw OptionError("order", sheets_are_straight);
}

void curve_mesh(unsigned order, std::span<const CurvedEdge> curves, MeshResult& result) {
    if (result.layer_grid_refused)
        throw MeshError("the cells of the layer form no columns, which curved cells need: leave the order out");
    const CurvesByEdges by_edges = curves_by_edges(curves, result.mesh);
    mesh::CurvedCells curved = mesh::curve_cells(result.mesh, order, by_edges.walls, {result.columns});
    result.curved = std::move(curved.nodes);
    result.curving = curved.summary;
    result.curved_check = std::move(curved.check);
    result.curving.wall_edges = edges_of_elements(result.geometry, result.mesh);
    report_divided_edges(by_edges.divided, result);
}

}  // namespace lamina::pipeline
