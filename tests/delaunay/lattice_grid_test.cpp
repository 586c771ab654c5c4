// The vertices of a lattice that lie inside a region.
#include "delaunay/refine/lattice_grid.hpp"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include <lamina/predicates.hpp>

#include "core/random.hpp"

namespace lamina::delaunay {
namespace {

/// Returns a grid of this edge over the box in which every vertex is set.
LatticeGrid full_grid(const Box& box, double edge) {
    LatticeGrid grid;
    grid.edge = edge;
    grid.include(box);
    grid.allocate();
    std::fill(grid.bits.begin(), grid.bits.end(), ~LatticeWord{0});
    return grid;
}

bool is_set(const LatticeGrid& grid, LatticeRow j, std::size_t i) { return (grid.row(j)[i / 64] >> (i % 64) & 1) != 0; }

// A rhombus whose left and right corners lie exactly on a row: there, one of the two edges at each corner must count.
TEST(LatticeGrid, CornersThatLieOnARowCountOnce) {
    core::Random random(7);
    for (int k = 0; k < 2000; ++k) {
        const double edge = random.real(0.01, 0.2);
        const Box box{{random.real(-1, 1), random.real(-1, 1)}, {3, 3}};
        LatticeGrid grid = full_grid(box, edge);
        const auto row = static_cast<LatticeRow>(2 + random.below(static_cast<std::size_t>(grid.rows) - 4));
        const double y = grid.row_y(row), middle = 0.5 * (box.lower.x + box.upper.x);
        const std::vector<Point> corners{
            {middle, box.lower.y}, {middle + 0.4, y}, {middle, box.upper.y}, {middle - 0.4, y}};
        std::vector<Segment> sides;
        for (std::size_t i = 0; i < 4; ++i) sides.push_back({VertexId(i), VertexId((i + 1) % 4)});
        clear_outside(grid, corners, sides);

        for (LatticeRow j = 0; j < grid.rows; ++j)
            for (std::size_t i = 0; i < 64 * grid.words; ++i) {
                const Point p = grid.point(j, i);
                double least = HUGE_VAL;
                for (std::size_t s = 0; s < 4; ++s)
                    least = std::min(least, orient2d(corners[s], corners[(s + 1) % 4], p));
                if (std::abs(least) < 1e-12) continue;  // on the border, where rounding decides
                ASSERT_EQ(is_set(grid, j, i), least > 0)
                    << k << ": row " << j << ", column " << i << ", corners on " << row;
            }
    }
}

}  // namespace
}  // namespace lamina::delaunay
