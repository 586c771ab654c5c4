// Sparse symmetric systems, by the residual of their solutions.
#include "morphing/symmetric_system.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include <lamina/error.hpp>
#include <lamina/threads.hpp>

#include "core/random.hpp"

namespace lamina::test {

namespace {

using morphing::Entry;
using morphing::Row;
using morphing::SymmetricSystem;

/// A matrix, and how many rows it has.
struct SystemToSolve {
    std::size_t n;
    std::vector<Entry> entries;
};

/// Returns a matrix whose diagonal exceeds the sum of the rest of its rows, with -1 between these pairs.
SystemToSolve dominant(std::size_t n, const std::vector<std::pair<std::size_t, std::size_t>>& pairs) {
    SystemToSolve system{n, {}};
    const auto add = [&](std::size_t i, std::size_t j, double value) {
        system.entries.push_back({static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(j), value});
    };
    for (std::size_t i = 0; i < n; ++i) add(i, i, 0.01);
    for (const auto& [i, j] : pairs) {
        add(std::max(i, j), std::min(i, j), -1);
        add(i, i, 1);
        add(j, j, 1);
    }
    return system;
}

/// A square grid, whose factor has dense parts of hundreds of columns.
SystemToSolve grid(std::size_t side) {
    std::vector<std::pair<std::size_t, std::size_t>> pairs;
    for (std::size_t i = 0; i < side; ++i)
        for (std::size_t j = 0; j + 1 < side; ++j) {
            pairs.emplace_back(i * side + j, i * side + j + 1);
            pairs.emplace_back(j * side + i, (j + 1) * side + i);
        }
    return dominant(side * side, pairs);
}

std::vector<Row> random_rows(std::size_t n) {
    core::Random random(7);
    std::vector<Row> rows(n);
    for (Row& row : rows)
        for (double& number : row) number = random.real(-1, 1);
    return rows;
}

/// Returns the largest number of right - A x.
double residual(const SystemToSolve& system, const std::vector<Row>& right, const std::vector<Row>& x) {
    std::vector<Row> left = right;
    for (const auto& [row, column, value] : system.entries)
        for (std::size_t k = 0; k < 4; ++k) {
            left[row][k] -= value * x[column][k];
            if (row != column) left[column][k] -= value * x[row][k];
        }
    double largest = 0;
    for (const Row& row : left)
        for (const double number : row) largest = std::max(largest, std::abs(number));
    return largest;
}

void expect_solved(const SystemToSolve& system) {
    const std::vector<Row> right = random_rows(system.n);
    const std::vector<Row> x = SymmetricSystem(system.n, system.entries).solve(right);
    EXPECT_LT(residual(system, right, x), 1e-11) << system.n << " rows";
}

TEST(SymmetricSystem, SolvesGrids) {
    for (const std::size_t side : {1, 2, 3, 7, 20, 65, 160}) expect_solved(grid(side));
}

TEST(SymmetricSystem, SolvesChainsRingsStarsDenseMatricesAndUnconnectedRows) {
    std::vector<std::pair<std::size_t, std::size_t>> chain, star, dense;
    for (std::size_t i = 0; i + 1 < 1000; ++i) chain.emplace_back(i, i + 1);
    for (std::size_t i = 1; i < 300; ++i) star.emplace_back(0, i);
    for (std::size_t i = 0; i < 130; ++i)
        for (std::size_t j = 0; j < i; ++j) dense.emplace_back(i, j);
    expect_solved(dominant(1000, chain));
    expect_solved(dominant(1003, chain));
    chain.emplace_back(0, 999);
    expect_solved(dominant(1000, chain));
    expect_solved(dominant(300, star));
    expect_solved(dominant(130, dense));
    expect_solved(dominant(5, {}));
}

TEST(SymmetricSystem, SolvesRandomGraphs) {
    core::Random random(3);
    for (std::size_t k = 0; k < 300; ++k) {
        const std::size_t n = 1 + k / 2;
        std::vector<std::pair<std::size_t, std::size_t>> pairs;
        for (std::size_t e = 0; e < 2 * k; ++e) {
            const auto i = random.below(n), j = random.below(n);
            if (i != j) pairs.emplace_back(i, j);
        }
        expect_solved(dominant(n, pairs));
    }
}

TEST(SymmetricSystem, HasTheSameSolutionOnAnyNumberOfThreads) {
    const SystemToSolve system = grid(160);
    const std::vector<Row> right = random_rows(system.n);
    std::vector<std::vector<Row>> solutions;
    for (const unsigned threads : {1u, 2u, 5u})
        with_threads(threads, [&] { solutions.push_back(SymmetricSystem(system.n, system.entries).solve(right)); });
    EXPECT_EQ(solutions[0], solutions[1]);
    EXPECT_EQ(solutions[0], solutions[2]);
}

TEST(SymmetricSystem, RefusesMatricesThatAreNotPositive) {
    SystemToSolve system = grid(20);
    system.entries.push_back({210, 210, -20});
    EXPECT_THROW(SymmetricSystem(system.n, system.entries), MeshError);
}

TEST(SymmetricSystem, MayHaveNoRows) { EXPECT_TRUE(SymmetricSystem(0, {}).solve({}).empty()); }

}  // namespace

}  // namespace lamina::test
