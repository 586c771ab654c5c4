// Where rays start and which way they go; internal to the layer stage.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <lamina/layers.hpp>
#include <lamina/point.hpp>

namespace lamina {

/// A ray before it has points.
struct RayLine {
    Point origin;
    Point direction;  ///< unit vector
};

/// Rays of all bodies one after the other; body e owns [begin[e], begin[e + 1]), closed in itself.
struct RaySet {
    std::vector<RayLine> rays;
    std::vector<std::size_t> begin{0};

    std::size_t bodies() const { return begin.size() - 1; }
    /// Of each ray, the one that follows counter-clockwise round its body.
    std::vector<std::size_t> following() const;
};

/// Convex vertices that turn by more than this are corners: the same angle as ElementSummary::sharp_corners.
inline constexpr double sharp_corner_deg = 60;

/// Rays of one counter-clockwise body in wall order: the bisector at each vertex, or a fan at a sharp corner, and
/// refining rays on the edges between, so that neighbours differ by at most options.max_ray_angle_deg. Vertices of the
/// body are origins exactly; the rays of a fan have one origin.
/// Source: thesis 3 and 3.1.
std::vector<RayLine> make_rays(std::span<const Point> body, const LayerOptions& options);

}  // namespace lamina
