// check_mesh(): whether a mesh is valid, and how good it is. All decisions are exact. boundary.hpp explains why simple,
// well nested boundary loops, cells of positive area and matching edges together mean that the domain is covered once.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include <lamina/mesh.hpp>

#include "mesh/adjacency.hpp"
#include "mesh/boundary.hpp"
#include "mesh/cell_text.hpp"
#include "mesh/check_arrays.hpp"
#include "mesh/check_cells.hpp"
#include "mesh/check_markers.hpp"
#include "mesh/defects.hpp"
#include "mesh/delaunay_count.hpp"
#include "mesh/exempt.hpp"
#include "mesh/walls.hpp"

namespace lamina::mesh {

namespace {

void check_topology(const Mesh& mesh, const Adjacency& adjacency, DefectList& defects) {
    const CellEdges edges(mesh);
    for (const std::uint32_t e : adjacency.overused)
        defects.add([&] {
            return MeshDefect{
                fmt::format("{} shares its edge {} with more than one cell or with one on the same side",
                            cell_text(mesh, edges.cell_of(e)), edge_text(Segment{edges.origin(e), edges.target(e)})),
                mesh.points[edges.origin(e).index()]};
        });
    for (const VertexId v : adjacency.orphans)
        defects.add([&] {
            return MeshDefect{fmt::format("vertex {} belongs to no cell", v.value), mesh.points[v.index()]};
        });
}

/// Returns vertices - edges + cells. Vertices of no cell are not counted.
long euler_characteristic(const Mesh& mesh, const Adjacency& adjacency) {
    const std::size_t cells = mesh.triangles.size() + mesh.quads.size();
    return static_cast<long>(mesh.points.size() - adjacency.orphans.size()) - static_cast<long>(adjacency.edges) +
           static_cast<long>(cells);
}

std::size_t count_edges_without_first_layer(const Mesh& mesh, const Adjacency& adjacency) {
    if (mesh.layer.empty()) return 0;
    const CellEdges edges(mesh);
    const auto is_beyond_layer_1 = [&](std::uint32_t edge) { return mesh.layer[edges.cell_of(edge)] > 1; };
    return static_cast<std::size_t>(
        std::count_if(adjacency.boundary.begin(), adjacency.boundary.end(), is_beyond_layer_1));
}

/// Checks sums that hold for every valid mesh. It follows from check_boundary() that they hold: this is a second,
/// independent look.
void check_totals(const MeshCheck& check, const BoundarySummary& boundary, DefectList& defects) {
    // A connected plane domain with k holes has the characteristic 1 - k, one outer loop and k inner ones.
    const long expected = 2 * static_cast<long>(boundary.outer_loops) - static_cast<long>(boundary.loops);
    if (check.euler_characteristic != expected)
        defects.add([&] {
            return MeshDefect{fmt::format("Euler characteristic {} where the boundary loops ask for {}",
                                          check.euler_characteristic, expected),
                              {}};
        });
    // The tolerance is generous for the rounding errors of 1e9 cells, and too small for a cell to hide in.
    constexpr double rounding = 1e-9;
    if (!(std::abs(check.area - boundary.area) <= rounding * boundary.area_magnitude))
        defects.add([&] {
            return MeshDefect{
                fmt::format("the cells' areas sum to {}, the boundary encloses {}", check.area, boundary.area), {}};
        });
}

}  // namespace

}  // namespace lamina::mesh

namespace lamina {

using namespace mesh;

MeshCheck check_mesh(const Mesh& mesh, const MeshCheckOptions& options) {
    validate(options);
    if (!options.first_heights.empty() && options.first_heights.size() != mesh.markers.size())
        throw OptionError("first_heights", "need one entry per marker");
    MeshCheck check;
    DefectList defects;
    const auto finish = [&] {
        check.defects = std::move(defects.kept);
        check.defect_count = defects.count;
        return std::move(check);
    };
    check_arrays(mesh, defects);
    if (!defects.empty()) return finish();

    const Adjacency adjacency = find_adjacency(mesh);
    CellsSummary cells = check_cells(mesh, adjacency, options.min_angle_deg);
    defects.append(std::move(cells.defects));
    check.area = cells.area;
    check_topology(mesh, adjacency, defects);
    check.euler_characteristic = euler_characteristic(mesh, adjacency);

    const std::vector<Segment> constraints = sorted_constraints(mesh);
    subtract_constraints(mesh, adjacency, constraints, cells.delaunay, defects);
    check.interior_edges = cells.delaunay.edges;
    check.delaunay_violations = cells.delaunay.violations;
    check.transition = summarize_transition(std::move(cells.transition));
    check.layer = cells.layer.summary();
    check.isotropic = cells.isotropic.summary();
    check.unexcused_cells = find_unexcused(mesh, adjacency, constraints, cells.narrow);
    check.isotropic.exempt = cells.narrow.size() - check.unexcused_cells.size();
    check.walls = measure_walls(mesh, adjacency, options);
    check.edges_without_first_layer = count_edges_without_first_layer(mesh, adjacency);

    const std::vector<Segment> edges = boundary_edges(mesh, adjacency);
    check_markers(mesh, edges, defects);
    if (adjacency.overused.empty()) {
        BoundarySummary boundary = check_boundary(mesh.points, edges);
        check.boundary_loops = boundary.loops;
        defects.append(std::move(boundary.defects));
        if (defects.empty()) check_totals(check, boundary, defects);
    }
    return finish();
}

}  // namespace lamina
