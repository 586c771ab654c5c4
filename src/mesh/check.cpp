// check_mesh(): whether a mesh is valid, and how good it is. All decisions are exact. boundary.hpp explains why simple,
// well nested boundary loops, cells of positive area and matching edges together mean that the domain is covered once.
#include <fmt/format.h>

#include <utility>

#include <lamina/mesh.hpp>

#include "mesh/adjacency.hpp"
#include "mesh/cell_text.hpp"
#include "mesh/check_arrays.hpp"
#include "mesh/check_boundary.hpp"
#include "mesh/check_cells.hpp"
#include "mesh/defects.hpp"
#include "mesh/delaunay_count.hpp"
#include "mesh/exempt.hpp"

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
    check_whole_boundary(mesh.points, mesh.markers, find_boundary_edges(mesh, adjacency), adjacency.overused.empty(),
                         options, check, defects);
    return finish();
}

}  // namespace lamina
