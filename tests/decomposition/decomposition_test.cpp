#include "decomposition/pieces.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <gtest/gtest.h>

#include <lamina/error.hpp>
#include <lamina/predicates.hpp>

#include "core/parallel.hpp"
#include "kernel/triangulator.hpp"
#include "support/kernel_families.hpp"
#include "support/point_sets.hpp"

namespace lamina::test {
namespace {

using decomposition::PiecewiseTriangulation;
using decomposition::triangulate_in_pieces;

std::vector<Triangle> sequential(const std::vector<Point>& points) {
    return canonical(kernel::without_ghosts(kernel::triangulate_points(points)).triangles);
}

TEST(Decomposition, EqualsBruteForceOnSmallSets) {
    std::size_t pieces = 0;
    for (std::uint64_t seed = 1; seed <= 300; ++seed) {
        Random random(seed);
        const std::size_t n = 5 + random.below(20);
        for (const auto& points : {random_points(n, seed), random_grid_points(n, 6, seed)}) {
            const PiecewiseTriangulation t = triangulate_in_pieces(points, {.depth = 4, .leaf_vertices = 4});
            ASSERT_EQ(canonical(t.triangles), brute_force_delaunay(points)) << "seed " << seed;
            pieces += t.stats.pieces;
        }
    }
    EXPECT_GT(pieces, 1500u);
}

TEST(Decomposition, EqualsSequentialAtEveryDepth) {
    for (const auto& points : {random_points(20'000, 3), square_lattice(120, 100), hexagonal_lattice(120, 100),
                               cocircular_points(8), layer_points(300, 30), naca_layer_points(20'000),
                               flat_plate_points(10'000, 1, 0), flat_plate_points(10'000, 0.8, 0.6)}) {
        const auto expected = sequential(points);
        for (unsigned depth = 0; depth <= 7; ++depth) {
            const PiecewiseTriangulation t = triangulate_in_pieces(points, {.depth = depth, .leaf_vertices = 20});
            std::printf("n %zu depth %u: %zu pieces, largest/mean %.2f, copies %.3f, crossing %zu, unbalanced %zu, uncut %zu\n",
                points.size(), depth, t.stats.pieces, double(t.stats.largest_piece) * t.stats.pieces / t.stats.piece_vertices,
                double(t.stats.piece_vertices) / points.size(), t.stats.crossing_cuts, t.stats.unbalanced_cuts, t.stats.uncut);
            ASSERT_EQ(canonical(t.triangles), expected) << "depth " << depth;
        }
    }
}

}  // namespace
}  // namespace lamina::test
