// The tree of boxes against brute force.
#include "core/box_tree.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "core/random.hpp"

namespace lamina {
namespace {

using Pairs = std::vector<std::pair<std::size_t, std::size_t>>;

/// Returns the boxes of the edges of a random walk, which follow each other as the edges of an outline do.
std::vector<Box> walk_boxes(std::size_t n, core::Random& random) {
    std::vector<Box> boxes(n);
    Point p{0.5, 0.5};
    for (Box& box : boxes) {
        box.include(p);
        p = p + 0.1 * Point{random.real(-1, 1), random.real(-1, 1)};
        box.include(p);
    }
    return boxes;
}

/// Returns sizes round the powers of 4, at which the tree gets a new level.
std::vector<std::size_t> sizes() { return {0, 1, 2, 3, 4, 5, 7, 15, 16, 17, 63, 64, 65, 200, 257}; }

TEST(BoxTree, VisitsOverlappingItemsInAscendingOrder) {
    core::Random random(1);
    for (const std::size_t n : sizes()) {
        const std::vector<Box> boxes = walk_boxes(n, random);
        const core::BoxTree tree(boxes);
        for (int k = 0; k < 50; ++k) {
            Box query;
            query.include({random.real(), random.real()});
            query.include({random.real(), random.real()});
            std::vector<std::size_t> expected, visited;
            for (std::size_t i = 0; i < n; ++i)
                if (boxes[i].overlaps(query)) expected.push_back(i);
            tree.overlaps(query, [&](std::size_t i) { visited.push_back(i); });
            EXPECT_EQ(visited, expected) << n;
        }
    }
}

TEST(BoxTree, VisitsItemsWithValuesBelowALimitInAscendingOrder) {
    core::Random random(6);
    for (const std::size_t n : sizes()) {
        const std::vector<Box> boxes = walk_boxes(n, random);
        const core::BoxTree tree(boxes);
        std::vector<double> values(n);
        for (double& value : values) value = random.real();
        const auto minima = tree.group_minima(values);
        for (int k = 0; k < 50; ++k) {
            Box query;
            query.include({random.real(), random.real()});
            query.include({random.real(), random.real()});
            const double slope = k % 5 == 0 ? 0 : random.real(0, 3), limit = random.real(-0.1, 1.5);
            std::vector<std::size_t> expected, visited;
            for (std::size_t i = 0; i < n; ++i) {
                const double x = std::max({boxes[i].lower.x - query.upper.x, query.lower.x - boxes[i].upper.x, 0.0});
                const double y = std::max({boxes[i].lower.y - query.upper.y, query.lower.y - boxes[i].upper.y, 0.0});
                if (values[i] + slope * std::hypot(x, y) < limit) expected.push_back(i);
            }
            tree.below(query, slope, limit, minima, [&](std::size_t i) { visited.push_back(i); });
            EXPECT_EQ(visited, expected) << n;
        }
    }
}

TEST(BoxTree, VisitsOverlappingPairsOnce) {
    core::Random random(2);
    for (const std::size_t n : sizes()) {
        const std::vector<Box> boxes = walk_boxes(n, random);
        Pairs expected, visited;
        for (std::size_t i = 0; i < n; ++i)
            for (std::size_t j = i + 1; j < n; ++j)
                if (boxes[i].overlaps(boxes[j])) expected.emplace_back(i, j);
        core::BoxTree(boxes).overlapping_pairs([&](std::size_t i, std::size_t j) { visited.emplace_back(i, j); });
        std::sort(visited.begin(), visited.end());
        EXPECT_EQ(visited, expected) << n;
    }
}

TEST(BoxTree, VisitsPairsWithinHalvesBeforePairsAcross) {
    // All boxes overlap, so that the order alone counts.
    const std::vector<Box> boxes(6, Box{{0, 0}, {1, 1}});
    Pairs visited;
    core::BoxTree(boxes).overlapping_pairs([&](std::size_t i, std::size_t j) { visited.emplace_back(i, j); });
    EXPECT_EQ(visited, (Pairs{{0, 1},
                              {2, 3},
                              {0, 2},
                              {0, 3},
                              {1, 2},
                              {1, 3},
                              {4, 5},
                              {0, 4},
                              {0, 5},
                              {1, 4},
                              {1, 5},
                              {2, 4},
                              {2, 5},
                              {3, 4},
                              {3, 5}}));
}

TEST(BoxTree, FindsTheMinimumOfValueAndDistance) {
    core::Random random(3);
    for (const std::size_t n : sizes()) {
        const std::vector<Box> boxes = walk_boxes(n, random);
        std::vector<double> values(n);
        for (double& value : values) value = random.real(0, 0.3);
        const core::BoxTree tree(boxes);
        const std::vector<std::vector<double>> minima = tree.group_minima(values);
        for (int k = 0; k < 50; ++k) {
            const Point p{random.real(), random.real()};
            const double slope = random.real(0.1, 2);
            const auto distance_to = [&](std::size_t i) { return std::sqrt(core::squared_distance(boxes[i], p)); };
            double expected = 0.8;
            for (std::size_t i = 0; i < n; ++i) expected = std::min(expected, values[i] + slope * distance_to(i));
            EXPECT_EQ(tree.minimum(p, slope, 0.8, minima, distance_to), expected) << n;
        }
    }
}

TEST(BoxTree, LooksAtFewItemsOfACurveWithLikeValues) {
    // The teeth of a comb, whose sides are near to each other.
    for (const std::size_t n : {400, 40000}) {
        std::vector<Box> boxes(n);
        const auto at = [&](std::size_t i) {
            const double along = 40.0 * static_cast<double>(i) / static_cast<double>(n), part = std::fmod(along, 2);
            return Point{0.01 * std::floor(along), part < 1 ? part : 2 - part};
        };
        for (std::size_t i = 0; i < n; ++i) {
            boxes[i].include(at(i));
            boxes[i].include(at(i + 1));
        }
        const core::BoxTree tree(boxes);
        const auto minima = tree.group_minima(std::vector<double>(n, 1e-4));
        for (const std::size_t k : {n / 7, n / 2, n - 3}) {
            std::size_t looks = 0;
            const Point p = midpoint(at(k), at(k + 1));
            tree.minimum(p, 0.1, 1, minima, [&](std::size_t i) {
                ++looks;
                return std::sqrt(core::squared_distance(boxes[i], p));
            });
            EXPECT_LE(looks, 8u) << k << " of " << n;
        }
    }
}

}  // namespace
}  // namespace lamina
