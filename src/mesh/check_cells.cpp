#include "mesh/check_cells.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <mutex>
#include <span>
#include <utility>

#include "core/in_order.hpp"
#include "core/parallel.hpp"
#include "core/predicates.hpp"
#include "mesh/adjacency.hpp"
#include "mesh/cell_orientation.hpp"
#include "mesh/cell_text.hpp"
#include "mesh/isotropic_cells.hpp"
#include "mesh/triangle_shapes.hpp"

namespace lamina::mesh {

namespace {

/// Reports a cell whose orientation has this sign unless the sign is positive.
void require_positive(double sign, const MeshView& mesh, std::size_t cell, Point at, CellsSummary& summary) {
    if (sign > 0) return;
    summary.defects.add([&] {
        return MeshDefect{fmt::format("{} {}", sign < 0 ? "clockwise or folded" : "flat", cell_text(mesh, cell)), at};
    });
}

/// Checks the orientation and the shape of one quadrilateral, and returns its area.
double check_quad(const MeshView& mesh, std::size_t cell, double min_angle_deg, CellsSummary& summary) {
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
void add_shapes(const MeshView& mesh, std::size_t first, const TriangleShapes& shapes, double min_angle_deg,
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
void check_triangles(const MeshView& mesh, std::size_t begin, std::size_t end, double min_angle_deg,
                     std::vector<double>& areas, CellsSummary& summary) {
    TriangleShapes shapes;
    for (std::size_t first = begin; first < end; first += TriangleShapes::capacity) {
        const std::size_t count = std::min(TriangleShapes::capacity, end - first);
        measure_triangles(mesh.points.data(), mesh.triangles.subspan(first, count), shapes);
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
void check_edge(const MeshView& mesh, const CellEdges& edges, EdgePair pair, AreaOfCell&& area_of_cell,
                CellsSummary& summary, VertexMarks& frozen) {
    const std::size_t cell = edges.cell_of(pair.edge), other = edges.cell_of(pair.twin);
    const bool isotropic = is_isotropic(mesh, cell), other_isotropic = is_isotropic(mesh, other);
    const double area = area_of_cell(cell), other_area = area_of_cell(other);
    if (!isotropic || !other_isotropic)
        summary.layer.add_to_largest_ratio(area, other_area, mesh.points[edges.origin(pair.edge).index()],
                                           mesh.points[edges.target(pair.edge).index()]);
    if (!isotropic && !other_isotropic) return;
    const auto freeze = [&] {
        frozen.add(edges.origin(pair.edge));
        frozen.add(edges.target(pair.edge));
    };
    if (isotropic != other_isotropic) {
        const auto [inner, outer] = isotropic ? std::pair{other_area, area} : std::pair{area, other_area};
        const auto [from, to] = isotropic ? std::pair{pair.twin, pair.edge} : std::pair{pair.edge, pair.twin};
        summary.transition.push_back({inner / outer, height_over(mesh, edges, to) / height_over(mesh, edges, from)});
        const std::size_t edge = isotropic ? pair.edge : pair.twin;
        summary.outline.push_back({edges.origin(edge), edges.target(edge)});
        freeze();
        return;
    }
    if (!mesh.piece.empty() && mesh.piece[cell] != mesh.piece[other]) freeze();
    summary.isotropic.add_neighbours(area, other_area);
    if (!is_isotropic_triangle(mesh, cell) || !is_isotropic_triangle(mesh, other)) return;
    ++summary.delaunay.edges;
    summary.delaunay.violations += violates_delaunay(mesh, pair.edge, pair.twin);
}

/// A block of cells, with memory that a thread uses for one block after the other.
struct CellBlock {
    std::size_t begin = 0, end = 0;   ///< its cells
    std::vector<std::uint32_t> twin;  ///< per edge of the block, both counted from the first one
    std::vector<std::uint32_t> firsts;
    std::vector<double> areas;  ///< per cell of the block
};

/// Sets `firsts` to the edges that have a twin with a higher number, so that each pair is there once. Selects them
/// without a branch, which the processor would mispredict half of the time.
void select_first_of_pairs(CellBlock& block) {
    block.firsts.resize(block.twin.size() + 1);
    std::size_t n = 0;
    for (std::size_t e = 0; e < block.twin.size(); ++e) {
        block.firsts[n] = static_cast<std::uint32_t>(e);
        n += static_cast<unsigned>(block.twin[e] > e) & static_cast<unsigned>(block.twin[e] != no_edge);
    }
    block.firsts.resize(n);
}

/// Checks the cells of a block and the edges between them.
void check_block(const MeshView& mesh, CellBlock& block, double min_angle_deg, CellsSummary& summary,
                 VertexMarks& frozen) {
    const CellEdges edges(mesh);
    const std::size_t begin = block.begin, end = block.end;
    block.areas.resize(end - begin);
    const std::size_t triangles_end = std::clamp(mesh.triangles.size(), begin, end);
    check_triangles(mesh, begin, triangles_end, min_angle_deg, block.areas, summary);
    for (std::size_t cell = triangles_end; cell < end; ++cell)
        block.areas[cell - begin] = check_quad(mesh, cell, min_angle_deg, summary);
    const auto area_of_cell = [&](std::size_t cell) { return block.areas[cell - begin]; };
    select_first_of_pairs(block);
    const auto first = static_cast<std::uint32_t>(edges.first(begin));
    for (const std::uint32_t e : block.firsts)
        check_edge(mesh, edges, {first + e, first + block.twin[e]}, area_of_cell, summary, frozen);
}

}  // namespace

double area_of(const MeshView& mesh, const CellEdges& edges, std::size_t cell) {
    const auto corner = [&](std::size_t i) { return mesh.points[edges.corner(cell, i).index()]; };
    return edges.corners(cell) == 3 ? 0.5 * cross(corner(1) - corner(0), corner(2) - corner(0))
                                    : 0.5 * cross(corner(2) - corner(0), corner(3) - corner(1));
}

double height_over(const MeshView& mesh, const CellEdges& edges, std::size_t edge) {
    const Point a = mesh.points[edges.origin(edge).index()], b = mesh.points[edges.target(edge).index()];
    const std::size_t cell = edges.cell_of(edge), corners = edges.corners(cell), first = edge - edges.first(cell);
    double sum = 0;
    for (std::size_t i = 2; i < corners; ++i) {
        const Point p = mesh.points[edges.corner(cell, (first + i) % corners).index()];
        sum += cross(b - a, p - a);
    }
    return sum / (distance(a, b) * static_cast<double>(corners - 2));
}

void CellsSummary::append(CellsSummary&& part) {
    area += part.area;
    layer.append(part.layer);
    isotropic.append(part.isotropic);
    narrow.insert(narrow.end(), part.narrow.begin(), part.narrow.end());
    delaunay.edges += part.delaunay.edges;
    delaunay.violations += part.delaunay.violations;
    transition.insert(transition.end(), part.transition.begin(), part.transition.end());
    outline.insert(outline.end(), part.outline.begin(), part.outline.end());
    defects.append(std::move(part.defects));
}

CheckedCells check_cells(const MeshView& mesh, double min_angle_deg, std::optional<std::size_t> max_bytes) {
    // One summary serves several blocks, since summaries are appended by one thread at a time.
    constexpr std::size_t cells_per_part = 4 * cells_per_block;
    const CellEdges edges(mesh);
    EdgeSurvey survey(mesh, max_bytes);
    CheckedCells checked{CellsSummary(min_angle_deg), {}, VertexMarks(mesh.points.size())};
    core::InOrder<CellsSummary> in_order([&](CellsSummary part) { checked.summary.append(std::move(part)); });
    core::parallel_for(edges.cells(), cells_per_part, [&](std::size_t begin, std::size_t end) {
        CellsSummary summary(min_angle_deg);
        CellBlock block;
        for (block.begin = begin; block.begin < end; block.begin = block.end) {
            block.end = std::min(end, block.begin + cells_per_block);
            survey.match_block(block.begin, block.end, block.twin);
            check_block(mesh, block, min_angle_deg, summary, checked.frozen);
        }
        in_order.put(begin / cells_per_part, std::move(summary));
    });
    // Nothing that is added here depends on the order: counts, maxima, and numbers that will be sorted.
    std::mutex mutex;
    survey.match_between([&](std::span<const EdgePair> pairs) {
        CellsSummary summary(min_angle_deg);
        for (const EdgePair pair : pairs)
            check_edge(
                mesh, edges, pair, [&](std::size_t cell) { return area_of(mesh, edges, cell); }, summary,
                checked.frozen);
        const std::lock_guard lock(mutex);
        checked.summary.append(std::move(summary));
    });
    checked.edges = survey.take_totals();
    return checked;
}

TransitionSummary summarize_transition(std::span<const TransitionRatios> ratios) {
    if (ratios.empty()) return {};
    std::vector<double> areas, heights;
    for (const TransitionRatios& at_edge : ratios) {
        areas.push_back(at_edge.area);
        heights.push_back(at_edge.height);
    }
    const auto percentile = [](std::vector<double>& values, std::size_t percent) {
        const auto at = values.begin() + static_cast<std::ptrdiff_t>((values.size() - 1) * percent / 100);
        std::nth_element(values.begin(), at, values.end());
        return *at;
    };
    return {ratios.size(), percentile(areas, 1), percentile(areas, 50), percentile(areas, 99), percentile(heights, 90)};
}

}  // namespace lamina::mesh
