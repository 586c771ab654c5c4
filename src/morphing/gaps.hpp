// The gaps that rays look across: slots between bodies, and coves.
#pragma once

#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include <lamina/mesh.hpp>

#include "morphing/rays.hpp"

namespace lamina::morphing {

/// The place on a wall that a wall vertex sees along its highest ray: a point of an edge between two wall vertices.
struct Gap {
    Segment across;     ///< places of the edge's ends among the wall vertices
    double share = 0;   ///< from 0 at its first end to 1 at its second
    double length = 1;  ///< up to there
    /// How much the layers fill the gap: 1 where they take all of it, 1/2 where they take half, and about r^2 where
    /// they take a small share r; 0 where nothing is near.
    double weight = 0;

    /// Returns the vector from the wall vertex to what it sees, at these places of the wall vertices.
    Point vector_from(std::size_t wall_vertex, std::span<const Point> wall) const {
        return (1 - share) * wall[across.a.index()] + share * wall[across.b.index()] - wall[wall_vertex];
    }
    /// Returns by which share the rays get longer where the gap has a new length. With d, the relative change of the
    /// length, it is weight x (d + k - sqrt(d^2 + k^2)) / 2, a smooth min(d, 0): a gap that closes takes its layers
    /// along, and one that opens leaves them as they are.
    double stretch(double new_length) const {
        const double d = new_length / length - 1;
        return 0.5 * weight * (d + kink - std::sqrt(d * d + kink * kink));
    }
    /// Returns the derivative of stretch().
    double stretch_derivative(double new_length) const {
        const double d = new_length / length - 1;
        return 0.5 * weight / length * (1 - d / std::sqrt(d * d + kink * kink));
    }

    static constexpr double kink = 0.25;  ///< the relative change of a gap within which the minimum is rounded
};

/// Returns the gap of each wall vertex. `tips` has the end of the highest ray of each, or the vertex itself.
std::vector<Gap> find_gaps(std::span<const Point> wall, std::span<const Segment> edges, std::span<const Point> tips);

}  // namespace lamina::morphing
