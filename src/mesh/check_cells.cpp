#include "mesh/check_cells.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "core/parallel.hpp"
#include "core/predicates.hpp"
#include "mesh/adjacency.hpp"
#include "mesh/cell_text.hpp"
#include "mesh/isotropic_cells.hpp"
#include "mesh/triangle_shapes.hpp"

namespace lamina::mesh {

namespace {

/// Returns a number that is > 0 for a counter-clockwise quad and 0 for a flat one. A quad is simple and
/// counter-clockwise if one of its diagonals splits it in two counter-clockwise triangles.
double quad_orientation(const Point* p) {
    using core::inline_orient2d;
    return std::max(std::min(inline_orient2d(p[0], p[1], p[2]), inline_orient2d(p[0], p[2], p[3])),
                    std::min(inline_orient2d(p[0], p[1], p[3]), inline_orient2d(p[1], p[2], p[3])));
}

/// Reports a cell whose orientation has this sign unless the sign is positive.
void require_positive(double sign, const Mesh& mesh, std::size_t cell, Point at, CellsSummary& summary) {
    if (sign > 0) return;
    summary.defects.add([&] {
        return MeshDefect{fmt::format("{} {}", sign < 0 ? "clockwise or folded" : "flat", cell_text(mesh, cell)), at};
    });
}

/// Checks the orientation and the shape of one quadrilateral, and returns its area.
double check_quad(const Mesh& mesh, std::size_t cell, double min_angle_deg, CellsSummary& summary) {
    Point p[4];
    for (std::size_t i = 0; i < 4; ++i) p[i] = mesh.points[mesh.quads[cell - mesh.triangles.size()].v[i].index()];
    require_positive(quad_orientation(p), mesh, cell, p[0], summary);
    const CellShape shape = measure_quad(p[0], p[1], p[2], p[3]);
    summary.area += shape.area;
    const bool isotropic = is_isotropic(mesh, cell);
    (isotropic ? summary.isotropic : summary.layer).add(shape);
    if (isotropic && shape.min_angle_deg < min_angle_deg) summary.narrow.push_back(static_cast<std::uint32_t>(cell));
    return shape.area;
}

/// Adds the shapes of the triangles from `first` on, which may belong to both regions.
void add_shapes(const Mesh& mesh, std::size_t first, const TriangleShapes& shapes, double min_angle_deg,
                CellsSummary& summary) {
    std::size_t isotropic = 0;
    for (std::size_t i = 0; i < shapes.size; ++i) isotropic += is_isotropic(mesh, first + i);
    const ShapeTotals totals = add_up(shapes);
    summary.area += totals.area;
    if (isotropic == 0) {
        summary.layer.add(shapes, totals);
    } else if (isotropic == shapes.size) {
        summary.isotropic.add(shapes, totals);
    } else {
        for (std::size_t i = 0; i < shapes.size; ++i)
            (is_isotropic(mesh, first + i) ? summary.isotropic : summary.layer).add(shapes.shape(i));
    }
    if (isotropic == 0 || !(totals.min_angle_deg < min_angle_deg)) return;
    for (std::size_t i = 0; i < shapes.size; ++i)
        if (shapes.min_angle_deg[i] < min_angle_deg && is_isotropic(mesh, first + i))
            summary.narrow.push_back(static_cast<std::uint32_t>(first + i));
}

/// Checks the orientation and the shapes of triangles, and stores their areas.
void check_triangles(const Mesh& mesh, std::size_t begin, std::size_t end, double min_angle_deg,
                     std::vector<double>& areas, CellsSummary& summary) {
    TriangleShapes shapes;
    for (std::size_t first = begin; first < end; first += TriangleShapes::capacity) {
        const std::size_t count = std::min(TriangleShapes::capacity, end - first);
        measure_triangles(mesh.points.data(), std::span(mesh.triangles).subspan(first, count), shapes);
        std::copy_n(shapes.area, count, areas.data() + (first - begin));
        for (std::size_t i = 0; i < count; ++i) {
            if (shapes.turn[i] > 0) continue;
            const auto corner = [&](unsigned k) { return mesh.points[mesh.triangles[first + i].v[k].index()]; };
            require_positive(orient2d(corner(0), corner(1), corner(2)), mesh, first + i, corner(0), summary);
        }
        add_shapes(mesh, first, shapes, min_angle_deg, summary);
    }
}

/// Checks an edge between two cells. area_of_cell(cell) returns the area of a cell.
template <class AreaOfCell>
void check_edge(const Mesh& mesh, const CellEdges& edges, std::size_t edge, std::size_t twin, AreaOfCell&& area_of_cell,
                CellsSummary& summary) {
    const std::size_t cell = edges.cell_of(edge), other = edges.cell_of(twin);
    const bool isotropic = is_isotropic(mesh, cell), other_isotropic = is_isotropic(mesh, other);
    if (!isotropic && !other_isotropic) return;
    const double area = area_of_cell(cell), other_area = area_of_cell(other);
    if (isotropic != other_isotropic) {
        summary.transition.push_back(isotropic ? other_area / area : area / other_area);
        return;
    }
    summary.isotropic.add_neighbours(area, other_area);
    if (!is_isotropic_triangle(mesh, cell) || !is_isotropic_triangle(mesh, other)) return;
    ++summary.delaunay.edges;
    summary.delaunay.violations += violates_delaunay(mesh, edge, twin);
}

/// Returns the edges in [begin, end) that have a twin with a higher number, so that each pair is returned once. Selects
/// them without a branch, which the processor would mispredict half of the time.
std::vector<std::uint32_t> first_of_pairs(const Adjacency& adjacency, std::size_t begin, std::size_t end) {
    std::vector<std::uint32_t> firsts(end - begin + 1);
    std::size_t n = 0;
    for (std::size_t e = begin; e < end; ++e) {
        firsts[n] = static_cast<std::uint32_t>(e);
        n += static_cast<unsigned>(adjacency.twin[e] > e) & static_cast<unsigned>(adjacency.twin[e] != no_edge);
    }
    firsts.resize(n);
    return firsts;
}

/// Checks the cells [begin, end) and the edges between them and later ones.
void check_block(const Mesh& mesh, const Adjacency& adjacency, std::size_t begin, std::size_t end, double min_angle_deg,
                 CellsSummary& summary) {
    const CellEdges edges(mesh);
    std::vector<double> areas(end - begin);
    const std::size_t triangles_end = std::clamp(mesh.triangles.size(), begin, end);
    check_triangles(mesh, begin, triangles_end, min_angle_deg, areas, summary);
    for (std::size_t cell = triangles_end; cell < end; ++cell)
        areas[cell - begin] = check_quad(mesh, cell, min_angle_deg, summary);
    const auto area_of_cell = [&](std::size_t cell) {
        return begin <= cell && cell < end ? areas[cell - begin] : area_of(mesh, edges, cell);
    };
    for (const std::uint32_t e : first_of_pairs(adjacency, edges.first(begin), edges.first(end)))
        check_edge(mesh, edges, e, adjacency.twin[e], area_of_cell, summary);
}

}  // namespace

double area_of(const Mesh& mesh, const CellEdges& edges, std::size_t cell) {
    const auto corner = [&](std::size_t i) { return mesh.points[edges.corner(cell, i).index()]; };
    return edges.corners(cell) == 3 ? 0.5 * cross(corner(1) - corner(0), corner(2) - corner(0))
                                    : 0.5 * cross(corner(2) - corner(0), corner(3) - corner(1));
}

void CellsSummary::append(CellsSummary&& part) {
    area += part.area;
    layer.append(part.layer);
    isotropic.append(part.isotropic);
    narrow.insert(narrow.end(), part.narrow.begin(), part.narrow.end());
    delaunay.edges += part.delaunay.edges;
    delaunay.violations += part.delaunay.violations;
    transition.insert(transition.end(), part.transition.begin(), part.transition.end());
    defects.append(std::move(part.defects));
}

CellsSummary check_cells(const Mesh& mesh, const Adjacency& adjacency, double min_angle_deg) {
    // One summary serves several blocks, since summaries are appended on one thread.
    constexpr std::size_t blocks = 4;
    const auto check_blocks = [&](std::size_t begin, std::size_t end) {
        CellsSummary summary(min_angle_deg);
        for (; begin < end; begin += cells_per_block)
            check_block(mesh, adjacency, begin, std::min(end, begin + cells_per_block), min_angle_deg, summary);
        return summary;
    };
    CellsSummary all(min_angle_deg);
    for (CellsSummary& part : core::parallel_blocks(CellEdges(mesh).cells(), blocks * cells_per_block, check_blocks))
        all.append(std::move(part));
    return all;
}

TransitionSummary summarize_transition(std::vector<double> area_ratios) {
    if (area_ratios.empty()) return {};
    const auto percentile = [&](std::size_t percent) {
        const auto at = area_ratios.begin() + static_cast<std::ptrdiff_t>((area_ratios.size() - 1) * percent / 100);
        std::nth_element(area_ratios.begin(), at, area_ratios.end());
        return *at;
    };
    return {area_ratios.size(), percentile(1), percentile(50), percentile(99)};
}

}  // namespace lamina::mesh
