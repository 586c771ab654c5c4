// The motion of the walls: each wall vertex moves, and the rays above it turn.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <lamina/mesh.hpp>

#include "morphing/gaps.hpp"
#include "morphing/rays.hpp"
#include "morphing/symmetric_system.hpp"

namespace lamina::morphing {

/// The motion x -> x + turn (x - w) + shift of a ray above a wall vertex w, in complex numbers; what is beyond the
/// vertex k up to which heights are kept moves by stretch (x - k) as well. A turn by a unit vector u is u - 1, so that
/// a motion which leaves everything in its place holds zeros.
struct Motion {
    Point turn;
    Point shift;
    Point stretch;
};

/// The turns of the edges of the walls, smoothed along the walls, and the motions of the rays that follow.
/// Gap::stretch(), at the ends of the edges, is smoothed in the same way.
///
/// Each edge turns by a unit vector r. The smoothed turns t minimise the sum over the edges of length |t - r|^2, and
/// over the pairs of neighbours of weight reach^2 / distance |t_before - t_after|^2: turns that change less along the
/// wall than over a share of the rays' height, which is the reach, let no rays cross. The weight is the cosine of the
/// angle between the two, and 0 beyond a right angle: the rays of a fan share out what its corner opens or closes.
class WallTurns {
public:
    /// `edges` are places in `wall`, the wall vertices.
    WallTurns(std::vector<Point> wall, std::vector<Segment> edges, std::vector<Ray> rays);

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
    std::vector<Gap> gaps_;                      ///< per wall vertex
    SymmetricSystem smoothing_;

    /// The turn of an edge, or of a ray before it is scaled to length 1, and by how much it is stretched.
    struct Change {
        Point turn{};
        double stretch = 0;
    };
    /// Returns the ends of the highest rays of the wall vertices.
    std::vector<Point> highest_tips() const;
    void find_edges_beside_vertices();
    Point vector_of(std::size_t edge, std::span<const Point> points) const;
    /// Returns the moved edge times the conjugate of the one before: its turn times a length.
    Point change_of(std::size_t edge, std::span<const Point> moved) const;
    std::vector<Change> smoothed(std::span<const Change> of_edges) const;
    std::vector<Change> smoothed_changes(std::span<const Point> moved) const;
    /// Returns the gradient of the stretch at a wall vertex by Gap::vector_from().
    Point stretch_gradient(std::size_t v, std::span<const Point> moved) const;
    /// Returns the value at a ray of values at the edges.
    Change at_ray(const Ray& ray, std::span<const Change> of_edges) const;
    /// Adds the gradient by the moved points of a function whose gradient by the changes of the edges is given.
    void add_gradient_of_edges(std::span<const Point> moved, std::span<const Change> by_edge,
                               std::vector<Point>& gradient) const;
};

}  // namespace lamina::morphing
