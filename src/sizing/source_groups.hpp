// Sources of the size field, made ready for distances and grouped by place.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include <lamina/sizing.hpp>

#include "core/box_tree.hpp"

namespace lamina::sizing {

/// Size + gradation x distance from the shape, but for the size.
struct Cone {
    Point a, along;
    double inverse_squared_length;  ///< 0 for a point
    double radius;
    SizeSource::Shape shape;

    /// From the shape without its radius.
    double squared_distance_to(Point p) const {
        if (shape == SizeSource::Shape::box) return core::squared_distance(Box{a, a + along}, p);
        const Point ap = p - a;
        const double t = std::clamp(dot(ap, along) * inverse_squared_length, 0.0, 1.0);
        return squared_length(ap - t * along);
    }
    double distance_to(Point p) const { return std::max(std::sqrt(squared_distance_to(p)) - radius, 0.0); }
    /// The shape is convex: it holds a box if it holds its corners.
    bool covers(const Box& box) const;
};
Cone make_cone(const SizeSource& source);

/// Node of a binary tree of sources: a group of several, or one source.
struct SourceGroup {
    Box box;
    double smallest = HUGE_VAL;  ///< size in the group
    std::uint32_t right = 0;     ///< the right child; the left one follows its parent
    std::uint32_t cone = 0;      ///< of a group of one
    bool single() const { return right == 0; }
    double extent() const { return std::max(box.width(), box.height()); }
};

/// The root is the first group.
struct SourceTree {
    std::vector<SourceGroup> groups;
    std::vector<Cone> cones;
};

/// Depends on the set of sources alone: neither on their order nor on the number of threads. O(n log n).
SourceTree group_sources(std::span<const SizeSource> sources);

}  // namespace lamina::sizing
