// The motion of the walls: each wall vertex moves, and the rays above it turn.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <lamina/mesh.hpp>

#include "morphing/rays.hpp"
#include "morphing/symmetric_system.hpp"

namespace lamina::morphing {

/// The motion x -> x + turn (x - w) + shift of a ray above a wall vertex w, in complex numbers. A turn by a unit vector u
/// is u - 1, so that a motion which leaves everything in its place holds zeros.
struct Motion {
    Point turn;
    Point shift;
};

/// The turns of the edges of the walls, smoothed along the walls, and the motions of the rays that follow.
///
/// Each edge turns by a unit vector r. The smoothed turns t minimise the sum over the edges of length |t - r|^2, and over
/// the pairs of neighbours of weight reach^2 / distance |t_before - t_after|^2: turns that change less along the wall
/// than over the height of the rays, which is the reach, let no rays cross. The weight is the cosine of the angle between
/// the two, and 0 beyond a right angle: the rays of a fan share out what its corner opens or closes.
class WallTurns {
public:
    /// `edges` are places in `wall`, the wall vertices, and `reach` has the height of the rays there.
    WallTurns(std::vector<Point> wall, std::vector<Segment> edges, std::vector<Ray> rays,
              std::span<const double> reach);

    /// Returns the motions of the rays where the wall vertices move to these points.
    std::vector<Motion> motions(std::span<const Point> moved) const;
    /// Returns the derivative of motions() in a direction.
    std::vector<Motion> derivative(std::span<const Point> moved, std::span<const Point> direction) const;
    /// Returns the gradient by the moved points of a function whose gradient by the motions is given.
    std::vector<Point> gradient(std::span<const Point> moved, std::span<const Motion> by_motion) const;

private:
    std::vector<Point> wall_;
    std::vector<Segment> edges_;
    std::vector<Ray> rays_;
    std::vector<double> length_;                 ///< per edge
    std::vector<std::uint32_t> before_, after_;  ///< per wall vertex: its edges, which are the same at an end of a wall
    SymmetricSystem smoothing_;

    void find_edges_beside_vertices();
    Point vector_of(std::size_t edge, std::span<const Point> points) const;
    /// Returns the moved edge times the conjugate of the one before: its turn times a length.
    Point change_of(std::size_t edge, std::span<const Point> moved) const;
    std::vector<Point> smoothed(std::span<const Point> of_edges) const;
    std::vector<Point> smoothed_turns(std::span<const Point> moved) const;
    /// Returns the value at a ray of values at the edges.
    Point at_ray(const Ray& ray, std::span<const Point> of_edges) const;
};

}  // namespace lamina::morphing
