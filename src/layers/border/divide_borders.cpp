// Outer borders must be graded before they are frozen, since no Delaunay refinement mends a long edge beside a short
// one (docs/decisions/0003). First each edge gets the number of parts that its target length needs. Then, wherever the
// parts on both sides of a corner differ by more than the allowed ratio, the edge of the longer part gets one more,
// until nothing changes. Both steps treat the two directions of a front alike.
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
// sources finds the minimum at a point.

// The edges of closed polygons in one list, with the indices of their neighbours: of fronts that are to be divided, and
// of walls.

namespace {

struct PolygonEdge {
    Point a, b;
    double length;
    std::size_t previous, next;  ///< indices of the edges before a and behind b
    double requested;            ///< the length that it asks edges beside it for, at least its own
};

/// Returns the edges of closed polygons, one polygon after the other. least_requests: one length per polygon and edge,
/// or empty.
std::vector<PolygonEdge> polygon_edges(std::span<const std::vector<Point>> polygons,
                                       std::span<const std::vector<double>> least_requests = {}) {
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

/// Returns a search tree over segments with the ends a and b.
template <class Segments>
core::BoxTree segment_tree(const Segments& segments) {
    std::vector<Box> boxes;
    boxes.reserve(segments.size());
    for (const auto& segment : segments) boxes.push_back(core::bounding_box(segment.a, segment.b));
    return core::BoxTree(std::move(boxes));
}

// The lengths that edges of fronts request of their surroundings: their own, or the width of a gap that they face.

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

/// Adds the sources of one edge, in order from its start to its end. A gap counts where it is: the edge is halved until
/// its parts are no longer than the gap that they face. A part requests the width of the gap, or `requested_length` if
/// that is less. tree: the tree over the edges.
void add_edge_sources(std::span<const PolygonEdge> edges, const core::BoxTree& tree, std::size_t edge,
                      double requested_length, std::vector<SizeSource>& sources) {
    add_part_sources(edges[edge].a, edges[edge].b, requested_length, edges_across(edges, tree, edge), sources);
}

/// A stretch of an edge and the target length of the edges on it.
struct TargetInterval {
    double length, target;
};

/// Finds target lengths. The target at x is the minimum over all edges j of (the length that j requests + gradation x
/// distance(x, j)), likewise over BorderOptions::sources, and is at most BorderOptions::max_edge. Targets are lower
/// than the options say by alike, so that no part of an edge is longer than the options allow and lengths grow
/// by no more than their gradation. Nor do successive parts of one edge, which grow by a factor of about
/// exp(alike x gradation), exceed max_ratio.
class TargetLength {
public:
    /// Keeps a reference to the edges.
    TargetLength(std::span<const PolygonEdge> edges, const BorderOptions& options)
        : edges_(edges),
          gradation_(std::min(options.gradation, 1 - 1 / options.max_ratio) / alike),
          max_target_(options.max_edge / alike) {
        const core::BoxTree edge_tree = segment_tree(edges_);
        for (std::size_t i = 0; i < edges_.size(); ++i)
            add_edge_sources(edges_, edge_tree, i, edges_[i].requested, sources_);
        for (SizeSource source : options.sources) {
            source.size /= alike;
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

    /// Returns the target along an edge as a step function that does not depend on the direction of the edge.
    std::vector<TargetInterval> along(std::size_t edge) const {
        const PolygonEdge& e = edges_[edge];
        std::vector<TargetInterval> intervals;
        add_intervals(e.a, e.b, e.length, std::min(e.length, max_target_), intervals);
        return intervals;
    }

private:
    std::span<const PolygonEdge> edges_;
    double gradation_, max_target_;
    std::vector<SizeSource> sources_;           ///< of the edges, then of the options
    core::BoxTree tree_{{}};                    ///< over the sources
    std::vector<std::vector<double>> targets_;  ///< of the sources, grouped for the search in the tree

    /// Adds the intervals between two points of an edge, which is halved until its parts are short beside the target in
    /// their middles, which is at most `cap`.
    void add_intervals(Point a, Point b, double length, double cap, std::vector<TargetInterval>& intervals) const {
        const Point middle = midpoint(a, b);
        const double target = tree_.minimum(middle, gradation_, cap, targets_,
                                            [&](std::size_t i) { return distance_to(sources_[i], middle); });
        if (length <= interval_share * target) {
            intervals.push_back({length, target});
            return;
        }
        add_intervals(a, middle, 0.5 * length, cap, intervals);
        add_intervals(middle, b, 0.5 * length, cap, intervals);
    }
};

// One edge divided by equal shares of the integral of ds / target, and the lengths of its parts.

/// An edge with its target lengths and the number of parts that it is divided into. All parts take equal shares of the
/// integral of ds / target, so they are long where the target is large.
class EdgeDivision {
public:
    /// target: TargetLength::along() of the edge. whole_up_to: the edge may be this many times as long as its target
    /// and still stay whole.
    EdgeDivision(double length, std::span<const TargetInterval> target, double whole_up_to) : length_(length) {
        double distance = 0;
        for (const TargetInterval& interval : target) {
            excess_ += interval.length / interval.target;
            intervals_.push_back({distance, excess_, interval.target});
            distance += interval.length;
        }
        if (excess_ > whole_up_to) parts_ = static_cast<std::size_t>(std::ceil(excess_ / alike));
    }

    /// Returns the length of the edge over the target length along it.
    double excess() const { return excess_; }
    bool divided() const { return parts_ > 1; }
    void add_part() { ++parts_; }
    /// Takes at least as many parts as another edge.
    void take_parts(const EdgeDivision& other) { parts_ = std::max(parts_, other.parts_); }

    /// Returns the distances of the division points from the edge's start, ascending.
    std::vector<double> division_points() const {
        std::vector<double> points;
        for (std::size_t k = 1; k < parts_; ++k) points.push_back(division_point(k));
        return points;
    }

    /// The lengths of the parts at both ends of the edge.
    struct EndParts {
        double first, last;
    };
    EndParts end_parts() const {
        return divided() ? EndParts{division_point(1), length_ - division_point(parts_ - 1)}
                         : EndParts{length_, length_};
    }

private:
    /// Where an interval begins, the integral up to its end, and its target.
    struct Interval {
        double begin, integral, target;
    };

    double length_, excess_ = 0;
    std::vector<Interval> intervals_;
    std::size_t parts_ = 1;

    /// Returns the distance of the end of part k, counted from 1, from the edge's start.
    double division_point(std::size_t k) const {
        const double wanted = excess_ * static_cast<double>(k) / static_cast<double>(parts_);
        const auto at = std::lower_bound(intervals_.begin(), intervals_.end() - 1, wanted,
                                         [](const Interval& i, double integral) { return i.integral < integral; });
        const double before = at == intervals_.begin() ? 0 : (at - 1)->integral;
        return at->begin + (wanted - before) * at->target;
    }
};

// Edges that lie back to back, on both sides of a sheet. They get the same points.

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

// The balance between the parts on both sides of each corner.

void sort_without_duplicates(std::vector<std::size_t>& indices) {
    std::sort(indices.begin(), indices.end());
    indices.erase(std::unique(indices.begin(), indices.end()), indices.end());
}

/// Adds parts until the lengths of the parts on both sides of each corner differ by no more than max_ratio: one part
/// more makes those of an edge with many hardly shorter. All corners are judged by one state and then changed together,
/// so that the result depends neither on where a polygon starts nor on its direction. across: edges_back_to_back(),
/// which have as many parts as each other.
void balance_divisions(std::span<const PolygonEdge> edges, std::span<const std::size_t> across, double max_ratio,
                       std::vector<EdgeDivision>& divisions) {
    constexpr double rounding = 1e-9;
    const double limit = max_ratio * (1 + rounding);
    std::vector<EdgeDivision::EndParts> ends;
    ends.reserve(edges.size());
    for (std::size_t i = 0; i < edges.size(); ++i) divisions[i].take_parts(divisions[across[i]]);
    for (const EdgeDivision& division : divisions) ends.push_back(division.end_parts());
    std::vector<std::size_t> active(edges.size()),
        longer;  // edges whose corners are judged, and those with longer parts
    std::iota(active.begin(), active.end(), std::size_t{0});
    const auto judge = [&](std::size_t i, std::size_t next) {
        if (ends[i].last > limit * ends[next].first) longer.push_back(i);
        if (ends[next].first > limit * ends[i].last) longer.push_back(next);
    };
    while (!active.empty()) {
        longer.clear();
        for (const std::size_t i : active) {
            judge(edges[i].previous, i);
            judge(i, edges[i].next);
        }
        sort_without_duplicates(longer);
        active.clear();
        for (const std::size_t i : longer) {
            divisions[i].add_part();
            divisions[across[i]].take_parts(divisions[i]);
            for (const std::size_t changed : {i, across[i]}) {
                ends[changed] = divisions[changed].end_parts();
                active.insert(active.end(), {edges[changed].previous, changed, edges[changed].next});
            }
        }
        sort_without_duplicates(active);
    }
}

// Exact tests of the parts of divided edges against each other and against the walls.

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

/// Removes the division points of edges whose parts meet or fold onto other parts or walls. Division points lie on
/// their edge only to rounding, so this happens where a front nearly touches a wall or another front. points: the
/// division points of each edge, in order. Precondition: the edges themselves meet each other and the walls in common
/// vertices and whole common edges only.
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

/// Returns whether an edge is longer than a source asks for at its middle.
bool exceeds_sources(const PolygonEdge& edge, const BorderOptions& options) {
    const Point middle = midpoint(edge.a, edge.b);
    return std::any_of(options.sources.begin(), options.sources.end(), [&](const SizeSource& source) {
        return edge.length > source.size + options.gradation * distance_to(source, middle);
    });
}

/// Returns the division of an edge by itself. It may stay whole up to so many times its target, unless sources ask for
/// less.
EdgeDivision own_division(const PolygonEdge& edge, std::span<const TargetInterval> target, double whole_up_to,
                          const BorderOptions& options) {
    const EdgeDivision division(edge.length, target, whole_up_to);
    const bool spared = !division.divided() && division.excess() > alike;
    return spared && exceeds_sources(edge, options) ? EdgeDivision(edge.length, target, alike) : division;
}

std::vector<EdgeDivision> balanced_divisions(std::span<const PolygonEdge> edges, std::span<const std::size_t> across,
                                             const BorderOptions& options,
                                             std::span<const std::vector<double>> whole_up_to) {
    const TargetLength target(edges, options);
    std::vector<double> slacks;
    for (const std::vector<double>& front : whole_up_to) slacks.insert(slacks.end(), front.begin(), front.end());
    slacks.resize(edges.size(), alike);
    std::vector<EdgeDivision> divisions;
    divisions.reserve(edges.size());
    for (std::size_t i = 0; i < edges.size(); ++i)
        divisions.push_back(own_division(edges[i], target.along(i), slacks[i], options));
    balance_divisions(edges, across, options.max_ratio, divisions);
    return divisions;
}

/// Returns the division points of an edge, without those that floating point cannot tell from their neighbours. Those
/// of a wall's edge are on its curve.
std::vector<Point> division_points(const PolygonEdge& edge, const EdgeDivision& division, const PlaceOnWall& place) {
    std::vector<Point> points;
    Point before = edge.a;
    for (double at : division.division_points()) {
        const double share = at / edge.length;
        Point p = edge.a + share * (edge.b - edge.a);
        if (place) p = place(edge.a, edge.b, share).value_or(p);
        if (p == before || p == edge.b) continue;
        points.push_back(p);
        before = p;
    }
    return points;
}

/// Returns the points of an edge that lie across from those of another one.
std::vector<Point> points_across(const PolygonEdge& other, const std::vector<Point>& of_other,
                                 const PolygonEdge& edge) {
    std::vector<Point> points(of_other.rbegin(), of_other.rend());
    for (Point& p : points) p = edge.a + distance(p, other.b) / other.length * (edge.b - edge.a);
    return points;
}

}  // namespace

BorderDivision divide_borders(std::span<const std::vector<Point>> fronts, std::span<const std::vector<Point>> walls,
                              const BorderOptions& options, std::span<const std::vector<double>> least_requests,
                              std::span<const std::vector<double>> whole_up_to, const PlaceOnWall& place_on_wall) {
    const std::vector<PolygonEdge> edges = polygon_edges(fronts, least_requests);
    const std::vector<std::size_t> across = edges_back_to_back(edges);
    const std::vector<EdgeDivision> divisions = balanced_divisions(edges, across, options, whole_up_to);
    std::vector<std::vector<Point>> points(edges.size());
    for (std::size_t i = 0; i < edges.size(); ++i)
        points[i] = across[i] < i ? points_across(edges[across[i]], points[across[i]], edges[i])
                                  : division_points(edges[i], divisions[i], place_on_wall);
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
