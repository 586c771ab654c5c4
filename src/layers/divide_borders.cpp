// Frozen borders must be graded before they are frozen (design 2): no Delaunay refinement mends a long edge beside a
// short one. First every edge gets the number of pieces that its target length asks for, and divided edges shift their
// cuts towards their neighbours' lengths; then, wherever the pieces on both sides of a corner still differ by more than
// the allowed ratio, the edge of the longer piece gets one more, until nothing changes. Both steps treat the two
// directions of a border alike.
#include "layers/divide_borders.hpp"

#include <algorithm>
#include <cmath>

#include "core/box_tree.hpp"
#include "core/segments.hpp"

namespace lamina::layers {
namespace {

/// An edge up to this much longer than its target is left alone.
constexpr double size_slack = 1.1;
/// And one that comes of a division already up to this: cuts shift, and the field is never quite what it was.
constexpr double planned_slack = 1.3;
/// Length of the intervals of the sums over ds / h, in units of h.
constexpr double interval = 0.25;
/// Edges are divided for the ratio's sake into at most this many times the pieces that size asks for.
constexpr std::size_t most_refined = 6;
/// Direction cosine below which two edges that see each other form a gap rather than a corner.
constexpr double facing = -0.3;
/// Gaps narrower than this share of an edge do not divide it further.
constexpr double narrowest_gap = 1.0 / 128;

struct Edge {
    Point a, b;
    double length;
    std::size_t previous, next;
    double factor = 0;  ///< it asks for this many times its length, if it comes of a division
};

std::vector<Edge> edges_of(std::span<const std::vector<Point>> borders,
                           std::span<const std::vector<double>> factors = {}) {
    std::vector<Edge> edges;
    for (const std::vector<Point>& border : borders) {
        const std::size_t first = edges.size(), n = border.size();
        for (std::size_t k = 0; k < n; ++k) {
            const Point a = border[k], b = border[(k + 1) % n];
            edges.push_back({a, b, distance(a, b), first + (k + n - 1) % n, first + (k + 1) % n});
            if (!factors.empty()) edges.back().factor = factors[&border - borders.data()][k];
        }
    }
    return edges;
}

template <class Segments>
core::BoxTree tree_of(const Segments& segments) {
    std::vector<Box> boxes;
    boxes.reserve(segments.size());
    for (const auto& segment : segments) boxes.push_back(core::bounding_box(segment.a, segment.b));
    return core::BoxTree(std::move(boxes));
}

/// Distance of two segments that do not cross.
double gap_between(Point a, Point b, const Edge& other) {
    return std::min({core::distance_to_segment(a, other.a, other.b), core::distance_to_segment(b, other.a, other.b),
                     core::distance_to_segment(other.a, a, b), core::distance_to_segment(other.b, a, b)});
}

/// Edges that lie across a gap from this one and no farther than its length.
std::vector<const Edge*> edges_across(std::span<const Edge> edges, const core::BoxTree& tree, std::size_t i) {
    std::vector<const Edge*> across;
    const Edge& edge = edges[i];
    Box near = core::bounding_box(edge.a, edge.b);
    near.lower = near.lower - Point{edge.length, edge.length};
    near.upper = near.upper + Point{edge.length, edge.length};
    tree.overlaps(near, [&](std::size_t j) {
        const Edge& other = edges[j];
        if (j == i || j == edge.previous || j == edge.next) return;
        const Point u = edge.b - edge.a, v = other.b - other.a;
        if (dot(u, v) > facing * edge.length * other.length) return;
        // The outside lies on the right of both.
        const Point between = midpoint(other.a, other.b) - midpoint(edge.a, edge.b);
        if (cross(u, between) < 0 && cross(v, between) > 0) across.push_back(&other);
    });
    return across;
}

/// A gap counts where it is: the edge is halved until its parts are no longer than the gap they face.
void add_sources(Point a, Point b, double edge_length, std::span<const Edge* const> across,
                 std::vector<SizeSource>& sources) {
    const double length = distance(a, b);
    double gap = HUGE_VAL;
    for (const Edge* other : across) gap = std::min(gap, gap_between(a, b, *other));
    if (gap < edge_length && gap < length && length > narrowest_gap * edge_length) {
        const Point middle = midpoint(a, b);
        add_sources(a, middle, edge_length, across, sources);
        add_sources(middle, b, edge_length, across, sources);
        return;
    }
    sources.push_back({a, b, std::clamp(gap, narrowest_gap * edge_length, edge_length)});
}

/// The target length along one edge, as a step function: symmetric in the edge's direction.
struct Interval {
    double length, size;
};

/// The slack included, no piece exceeds what the options ask for, and lengths grow by no more than their gradation; and
/// pieces of one edge, which grow by a factor of about exp(size_slack x gradation), by no more than the ratio.
class TargetLength {
public:
    TargetLength(std::span<const Edge> edges, const BorderOptions& options)
        : edges_(edges),
          gradation_(std::min(options.gradation, 1 - 1 / options.max_ratio) / size_slack),
          longest_(options.max_edge / size_slack),
          tree_({}),
          at_start_(edges.size(), longest_) {
        const core::BoxTree edge_tree = tree_of(edges);
        for (std::size_t i = 0; i < edges.size(); ++i) {
            const auto& [a, b, length, previous, next, factor] = edges[i];
            const std::size_t first = sources_.size();
            add_sources(a, b, factor > 0 ? factor * length : length, edges_across(edges, edge_tree, i), sources_);
            at_start_[i] = std::min(at_start_[i], sources_[first].size);
            at_start_[edges[i].next] = std::min(at_start_[edges[i].next], sources_.back().size);
        }
        for (SizeSource source : options.sources) {
            source.size /= size_slack;
            sources_.push_back(source);
        }
        std::vector<Box> boxes;
        std::vector<double> sizes;
        for (const SizeSource& source : sources_) {
            boxes.push_back(lamina::bounding_box(source));
            sizes.push_back(source.size);
        }
        tree_ = core::BoxTree(std::move(boxes));
        values_ = tree_.group_minima(std::move(sizes));
        // Along a border first: a good bound makes the search in the tree short.
        for (int round = 0; round < 2; ++round) {
            for (std::size_t i = 0; i < edges.size(); ++i) pass_on(i, i, edges[i].next);
            for (std::size_t i = edges.size(); i-- > 0;) pass_on(i, edges[i].next, i);
        }
        for (std::size_t i = 0; i < edges.size(); ++i) at_start_[i] = at(edges[i].a, at_start_[i]);
    }

    std::vector<Interval> along(std::size_t i) const {
        const Edge& edge = edges_[i];
        std::vector<Interval> intervals;
        const double cap = std::min(edge.length, longest_);
        divide(edge.a, edge.b, edge.length, at_start_[i], at_start_[edge.next], cap, intervals);
        return intervals;
    }

private:
    std::span<const Edge> edges_;
    double gradation_, longest_;
    std::vector<SizeSource> sources_;  ///< parts of edges and the lengths they ask for; then those of the options
    core::BoxTree tree_;               ///< of the sources
    std::vector<std::vector<double>> values_;
    std::vector<double> at_start_;

    void pass_on(std::size_t edge, std::size_t from, std::size_t to) {
        at_start_[to] = std::min(at_start_[to], at_start_[from] + gradation_ * edges_[edge].length);
    }

    double at(Point p, double start) const {
        return tree_.minimum(p, gradation_, start, values_, [&](std::size_t i) { return distance_to(sources_[i], p); });
    }

    /// Between the ends the target rises from both until it meets or reaches `cap`, unless something near the middle
    /// asks for less: halves until the middle agrees.
    void divide(Point a, Point b, double length, double size_a, double size_b, double cap,
                std::vector<Interval>& intervals) const {
        const double least = std::min(size_a, size_b);
        const double expected = std::min(cap, least + gradation_ * 0.5 * length);
        if (length > 2 * least) {
            const Point middle = midpoint(a, b);
            const double size = at(middle, expected);
            if (size < 0.9 * expected || length > 64 * least) {
                divide(a, middle, 0.5 * length, size_a, size, cap, intervals);
                divide(middle, b, 0.5 * length, size, size_b, cap, intervals);
                return;
            }
        }
        // Two cones and a plateau; the cones meet at `peak`.
        const double peak = std::clamp(0.5 * (length + (size_b - size_a) / gradation_), 0.0, length);
        const double rise_a = std::min(peak, std::max(0.0, (cap - size_a) / gradation_));
        const double rise_b = std::min(length - peak, std::max(0.0, (cap - size_b) / gradation_));
        march(size_a, rise_a, intervals);
        const double plateau = length - rise_a - rise_b;
        if (plateau > 0) {
            const double n = std::ceil(plateau / (interval * cap));
            intervals.insert(intervals.end(), static_cast<std::size_t>(n), {plateau / n, cap});
        }
        const auto from = static_cast<std::ptrdiff_t>(intervals.size());
        march(size_b, rise_b, intervals);
        std::reverse(intervals.begin() + from, intervals.end());
    }

    void march(double size, double length, std::vector<Interval>& intervals) const {
        for (double done = 0; done < length;) {
            const double step = std::min(interval * (size + gradation_ * done), length - done);
            intervals.push_back({step, size + gradation_ * (done + 0.5 * step)});
            if (done + step == done) break;
            done += step;
        }
    }
};

/// One edge with its step function and the pieces it is cut into.
struct Division {
    std::vector<Interval> field;      ///< as the target length asks
    std::vector<Interval> intervals;  ///< and tilted towards the neighbours
    double total = 0;                 ///< sum of length / size over intervals
    std::size_t least_pieces = 1, pieces = 1;

    /// Scales the sizes by a factor that runs linearly from `first` at the edge's start to `last` at its end.
    void tilt(double first, double last) {
        double length = 0, done = 0;
        for (const Interval& i : field) length += i.length;
        intervals = field;
        total = 0;
        for (Interval& i : intervals) {
            i.size *= first + (last - first) * ((done + 0.5 * i.length) / length);
            done += i.length;
            total += i.length / i.size;
        }
    }

    /// Distances from the edge's start of the ends of the pieces, the last one (the edge's end) left out.
    std::vector<double> cuts() const {
        std::vector<double> result;
        double distance = 0, sum = 0;
        std::size_t k = 1;
        for (const auto& [length, size] : intervals) {
            const double share = length / size;
            while (k < pieces) {
                const double wanted = total * static_cast<double>(k) / static_cast<double>(pieces);
                if (wanted > sum + share) break;
                result.push_back(distance + (wanted - sum) * size);
                ++k;
            }
            sum += share;
            distance += length;
        }
        return result;
    }

    /// Largest target length on each piece between these points on the edge from `start`, over its own length, but no
    /// less than 1.
    std::vector<double> factors(Point start, std::span<const Point> cut_points) const {
        std::vector<double> ends;
        for (Point p : cut_points) ends.push_back(distance(start, p));
        std::vector<double> result;
        double from = 0, to = 0, largest = 0;
        const auto end_piece = [&](double end) {
            result.push_back(end > from ? std::max(1.0, largest / (end - from)) : 1);
            from = end;
        };
        for (const Interval& i : field) {
            to += i.length;
            largest = std::max(largest, i.size);
            while (result.size() < ends.size() && ends[result.size()] <= to) {
                end_piece(ends[result.size()]);
                largest = i.size;
            }
        }
        end_piece(to);
        return result;
    }

    /// The largest ratio of the lengths of two pieces side by side.
    double largest_ratio(double edge_length) const {
        double largest = 1, from = 0, before = 0;
        std::vector<double> to = cuts();
        to.push_back(edge_length);
        for (double at : to) {
            const double piece = at - from;
            if (before > 0) largest = std::max({largest, piece / before, before / piece});
            before = piece;
            from = at;
        }
        return largest;
    }

    struct Ends {
        double first, last;
    };
    Ends ends(double edge_length) const {
        if (pieces == 1) return {edge_length, edge_length};
        const double piece = total / static_cast<double>(pieces);
        const auto advance = [piece](auto begin, auto end) {
            double distance = 0, sum = 0;
            for (auto it = begin; it != end; ++it) {
                const double share = it->length / it->size;
                if (sum + share >= piece) return distance + (piece - sum) * it->size;
                sum += share;
                distance += it->length;
            }
            return distance;
        };
        return {advance(intervals.begin(), intervals.end()), advance(intervals.rbegin(), intervals.rend())};
    }
};

/// By how much the sizes at one end of a divided edge are scaled, given the first piece there and the piece beyond:
/// halfway where the neighbour is divided and gives way as well, and beyond the neighbour where it cannot. With
///
///     |-------- 1 --------|---- 0.61 ---|-- 0.39 --|-- 0.5 --|-- 0.5 --|
///
/// a whole edge meets edges cut in two at a ratio of 1.64 instead of 2.
double tilt_towards(double own, double beyond, bool divided) {
    const double q = std::clamp(beyond / own, 0.25, 4.0);
    return divided ? std::sqrt(q) : q * std::sqrt(std::sqrt(q));
}

/// Adds pieces where neighbours differ too much. All corners are judged by one state, then changed together: the
/// result does not depend on where a border starts or which way it runs.
void balance(std::span<const Edge> edges, double ratio, std::vector<Division>& divisions) {
    const double limit = ratio * (1 + 1e-9);
    std::vector<Division::Ends> untilted(edges.size()), ends(edges.size());
    const auto measure = [&](std::size_t i) {
        divisions[i].tilt(1, 1);
        untilted[i] = divisions[i].ends(edges[i].length);
    };
    const auto tilt = [&](std::size_t i) {
        Division& division = divisions[i];
        const std::size_t before = edges[i].previous, after = edges[i].next;
        if (division.pieces > 1) {
            double first = tilt_towards(untilted[i].first, untilted[before].last, divisions[before].pieces > 1);
            double last = tilt_towards(untilted[i].last, untilted[after].first, divisions[after].pieces > 1);
            division.tilt(first, last);
            // No more than the pieces inside the edge can bear.
            for (int tries = 0; tries < 4 && division.largest_ratio(edges[i].length) > limit; ++tries) {
                first = tries < 3 ? std::sqrt(first) : 1;
                last = tries < 3 ? std::sqrt(last) : 1;
                division.tilt(first, last);
            }
        }
        ends[i] = division.ends(edges[i].length);
    };
    for (std::size_t i = 0; i < edges.size(); ++i) measure(i);
    for (std::size_t i = 0; i < edges.size(); ++i) tilt(i);

    std::vector<std::size_t> active(edges.size());
    for (std::size_t i = 0; i < edges.size(); ++i) active[i] = i;
    std::vector<std::size_t> longer;
    const auto sort_out = [](std::vector<std::size_t>& places) {
        std::sort(places.begin(), places.end());
        places.erase(std::unique(places.begin(), places.end()), places.end());
    };
    while (!active.empty()) {
        longer.clear();
        const auto compare = [&](std::size_t i, std::size_t j) {
            if (ends[i].last > limit * ends[j].first) longer.push_back(i);
            if (ends[j].first > limit * ends[i].last) longer.push_back(j);
        };
        for (std::size_t i : active) {
            compare(edges[i].previous, i);
            compare(i, edges[i].next);
        }
        sort_out(longer);
        std::erase_if(longer,
                      [&](std::size_t i) { return divisions[i].pieces >= most_refined * divisions[i].least_pieces; });
        active.clear();
        for (std::size_t i : longer) {
            ++divisions[i].pieces;
            measure(i);
            active.insert(active.end(), {edges[i].previous, i, edges[i].next});
        }
        sort_out(active);
        for (std::size_t i : active) tilt(i);
    }
}

/// A straight piece of a divided border.
struct Piece {
    Point a, b;
    std::size_t edge;  ///< that it is part of
};

/// Division points lie on their edge to rounding only. Where a border all but touches a wall or itself that can make it
/// cross: such edges are left whole. cuts: per edge.
void undo_crossing_cuts(std::span<const Edge> edges, std::span<const Edge> walls,
                        std::vector<std::vector<Point>>& cuts) {
    const core::BoxTree wall_tree = tree_of(walls);
    for (bool changed = true; changed;) {
        changed = false;
        std::vector<Piece> pieces;
        for (std::size_t i = 0; i < edges.size(); ++i) {
            Point from = edges[i].a;
            for (Point p : cuts[i]) {
                pieces.push_back({from, p, i});
                from = p;
            }
            pieces.push_back({from, edges[i].b, i});
        }
        const core::BoxTree tree = tree_of(pieces);
        const auto conflict = [](const Piece& piece, Point p, Point q) {
            if (piece.a == q) return core::segments_fold(q, p, piece.b);
            if (piece.b == p) return core::segments_fold(p, piece.a, q);
            if (piece.a == p) return core::segments_fold(p, piece.b, q);
            if (piece.b == q) return core::segments_fold(q, piece.a, p);
            return core::segments_meet(piece.a, piece.b, p, q);
        };
        const auto undo = [&](std::size_t edge) {
            changed |= !cuts[edge].empty();
            cuts[edge].clear();
        };
        for (std::size_t k = 0; k < pieces.size(); ++k) {
            const Piece& piece = pieces[k];
            const Box box = core::bounding_box(piece.a, piece.b);
            tree.overlaps(box, [&](std::size_t other) {
                if (other <= k || !conflict(piece, pieces[other].a, pieces[other].b)) return;
                undo(piece.edge);
                undo(pieces[other].edge);
            });
            wall_tree.overlaps(box, [&](std::size_t w) {
                const bool along = edges[piece.edge].a == walls[w].a && edges[piece.edge].b == walls[w].b;
                if (!along && conflict(piece, walls[w].a, walls[w].b)) undo(piece.edge);
            });
        }
    }
}

}  // namespace

BorderDivision divide_borders(std::span<const std::vector<Point>> borders, std::span<const std::vector<Point>> walls,
                              const BorderOptions& options, std::span<const std::vector<double>> factors) {
    const std::vector<Edge> edges = edges_of(borders, factors);
    const TargetLength target(edges, options);
    std::vector<Division> divisions(edges.size());
    for (std::size_t i = 0; i < edges.size(); ++i) {
        Division& division = divisions[i];
        division.field = target.along(i);
        division.tilt(1, 1);
        const double slack = edges[i].factor > 0 ? planned_slack : size_slack;
        division.least_pieces = static_cast<std::size_t>(std::max(1.0, std::ceil(division.total / slack)));
        division.pieces = division.least_pieces;
    }
    balance(edges, options.max_ratio, divisions);

    std::vector<std::vector<Point>> cuts(edges.size());
    for (std::size_t i = 0; i < edges.size(); ++i) {
        const Edge& edge = edges[i];
        Point before = edge.a;
        for (double at : divisions[i].cuts()) {
            const Point p = edge.a + (at / edge.length) * (edge.b - edge.a);
            if (p == before || p == edge.b) continue;  // too short for floating point
            cuts[i].push_back(p);
            before = p;
        }
    }
    undo_crossing_cuts(edges, edges_of(walls), cuts);

    BorderDivision result;
    std::size_t i = 0;
    for (const std::vector<Point>& border : borders) {
        auto& points = result.points.emplace_back();
        auto& of_border = result.factors.emplace_back();
        for (std::size_t k = 0; k < border.size(); ++k, ++i) {
            of_border.push_back(divisions[i].factors(edges[i].a, cuts[i]));
            points.push_back(std::move(cuts[i]));
        }
    }
    return result;
}

}  // namespace lamina::layers
