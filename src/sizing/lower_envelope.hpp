// The exact size field: the lower envelope of the cones over all sources.
// Source: P.-O. Persson, Mesh size functions for implicit geometries and PDE-based gradient limiting, Engineering with
// Computers 22 (2006): in a convex domain the gradient-limited size is h(x) = min_i (h_i + gradation |x - x_i|).
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include <lamina/sizing.hpp>

#include "sizing/source_groups.hpp"

namespace lamina::sizing {

/// The groups of sources that may decide the field somewhere in a cell.
struct Candidates {
    std::size_t begin, end;  ///< a range of the stack of LowerEnvelope
    double nearest;          ///< a lower bound of the distance of the groups from the cell
    bool constant = false;   ///< one of the sources covers the cell, and none has a lower value anywhere in it

    bool empty() const { return begin == end; }
};

/// Evaluates min(max_size, min over sources (size + gradation x distance)). The evaluation is fast because groups of
/// sources that cannot matter in a cell are dropped on the way down a quadtree (branch and bound): the candidates of
/// all cells between the root and the present one lie on a stack.
class LowerEnvelope {
public:
    LowerEnvelope(const SourceTree& sources, const SizeFieldOptions& options)
        : gradation_(options.gradation),
          inverse_gradation_(1 / std::max(options.gradation, 1e-300)),
          max_size_(options.max_size),
          groups_(sources.groups),
          shapes_(sources.shapes) {}

    double max_size() const { return max_size_; }

    /// Clears the stack and puts the group of all sources there.
    Candidates push_all() {
        stack_.clear();
        if (!groups_.empty()) stack_.push_back(0);
        return {0, stack_.size(), 0};
    }
    /// Clears the stack and puts groups there that copy() returned.
    Candidates push_copy(const std::vector<std::uint32_t>& groups) {
        stack_ = groups;
        return {0, stack_.size(), 0};
    }
    /// Pushes the candidates of a cell: those of its parent without the groups that another source undercuts all over
    /// the cell. `side` is the cell's side, `max_value` an upper bound of the field in the cell.
    Candidates push(const Box& cell, double side, double max_value, const Candidates& parent);
    /// Removes the topmost candidates.
    void pop(const Candidates& top) { stack_.resize(top.begin); }
    /// Returns the candidates as numbers of their groups.
    std::vector<std::uint32_t> copy(const Candidates& candidates) const {
        return {stack_.begin() + static_cast<std::ptrdiff_t>(candidates.begin),
                stack_.begin() + static_cast<std::ptrdiff_t>(candidates.end)};
    }
    bool is_one_source(const Candidates& candidates) const {
        return candidates.end - candidates.begin == 1 && groups_[stack_[candidates.begin]].is_single();
    }

    /// Returns the exact field at a point of the candidates' cell. `bound` is an upper bound of it.
    double evaluate(Point p, const Candidates& candidates, double bound);

private:
    double gradation_, inverse_gradation_, max_size_;
    const std::vector<SourceGroup>& groups_;
    const std::vector<SourceShape>& shapes_;
    std::vector<std::uint32_t> stack_;
    std::vector<std::uint32_t> pending_;  ///< groups still to be visited in a walk down the tree of groups
};

}  // namespace lamina::sizing
