// Target lengths as the minimum over cones, one round each source, of a slope of the gradation. A tree over the
// sources finds the minimum at a point; along an edge the target is assembled from rises and plateaus.
#include "layers/border/target_length.hpp"

#include <algorithm>
#include <cmath>

#include "core/segments.hpp"
#include "layers/parameters.hpp"

namespace lamina::layers {

// The edges of closed polygons in one list, with the indices of their neighbours.

std::vector<PolygonEdge> polygon_edges(std::span<const std::vector<Point>> polygons,
                                       std::span<const std::vector<double>> least_requests) {
    std::vector<PolygonEdge> edges;
    for (std::size_t p = 0; p < polygons.size(); ++p) {
        const std::vector<Point>& polygon = polygons[p];
        const std::size_t first = edges.size(), n = polygon.size();
        for (std::size_t k = 0; k < n; ++k) {
            const Point a = polygon[k], b = polygon[(k + 1) % n];
            const double length = distance(a, b);
            const double requested = least_requests.empty() ? length : std::max(length, least_requests[p][k]);
            edges.push_back({a, b, length, first + (k + n - 1) % n, first + (k + 1) % n, requested});
        }
    }
    return edges;
}

// The search for gaps between edges, and the sources along an edge that faces one.

namespace {

/// Returns the distance of two segments that do not cross.
double segment_distance(Point a, Point b, const PolygonEdge& other) {
    return std::min({core::distance_to_segment(a, other.a, other.b), core::distance_to_segment(b, other.a, other.b),
                     core::distance_to_segment(other.a, a, b), core::distance_to_segment(other.b, a, b)});
}

/// Returns the edges that lie across a gap from this one, no farther away than about its length.
std::vector<const PolygonEdge*> edges_across(std::span<const PolygonEdge> edges, const core::BoxTree& tree,
                                             std::size_t i) {
    std::vector<const PolygonEdge*> across;
    const PolygonEdge& edge = edges[i];
    Box near = core::bounding_box(edge.a, edge.b);
    near.lower = near.lower - Point{edge.length, edge.length};
    near.upper = near.upper + Point{edge.length, edge.length};
    tree.overlaps(near, [&](std::size_t j) {
        const PolygonEdge& other = edges[j];
        if (j == i || j == edge.previous || j == edge.next) return;
        const Point u = edge.b - edge.a, v = other.b - other.a;
        if (dot(u, v) > 0) return;  // a corner rather than a gap
        // Each must lie on the right of the other, where the outside is.
        const Point between = midpoint(other.a, other.b) - midpoint(edge.a, edge.b);
        if (cross(u, between) < 0 && cross(v, between) > 0) across.push_back(&other);
    });
    return across;
}

/// Adds the sources of the part a-b of an edge.
void add_part_sources(Point a, Point b, double requested_length, std::span<const PolygonEdge* const> across,
                      std::vector<SizeSource>& sources) {
    const double length = distance(a, b);
    double gap = HUGE_VAL;
    for (const PolygonEdge* other : across) gap = std::min(gap, segment_distance(a, b, *other));
    if (gap < requested_length && gap < length && length > min_gap_share * requested_length) {
        const Point middle = midpoint(a, b);
        add_part_sources(a, middle, requested_length, across, sources);
        add_part_sources(middle, b, requested_length, across, sources);
        return;
    }
    sources.push_back({a, b, std::clamp(gap, min_gap_share * requested_length, requested_length)});
}

}  // namespace

void add_edge_sources(std::span<const PolygonEdge> edges, const core::BoxTree& tree, std::size_t edge,
                      double requested_length, std::vector<SizeSource>& sources) {
    add_part_sources(edges[edge].a, edges[edge].b, requested_length, edges_across(edges, tree, edge), sources);
}

namespace {}  // namespace

TargetLength::TargetLength(std::span<const PolygonEdge> edges, const BorderOptions& options)
    : edges_(edges),
      gradation_(std::min(options.gradation, 1 - 1 / options.max_ratio) / target_slack),
      max_target_(options.max_edge / target_slack),
      tree_({}),
      at_start_(edges.size(), max_target_) {
    add_sources(options);
    find_targets_at_starts();
}

void TargetLength::add_sources(const BorderOptions& options) {
    const core::BoxTree edge_tree = segment_tree(edges_);
    for (std::size_t i = 0; i < edges_.size(); ++i) {
        const PolygonEdge& edge = edges_[i];
        const std::size_t first = sources_.size();
        add_edge_sources(edges_, edge_tree, i, edge.requested, sources_);
        at_start_[i] = std::min(at_start_[i], sources_[first].size);
        at_start_[edge.next] = std::min(at_start_[edge.next], sources_.back().size);
    }
    for (SizeSource source : options.sources) {
        source.size /= target_slack;
        sources_.push_back(source);
    }
    std::vector<Box> boxes;
    std::vector<double> targets;
    boxes.reserve(sources_.size());
    targets.reserve(sources_.size());
    for (const SizeSource& source : sources_) {
        boxes.push_back(lamina::bounding_box(source));
        targets.push_back(source.size);
    }
    tree_ = core::BoxTree(std::move(boxes));
    targets_ = tree_.group_minima(std::move(targets));
}

void TargetLength::find_targets_at_starts() {
    const auto pass_on = [&](std::size_t edge, std::size_t from, std::size_t to) {
        at_start_[to] = std::min(at_start_[to], at_start_[from] + gradation_ * edges_[edge].length);
    };
    // Targets are passed on along the fronts first: good bounds make the searches in the tree short.
    for (int round = 0; round < 2; ++round) {
        for (std::size_t i = 0; i < edges_.size(); ++i) pass_on(i, i, edges_[i].next);
        for (std::size_t i = edges_.size(); i-- > 0;) pass_on(i, edges_[i].next, i);
    }
    for (std::size_t i = 0; i < edges_.size(); ++i) at_start_[i] = at(edges_[i].a, at_start_[i]);
}

std::vector<TargetInterval> TargetLength::along(std::size_t edge) const {
    const PolygonEdge& e = edges_[edge];
    std::vector<TargetInterval> intervals;
    add_intervals({e.a, at_start_[edge]}, {e.b, at_start_[e.next]}, e.length, std::min(e.length, max_target_),
                  intervals);
    return intervals;
}

/// Returns the target at p, or `upper_bound` if that is less.
double TargetLength::at(Point p, double upper_bound) const {
    return tree_.minimum(p, gradation_, upper_bound, targets_,
                         [&](std::size_t i) { return distance_to(sources_[i], p); });
}

/// Adds the intervals between two points of an edge. The target rises from both ends until the rises meet or reach
/// `cap`, unless something near the middle requests less. In that case the stretch is halved until the middle agrees.
///
///              cap ____________
///                 /            \          target
///                /              \ .
///      target_a /                \ target_b
///              a ---------------- b
void TargetLength::add_intervals(const End& a, const End& b, double length, double cap,
                                 std::vector<TargetInterval>& intervals) const {
    const double min_target = std::min(a.target, b.target);
    const double expected = std::min(cap, min_target + gradation_ * 0.5 * length);
    if (length > 2 * min_target) {
        const Point middle = midpoint(a.at, b.at);
        const double target = at(middle, expected);
        if (target < 0.9 * expected || length > 64 * min_target) {
            add_intervals(a, {middle, target}, 0.5 * length, cap, intervals);
            add_intervals({middle, target}, b, 0.5 * length, cap, intervals);
            return;
        }
    }
    // The two rises would meet at this distance from a.
    const double peak = std::clamp(0.5 * (length + (b.target - a.target) / gradation_), 0.0, length);
    const double rise_a = std::min(peak, std::max(0.0, (cap - a.target) / gradation_));
    const double rise_b = std::min(length - peak, std::max(0.0, (cap - b.target) / gradation_));
    add_rise(a.target, rise_a, intervals);
    const double plateau = length - rise_a - rise_b;
    if (plateau > 0) {
        const double n = std::ceil(plateau / (interval_share * cap));
        intervals.insert(intervals.end(), static_cast<std::size_t>(n), {plateau / n, cap});
    }
    const auto from = static_cast<std::ptrdiff_t>(intervals.size());
    add_rise(b.target, rise_b, intervals);
    std::reverse(intervals.begin() + from, intervals.end());
}

/// Adds intervals of this total length, on which the target rises from `target` by the gradation.
void TargetLength::add_rise(double target, double length, std::vector<TargetInterval>& intervals) const {
    for (double done = 0; done < length;) {
        const double step = std::min(interval_share * (target + gradation_ * done), length - done);
        intervals.push_back({step, target + gradation_ * (done + 0.5 * step)});
        if (done + step == done) break;
        done += step;
    }
}

}  // namespace lamina::layers
