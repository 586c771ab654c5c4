// Outer borders must be graded before they are frozen, since no Delaunay refinement mends a long edge beside a short
// one (docs/decisions/0003). First each edge gets the number of parts that its target length needs, and the division
// points of divided edges shift towards the lengths of the neighbours. Then, wherever the parts on both sides of a
// corner still differ by more than the allowed ratio, the edge of the longer part gets one more, until nothing changes.
// Both steps treat the two directions of a front alike.
#include "layers/border/divide_borders.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>
#include <utility>

#include "core/box_tree.hpp"
#include "core/segments.hpp"
#include "layers/parameters.hpp"
#include "layers/stages.hpp"

namespace lamina::layers {

// Target lengths as the minimum over cones, one round each source, of a slope of the gradation. A tree over the
// sources finds the minimum at a point; along an edge the target is assembled from rises and plateaus.

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

// One edge divided by equal shares of the integral of ds / target, and the lengths of its parts.

namespace {

/// Edges are divided for the sake of the ratio into at most this many times the parts that the target needs.
constexpr std::size_t max_refinement = 6;

}  // namespace

EdgeDivision::EdgeDivision(double length, std::vector<TargetInterval> target, double whole_up_to)
    : length_(length), target_(std::move(target)) {
    scale_targets(1, 1);
    excess_ = total_;
    const bool whole = total_ <= std::max(whole_up_to, target_slack);
    min_parts_ = whole ? 1 : static_cast<std::size_t>(std::ceil(total_ / target_slack));
    parts_ = min_parts_;
}

bool EdgeDivision::extensible() const { return parts_ < max_refinement * min_parts_; }

void EdgeDivision::scale_targets(double first, double last) {
    double length = 0, done = 0;
    for (const TargetInterval& i : target_) length += i.length;
    scaled_ = target_;
    total_ = 0;
    for (TargetInterval& i : scaled_) {
        i.target *= first + (last - first) * ((done + 0.5 * i.length) / length);
        done += i.length;
        total_ += i.length / i.target;
    }
}

std::vector<double> EdgeDivision::division_points() const {
    std::vector<double> points;
    double distance = 0, sum = 0;  // along the edge, and of length / target, up to the current interval
    std::size_t k = 1;
    for (const auto& [length, target] : scaled_) {
        const double share = length / target;
        while (k < parts_) {
            const double wanted = total_ * static_cast<double>(k) / static_cast<double>(parts_);
            if (wanted > sum + share) break;
            points.push_back(distance + (wanted - sum) * target);
            ++k;
        }
        sum += share;
        distance += length;
    }
    assert(points.size() + 1 == parts_);
    return points;
}

EdgeDivision::EndParts EdgeDivision::end_parts() const {
    if (parts_ == 1) return {length_, length_};
    const double part = total_ / static_cast<double>(parts_);
    const auto advance = [part](auto begin, auto end) {
        double distance = 0, sum = 0;
        for (auto it = begin; it != end; ++it) {
            const double share = it->length / it->target;
            if (sum + share >= part) return distance + (part - sum) * it->target;
            sum += share;
            distance += it->length;
        }
        return distance;
    };
    return {advance(scaled_.begin(), scaled_.end()), advance(scaled_.rbegin(), scaled_.rend())};
}

double EdgeDivision::max_ratio() const {
    double ratio = 1, from = 0, before = 0;
    std::vector<double> ends = division_points();
    ends.push_back(length_);
    for (double to : ends) {
        const double part = to - from;
        if (before > 0) ratio = std::max({ratio, part / before, before / part});
        before = part;
        from = to;
    }
    return ratio;
}

// Edges that lie back to back, on both sides of a sheet. They get the same points.

namespace {

/// Returns, for each edge, the number of the one that lies back to back with it but for a gap, or its own number.
std::vector<std::size_t> edges_back_to_back(std::span<const PolygonEdge> edges) {
    constexpr double widest_gap = 1e-6;  // of the edge
    std::vector<std::size_t> across(edges.size());
    std::iota(across.begin(), across.end(), std::size_t{0});
    const core::BoxTree tree = segment_tree(edges);
    for (std::size_t i = 0; i < edges.size(); ++i) {
        const PolygonEdge& edge = edges[i];
        const double gap = widest_gap * edge.length;
        const Point middle = midpoint(edge.a, edge.b);
        tree.overlaps({middle - Point{gap, gap}, middle + Point{gap, gap}}, [&](std::size_t j) {
            if (distance(edge.a, edges[j].b) < gap && distance(edge.b, edges[j].a) < gap) across[i] = j;
        });
    }
    return across;
}

}  // namespace

// The balance between the parts on both sides of each corner. Divided edges first give way to their neighbours; where
// that is not enough, the edge of the longer part gets one more.

namespace {

void sort_without_duplicates(std::vector<std::size_t>& indices) {
    std::sort(indices.begin(), indices.end());
    indices.erase(std::unique(indices.begin(), indices.end()), indices.end());
}

/// Returns the factor for the targets at one end of a divided edge, given the length of the part at that end and of the
/// neighbour's part beyond. The factor takes the part halfway to the neighbour's length where the neighbour is divided
/// and gives way as well, and beyond the neighbour's length where it cannot. With
///
///     |-------- 1 --------|---- 0.61 ---|-- 0.39 --|-- 0.5 --|-- 0.5 --|
///
/// a whole edge meets edges that are divided in two at a ratio of 1.64 instead of 2.
double factor_towards(double own, double neighbour, bool neighbour_divided) {
    const double q = std::clamp(neighbour / own, 0.25, 4.0);
    return neighbour_divided ? std::sqrt(q) : q * std::sqrt(std::sqrt(q));
}

class Balance {
public:
    /// `across`: edges_back_to_back(), which have as many parts as each other.
    Balance(std::span<const PolygonEdge> edges, std::span<const std::size_t> across, double max_ratio,
            std::vector<EdgeDivision>& divisions)
        : edges_(edges),
          across_(across),
          limit_(max_ratio * (1 + 1e-9)),
          divisions_(divisions),
          unscaled_(edges.size()),
          scaled_(edges.size()) {}

    void run() {
        for (std::size_t i = 0; i < edges_.size(); ++i) divisions_[i].take_parts(divisions_[across_[i]]);
        for (std::size_t i = 0; i < edges_.size(); ++i) measure(i);
        for (std::size_t i = 0; i < edges_.size(); ++i) scale_towards_neighbours(i);
        std::vector<std::size_t> active(edges_.size());  // edges whose corners are to be judged
        std::iota(active.begin(), active.end(), std::size_t{0});
        while (!active.empty()) {
            const std::vector<std::size_t> longer = edges_with_longer_parts(active);
            active.clear();
            for (const std::size_t longer_edge : longer) {
                divisions_[longer_edge].add_part();
                divisions_[across_[longer_edge]].take_parts(divisions_[longer_edge]);
                for (const std::size_t i : {longer_edge, across_[longer_edge]}) {
                    measure(i);
                    active.insert(active.end(), {edges_[i].previous, i, edges_[i].next});
                }
            }
            sort_without_duplicates(active);
            for (std::size_t i : active) scale_towards_neighbours(i);
        }
    }

private:
    std::span<const PolygonEdge> edges_;
    std::span<const std::size_t> across_;
    double limit_;  ///< max_ratio with a slack for rounding
    std::vector<EdgeDivision>& divisions_;
    std::vector<EdgeDivision::EndParts> unscaled_, scaled_;  ///< per edge, with its targets as given and as scaled

    void measure(std::size_t i) {
        divisions_[i].scale_targets(1, 1);
        unscaled_[i] = divisions_[i].end_parts();
    }

    /// Scales the targets of a divided edge so that its parts approach those of the neighbours in length, as far as the
    /// ratio of the parts inside the edge allows.
    void scale_towards_neighbours(std::size_t i) {
        EdgeDivision& division = divisions_[i];
        const std::size_t before = edges_[i].previous, after = edges_[i].next;
        if (division.divided()) {
            double first = factor_towards(unscaled_[i].first, unscaled_[before].last, divisions_[before].divided());
            double last = factor_towards(unscaled_[i].last, unscaled_[after].first, divisions_[after].divided());
            division.scale_targets(first, last);
            for (int tries = 0; tries < 4 && division.max_ratio() > limit_; ++tries) {
                first = tries < 3 ? std::sqrt(first) : 1;
                last = tries < 3 ? std::sqrt(last) : 1;
                division.scale_targets(first, last);
            }
        }
        scaled_[i] = division.end_parts();
    }

    /// Returns the edges that have the longer part at a corner of these edges where the ratio is too large, unless they
    /// may get no more parts.
    std::vector<std::size_t> edges_with_longer_parts(std::span<const std::size_t> active) const {
        std::vector<std::size_t> longer;
        const auto compare = [&](std::size_t i, std::size_t j) {
            if (scaled_[i].last > limit_ * scaled_[j].first) longer.push_back(i);
            if (scaled_[j].first > limit_ * scaled_[i].last) longer.push_back(j);
        };
        for (std::size_t i : active) {
            compare(edges_[i].previous, i);
            compare(i, edges_[i].next);
        }
        sort_without_duplicates(longer);
        std::erase_if(longer, [&](std::size_t i) { return !divisions_[i].extensible(); });
        return longer;
    }
};

}  // namespace

void balance_divisions(std::span<const PolygonEdge> edges, double max_ratio, std::vector<EdgeDivision>& divisions) {
    Balance(edges, edges_back_to_back(edges), max_ratio, divisions).run();
}

// Exact tests of the parts of divided edges against each other and against the walls.

namespace {

/// A part of a divided edge.
struct EdgePart {
    Point a, b;
    std::size_t edge;  ///< index of the edge
};

std::vector<EdgePart> parts_of(std::span<const PolygonEdge> edges, const std::vector<std::vector<Point>>& points) {
    std::vector<EdgePart> parts;
    for (std::size_t i = 0; i < edges.size(); ++i) {
        Point from = edges[i].a;
        for (Point p : points[i]) {
            parts.push_back({from, p, i});
            from = p;
        }
        parts.push_back({from, edges[i].b, i});
    }
    return parts;
}

/// Returns whether a part and the segment p-q meet in more than a common end.
bool in_conflict(const EdgePart& part, Point p, Point q) {
    if (part.a == q) return core::segments_fold(q, p, part.b);
    if (part.b == p) return core::segments_fold(p, part.a, q);
    if (part.a == p) return core::segments_fold(p, part.b, q);
    if (part.b == q) return core::segments_fold(q, part.a, p);
    return core::segments_meet(part.a, part.b, p, q);
}

/// Returns the edges that have a part in conflict with a wall or with a part of another edge. May list an edge twice.
std::vector<std::size_t> edges_in_conflict(std::span<const PolygonEdge> edges, std::span<const EdgePart> parts,
                                           std::span<const PolygonEdge> walls, const core::BoxTree& wall_tree) {
    std::vector<std::size_t> found;
    const core::BoxTree part_tree = segment_tree(parts);
    for (std::size_t k = 0; k < parts.size(); ++k) {
        const EdgePart& part = parts[k];
        const Box box = core::bounding_box(part.a, part.b);
        part_tree.overlaps(box, [&](std::size_t other) {
            if (other <= k || !in_conflict(part, parts[other].a, parts[other].b)) return;
            found.insert(found.end(), {part.edge, parts[other].edge});
        });
        wall_tree.overlaps(box, [&](std::size_t w) {
            const bool is_wall_edge = edges[part.edge].a == walls[w].a && edges[part.edge].b == walls[w].b;
            if (!is_wall_edge && in_conflict(part, walls[w].a, walls[w].b)) found.push_back(part.edge);
        });
    }
    return found;
}

}  // namespace

void undo_crossings(std::span<const PolygonEdge> edges, std::span<const PolygonEdge> walls,
                    std::vector<std::vector<Point>>& points) {
    const core::BoxTree wall_tree = segment_tree(walls);
    for (bool changed = true; changed;) {
        changed = false;
        for (std::size_t edge : edges_in_conflict(edges, parts_of(edges, points), walls, wall_tree)) {
            changed |= !points[edge].empty();
            points[edge].clear();
        }
    }
}

namespace {

/// Returns whether an edge is longer than a source asks for at its middle.
bool exceeds_sources(const PolygonEdge& edge, const BorderOptions& options) {
    const Point middle = midpoint(edge.a, edge.b);
    return std::any_of(options.sources.begin(), options.sources.end(), [&](const SizeSource& source) {
        return edge.length > source.size + options.gradation * distance_to(source, middle);
    });
}

/// Returns the division of an edge by itself. It may stay whole up to so many times its target, unless sources ask for
/// less.
EdgeDivision own_division(const PolygonEdge& edge, std::vector<TargetInterval> target, double whole_up_to,
                          const BorderOptions& options) {
    if (whole_up_to <= target_slack) return {edge.length, std::move(target)};
    const EdgeDivision division(edge.length, target, whole_up_to);
    const bool spared = !division.divided() && division.excess() > target_slack;
    return spared && exceeds_sources(edge, options) ? EdgeDivision(edge.length, std::move(target)) : division;
}

std::vector<EdgeDivision> balanced_divisions(std::span<const PolygonEdge> edges, const BorderOptions& options,
                                             std::span<const std::vector<double>> whole_up_to) {
    const TargetLength target(edges, options);
    std::vector<double> slacks;
    for (const std::vector<double>& front : whole_up_to) slacks.insert(slacks.end(), front.begin(), front.end());
    slacks.resize(edges.size(), target_slack);
    std::vector<EdgeDivision> divisions;
    divisions.reserve(edges.size());
    for (std::size_t i = 0; i < edges.size(); ++i)
        divisions.push_back(own_division(edges[i], target.along(i), slacks[i], options));
    balance_divisions(edges, options.max_ratio, divisions);
    return divisions;
}

/// Returns the division points of an edge, without those that floating point cannot tell from their neighbours.
std::vector<Point> division_points(const PolygonEdge& edge, const EdgeDivision& division) {
    std::vector<Point> points;
    Point before = edge.a;
    for (double at : division.division_points()) {
        const Point p = edge.a + (at / edge.length) * (edge.b - edge.a);
        if (p == before || p == edge.b) continue;
        points.push_back(p);
        before = p;
    }
    return points;
}

/// Returns the points of an edge that lie across from those of another one.
std::vector<Point> points_across(const PolygonEdge& other, const std::vector<Point>& of_other,
                                 const PolygonEdge& edge) {
    std::vector<Point> points;
    for (auto p = of_other.rbegin(); p != of_other.rend(); ++p)
        points.push_back(edge.a + distance(*p, other.b) / other.length * (edge.b - edge.a));
    return points;
}

}  // namespace

BorderDivision divide_borders(std::span<const std::vector<Point>> fronts, std::span<const std::vector<Point>> walls,
                              const BorderOptions& options, std::span<const std::vector<double>> least_requests,
                              std::span<const std::vector<double>> whole_up_to) {
    const std::vector<PolygonEdge> edges = polygon_edges(fronts, least_requests);
    const std::vector<EdgeDivision> divisions = balanced_divisions(edges, options, whole_up_to);
    std::vector<std::vector<Point>> points(edges.size());
    const std::vector<std::size_t> across = edges_back_to_back(edges);
    for (std::size_t i = 0; i < edges.size(); ++i)
        points[i] = across[i] < i ? points_across(edges[across[i]], points[across[i]], edges[i])
                                  : division_points(edges[i], divisions[i]);
    undo_crossings(edges, polygon_edges(walls), points);

    BorderDivision result;
    std::size_t i = 0;
    for (const std::vector<Point>& front : fronts) {
        auto& points_of_front = result.points.emplace_back();
        auto& excess_of_front = result.excess.emplace_back();
        for (std::size_t k = 0; k < front.size(); ++k, ++i) {
            excess_of_front.push_back(divisions[i].excess());
            points_of_front.push_back(std::move(points[i]));
        }
    }
    assert(i == edges.size());
    return result;
}

}  // namespace lamina::layers
