// The edges of closed polygons: of fronts that are to be divided, and of walls.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <lamina/point.hpp>

#include "core/box_tree.hpp"
#include "core/segments.hpp"

namespace lamina::layers {

struct PolygonEdge {
    Point a, b;
    double length;
    std::size_t previous, next;  ///< indices of the edges before a and behind b
    double requested;            ///< the length that it asks edges beside it for, at least its own
};

/// Returns the edges of closed polygons, one polygon after the other. least_requests: one length per polygon and edge,
/// or empty.
std::vector<PolygonEdge> polygon_edges(std::span<const std::vector<Point>> polygons,
                                       std::span<const std::vector<double>> least_requests = {});

/// Returns a search tree over segments with the ends a and b.
template <class Segments>
core::BoxTree segment_tree(const Segments& segments) {
    std::vector<Box> boxes;
    boxes.reserve(segments.size());
    for (const auto& segment : segments) boxes.push_back(core::bounding_box(segment.a, segment.b));
    return core::BoxTree(std::move(boxes));
}

}  // namespace lamina::layers
