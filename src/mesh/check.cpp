// Is a mesh valid? All decisions are exact; see boundary.hpp for why simple, well nested boundary loops, positive cells
// and matching edges together mean that the domain is covered exactly once.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include <lamina/mesh.hpp>
#include <lamina/predicates.hpp>

#include "core/parallel.hpp"
#include "core/predicates.hpp"
#include "core/segments.hpp"
#include "mesh/adjacency.hpp"
#include "mesh/boundary.hpp"
#include "mesh/defects.hpp"
#include "mesh/quality.hpp"

namespace lamina::mesh {

namespace {

using mesh::Adjacency;
using mesh::CellEdges;
using mesh::CellShape;
using mesh::DefectList;
using mesh::QualityCollector;

/// Cells or vertices a block: what a block of cells takes stays in the second-level cache.
constexpr std::size_t grain = 1 << 13;

/// "triangle 7 (3, 5, 9)"
std::string name_of(const Mesh& mesh, std::size_t cell) {
    if (cell < mesh.triangles.size()) {
        const VertexId* v = mesh.triangles[cell].v;
        return fmt::format("triangle {} ({}, {}, {})", cell, v[0].value, v[1].value, v[2].value);
    }
    const VertexId* v = mesh.quads[cell - mesh.triangles.size()].v;
    return fmt::format("quad {} ({}, {}, {}, {})", cell - mesh.triangles.size(), v[0].value, v[1].value, v[2].value,
                       v[3].value);
}

std::string name_of(const Segment& edge) { return fmt::format("{}-{}", edge.a.value, edge.b.value); }

template <class F>
void check_blocks(std::size_t n, DefectList& defects, F&& check_one) {
    const auto check_block = [&](std::size_t begin, std::size_t end) {
        DefectList found;
        for (std::size_t i = begin; i < end; ++i) check_one(i, found);
        return found;
    };
    for (DefectList& found : core::parallel_blocks(n, grain, check_block)) defects.append(std::move(found));
}

// --- Arrays: whatever comes after may index and compute without looking.

void check_arrays(const Mesh& mesh, DefectList& defects) {
    const std::size_t vertices = mesh.points.size();
    const CellEdges edges(mesh);
    const auto in_range = [&](const Segment& s) { return s.a.index() < vertices && s.b.index() < vertices; };

    if (edges.cells() == 0) defects.add([] { return MeshDefect{"no cells", {}}; });
    const auto check_size = [&](const char* array, std::size_t size) {
        if (size != 0 && size != edges.cells())
            defects.add([&] {
                return MeshDefect{fmt::format("{} entries in '{}' for {} cells", size, array, edges.cells()), {}};
            });
    };
    check_size("region", mesh.region.size());
    check_size("piece", mesh.piece.size());
    check_size("layer", mesh.layer.size());

    check_blocks(vertices, defects, [&](std::size_t v, DefectList& found) {
        const Point p = mesh.points[v];
        if (!in_exact_range(p))
            found.add([&] {
                return MeshDefect{fmt::format("vertex {} ({}, {}) is not a number or out of range", v, p.x, p.y), p};
            });
    });
    check_blocks(edges.cells(), defects, [&](std::size_t cell, DefectList& found) {
        for (std::size_t i = 0; i < edges.corners(cell); ++i)
            if (edges.corner(cell, i).index() >= vertices) {
                found.add([&] {
                    return MeshDefect{fmt::format("{} has an index out of range", name_of(mesh, cell)), {}};
                });
                return;
            }
    });
    for (const Marker& marker : mesh.markers)
        for (const Segment& edge : marker.edges)
            if (!in_range(edge))
                defects.add([&] {
                    return MeshDefect{
                        fmt::format("edge {} of marker '{}' has an index out of range", name_of(edge), marker.name),
                        {}};
                });
    for (const Segment& edge : mesh.constraints)
        if (!in_range(edge))
            defects.add([&] {
                return MeshDefect{fmt::format("constraint {} has an index out of range", name_of(edge)), {}};
            });
}

// --- Cells and interior edges: orientation, area, shape; Delaunay property, areas of neighbours, hand-over from the
// layer.

struct CellsSummary {
    double area = 0;
    QualityCollector layer, isotropic;
    std::vector<std::uint32_t> narrow;  ///< isotropic cells with an angle below the bound
    std::size_t interior_edges = 0;     ///< between isotropic triangles; constraints are taken out afterwards
    std::size_t delaunay_violations = 0;
    std::vector<double> transition;  ///< area of the layer's cell over the isotropic one's
    DefectList defects;

    explicit CellsSummary(double bound = 0) : layer(bound), isotropic(bound) {}
    void append(CellsSummary&& part) {
        area += part.area;
        layer.append(part.layer);
        isotropic.append(part.isotropic);
        narrow.insert(narrow.end(), part.narrow.begin(), part.narrow.end());
        interior_edges += part.interior_edges;
        delaunay_violations += part.delaunay_violations;
        transition.insert(transition.end(), part.transition.begin(), part.transition.end());
        defects.append(std::move(part.defects));
    }
};

bool is_isotropic(const Mesh& mesh, std::size_t cell) {
    return mesh.region.empty() || mesh.region[cell] == Region::isotropic;
}

bool is_isotropic_triangle(const Mesh& mesh, std::size_t cell) {
    return cell < mesh.triangles.size() && is_isotropic(mesh, cell);
}

/// > 0 for counter-clockwise, 0 for flat. A quad is simple and counter-clockwise if one of its diagonals splits it in
/// two such triangles.
double cell_orientation(const Point* p, std::size_t corners) {
    using core::inline_orient2d;
    if (corners == 3) return inline_orient2d(p[0], p[1], p[2]);
    return std::max(std::min(inline_orient2d(p[0], p[1], p[2]), inline_orient2d(p[0], p[2], p[3])),
                    std::min(inline_orient2d(p[0], p[1], p[3]), inline_orient2d(p[1], p[2], p[3])));
}

/// Orientation and shape of one cell; its area.
double check_cell(const Mesh& mesh, const CellEdges& edges, std::size_t cell, const MeshCheckOptions& options,
                  CellsSummary& summary) {
    Point p[4];
    const std::size_t corners = edges.corners(cell);
    for (std::size_t i = 0; i < corners; ++i) p[i] = mesh.points[edges.corner(cell, i).index()];
    if (const double sign = cell_orientation(p, corners); !(sign > 0))
        summary.defects.add([&] {
            return MeshDefect{fmt::format("{} {}", sign < 0 ? "clockwise or folded" : "flat", name_of(mesh, cell)),
                              p[0]};
        });
    const CellShape shape =
        corners == 3 ? core::measure_triangle(p[0], p[1], p[2]) : mesh::measure_quad(p[0], p[1], p[2], p[3]);
    summary.area += shape.area;
    const bool isotropic = is_isotropic(mesh, cell);
    (isotropic ? summary.isotropic : summary.layer).add(shape);
    if (isotropic && shape.min_angle_deg < options.min_angle_deg)
        summary.narrow.push_back(static_cast<std::uint32_t>(cell));
    return shape.area;
}

/// Exact; counter-clockwise a, b, c.
bool strictly_in_circle(Point a, Point b, Point c, Point d) {
    const core::RoundedIncircle rounded = core::rounded_incircle(a, b, c, d);
    return (rounded.certain() ? rounded.det : incircle(a, b, c, d)) > 0;
}

/// Is the vertex opposite to the directed edge's twin strictly inside the circle of the edge's own triangle?
bool violates_delaunay(const Mesh& mesh, std::size_t edge, std::size_t twin) {
    const VertexId* v = mesh.triangles[edge / 3].v;
    const VertexId opposite = mesh.triangles[twin / 3].v[(twin + 2) % 3];
    return strictly_in_circle(mesh.points[v[0].index()], mesh.points[v[1].index()], mesh.points[v[2].index()],
                              mesh.points[opposite.index()]);
}

double area_of(const Mesh& mesh, const CellEdges& edges, std::size_t cell) {
    const auto corner = [&](std::size_t i) { return mesh.points[edges.corner(cell, i).index()]; };
    return edges.corners(cell) == 3 ? 0.5 * cross(corner(1) - corner(0), corner(2) - corner(0))
                                    : 0.5 * cross(corner(2) - corner(0), corner(3) - corner(1));
}

/// An edge between two cells; area_of(cell) gives areas of cells.
template <class AreaOf>
void check_edge(const Mesh& mesh, const CellEdges& edges, std::size_t edge, std::size_t twin, AreaOf&& area_of,
                CellsSummary& summary) {
    const std::size_t cell = edges.cell_of(edge), other = edges.cell_of(twin);
    const bool isotropic = is_isotropic(mesh, cell), other_isotropic = is_isotropic(mesh, other);
    if (!isotropic && !other_isotropic) return;
    const double area = area_of(cell), other_area = area_of(other);
    if (isotropic != other_isotropic) {
        summary.transition.push_back(isotropic ? other_area / area : area / other_area);
        return;
    }
    summary.isotropic.add_neighbours(area, other_area);
    if (!is_isotropic_triangle(mesh, cell) || !is_isotropic_triangle(mesh, other)) return;
    ++summary.interior_edges;
    summary.delaunay_violations += violates_delaunay(mesh, edge, twin);
}

/// Of the edges [begin, end), those to a cell whose edge comes later: each pair once. Without a branch, which would be
/// guessed wrong half of the time.
std::vector<std::uint32_t> first_of_pairs(const Adjacency& adjacency, std::size_t begin, std::size_t end) {
    std::vector<std::uint32_t> firsts(end - begin + 1);
    std::size_t n = 0;
    for (std::size_t e = begin; e < end; ++e) {
        firsts[n] = static_cast<std::uint32_t>(e);
        n += (adjacency.twin[e] > e) & (adjacency.twin[e] != mesh::no_edge);
    }
    firsts.resize(n);
    return firsts;
}

/// The cells [begin, end) and the edges between them and later ones.
void check_block(const Mesh& mesh, const Adjacency& adjacency, std::size_t begin, std::size_t end,
                 const MeshCheckOptions& options, CellsSummary& summary) {
    const CellEdges edges(mesh);
    std::vector<double> areas(end - begin);
    for (std::size_t cell = begin; cell < end; ++cell)
        areas[cell - begin] = check_cell(mesh, edges, cell, options, summary);
    const auto area = [&](std::size_t cell) {
        return begin <= cell && cell < end ? areas[cell - begin] : area_of(mesh, edges, cell);
    };
    for (const std::uint32_t e : first_of_pairs(adjacency, edges.first(begin), edges.first(end)))
        check_edge(mesh, edges, e, adjacency.twin[e], area, summary);
}

CellsSummary check_cells(const Mesh& mesh, const Adjacency& adjacency, const MeshCheckOptions& options) {
    // Summaries are added up one after the other, so there are fewer of them than blocks.
    constexpr std::size_t blocks = 4;
    const auto several_blocks = [&](std::size_t begin, std::size_t end) {
        CellsSummary summary(options.min_angle_deg);
        for (; begin < end; begin += grain)
            check_block(mesh, adjacency, begin, std::min(end, begin + grain), options, summary);
        return summary;
    };
    CellsSummary all(options.min_angle_deg);
    for (CellsSummary& part : core::parallel_blocks(CellEdges(mesh).cells(), blocks * grain, several_blocks))
        all.append(std::move(part));
    return all;
}

TransitionSummary summarize(std::vector<double> area_ratios) {
    if (area_ratios.empty()) return {};
    const auto percentile = [&](std::size_t percent) {
        const auto at = area_ratios.begin() + static_cast<std::ptrdiff_t>((area_ratios.size() - 1) * percent / 100);
        std::nth_element(area_ratios.begin(), at, area_ratios.end());
        return *at;
    };
    return {area_ratios.size(), percentile(1), percentile(50), percentile(99)};
}

/// Each with its smaller vertex first, sorted, once.
std::vector<Segment> sorted_constraints(const Mesh& mesh) {
    std::vector<Segment> constraints = mesh.constraints;
    for (Segment& edge : constraints)
        if (edge.b < edge.a) std::swap(edge.a, edge.b);
    std::sort(constraints.begin(), constraints.end());
    constraints.erase(std::unique(constraints.begin(), constraints.end()), constraints.end());
    return constraints;
}

/// Takes constraints between isotropic triangles out of the count again: they are few.
void exempt_constraints(const Mesh& mesh, const Adjacency& adjacency, const std::vector<Segment>& constraints,
                        CellsSummary& summary, DefectList& defects) {
    const CellEdges edges(mesh);
    const std::vector<std::uint32_t> edge_of = mesh::find_edges(mesh, constraints);
    for (std::size_t i = 0; i < constraints.size(); ++i) {
        const Segment& constraint = constraints[i];
        const std::uint32_t found = edge_of[i];
        if (found == mesh::no_edge) {
            defects.add([&] {
                return MeshDefect{fmt::format("constraint {} is no edge of the mesh", name_of(constraint)),
                                  mesh.points[constraint.a.index()]};
            });
            continue;
        }
        if (adjacency.twin[found] == mesh::no_edge) continue;
        const std::size_t edge = std::min(found, adjacency.twin[found]), twin = adjacency.twin[edge];
        if (!is_isotropic_triangle(mesh, edges.cell_of(edge)) || !is_isotropic_triangle(mesh, edges.cell_of(twin)))
            continue;
        --summary.interior_edges;
        summary.delaunay_violations -= violates_delaunay(mesh, edge, twin);
    }
}

// --- Angles below the bound that no refinement could mend.

/// The two frozen edges between which a corner of an isotropic cell lies, as far as the mesh tells.
class FrozenCorners {
public:
    FrozenCorners(const Mesh& mesh, const Adjacency& adjacency, const std::vector<Segment>& constraints)
        : mesh_(mesh), edges_(mesh), adjacency_(adjacency), constraints_(constraints) {}

    /// Does a corner of the cell lie between two frozen edges that enclose less than 60 degrees?
    bool excuse(std::size_t cell) const {
        for (std::size_t i = 0; i < edges_.corners(cell); ++i)
            if (is_sharp(edges_.first(cell) + i)) return true;
        return false;
    }

private:
    const Mesh& mesh_;
    CellEdges edges_;
    const Adjacency& adjacency_;
    const std::vector<Segment>& constraints_;

    std::size_t next(std::size_t edge) const { return turned(edge, 1); }
    std::size_t previous(std::size_t edge) const { return turned(edge, edges_.corners(edges_.cell_of(edge)) - 1); }
    std::size_t turned(std::size_t edge, std::size_t steps) const {
        const std::size_t cell = edges_.cell_of(edge), first = edges_.first(cell);
        return first + (edge - first + steps) % edges_.corners(cell);
    }

    /// Of an edge of an isotropic cell: on the boundary, on the layer or another piece, or a constraint.
    bool is_frozen(std::size_t edge) const {
        const std::uint32_t twin = adjacency_.twin[edge];
        if (twin == mesh::no_edge) return true;
        const std::size_t cell = edges_.cell_of(edge), other = edges_.cell_of(twin);
        if (!is_isotropic(mesh_, other)) return true;
        if (!mesh_.piece.empty() && mesh_.piece[cell] != mesh_.piece[other]) return true;
        const VertexId a = edges_.origin(edge), b = edges_.target(edge);
        return std::binary_search(constraints_.begin(), constraints_.end(), Segment{std::min(a, b), std::max(a, b)});
    }

    /// Cells round the origin of `edge` are walked until both ways end at a frozen edge.
    ///
    ///      b   .          edge: from v, the cell on its left; to a and b go the frozen edges
    ///       \ .  cell
    ///        v-----> edge
    ///         \  .
    ///          a
    bool is_sharp(std::size_t edge) const {
        std::size_t right = edge;  // leaves v
        while (!is_frozen(right)) {
            right = next(adjacency_.twin[right]);
            if (right == edge) return false;  // nothing is frozen round v
        }
        std::size_t left = previous(edge);  // arrives at v
        while (!is_frozen(left)) left = previous(adjacency_.twin[left]);
        const Point v = mesh_.points[edges_.origin(edge).index()];
        const Point a = mesh_.points[edges_.target(right).index()] - v;
        const Point b = mesh_.points[edges_.origin(left).index()] - v;
        return core::encloses_sharp_angle(a, b);
    }
};

std::size_t count_exempt(const FrozenCorners& corners, const std::vector<std::uint32_t>& narrow) {
    std::size_t exempt = 0;
    const auto count = [&](std::size_t begin, std::size_t end) {
        return std::count_if(narrow.begin() + static_cast<std::ptrdiff_t>(begin),
                             narrow.begin() + static_cast<std::ptrdiff_t>(end),
                             [&](std::uint32_t cell) { return corners.excuse(cell); });
    };
    for (const auto part : core::parallel_blocks(narrow.size(), grain, count)) exempt += static_cast<std::size_t>(part);
    return exempt;
}

// --- Topology and markers.

void report_topology(const Mesh& mesh, const Adjacency& adjacency, DefectList& defects) {
    const CellEdges edges(mesh);
    for (const std::uint32_t e : adjacency.overused)
        defects.add([&] {
            return MeshDefect{
                fmt::format("{} shares its edge {} with more than one cell or with one on the same side",
                            name_of(mesh, edges.cell_of(e)), name_of(Segment{edges.origin(e), edges.target(e)})),
                mesh.points[edges.origin(e).index()]};
        });
    for (const VertexId v : adjacency.orphans)
        defects.add([&] {
            return MeshDefect{fmt::format("vertex {} belongs to no cell", v.value), mesh.points[v.index()]};
        });
}

std::vector<Segment> boundary_edges(const Mesh& mesh, const Adjacency& adjacency) {
    const CellEdges edges(mesh);
    std::vector<Segment> boundary;
    boundary.reserve(adjacency.boundary.size());
    for (const std::uint32_t e : adjacency.boundary) boundary.push_back({edges.origin(e), edges.target(e)});
    std::sort(boundary.begin(), boundary.end());
    return boundary;
}

std::size_t count_edges_without_first_layer(const Mesh& mesh, const Adjacency& adjacency) {
    if (mesh.layer.empty()) return 0;
    const CellEdges edges(mesh);
    const auto beyond = [&](std::uint32_t edge) { return mesh.layer[edges.cell_of(edge)] > 1; };
    return static_cast<std::size_t>(std::count_if(adjacency.boundary.begin(), adjacency.boundary.end(), beyond));
}

/// Every boundary edge in exactly one marker, and nothing else in any. `boundary` is sorted.
void check_markers(const Mesh& mesh, const std::vector<Segment>& boundary, DefectList& defects) {
    std::vector<std::uint8_t> marked(boundary.size(), 0);
    const auto report = [&](const Segment& edge, const std::string& what) {
        defects.add([&] { return MeshDefect{what, mesh.points[edge.a.index()]}; });
    };
    for (const Marker& marker : mesh.markers) {
        const auto same_name = [&](const Marker& other) { return &other < &marker && other.name == marker.name; };
        if (std::any_of(mesh.markers.begin(), mesh.markers.end(), same_name))
            defects.add([&] { return MeshDefect{fmt::format("two markers are named '{}'", marker.name), {}}; });
        for (const Segment& edge : marker.edges) {
            const auto found = std::lower_bound(boundary.begin(), boundary.end(), edge);
            if (found == boundary.end() || *found != edge) {
                const bool reversed = std::binary_search(boundary.begin(), boundary.end(), Segment{edge.b, edge.a});
                report(edge, fmt::format("edge {} of marker '{}' {}", name_of(edge), marker.name,
                                         reversed ? "has the mesh on its right" : "is not on the boundary"));
            } else if (std::exchange(marked[static_cast<std::size_t>(found - boundary.begin())], 1)) {
                report(edge, fmt::format("boundary edge {} is marked twice, once as '{}'", name_of(edge), marker.name));
            }
        }
    }
    for (std::size_t i = 0; i < boundary.size(); ++i)
        if (!marked[i]) report(boundary[i], fmt::format("boundary edge {} is in no marker", name_of(boundary[i])));
}

/// What holds for every valid mesh; a second look at what check_boundary proves.
void check_totals(const MeshCheck& check, const mesh::BoundarySummary& boundary, DefectList& defects) {
    // A connected planar domain with k holes has characteristic 1 - k, one outer loop and k inner ones.
    const long expected = 2 * static_cast<long>(boundary.outer_loops) - static_cast<long>(boundary.loops);
    if (check.euler_characteristic != expected)
        defects.add([&] {
            return MeshDefect{fmt::format("Euler characteristic {} where the boundary loops ask for {}",
                                          check.euler_characteristic, expected),
                              {}};
        });
    constexpr double rounding = 1e-9;  // generous for 1e9 cells, too small for a cell to hide in
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
    MeshCheck check;
    DefectList defects;
    const auto finish = [&] {
        check.defects = std::move(defects.kept);
        check.defect_count = defects.count;
        return std::move(check);
    };
    check_arrays(mesh, defects);
    if (!defects.empty()) return finish();
    const std::size_t cells = CellEdges(mesh).cells();

    const Adjacency adjacency = find_adjacency(mesh);
    CellsSummary all = check_cells(mesh, adjacency, options);
    defects.append(std::move(all.defects));
    check.area = all.area;

    report_topology(mesh, adjacency, defects);
    check.euler_characteristic = static_cast<long>(mesh.points.size() - adjacency.orphans.size()) -
                                 static_cast<long>(adjacency.edges) + static_cast<long>(cells);

    const std::vector<Segment> constraints = sorted_constraints(mesh);
    exempt_constraints(mesh, adjacency, constraints, all, defects);
    check.interior_edges = all.interior_edges;
    check.delaunay_violations = all.delaunay_violations;
    check.transition = summarize(std::move(all.transition));
    check.layer = all.layer.summary();
    check.isotropic = all.isotropic.summary();
    check.isotropic.exempt = count_exempt({mesh, adjacency, constraints}, all.narrow);

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
