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

/// Returns the largest Mach number near a point of a front, which is that ahead of it.
double mach_ahead(const CompressibleFlow& flow, Point p) {
    const double reach = ahead_distance * flow.chord;
    double largest = 0;
    for (std::size_t v = 0; v < flow.points.size(); ++v)
        if (flow.mach_numbers[v] > largest && squared_length(flow.points[v] - p) <= reach * reach)
            largest = flow.mach_numbers[v];
    return largest;
}

/// Returns the direction of the free stream.
Point stream_of(const CompressibleFlow& flow) {
    const double alpha = core::radians(flow.alpha_deg);
    return {core::cos_reproducible(alpha), core::sin_reproducible(alpha)};
}

/// Returns the entropy that a normal shock makes, over the gas constant.
double entropy_rise(double mach) {
    const double squared = mach * mach;
    if (squared <= 1) return 0;
    const double pressures = 1 + 7 * (squared - 1) / 6, densities = 6 * squared / (squared + 5);
    return 2.5 * core::log_reproducible(pressures) - 3.5 * core::log_reproducible(densities);
}

/// Returns the flux of mass per area at a Mach number, over that of the free stream.
double mass_flux(double mach, double free_stream) {
    const double ratio = (1 + 0.2 * free_stream * free_stream) / (1 + 0.2 * mach * mach);
    return mach / free_stream * ratio * ratio * ratio;
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

/// The change of the pressure in a triangle.
struct PressureRise {
    Point middle;            ///< of the triangle
    double edge = 0;         ///< length of an edge of an equilateral triangle of its area
    double share = 0;        ///< by which the pressure changes over that length
    double normal_mach = 0;  ///< largest Mach number of a corner in the direction in which the pressure rises
};

PressureRise pressure_rise(const CompressibleFlow& flow, const Triangle& triangle) {
    Point gradient{}, middle{};
    double lowest = HUGE_VAL, normal_mach = 0;
    const auto corner = [&](std::size_t k) { return flow.points[triangle.v[k % 3].index()]; };
    const double twice_area = cross(corner(1) - corner(0), corner(2) - corner(0));
    for (std::size_t k = 0; k < 3; ++k) {
        const double pressure = flow.pressures[triangle.v[k].index()];
        gradient = gradient + (pressure / twice_area) * perpendicular(corner(k + 2) - corner(k + 1));
        middle = middle + (1.0 / 3) * corner(k);
        lowest = std::min(lowest, pressure);
    }
    const double steepness = length(gradient);
    for (const VertexId v : triangle.v) {
        const double speed = length(flow.velocities[v.index()]);
        if (!(speed > 0 && steepness > 0)) continue;
        const double along = dot(flow.velocities[v.index()], gradient) / (speed * steepness);
        normal_mach = std::max(normal_mach, along * flow.mach_numbers[v.index()]);
    }
    const double edge = std::sqrt(2 / std::sqrt(3.0) * twice_area);
    return {middle, edge, steepness * edge / lowest, normal_mach};
}

/// Adds sources in the triangles of shocks, where flow crosses lines of equal pressure faster than sound as the
/// pressure rises. Sizes are a share of the edges there: far away the flow says less well where the shock is. What is a
/// chord behind the bodies acts on nothing ahead of it. Source: D. Lovely, R. Haimes, AIAA paper 99-3285 (1999).
void add_sources_in_shocks(const CompressibleFlow& flow, double fineness, std::vector<SizeSource>& sources) {
    constexpr double least_share = 0.05;  // shocks of Mach 1.1 spread over five triangles
    constexpr double size_over_edge = 0.25, reach_over_edge = 0.25, chords_behind = 1;
    const Point stream = stream_of(flow);
    double rear = -HUGE_VAL;
    for (const CompressibleElement& element : flow.elements)
        for (const CompressibleSide* side : {&element.upper, &element.lower})
            for (const CompressibleWallPoint& p : side->points) rear = std::max(rear, dot(stream, p.at));
    for (const Triangle& triangle : flow.triangles) {
        const PressureRise rise = pressure_rise(flow, triangle);
        if (!(rise.normal_mach > 1 && rise.share > least_share)) continue;
        if (dot(stream, rise.middle) > rear + chords_behind * flow.chord) continue;
        const double size = std::max(front_size * flow.chord, size_over_edge * rise.edge) / fineness;
        sources.push_back({rise.middle, rise.middle, size, reach_over_edge * rise.edge});
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
        if (!front.empty() && mach_ahead(flow, at) < fading_mach) break;
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

double wave_drag(const CompressibleFlow& flow, const WallShock& shock) {
    const Point stream = stream_of(flow);
    const std::vector<Point>& front = shock.front;
    double sum = 0;
    for (std::size_t i = 1; i < front.size(); ++i) {
        const double mach = mach_ahead(flow, midpoint(front[i - 1], front[i]));
        sum += entropy_rise(mach) * mass_flux(mach, flow.mach) * std::abs(cross(stream, front[i] - front[i - 1]));
    }
    return sum / (0.7 * flow.mach * flow.mach * flow.chord);
}

ShockSizes sizes_at_shocks(const CompressibleFlow& flow, double fineness) {
    ShockSizes sizes;
    if (!flow.converged) return sizes;
    sizes.knows_shocks = true;
    if (flow.mach >= 1) add_sources_in_shocks(flow, fineness, sizes.sources);
    const double chord = flow.chord;
    const Expectation expectation = expectation_of(flow);
    const Point shift = -expectation.ahead * chord * stream_of(flow);
    for (std::size_t e = 0; e < flow.elements.size(); ++e)
        for (const CompressibleSide* side : {&flow.elements[e].upper, &flow.elements[e].lower}) {
            bool is_first = true;
            for (const WallShock& shock : side->shocks) {
                if (shock.mach_ahead < least_mach) continue;
                const Point foot = shock.at + shift;
                if (std::exchange(is_first, false))
                    add_spacings(*side, e, foot, expectation.reach * chord, wall_spacing * chord / fineness,
                                 sizes.spacings);
                const std::vector<Point>& front = shock.front;
                add_sources(front, shift, expectation.radius, chord, fineness, sizes.sources);
                sizes.shocks.push_back({flow.elements[e].name, foot, flow.has_layers, shock.mach_ahead,
                                        distance(front.front(), front.back())});
            }
        }
    return sizes;
}

}  // namespace lamina::pipeline
