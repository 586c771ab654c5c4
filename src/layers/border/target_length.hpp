// The target length along the edges of fronts, which decides how they are divided.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <lamina/point.hpp>
#include <lamina/sizing.hpp>

#include "core/box_tree.hpp"
#include "core/segments.hpp"
#include "layers/layer.hpp"
#include "layers/parameters.hpp"

namespace lamina::layers {

// The edges of closed polygons: of fronts that are to be divided, and of walls.

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

// The lengths that edges of fronts request of their surroundings: their own, or the width of a gap that they face.

/// Adds the sources of one edge, in order from its start to its end. A gap counts where it is: the edge is halved until
/// its parts are no longer than the gap that they face. A part requests the width of the gap, or `requested_length` if
/// that is less. tree: the tree over the edges.
void add_edge_sources(std::span<const PolygonEdge> edges, const core::BoxTree& tree, std::size_t edge,
                      double requested_length, std::vector<SizeSource>& sources);

/// A stretch of an edge and the target length of the edges on it.
struct TargetInterval {
    double length, target;
};

/// Finds target lengths. The target at x is the minimum over all edges j of (the length that j requests + gradation x
/// distance(x, j)), likewise over BorderOptions::sources, and is at most BorderOptions::max_edge. Targets are lower
/// than the options say by target_slack, so that no part of an edge is longer than the options allow and lengths grow
/// by no more than their gradation. Nor do successive parts of one edge, which grow by a factor of about
/// exp(target_slack x gradation), exceed max_ratio.
class TargetLength {
public:
    /// Keeps a reference to the edges.
    TargetLength(std::span<const PolygonEdge> edges, const BorderOptions& options);

    /// Returns the target along an edge as a step function that does not depend on the direction of the edge.
    std::vector<TargetInterval> along(std::size_t edge) const;

private:
    /// An end of a stretch of an edge.
    struct End {
        Point at;
        double target;
    };

    std::span<const PolygonEdge> edges_;
    double gradation_, max_target_;
    std::vector<SizeSource> sources_;           ///< of the edges, then of the options
    core::BoxTree tree_;                        ///< over the sources
    std::vector<std::vector<double>> targets_;  ///< of the sources, grouped for the search in the tree
    std::vector<double> at_start_;              ///< target at the start of each edge

    void add_sources(const BorderOptions& options);
    void find_targets_at_starts();
    double at(Point p, double upper_bound) const;
    void add_intervals(const End& a, const End& b, double length, double cap,
                       std::vector<TargetInterval>& intervals) const;
    void add_rise(double target, double length, std::vector<TargetInterval>& intervals) const;
};

}  // namespace lamina::layers
