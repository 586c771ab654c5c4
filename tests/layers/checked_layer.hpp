// Layers that check_layer() has looked at, and sets of points compared.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <lamina/layers.hpp>

#include "support/layers.hpp"
#include "support/shapes.hpp"

namespace lamina {

inline Layer sound_layer(const Geometry& geometry, const LayerOptions& options, const BorderOptions& border = {}) {
    Layer layer = test::make_layer(geometry, options, border);
    for (const std::string& finding : check_layer(layer, options, border)) ADD_FAILURE() << finding;
    return layer;
}
inline Layer sound_layer(const shapes::Outline& outline, const LayerOptions& options,
                         const BorderOptions& border = {}) {
    return sound_layer(shapes::geometry({outline}), options, border);
}

inline std::vector<Point> sorted_points(std::vector<Point> points, bool mirror) {
    if (mirror)
        for (Point& p : points) p.y = -p.y;
    std::sort(points.begin(), points.end(), lexicographically_less);
    return points;
}

/// Largest distance from a point of one set to the nearest of the other; the sets are small.
inline double set_distance(const std::vector<Point>& a, const std::vector<Point>& b) {
    double largest = 0;
    for (Point p : a) {
        auto at = std::lower_bound(b.begin(), b.end(), Point{p.x - 1e-9, -HUGE_VAL}, lexicographically_less);
        double nearest = HUGE_VAL;
        for (; at != b.end() && at->x <= p.x + 1e-9; ++at) nearest = std::min(nearest, distance(p, *at));
        largest = std::max(largest, nearest);
    }
    return largest;
}

}  // namespace lamina
