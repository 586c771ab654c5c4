// Sources of the size field, prepared for distances and grouped by place.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include <lamina/sizing.hpp>

#include "core/bounding_box.hpp"
#include "core/box_tree.hpp"

namespace lamina::sizing {

/// The shape of a source, prepared for distances.
struct SourceShape {
    Point a, along;                 ///< along = b - a of SizeSource
    double inverse_squared_length;  ///< 1 / |along|^2; 0 for a point
    double radius;
    SizeSource::Shape shape;

    /// Returns the squared distance from p to the shape without its radius.
    double squared_distance_to(Point p) const {
        if (shape == SizeSource::Shape::box) return core::squared_distance(Box{a, a + along}, p);
        const Point ap = p - a;
        const double t = std::clamp(dot(ap, along) * inverse_squared_length, 0.0, 1.0);
        return squared_length(ap - t * along);
    }
    /// Returns the distance from p to the shape; 0 inside it.
    double distance_to(Point p) const { return std::max(std::sqrt(squared_distance_to(p)) - radius, 0.0); }
    /// Returns whether the box lies inside the shape.
    bool covers(const Box& box) const { return has_inside() && covers_corners(box); }
    bool has_inside() const { return radius > 0 || shape == SizeSource::Shape::box; }

private:
    bool covers_corners(const Box& box) const;
};
SourceShape prepare_shape(const SizeSource& source);

/// A node of a binary tree of sources: a group of several sources, or a single one.
struct SourceGroup {
    Box box;
    double min_size = HUGE_VAL;  ///< of the sources in the group
    std::uint32_t right = 0;     ///< the right child; the left child follows its parent
    std::uint32_t shape = 0;     ///< of a single source: its index in SourceTree::shapes

    bool is_single() const { return right == 0; }
    /// Returns the longer side of the box.
    double extent() const { return core::longer_side(box); }
};

/// A binary tree of groups of sources. The first group is the root.
struct SourceTree {
    std::vector<SourceGroup> groups;
    std::vector<SourceShape> shapes;
};

/// Groups sources. The tree depends on the set of sources alone, neither on their order nor on the number of threads.
/// O(n log n).
SourceTree group_sources(std::span<const SizeSource> sources);

}  // namespace lamina::sizing
