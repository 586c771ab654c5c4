// Sources of the size field along the wakes (docs/decisions/0036).
#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "flow/boundary_layer.hpp"
#include "flow/panel_system.hpp"
#include "pipeline/flow_guidance.hpp"

namespace lamina::pipeline {

namespace {

/// Length of the wakes, in chords of the configuration.
constexpr double wake_length = 2;
/// Number of triangles across a wake, and across its inner part.
constexpr double triangles_across = 10;
/// At either edge of a wake, triangles may grow over this share of its width.
constexpr double outer_share = 0.15;
/// A wake is a chain of segments of one size each. This is the largest ratio of successive sizes, and the longest
/// segment, in sizes.
constexpr double size_ratio = 1.1, max_segment = 20;
/// The inner wake, where the flow from next to the wall gains speed, has this width at the trailing edge, in momentum
/// thicknesses of both sides. It widens per length as a plane mixing layer beside fluid at rest does (S. B. Pope,
/// Turbulent Flows (2000), section 5.4.2).
constexpr double inner_start = 4, inner_growth = 0.06;
/// Lift of viscous over that of potential flow, and how far it may be from this. It is 0.86 to 0.9 where the flow is
/// attached and 0.8 where it separates on a flap, but wakes of little lift hardly bend.
constexpr double lift_share = 0.8, lift_share_range = 0.05;

/// A line with the arc length at each of its points.
struct MeasuredLine {
    std::vector<Point> points;
    std::vector<double> s;

    void add(Point p) {
        s.push_back(points.empty() ? 0 : s.back() + distance(points.back(), p));
        points.push_back(p);
    }
    /// Returns the point at an arc length, or the last one.
    Point at(double length) const {
        const auto i = static_cast<std::size_t>(std::upper_bound(s.begin(), s.end(), length) - s.begin());
        if (i == s.size()) return points.back();
        return points[i - 1] + (length - s[i - 1]) / (s[i] - s[i - 1]) * (points[i] - points[i - 1]);
    }
};

/// Returns the flow with weaker vortices and sources.
Flow weakened(Flow flow, double factor) {
    for (PanelSheet& sheet : flow.sheets) {
        for (double& strength : sheet.strengths) strength *= factor;
        sheet.base_strength *= factor;
        sheet.base_source *= factor;
    }
    return flow;
}

/// Returns how far the rearmost trailing edge lies along the free stream.
double rear_along(const Flow& flow, Point stream) {
    double rear = -HUGE_VAL;
    for (const ElementFlow& element : flow.elements) rear = std::max(rear, dot(element.upper.back().at, stream));
    return rear;
}

/// Follows potential flow, which keeps to the walls, past all bodies. Behind them the lift decides where the line goes,
/// so that it follows the weaker flow there.
MeasuredLine wake_line(const Flow& flow, const Flow& weaker, Point from) {
    const Point stream = flow::free_stream(flow.alpha_deg);
    const double length = wake_length * flow.chord, rear = rear_along(flow, stream);
    MeasuredLine line;
    for (const Point p : streamline(flow, from, length)) {
        line.add(p);
        // The first step leaves the trailing edge.
        if (line.points.size() > 1 && dot(p, stream) > rear) break;
    }
    if (line.s.back() >= length) return line;
    const std::vector<Point> rest = streamline(weaker, line.points.back(), length - line.s.back());
    for (std::size_t i = 1; i < rest.size(); ++i) line.add(rest[i]);
    return line;
}

/// Returns a chain of capsules along the line. Their size and radius are functions of the arc length; the chain ends
/// where `goes_on` does not hold.
std::vector<SizeSource> make_chain(const MeasuredLine& line, const std::function<double(double)>& size_at,
                                   const std::function<double(double)>& radius_at,
                                   const std::function<bool(double)>& goes_on) {
    std::vector<SizeSource> chain;
    std::size_t first = 0;
    double size = size_at(0);
    for (std::size_t i = 1; i < line.points.size() && goes_on(line.s[first]); ++i) {
        const bool is_last = i + 1 == line.points.size();
        const double next = size_at(line.s[i]);
        if (!is_last && next < size_ratio * size && line.s[i] - line.s[first] < max_segment * size) continue;
        chain.push_back(
            {.a = line.points[first], .b = line.points[i], .size = size, .radius = radius_at(line.s[first])});
        first = i;
        size = next;
    }
    return chain;
}

}  // namespace

std::vector<WakeSources> wakes_of_flow(const Flow& flow) {
    constexpr double radius_over_size = triangles_across * (0.5 - outer_share);
    const Flow expected = weakened(flow, lift_share), least = weakened(flow, lift_share - lift_share_range);
    std::vector<WakeSources> wakes;
    for (const ElementFlow& element : flow.elements) {
        const FlowPoint &above = element.upper.back(), &below = element.lower.back();
        const double momentum = above.momentum + below.momentum;
        const Point from = midpoint(above.at, below.at);
        const MeasuredLine line = wake_line(flow, expected, from), other = wake_line(flow, least, from);
        const auto width = [&](double s) {
            return flow::wake_thickness(above.thickness, below.thickness, momentum, s);
        };
        const auto size = [&](double s) { return width(s) / triangles_across; };
        const auto inner_size = [&](double s) {
            return (inner_start * momentum + inner_growth * s) / triangles_across;
        };
        WakeSources& wake = wakes.emplace_back();
        wake.wake = {element.name, line.s.back(), width(0), width(line.s.back())};
        wake.outer = make_chain(
            line, size, [&](double s) { return radius_over_size * size(s) + distance(line.at(s), other.at(s)); },
            [](double) { return true; });
        wake.inner = make_chain(
            line, inner_size, [&](double s) { return radius_over_size * inner_size(s); },
            [&](double s) { return size_ratio * inner_size(s) < size(s); });
    }
    return wakes;
}

}  // namespace lamina::pipeline
