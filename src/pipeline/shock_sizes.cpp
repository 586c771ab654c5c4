#include "pipeline/shock_sizes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>

#include "core/reproducible_math.hpp"
#include "flow/euler/triangles_at_edges.hpp"

namespace lamina::pipeline {

namespace {

// All lengths are in chords of the configuration.

/// Spacing of walls from ahead of a shock to the trailing edge, and size along the front.
constexpr double wall_spacing = 0.005, front_size = 0.01;

/// Where a shock is expected, from one of a flow before the mesh.
struct Expectation {
    double ahead;   ///< the middle of where it may be lies this far ahead of the shock of that flow
    double reach;   ///< from which walls are fine this far ahead of that
    double radius;  ///< and triangles up to this distance on both sides
};

/// Boundary layers move shocks forward by 0.06 to 0.09 on RAE 2822: without them sizes cover both places. With them the
/// shock is at most 0.02 off.
Expectation expectation_of(const CompressibleFlow& flow) {
    if (flow.has_layers) return {0, 0.06, 0.03};
    return {0.04, 0.11, 0.05};
}

/// Shocks of smaller Mach numbers hardly change lift and drag.
constexpr double least_mach = 1.1;
/// The front ends where no Mach number within this distance is larger than this.
constexpr double ahead_distance = 0.04, fading_mach = 1.05;
/// The front is a chain of segments of about this length.
constexpr double segment_length = 0.02;

using Edge = std::array<std::uint32_t, 2>;

/// The edge of the wall at which the Mach number falls through 1: the vertices before and behind it.
std::optional<Edge> edge_of(const CompressibleFlow& flow, const CompressibleSide& side, const WallShock& shock) {
    const auto vertex = [&](Point p) {
        return static_cast<std::uint32_t>(std::find(flow.points.begin(), flow.points.end(), p) - flow.points.begin());
    };
    std::optional<Edge> nearest;
    double away = HUGE_VAL;
    for (std::size_t i = 1; i < side.points.size(); ++i) {
        const CompressibleWallPoint &a = side.points[i - 1], &b = side.points[i];
        const double distance_to = distance(midpoint(a.at, b.at), shock.at);
        if (!(a.mach > 1 && b.mach <= 1) || distance_to >= away) continue;
        away = distance_to;
        nearest = Edge{vertex(a.at), vertex(b.at)};
    }
    return nearest;
}

bool is_faded(const CompressibleFlow& flow, Point p) {
    const double reach = ahead_distance * flow.chord;
    for (std::size_t v = 0; v < flow.points.size(); ++v)
        if (flow.mach_numbers[v] >= fading_mach && squared_length(flow.points[v] - p) <= reach * reach) return false;
    return true;
}

/// Adds the spacings of one side from a point of it on.
void add_spacings(const CompressibleSide& side, std::size_t element, Point foot, double ahead, double spacing,
                  std::vector<geometry::WallSpacing>& spacings) {
    const auto nearer = [&](const CompressibleWallPoint& a, const CompressibleWallPoint& b) {
        return squared_length(a.at - foot) < squared_length(b.at - foot);
    };
    auto first = std::min_element(side.points.begin(), side.points.end(), nearer);
    for (double way = 0; first != side.points.begin() && way < ahead; --first)
        way += distance(first->at, std::prev(first)->at);
    for (; std::next(first) != side.points.end(); ++first)
        spacings.push_back({element, first->at, std::next(first)->at, spacing});
}

/// Adds the sources along a front, moved by a vector.
void add_sources(const std::vector<Point>& front, Point shift, double radius, double chord, double fineness,
                 std::vector<SizeSource>& sources) {
    Point from = front.front();
    for (std::size_t i = 0; i < front.size(); ++i) {
        if (i + 1 < front.size() && distance(from, front[i]) < segment_length * chord) continue;
        sources.push_back({from + shift, front[i] + shift, front_size * chord / fineness, radius * chord});
        from = front[i];
    }
}

}  // namespace

std::vector<Point> trace_front(const CompressibleFlow& flow, const CompressibleSide& side, const WallShock& shock) {
    const std::optional<Edge> begin = edge_of(flow, side, shock);
    if (!begin) return {shock.at};
    const flow::euler::TrianglesAtEdges at_edges(flow.triangles);
    std::vector<Point> front;
    auto [fast, slow] = *begin;
    std::optional<std::uint32_t> last;
    while (front.size() < flow.triangles.size()) {
        const double share = (flow.mach_numbers[fast] - 1) / (flow.mach_numbers[fast] - flow.mach_numbers[slow]);
        const Point at = flow.points[fast] + share * (flow.points[slow] - flow.points[fast]);
        if (!front.empty() && is_faded(flow, at)) break;
        front.push_back(at);
        last = at_edges.beside(fast, slow, last);
        if (!last) break;
        std::uint32_t third = fast;
        for (const VertexId v : flow.triangles[*last].v)
            if (v.value != fast && v.value != slow) third = v.value;
        (flow.mach_numbers[third] > 1 ? fast : slow) = third;
    }
    return front;
}

ShockSizes sizes_at_shocks(const CompressibleFlow& flow, double fineness) {
    ShockSizes sizes;
    if (!flow.converged) return sizes;
    sizes.knows_shocks = true;
    const double alpha = core::radians(flow.alpha_deg), chord = flow.chord;
    const Expectation expectation = expectation_of(flow);
    const Point shift =
        -expectation.ahead * chord * Point{core::cos_reproducible(alpha), core::sin_reproducible(alpha)};
    for (std::size_t e = 0; e < flow.elements.size(); ++e)
        for (const CompressibleSide* side : {&flow.elements[e].upper, &flow.elements[e].lower}) {
            bool is_first = true;
            for (const WallShock& shock : side->shocks) {
                if (shock.mach_ahead < least_mach) continue;
                const Point foot = shock.at + shift;
                if (std::exchange(is_first, false))
                    add_spacings(*side, e, foot, expectation.reach * chord, wall_spacing * chord / fineness,
                                 sizes.spacings);
                const std::vector<Point> front = trace_front(flow, *side, shock);
                add_sources(front, shift, expectation.radius, chord, fineness, sizes.sources);
                sizes.shocks.push_back({flow.elements[e].name, foot, flow.has_layers, shock.mach_ahead,
                                        distance(front.front(), front.back())});
            }
        }
    return sizes;
}

}  // namespace lamina::pipeline
