// Sources of the size field along the wakes (docs/decisions/0036).
#include <algorithm>
#include <cmath>
#include <functional>
#include <span>
#include <utility>
#include <vector>

#include "flow/boundary_layer.hpp"
#include "flow/panel_system.hpp"
#include "pipeline/flow_guidance.hpp"
#include "surface/spline.hpp"

namespace lamina::pipeline {

namespace {

/// Length of the wakes, in chords of the configuration.
constexpr double wake_length = 2;
/// Number of triangles across a wake, and across its inner part.
constexpr double triangles_across = 10;
/// At either edge of a wake, triangles may grow over this share of its width.
constexpr double outer_share = 0.15;
/// No triangle is smaller than this for the sake of wakes, in chords of the configuration.
constexpr double smallest_size = 5e-5;
/// A wake is a chain of segments of one size each. This is the largest ratio of successive sizes, and the longest
/// segment, in sizes.
constexpr double size_ratio = 1.1, max_segment = 20;
/// The inner wake, where the fluid from next to the wall gains speed, has this width at the trailing edge, in momentum
/// thicknesses of both sides. The growth per length is about half that of a mixing layer beside fluid at rest, 0.11
/// (S. B. Pope, Turbulent Flows (2000), section 5.4.2), since the fluid is not at rest for long.
constexpr double inner_start = 4, inner_growth = 0.06;
/// Lift of viscous over that of potential flow, and how far it may be from this. It is 0.86 to 0.9 where the flow is
/// attached and 0.8 where it separates on a flap, but wakes of little lift hardly bend.
constexpr double lift_share = 0.8, lift_share_range = 0.05;
/// Behind the bodies the lift falls to that in so many steps, over this length in chords: a flow with less lift turns
/// round the trailing edge.
constexpr int lift_steps = 6;
constexpr double lift_fall_length = 0.15;
/// A spline through the points of a streamline is taken for straight between this many points of each piece.
constexpr int parts_of_a_step = 16;

/// A line with the arc length at each of its points.
struct MeasuredLine {
    std::vector<Point> points;
    std::vector<double> s;

    /// Adds a point, unless it is the last one again.
    void add(Point p) {
        if (!points.empty() && p == points.back()) return;
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

/// Streamlines need be no more exact than sizes are, and those that only tell widths have longer steps.
constexpr StreamlineOptions rough{.tolerance = 1e-5}, rougher{.tolerance = 1e-4, .max_step = 0.25};

void append_streamline(const Flow& flow, double length, const StreamlineOptions& options, MeasuredLine& line) {
    const std::vector<Point> more = streamline(flow, line.points.back(), length, options);
    for (std::size_t i = 1; i < more.size(); ++i) line.add(more[i]);
}

/// Follows potential flow from a trailing edge past all bodies, since it keeps to their walls. The first step leaves the
/// trailing edge.
MeasuredLine line_past_bodies(const Flow& flow, Point from) {
    constexpr double shortest = 1e-3;  // in chords
    const Point stream = flow::free_stream(flow.alpha_deg);
    const double rear = rear_along(flow, stream);
    MeasuredLine line;
    line.add(from);
    do {
        const std::size_t points = line.points.size();
        const double left = std::max(rear - dot(line.points.back(), stream), shortest * flow.chord);
        append_streamline(flow, std::min(left, wake_length * flow.chord - line.s.back()), rough, line);
        if (line.points.size() == points) break;  // the line ends at a body
    } while (dot(line.points.back(), stream) <= rear && line.s.back() < wake_length * flow.chord);
    return line;
}

/// Continues a line that has passed all bodies, up to the length of the wakes. The lift falls to this share.
MeasuredLine continued(MeasuredLine line, const Flow& flow, double share, const StreamlineOptions& options) {
    const Point stream = flow::free_stream(flow.alpha_deg);
    const double all = wake_length * flow.chord, step = lift_fall_length / lift_steps * flow.chord;
    if (dot(line.points.back(), stream) <= rear_along(flow, stream)) return line;
    for (int k = 1; k <= lift_steps; ++k) {
        const Flow weaker = weakened(flow, 1 - (1 - share) * k / lift_steps);
        const double left = all - line.s.back();
        append_streamline(weaker, k < lift_steps ? std::min(step, left) : left, options, line);
    }
    return line;
}

/// Returns a chain of capsules along the line. Their size and radius are functions of the arc length; the chain ends
/// where `goes_on` does not hold.
std::vector<WakeSource> make_chain(const MeasuredLine& line, const std::function<double(double)>& size_at,
                                   const std::function<double(double)>& radius_at,
                                   const std::function<bool(double)>& goes_on) {
    std::vector<WakeSource> chain;
    const double end = line.s.back();
    for (double s = 0; s < end && goes_on(s);) {
        const double size = size_at(s);
        double next = s + size;
        while (next < end && next - s < max_segment * size && size_at(next) < size_ratio * size) next += size;
        next = std::min(next, end);
        chain.push_back({s, {.a = line.at(s), .b = line.at(next), .size = size, .radius = radius_at(s)}});
        s = next;
    }
    return chain;
}

double wake_width(const ElementFlow& element, double behind) {
    const FlowPoint &above = element.upper.back(), &below = element.lower.back();
    return flow::wake_thickness(above.thickness, below.thickness, above.momentum + below.momentum, behind);
}

}  // namespace

std::vector<ElementWake> wakes_of_flow(const Flow& flow, double fineness) {
    const double across = fineness * triangles_across, radius_over_size = across * (0.5 - outer_share);
    std::vector<ElementWake> wakes;
    for (const ElementFlow& element : flow.elements) {
        const FlowPoint &above = element.upper.back(), &below = element.lower.back();
        const double momentum = above.momentum + below.momentum;
        const Point from = midpoint(above.at, below.at);
        const MeasuredLine begun = line_past_bodies(flow, from), line = continued(begun, flow, lift_share, rough),
                           other = continued(begun, flow, lift_share - lift_share_range, rougher);
        const auto width = [&](double s) { return wake_width(element, s); };
        const auto bounded = [&](double size) { return std::max(size, smallest_size / fineness * flow.chord); };
        const auto size = [&](double s) { return bounded(width(s) / across); };
        const auto inner_size = [&](double s) { return bounded((inner_start * momentum + inner_growth * s) / across); };
        ElementWake& wake = wakes.emplace_back();
        wake.wake = {element.name, line.s.back(), width(0), width(line.s.back())};
        wake.line = line.points;
        wake.outer = make_chain(
            line, size, [&](double s) { return radius_over_size * size(s) + distance(line.at(s), other.at(s)); },
            [](double) { return true; });
        wake.inner = make_chain(
            line, inner_size, [&](double s) { return radius_over_size * inner_size(s); },
            [&](double s) { return size_ratio * inner_size(s) < size(s); });
    }
    return wakes;
}

std::vector<WakeLine> wake_lines(const Flow& flow, std::span<const ElementWake> wakes,
                                 std::span<const WallHeight> heights) {
    std::vector<WakeLine> lines;
    for (std::size_t e = 0; e < wakes.size(); ++e) {
        if (wakes[e].line.size() < 2) continue;
        // The chain of heights round an element begins and ends at its trailing edge.
        const auto is_own = [&](const WallHeight& height) { return height.element == e; };
        const auto above = std::find_if(heights.begin(), heights.end(), is_own);
        const auto below = std::find_if(heights.rbegin(), heights.rend(), is_own);
        const surface::SplineCurve curve({wakes[e].line, false});
        double behind = 0;
        WakeLine line{e, {{wakes[e].line.front(), above->height, below->height}}};
        for (std::size_t piece = 0; piece < curve.pieces(); ++piece)
            for (int k = 1; k <= parts_of_a_step; ++k) {
                const Point to = curve.at(piece, static_cast<double>(k) / parts_of_a_step);
                behind += distance(line.points.back().at, to);
                const double half = 0.5 * room_above * wake_width(flow.elements[e], behind);
                line.points.push_back({to, std::max(above->height, half), std::max(below->height, half)});
            }
        lines.push_back(std::move(line));
    }
    return lines;
}

}  // namespace lamina::pipeline
