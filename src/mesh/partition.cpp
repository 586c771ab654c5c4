#include "mesh/partition.hpp"

#include <algorithm>
#include <numeric>
#include <span>
#include <utility>

#include <lamina/error.hpp>

#include "core/parallel.hpp"
#include "mesh/adjacency.hpp"

namespace lamina::mesh {

namespace {

/// The middle of a cell, and its number.
struct NumberedMiddle {
    Point at;
    std::uint32_t cell;
};

/// Orders middles by one coordinate; equal ones by the other coordinate and by their cells, so that ties have a rule.
struct ByCoordinate {
    bool by_x;

    bool operator()(const NumberedMiddle& a, const NumberedMiddle& b) const {
        const Point p = by_x ? a.at : Point{a.at.y, a.at.x}, q = by_x ? b.at : Point{b.at.y, b.at.x};
        return p.x != q.x ? p.x < q.x : p.y != q.y ? p.y < q.y : a.cell < b.cell;
    }
};

/// Stores the parts, from `first` on, of these cells.
void bisect(std::span<NumberedMiddle> middles, std::uint32_t first, std::size_t parts,
            std::span<std::uint32_t> part_of_cell) {
    if (parts == 1) {
        for (const NumberedMiddle& middle : middles) part_of_cell[middle.cell] = first;
        return;
    }
    Box box;
    for (const NumberedMiddle& middle : middles) box.include(middle.at);
    const std::size_t lower_parts = parts / 2;
    // The first parts have one cell more where the number of cells is no multiple of that of the parts.
    const std::size_t lower = middles.size() / parts * lower_parts + std::min(lower_parts, middles.size() % parts);
    const auto border = middles.begin() + static_cast<std::ptrdiff_t>(lower);
    std::nth_element(middles.begin(), border, middles.end(), ByCoordinate{box.width() >= box.height()});
    core::parallel_invoke([&] { bisect(middles.first(lower), first, lower_parts, part_of_cell); },
                          [&] {
                              bisect(middles.subspan(lower), first + static_cast<std::uint32_t>(lower_parts),
                                     parts - lower_parts, part_of_cell);
                          });
}

}  // namespace

std::vector<std::uint32_t> partition_cells(const MeshView& mesh, std::size_t parts) {
    if (parts == 0) throw OptionError("parts", "must be positive");
    const CellEdges cells(mesh);
    std::vector<NumberedMiddle> middles(cells.cells());
    for (std::size_t c = 0; c < middles.size(); ++c) {
        Point sum{0, 0};
        for (std::size_t i = 0; i < cells.corners(c); ++i) sum = sum + mesh.points[cells.corner(c, i).index()];
        middles[c] = {(1.0 / static_cast<double>(cells.corners(c))) * sum, static_cast<std::uint32_t>(c)};
    }
    std::vector<std::uint32_t> part_of_cell(middles.size());
    bisect(middles, 0, parts, part_of_cell);
    return part_of_cell;
}

}  // namespace lamina::mesh
