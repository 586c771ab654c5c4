// A triangle over a part of a constrained edge is at least half as high as that part is long times the tangent of its
// smallest angle, and no higher than what lies opposite is far away. So an edge is cut into a number of parts in
// proportion to the integral of tan(bound) / d over its length, where d is the distance to the nearest vertex or
// constrained edge that one sees from there and that does not meet the edge. d is found by walking through the
// triangulation, the nearest triangles first.
//
// d grows by at most 1 per unit of length. Where it is linear between three places it is taken to be so between the
// outer ones; otherwise the interval is divided, by the golden section, since vertices of real inputs often lie at
// equal distances. The walks have a budget. What they do not reach, and what they miss, counts as nothing.
#include "delaunay/refine/estimate_angles.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <queue>
#include <utility>
#include <vector>

#include "core/predicates.hpp"
#include "core/reproducible_math.hpp"
#include "core/segments.hpp"
#include "delaunay/refine/border_lines.hpp"

namespace lamina::delaunay {

namespace {

/// An edge by which a walk enters a triangle, and its distance from the begin of the walk.
struct Entrance {
    double distance;
    Index triangle;
    unsigned edge;
    /// Puts the nearest on top of a heap.
    friend bool operator<(const Entrance& a, const Entrance& b) {
        return std::pair(a.distance, a.triangle) > std::pair(b.distance, b.triangle);
    }
};

/// Measures how wide the channels beside constrained edges are.
class ChannelSurvey {
public:
    ChannelSurvey(const ConstrainedInput& input, const BorderLines& lines)
        : input_(input), lines_(lines), budget_(1000 + 4 * input.tris.size()) {}

    /// Returns the integral of 1 / d over an edge, seen from its triangle t; 0 if that is not narrow.
    double along(Index t, unsigned e);

private:
    /// Edges this many times as long as their triangles are high may lie beside a channel.
    static constexpr double min_slenderness = 8;
    static constexpr int max_depth = 60;

    /// A place on the edge, at 0 to 1 of its length, and the distance to what lies opposite.
    struct Place {
        double t, d;
    };

    const ConstrainedInput& input_;
    const BorderLines& lines_;
    std::size_t budget_;  ///< triangles that may still be visited
    std::array<Index, 2> ends_{};
    Index line_ = no_index;  ///< the line of the edge
    Entrance begin_{};       ///< the edge
    Point from_, extent_;
    double length_ = 0;
    std::priority_queue<Entrance> entrances_;

    Point point(Index v) const { return input_.points[v]; }
    bool is_left_alone(Index v) const;
    Place place(double t) { return {t, distance_from(from_ + t * extent_)}; }
    double between(Place from, Place to, int depth);
    double distance_from(Point p);
    double distance_to_border(Point p, Index a, Index b) const;
};

double ChannelSurvey::along(Index t, unsigned e) {
    // The ends themselves may be corners, where the distance is 0.
    constexpr double margin = 1e-3;
    const Tri& tri = input_.tris[t];
    ends_ = {tri.v[next(e)], tri.v[previous(e)]};
    line_ = lines_.line_of_edge(ends_[0], ends_[1]);
    from_ = point(ends_[0]);
    extent_ = point(ends_[1]) - from_;
    if (squared_length(extent_) < min_slenderness * std::abs(cross(extent_, point(tri.v[e]) - from_))) return 0;
    begin_ = {0, t, e};
    length_ = length(extent_);
    return length_ * between(place(margin), place(1 - margin), max_depth);
}

/// Returns the integral of 1 / d for d that is linear between two places.
double integral_of_inverse(double length, double from, double to) {
    const double mean = 0.5 * (from + to), change = to - from;
    constexpr double even = 0.01;
    return length * (std::abs(change) < even * mean ? 1 / mean : std::log(to / from) / change);
}

double ChannelSurvey::between(Place from, Place to, int depth) {
    constexpr double golden = 1 - 1 / std::numbers::phi, max_deviation = 0.3, max_ratio = 3;
    const double extent = to.t - from.t;
    const Place middle = place(from.t + golden * extent);
    if (!std::isfinite(from.d + middle.d + to.d)) return 0;
    const double linear = from.d + golden * (to.d - from.d);
    const auto [low, high] = std::minmax({from.d, middle.d, to.d});
    const bool is_linear = high < max_ratio * low && std::abs(middle.d - linear) < max_deviation * linear;
    if (depth == 0 || is_linear || extent * length_ < low) return integral_of_inverse(extent, from.d, to.d);
    return between(from, middle, depth - 1) + between(middle, to, depth - 1);
}

/// Returns the distance from a place on the edge to what lies opposite, but no less than the length to which refinement
/// splits edges; infinite if the budget is spent, and where rounding hides the distance, since nothing is split there.
double ChannelSurvey::distance_from(Point p) {
    double nearest = HUGE_VAL;
    entrances_ = {};
    entrances_.push(begin_);
    while (!entrances_.empty() && entrances_.top().distance < nearest) {
        const Entrance at = entrances_.top();
        entrances_.pop();
        if (budget_ == 0) return HUGE_VAL;
        --budget_;
        const Tri& tri = input_.tris[at.triangle];
        const Index apex = tri.v[at.edge];
        if (const double d = distance(p, point(apex)); d < nearest && !is_left_alone(apex)) nearest = d;
        for (const unsigned e : {next(at.edge), previous(at.edge)}) {
            const Index a = tri.v[next(e)], b = tri.v[previous(e)];
            if (tri.n[e].is_constrained())
                nearest = std::min(nearest, distance_to_border(p, a, b));
            else
                entrances_.push(
                    {core::distance_to_segment(p, point(a), point(b)), tri.n[e].triangle(), tri.n[e].edge()});
        }
    }
    if (nearest < unresolved_distance(point(ends_[0]), point(ends_[1]))) return HUGE_VAL;
    return std::max(nearest, shortest_edge(magnitude(p), length_));
}

/// Returns whether a vertex is an end of the edge, or is on another side of a sharp corner of its line, or on a chain
/// that nearly coincides: a vertex in a corner asks for another one at the same distance from it, and for nothing
/// between.
bool ChannelSurvey::is_left_alone(Index v) const {
    return v == ends_[0] || v == ends_[1] || lines_.nearly_coincide(line_, v) ||
           lines_.facing_corner(input_.points, line_, v) != no_index;
}

/// Returns the distance from p to a constrained edge; infinite if that is another side of a corner: lines that meet are
/// split at the same distances from their corner, and what lies between is not divided further.
double ChannelSurvey::distance_to_border(Point p, Index a, Index b) const {
    return lines_.meet(line_, lines_.line_of_edge(a, b)) ? HUGE_VAL : core::distance_to_segment(p, point(a), point(b));
}

/// The two nearest neighbours of a vertex.
struct NearestTwo {
    Index nearest = no_index;
    double first = HUGE_VAL, second = HUGE_VAL;  ///< squared distances

    void add(Index v, double squared) {
        if (v == nearest) return;
        if (squared < first) {
            second = std::exchange(first, squared);
            nearest = v;
        } else {
            second = std::min(second, squared);
        }
    }
};

/// Returns how often lengths double from the nearest neighbours of vertices to the second nearest ones, beyond what is
/// usual, summed over the vertices. A vertex on a dense line has two neighbours that are near, and counts as nothing.
double count_doublings(const ConstrainedInput& input) {
    constexpr double usual = 2;
    std::vector<NearestTwo> neighbours(input.points.size());
    for (const Tri& tri : input.tris) {
        for (unsigned e = 0; e < 3; ++e) {
            const Index a = tri.v[e], b = tri.v[next(e)];
            const double squared = squared_length(input.points[b] - input.points[a]);
            neighbours[a].add(b, squared);
            neighbours[b].add(a, squared);
        }
    }
    double sum = 0;
    for (const NearestTwo& n : neighbours)
        if (n.nearest != no_index) sum += std::max(0.0, 0.5 * std::log2(n.second / n.first) - usual);
    return sum;
}

}  // namespace

AngleEstimate estimate_for_angles(const ConstrainedInput& input, const BorderLines& lines, double min_angle_deg) {
    // Triangles that grow from each part of an edge into the open, and for each doubling of lengths, as measured. They
    // grow slowly where the bound is high.
    constexpr double usual = 3.3, high_bound_deg = 28, more_per_degree = 1.5;
    const double growing = usual + more_per_degree * std::max(0.0, min_angle_deg - high_bound_deg);
    const double tangent = std::tan(core::radians(min_angle_deg));
    ChannelSurvey survey(input, lines);
    AngleEstimate sum{0, growing * count_doublings(input)};
    for (Index t = 0; t < input.tris.size(); ++t) {
        for (unsigned e = 0; e < 3; ++e) {
            const Link across = input.tris[t].n[e];
            const bool has_two_sides = !across.is_border();
            if (!across.is_constrained() || (has_two_sides && across.triangle() < t)) continue;
            const double left = survey.along(t, e);
            const double right = has_two_sides ? survey.along(across.triangle(), across.edge()) : left;
            sum.in_channels += tangent * (has_two_sides ? left + right : left);
            sum.growing += tangent * growing * std::abs(left - right);
        }
    }
    return sum;
}

}  // namespace lamina::delaunay
