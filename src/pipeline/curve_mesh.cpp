#include "pipeline/curve_mesh.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <lamina/error.hpp>

#include "core/lexicographic_order.hpp"
#include "mesh/curve_cells.hpp"
#include "pipeline/close_sheets.hpp"

namespace lamina::pipeline {

namespace {

/// Returns the curves of all edges of the mesh that stand between the same two points as an edge of a wall. Edges that were
/// divided after the walls were prepared are straight.
std::vector<mesh::WallCurve> curves_of_walls(std::span<const surface::CurvedEdge> given, const Mesh& mesh) {
    using surface::CurvedEdge;
    std::vector<const CurvedEdge*> curves;
    for (const CurvedEdge& edge : given) curves.push_back(&edge);
    const core::LexicographicOrder precedes;
    const auto less = [&](const CurvedEdge* a, const CurvedEdge* b) {
        return a->begin == b->begin ? precedes(a->end, b->end) : precedes(a->begin, b->begin);
    };
    std::sort(curves.begin(), curves.end(), less);
    std::vector<mesh::WallCurve> walls;
    for (const Marker& marker : mesh.markers) {
        if (marker.kind != MarkerKind::wall) continue;
        for (const Segment& edge : marker.edges) {
            // The body is on the left of its outline, and the mesh on that of the marker.
            const CurvedEdge wanted{mesh.points[edge.b.index()], mesh.points[edge.a.index()], {}};
            const auto found = std::lower_bound(curves.begin(), curves.end(), &wanted, less);
            if (found == curves.end() || less(&wanted, *found)) continue;
            walls.push_back({edge, {(*found)->between.rbegin(), (*found)->between.rend()}});
        }
    }
    return walls;
}

}  // namespace

void validate_order(const CaseOptions& options) {
    const auto refuse = [](const char* reason) { throw OptionError("order", reason); };
    if (options.order < 1 || options.order > max_cell_order) refuse("must be from 1 to 4");
    if (options.order == 1) return;
    if (options.layer.enabled && options.layer.topology == LayerTopology::delaunay)
        refuse("curved cells stand in columns: take --layer-topology quads or layered");
    if (options.far_field.pitch) refuse("the borders of a row of blades match with straight cells alone");
    if (!options.geometry.sheets.empty()) refuse("sheets have straight cells");
}

void curve_mesh(unsigned order, std::span<const surface::CurvedEdge> curves, MeshResult& result) {
    if (has_sheets(result.geometry)) throw OptionError("order", "sheets have straight cells");
    if (result.layer_grid_refused)
        throw MeshError("the cells of the layer form no columns, which curved cells need: leave the order out");
    mesh::CurvedCells curved =
        mesh::curve_cells(result.mesh, order, curves_of_walls(curves, result.mesh), {result.columns});
    result.curved = std::move(curved.nodes);
    result.curving = curved.summary;
    result.curved_check = std::move(curved.check);
}

}  // namespace lamina::pipeline
