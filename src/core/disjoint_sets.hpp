// Sets of numbers that grow together.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace lamina::core {

/// The numbers below n, each in a set of its own at first. Source: R. E. Tarjan, J. ACM 22 (1975), with the paths
/// halved as by Tarjan and van Leeuwen (1984).
class DisjointSets {
public:
    explicit DisjointSets(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), std::uint32_t{0}); }

    /// Returns the smallest number of the set of v.
    std::uint32_t find(std::uint32_t v) {
        while (parent_[v] != v) v = parent_[v] = parent_[parent_[v]];
        return v;
    }
    /// Joins the sets of two numbers. Returns whether they were different ones.
    bool join(std::uint32_t a, std::uint32_t b) {
        const auto [low, high] = std::minmax({find(a), find(b)});
        parent_[high] = low;
        return low != high;
    }

private:
    std::vector<std::uint32_t> parent_;
};

}  // namespace lamina::core
