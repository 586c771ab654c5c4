// Target lengths as the minimum over cones, one round each source, of a slope of the gradation. A tree over the
// sources finds the minimum at a point; along an edge the target is assembled from rises and plateaus.
#include "layers/target_length.hpp"

#include <algorithm>
#include <cmath>

#include "layers/gap_sources.hpp"

namespace lamina::layers {

namespace {

/// Length of the intervals of the step function, as a share of the target.
constexpr double interval_share = 0.25;

}  // namespace

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
