// The chain problem of leans, against an independent solver and its conditions of optimality.
#include "layers/directions/leans.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/random.hpp"

namespace lamina::layers {
namespace {

struct Problem {
    std::vector<ColumnLack> lacks;
    std::vector<LeanBounds> bounds;
    double stiffness;
};

/// Returns a problem of n rays: columns that lack width or have too much, some that ask for nothing, some rays that
/// cannot lean and some that lean to one side alone.
Problem random_problem(std::size_t n, core::Random& random) {
    Problem problem{{}, {}, std::pow(10, random.real(-3, -1))};
    for (std::size_t k = 0; k < n; ++k) {
        const double wanted = random.below(8) == 0 ? -HUGE_VAL : random.real(-0.5, 0.2);
        problem.lacks.push_back({wanted, wanted - random.real(-0.1, 0.3)});
        const double most = random.below(5) == 0 ? 0 : random.real(0, 0.7);
        problem.bounds.push_back({random.below(6) == 0 ? 0 : -most, most});
    }
    return problem;
}

double next_of(const std::vector<double>& values, std::size_t k) { return values[k + 1 < values.size() ? k + 1 : 0]; }

double value_of(const Problem& p, const std::vector<double>& leans) {
    double sum = 0;
    for (std::size_t k = 0; k < leans.size(); ++k) {
        const double opening = next_of(leans, k) - leans[k];
        const double wanted = std::max(p.lacks[k].wanted - opening, 0.0),
                     least = std::max(p.lacks[k].least - opening, 0.0);
        sum += wanted * wanted + least * least + p.stiffness * leans[k] * leans[k];
    }
    return sum;
}

/// Returns the slope of half the term of a column by the angle that its rays diverge by, with the sign changed.
double pull_of(const ColumnLack& lack, double opening) {
    return std::max(lack.wanted - opening, 0.0) + std::max(lack.least - opening, 0.0);
}

/// Returns the largest violation of the conditions of optimality: by how much a lean could go on downhill.
double residual_of(const Problem& p, const std::vector<double>& leans) {
    const std::size_t n = leans.size();
    double largest = 0;
    for (std::size_t i = 0; i < n; ++i) {
        const std::size_t before = (i + n - 1) % n;
        const double slope = p.stiffness * leans[i] + pull_of(p.lacks[i], next_of(leans, i) - leans[i]) -
                             pull_of(p.lacks[before], leans[i] - leans[before]);
        const double free = std::clamp(leans[i] - slope, p.bounds[i].least, p.bounds[i].most);
        largest = std::max(largest, std::abs(free - leans[i]));
    }
    return largest;
}

/// Minimises over one lean after the other, by halvings, until none moves.
std::vector<double> descend(const Problem& p) {
    const std::size_t n = p.lacks.size();
    std::vector<double> leans(n, 0.0);
    for (std::size_t i = 0; i < n; ++i) leans[i] = std::clamp(0.0, p.bounds[i].least, p.bounds[i].most);
    for (int sweep = 0; sweep < 20000; ++sweep) {
        double moved = 0;
        for (std::size_t i = 0; i < n; ++i) {
            const std::size_t before = (i + n - 1) % n;
            double low = p.bounds[i].least, high = p.bounds[i].most;
            for (int halving = 0; halving < 60; ++halving) {
                const double t = 0.5 * (low + high);
                const double slope = p.stiffness * t + pull_of(p.lacks[i], next_of(leans, i) - t) -
                                     pull_of(p.lacks[before], t - leans[before]);
                (slope < 0 ? low : high) = t;
            }
            moved = std::max(moved, std::abs(0.5 * (low + high) - leans[i]));
            leans[i] = 0.5 * (low + high);
        }
        if (moved < 1e-15) break;
    }
    return leans;
}

TEST(LeanChain, IsTheMinimum) {
    core::Random random(1);
    for (int trial = 0; trial < 2000; ++trial) {
        const Problem p = random_problem(3 + random.below(trial % 10 == 0 ? 2000 : 60), random);
        const ChainLeans found = minimise_leans(p.lacks, p.bounds, p.stiffness);
        for (std::size_t i = 0; i < found.leans.size(); ++i) {
            EXPECT_GE(found.leans[i], p.bounds[i].least);
            EXPECT_LE(found.leans[i], p.bounds[i].most);
        }
        EXPECT_LT(residual_of(p, found.leans), 1e-12) << trial;
        EXPECT_LE(found.steps, 40u) << trial;
    }
}

TEST(LeanChain, EqualsAnIndependentSolution) {
    core::Random random(2);
    for (int trial = 0; trial < 40; ++trial) {
        const Problem p = random_problem(3 + random.below(20), random);
        const std::vector<double> found = minimise_leans(p.lacks, p.bounds, p.stiffness).leans, other = descend(p);
        for (std::size_t i = 0; i < found.size(); ++i) EXPECT_NEAR(found[i], other[i], 0.01) << trial << " " << i;
        EXPECT_LE(value_of(p, found), value_of(p, other) + 1e-14);
    }
}

TEST(LeanChain, TreatsBothDirectionsAlike) {
    core::Random random(3);
    for (int trial = 0; trial < 200; ++trial) {
        const std::size_t n = 3 + random.below(100);
        const Problem p = random_problem(n, random);
        Problem mirrored = p;
        for (std::size_t k = 0; k < n; ++k) {
            mirrored.lacks[k] = p.lacks[(2 * n - 2 - k) % n];
            mirrored.bounds[k] = {-p.bounds[n - 1 - k].most, -p.bounds[n - 1 - k].least};
        }
        const std::vector<double> leans = minimise_leans(p.lacks, p.bounds, p.stiffness).leans,
                                  twin = minimise_leans(mirrored.lacks, mirrored.bounds, mirrored.stiffness).leans;
        for (std::size_t i = 0; i < n; ++i) EXPECT_NEAR(leans[i], -twin[n - 1 - i], 1e-12);
    }
}

/// A column in the middle of many that lack nothing widens by what it lacks but for the stiffness, from both sides
/// alike.
TEST(LeanChain, SharesALackBetweenBothSides) {
    const std::size_t n = 101;
    Problem p{std::vector<ColumnLack>(n, {-1, -1}), std::vector<LeanBounds>(n, {-1, 1}), 1e-3};
    p.lacks[50].wanted = 0.2;
    const std::vector<double> leans = minimise_leans(p.lacks, p.bounds, p.stiffness).leans;
    EXPECT_NEAR(leans[50], -leans[51], 1e-14);
    EXPECT_NEAR(leans[51] - leans[50], 0.2, 1e-3);
    EXPECT_EQ(leans[49], 0);
    EXPECT_EQ(leans[52], 0);
}

}  // namespace
}  // namespace lamina::layers
