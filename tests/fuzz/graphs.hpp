// Points and segments from the bytes of an input, for the targets that triangulate.
#pragma once

#include <vector>

#include <lamina/ids.hpp>
#include <lamina/point.hpp>

#include "fuzz/fuzz.hpp"

namespace lamina::fuzz {

struct Graph {
    std::vector<Point> points;
    std::vector<Segment> segments;
};

/// Returns up to `max_points` points and as many segments.
inline Graph read_graph(Numbers& numbers, std::size_t max_points) {
    Graph graph;
    const std::size_t points = 3 + numbers.below(max_points - 2), segments = numbers.below(max_points);
    for (std::size_t i = 0; i < points; ++i) {
        const double x = numbers.coordinate();
        graph.points.push_back({x, numbers.coordinate()});
    }
    for (std::size_t i = 0; i < segments; ++i) {
        const VertexId a{numbers.below(points)};
        graph.segments.push_back({a, VertexId{numbers.below(points)}});
    }
    return graph;
}

}  // namespace lamina::fuzz
