// Points and segments to be triangulated and refined, for tests and for the stress program.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <lamina/ids.hpp>
#include <lamina/point.hpp>

namespace lamina::test {

/// Points and segments to be triangulated.
struct PlanarGraph {
    std::vector<Point> points;
    std::vector<Segment> segments;

    /// Appends a closed polygon.
    void add_loop(const std::vector<Point>& corners);
    /// Appends a segment between two new points. Returns false, and appends nothing, if it meets another segment.
    bool add_segment(Point a, Point b);
};

/// A random graph, and the name of its kind.
struct RandomGraph {
    std::string kind;
    PlanarGraph graph;
};

/// Returns a square of ten units with isolated vertices, dangling segments, slits (two segments or a closed loop), a
/// fan of segments round one point, a hole with sharp corners, or a mixture, by the seed.
RandomGraph random_planar_graph(std::uint64_t seed);

}  // namespace lamina::test
