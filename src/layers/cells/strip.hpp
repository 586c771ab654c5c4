// Strips: polygons between two chains of points, cut into triangles without large angles.
#pragma once

#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include <lamina/ids.hpp>
#include <lamina/point.hpp>

namespace lamina::layers {

/// Cuts strips, one after the other. A strip lies between a lower and an upper chain, which both run from its first
/// side to its last; the sides join the ends of the chains. Each triangle stands on an edge of one chain and has its
/// apex on the other. A lower chain of one corner gives a fan, one of two corners a choice of diagonals or of two fans:
///
///     c-----q3----q2----q1----b
///     |   /   .'    `.   `.   |       Upper chain b, q1, q2, q3, c; lower chain a, d. The triangles on b-q1 and q1-q2
///     |  / .'          `. `.  |       have their apex at a; then comes the one on a-d with its apex at q2, and then
///     | /.'              `.`. |       those on q2-q3 and q3-c with their apex at d.
///     d-----------------------a
class StripCutter {
public:
    explicit StripCutter(std::span<const Point> points) : points_(points) {}

    /// Adds the triangles of the best cut, counter-clockwise, from the first side to the last: the sum of 1 / (1 +
    /// cos)^4 of the largest angles of all triangles is smallest, which the largest angle of all decides where one is
    /// much larger than others. Sums that differ by less than a millionth, which is more than rounding, count as equal.
    /// Where cuts are equal, `first_leads` prefers a large fan from the lower corner of the first side, otherwise from
    /// that of the last. Returns false, and adds nothing, where every cut has a triangle that is not positive (exact).
    /// Precondition: each chain has a corner or more, and both together three or more.
    bool cut(std::span<const VertexId> lower, std::span<const VertexId> upper, bool first_leads,
             std::vector<Triangle>& triangles);

private:
    /// A corner of each chain, joined by an edge: the state of a cut between the first side and the last. Its burdens
    /// are the least possible sums over the triangles from here, if the next one stands on the upper or the lower
    /// chain.
    struct CutState {
        double via_upper = HUGE_VAL, via_lower = HUGE_VAL;
        double burden = HUGE_VAL;  ///< the smaller one
    };

    std::span<const Point> points_;
    std::span<const VertexId> lower_, upper_;
    std::vector<CutState> states_;  ///< for each corner of the lower chain, all corners of the upper one

    CutState& state(std::size_t i, std::size_t j) { return states_[i * upper_.size() + j]; }
    void find_burdens();
};

}  // namespace lamina::layers
