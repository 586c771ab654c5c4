// The target length along the edges of fronts, which decides how they are divided.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <lamina/layers.hpp>

#include "core/box_tree.hpp"
#include "layers/polygon_edges.hpp"

namespace lamina::layers {

/// An edge may be this many times as long as its target before it is divided.
inline constexpr double target_slack = 1.1;

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
