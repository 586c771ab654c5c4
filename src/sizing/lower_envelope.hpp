// The exact size field: the lower envelope of the cones over all sources.
// Source: P.-O. Persson, Mesh size functions for implicit geometries and PDE-based gradient limiting, Engineering with
// Computers 22 (2006): in a convex domain the gradient-limited size is h(x) = min_i (h_i + gradation |x - x_i|).
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <lamina/sizing.hpp>

#include "sizing/source_groups.hpp"

namespace lamina::sizing {

inline constexpr double sqrt_half = 0.70710678118654752;

/// The sources and groups of sources that may decide the field somewhere in a cell.
struct Candidates {
    std::size_t begin, groups, end;  ///< two ranges of the stack of LowerEnvelope: single sources, groups of several
    double nearest;                  ///< a lower bound of the distance of the candidates from the cell
    bool constant = false;           ///< one of the sources covers the cell, and none has a lower value anywhere in it

    bool empty() const { return begin == end; }
    bool is_one_source() const { return groups == begin + 1 && end == groups; }
};

/// The four quadrants of a cell, side by side: compilers work on several at once.
struct Quadrants {
    static constexpr std::size_t count = 4;
    using Numbers = std::array<double, count>;

    Numbers lower_x, lower_y, upper_x, upper_y;
    Numbers max_value;  ///< upper bounds of the field
    double side;

    Box box(std::size_t q) const { return {{lower_x[q], lower_y[q]}, {upper_x[q], upper_y[q]}}; }
};

/// Points of a cell, side by side, with upper bounds of the field there.
template <std::size_t N>
struct CellPoints {
    std::array<double, N> x, y, h;
};

/// Evaluates min(max_size, min over sources (size + gradation x distance)). The evaluation is fast because groups of
/// sources that cannot matter in a cell are dropped on the way down a quadtree (branch and bound): the candidates of
/// all cells between the root and the present one lie on a stack.
class LowerEnvelope {
public:
    LowerEnvelope(const SourceTree& sources, const SizeFieldOptions& options)
        : gradation_(options.gradation),
          max_size_(options.max_size),
          groups_(sources.groups),
          shapes_(sources.shapes) {}

    double max_size() const { return max_size_; }

    /// Clears the stack and puts the group of all sources there.
    Candidates push_all() {
        std::vector<std::uint32_t> all;
        if (!groups_.empty()) all.push_back(0);
        return push_copy(all);
    }
    /// Clears the stack and puts candidates there that copy() returned.
    Candidates push_copy(const std::vector<std::uint32_t>& candidates);
    /// Pushes the candidates of the four quadrants of a cell: those of the cell without the ones that another source
    /// undercuts all over the quadrant.
    std::array<Candidates, Quadrants::count> push(const Quadrants& quadrants, const Candidates& parent);
    /// Removes all candidates from the first ones of a cell on.
    void pop(const Candidates& first) { stack_.resize(first.begin); }
    /// Returns the candidates as numbers of their groups.
    std::vector<std::uint32_t> copy(const Candidates& candidates) const {
        return {stack_.begin() + static_cast<std::ptrdiff_t>(candidates.begin),
                stack_.begin() + static_cast<std::ptrdiff_t>(candidates.end)};
    }

    /// Lowers h at points of the candidates' cell, where it is an upper bound of the field, to the exact field.
    /// Instantiated for 4 and 6 points.
    template <std::size_t N>
    void evaluate(const Candidates& candidates, CellPoints<N>& points);

private:
    /// A group, and a lower bound of the values of its sources at a point.
    struct BoundedGroup {
        std::uint32_t index;
        double lowest;
    };

    /// A candidate, and the quadrants that it is one of, as bits.
    struct Found {
        std::uint32_t group, quadrants;
    };

    /// The bounds of the candidates of each quadrant, as far as push() has found them.
    struct QuadrantBounds {
        Quadrants::Numbers nearest;                              ///< distance of the nearest candidate
        Quadrants::Numbers lowest;                               ///< lowest value of a candidate
        Quadrants::Numbers covering;                             ///< smallest size of a source that covers the quadrant
        Quadrants::Numbers lowest_of_groups;                     ///< lowest value of a candidate of several sources
        std::array<std::size_t, Quadrants::count> lowest_group;  ///< its place in groups_found_
    };

    void find_source(std::uint32_t index, const Quadrants& quadrants, QuadrantBounds& bounds);
    void find_in_group(std::uint32_t index, const Quadrants& quadrants, QuadrantBounds& bounds);
    double evaluate_group(std::uint32_t index, Point p, double best);

    double gradation_, max_size_;
    const std::vector<SourceGroup>& groups_;
    const std::vector<SourceShape>& shapes_;
    std::vector<std::uint32_t> stack_;
    // Scratch space, kept so that it is allocated once: the groups still to be visited in a walk down the tree of
    // groups, and what push() has found so far.
    std::vector<std::uint32_t> pending_;
    std::vector<BoundedGroup> pending_at_point_;
    std::vector<Found> sources_found_, groups_found_;
};

}  // namespace lamina::sizing
