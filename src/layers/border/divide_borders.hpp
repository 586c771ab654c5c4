// The division of fronts into edges of gradually varying length, which makes them outer borders.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include <lamina/point.hpp>
#include <lamina/sizing.hpp>

#include "core/box_tree.hpp"
#include "core/segments.hpp"
#include "layers/layer.hpp"
#include "layers/parameters.hpp"
#include "layers/stages.hpp"

namespace lamina::layers {

// The target length along the edges of fronts, which decides how they are divided.

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

// The division of one edge of a front into parts.

/// An edge with its target lengths and the number of parts that it is divided into. All parts take equal shares of the
/// integral of ds / target, so they are long where the target is large.
class EdgeDivision {
public:
    EdgeDivision() = default;
    /// target: TargetLength::along() of the edge. whole_up_to: the edge may be this many times as long as its target
    /// and still stay whole.
    EdgeDivision(double length, std::vector<TargetInterval> target, double whole_up_to = target_slack);

    /// Returns the length of the edge over the target length along it.
    double excess() const { return excess_; }

    bool divided() const { return parts_ > 1; }
    /// Returns whether there may be another part: up to six times as many parts as the target needs.
    bool extensible() const;
    void add_part() { ++parts_; }
    /// Takes at least as many parts as another edge.
    void take_parts(const EdgeDivision& other) { parts_ = std::max(parts_, other.parts_); }

    /// Multiplies the targets by a factor that runs linearly from `first` at the edge's start to `last` at its end.
    /// Replaces the factors of earlier calls.
    void scale_targets(double first, double last);

    /// Returns the distances of the division points from the edge's start, ascending.
    std::vector<double> division_points() const;

    /// The lengths of the parts at both ends of the edge.
    struct EndParts {
        double first, last;
    };
    EndParts end_parts() const;

    /// Returns the largest ratio of the lengths of two neighbouring parts; 1 for an edge that is not divided.
    double max_ratio() const;

private:
    double length_ = 0, excess_ = 0;
    std::vector<TargetInterval> target_;  ///< unscaled
    std::vector<TargetInterval> scaled_;
    double total_ = 0;  ///< sum of length / target over the scaled intervals
    std::size_t min_parts_ = 1, parts_ = 1;
};

// Divisions of neighbouring edges balanced against each other.

/// Shifts division points and adds parts until the lengths of the parts on both sides of each corner differ by no more
/// than max_ratio, except where an edge may get no more parts. One division per edge. All corners are judged by one
/// state and then changed together, so that the result depends neither on where a polygon starts nor on its direction.
void balance_divisions(std::span<const PolygonEdge> edges, double max_ratio, std::vector<EdgeDivision>& divisions);

// Divisions of edges taken back where rounding makes them cross something.

/// Removes the division points of edges whose parts meet or fold onto other parts or walls. Division points lie on
/// their edge only to rounding, so this happens where a front nearly touches a wall or another front. points: the
/// division points of each edge, in order. Precondition: the edges themselves meet each other and the walls in common
/// vertices and whole common edges only.
void undo_crossings(std::span<const PolygonEdge> edges, std::span<const PolygonEdge> walls,
                    std::vector<std::vector<Point>>& points);

/// How the edges of fronts are divided. Both members hold one entry per front and edge; edge k runs from corner k to
/// corner k + 1.
struct BorderDivision {
    std::vector<std::vector<std::vector<Point>>> points;  ///< the division points inside the edge, in order
    std::vector<std::vector<double>> excess;              ///< length of the edge over the target length along it
};

/// Divides the edges of fronts so that lengths vary gradually along and between the fronts. Corners stay, and no edges
/// are merged. The target length at x is the minimum over all edges j of (the length that j requests + gradation x
/// distance(x, j)) and likewise over options.sources. An edge requests its own length. Where parts of it face another
/// edge across a gap narrower than the edge, they request the width of the gap.
/// least_requests holds one length per front and edge, or is empty; no edge requests less than that. whole_up_to holds
/// one number per front and edge, or is empty: that many times its target length an edge may be long and stay whole, but
/// where it is longer than a source asks for.
/// Edges that lie back to back, as both sides of a sheet without layers, get the same points.
/// Precondition: the fronts are simple and disjoint; they meet walls only in vertices and whole edges of both. The
/// result is so, too: an edge whose division would cross something by rounding stays whole.
BorderDivision divide_borders(std::span<const std::vector<Point>> fronts, std::span<const std::vector<Point>> walls,
                              const BorderOptions& options, std::span<const std::vector<double>> least_requests = {},
                              std::span<const std::vector<double>> whole_up_to = {});

}  // namespace lamina::layers
