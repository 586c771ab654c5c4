// Which process makes which pieces of a mesh.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "decoupling/cut_to_size.hpp"

namespace lamina::pipeline {

/// The pieces that a process makes: first those that are its own, then some of those that all share, until none is
/// left. Both are in the order of the work, the largest first.
struct PieceDeal {
    std::vector<std::size_t> own;
    std::vector<std::size_t> shared;  ///< the same for all processes
};

/// Deals the pieces. A process keeps those that are marked as kept. Of the rest it keeps those that it has searched,
/// whose lines it has divided and along which it matches the seams, but no more than four fifths of an equal share of
/// the rest by estimate, and none with which it would keep more than four fifths of an equal share of all. All others
/// are shared: they make up for wrong estimates, and for processes that have other work or are slow.
PieceDeal deal_pieces(std::span<const decoupling::EstimatedBorder> borders, unsigned process, unsigned processes);

}  // namespace lamina::pipeline
