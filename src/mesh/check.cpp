// check_mesh(): whether a mesh is valid, and how good it is. All decisions are exact. boundary.hpp explains why simple,
// well nested boundary loops, cells of positive area and matching edges together mean that the domain is covered once.
#include <fmt/format.h>

#include <utility>

#include <lamina/error.hpp>
#include <lamina/mesh.hpp>

#include "mesh/adjacency.hpp"
#include "mesh/boundary_edges.hpp"
#include "mesh/cell_text.hpp"
#include "mesh/check_arrays.hpp"
#include "mesh/check_boundary.hpp"
#include "mesh/check_cells.hpp"
#include "mesh/defects.hpp"
#include "mesh/delaunay_count.hpp"
#include "mesh/exempt.hpp"

namespace lamina::mesh {

namespace {

void check_topology(const MeshView& mesh, const EdgeTotals& totals, DefectList& defects) {
    const CellEdges edges(mesh);
    for (const std::uint32_t e : totals.overused)
        defects.add([&] {
            return MeshDefect{
                fmt::format("{} shares its edge {} with more than one cell or with one on the same side",
                            cell_text(mesh, edges.cell_of(e)), edge_text(Segment{edges.origin(e), edges.target(e)})),
                mesh.points[edges.origin(e).index()]};
        });
    for (const VertexId v : totals.orphans)
        defects.add([&] {
            return MeshDefect{fmt::format("vertex {} belongs to no cell", v.value), mesh.points[v.index()]};
        });
}

/// Returns vertices - edges + cells. Vertices of no cell are not counted.
long euler_characteristic(const MeshView& mesh, const EdgeTotals& totals) {
    const std::size_t cells = mesh.triangles.size() + mesh.quads.size();
    return static_cast<long>(mesh.points.size() - totals.orphans.size()) - static_cast<long>(totals.edges) +
           static_cast<long>(cells);
}

}  // namespace

}  // namespace lamina::mesh

namespace lamina {

using namespace mesh;

MeshCheck check_mesh(const MeshView& mesh, const MeshCheckOptions& options) {
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

    CheckedCells checked = check_cells(mesh, options.min_angle_deg, options.max_memory_bytes);
    CellsSummary& cells = checked.summary;
    defects.append(std::move(cells.defects));
    check.area = cells.area;
    check_topology(mesh, checked.edges, defects);
    check.euler_characteristic = euler_characteristic(mesh, checked.edges);
    const std::vector<BoundaryEdge> boundary = find_boundary_edges(mesh, checked.edges.boundary);
    const bool conforming = checked.edges.overused.empty();

    const std::vector<Segment> constraints = sorted_constraints(mesh);
    subtract_constraints(mesh, constraints, cells.delaunay, defects);
    check.interior_edges = cells.delaunay.edges;
    check.delaunay_violations = cells.delaunay.violations;
    check.transition = summarize_transition(cells.transition);
    check.layer = cells.layer.summary();
    check.isotropic = cells.isotropic.summary();
    const std::size_t narrow = cells.narrow.size();
    check.unexcused_cells = find_unexcused(mesh, std::move(checked), constraints);
    check.isotropic.exempt = narrow - check.unexcused_cells.size();
    measure_boundary(mesh.points, mesh.markers, boundary, options, check);
    check_whole_boundary(mesh.points, mesh.markers, boundary, conforming, check, defects);
    return finish();
}

}  // namespace lamina
