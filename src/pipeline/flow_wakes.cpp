// Sources of the size field along the wakes (docs/decisions/0036).
#include <algorithm>
#include <cmath>
#include <functional>
#include <span>
#include <utility>
#include <vector>

#include "flow/boundary_layer.hpp"
#include "flow/panel_system.hpp"
#include "flow/potential.hpp"
#include "flow/separation.hpp"
#include "pipeline/flow_guidance.hpp"
#include "surface/spline.hpp"

namespace lamina::pipeline {

namespace {

/// Length of the wakes, and of layers along them, in chords of the configuration.
constexpr double wake_length = 20, layered_length = 2;
/// Number of edges across a wake, and across its inner part. There are fewer behind all elements and the mixing layers
/// of a base, where the speed changes by no more than this from one to the next, over the free stream's: the velocity
/// defect of a plane wake over its width is 0.86 over the distance, whatever the drag is (H. Schlichting,
/// Boundary-Layer Theory, 7th ed. (1979), section 24.5), so that sizes grow as the distance.
constexpr double edges_across = 10, change_of_speed = 0.0135, growth_behind = change_of_speed / 0.86;
/// At either edge of a wake, triangles may grow over this share of its width.
constexpr double outer_share = 0.15;
/// No triangle is smaller than this for the sake of wakes, in chords of the configuration.
constexpr double smallest_size = 5e-5;
/// A wake is a chain of segments of one size each. This is the largest ratio of successive sizes, and the longest
/// segment, in sizes.
constexpr double size_ratio = 1.1;
constexpr int max_segment = 20;
/// The inner wake, where the fluid from next to the wall gains speed, has this width at the trailing edge, in momentum
/// thicknesses of both sides. The growth per length is that of a mixing layer beside fluid at rest, 0.11 (S. B. Pope,
/// Turbulent Flows (2000), section 5.4.2), where much of the fluid is at rest. Where it is not at rest for long, behind
/// attached layers, it is about half of that.
constexpr double inner_start = 4, inner_growth_attached = 0.06, inner_growth_at_rest = 0.11;
/// Behind a base that is wider than the inner wake there are two mixing layers, from its corners, with fluid at rest
/// between them. They meet after this many widths of the base: where both together are as wide as it.
constexpr double mixing_length = 0.5 / inner_growth_at_rest;
/// Fluid at rest between two shear layers, in its width where it begins: its wake widens by 0.1 on either side per
/// length; both shear layers lie within it. Edges are as long as the first number up to the first distance, and grow to
/// the second number at the second distance, where the wake ends. Resolved vortex streets behind cylinders have 30 to
/// 50 edges across the body (P. Parnaudeau, J. Carlier, D. Heitz, E. Lamballais, Phys. Fluids 20 (2008), 085101).
constexpr double open_half_width = 0.6, open_growth = 0.1, open_edge = 0.025, open_even_length = 5,
                 open_last_edge = 0.1, open_length = 20;
/// Lift of viscous over that of potential flow, and how far it may be from this. It is 0.86 to 0.9 where the flow is
/// attached and 0.8 where it separates on a flap, but wakes of little lift hardly bend.
constexpr double lift_share = 0.8, lift_share_range = 0.05;
/// Behind its trailing edge a wake is that of a flow whose lift falls to that share in so many steps, over this length
/// in chords: a flow with less lift turns round the trailing edge.
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

/// Streamlines need be no more exact than sizes are. Those that only tell widths, and far behind all, have longer
/// steps.
constexpr StreamlineOptions rough{.tolerance = 1e-5}, rougher{.tolerance = 1e-4, .max_step = 0.25};

void append_streamline(const Flow& flow, double length, const StreamlineOptions& options, MeasuredLine& line) {
    const std::vector<Point> more = streamline(flow, line.points.back(), length, options);
    for (std::size_t i = 1; i < more.size(); ++i) line.add(more[i]);
}

/// The flows whose lift falls from that of potential flow to a share of it.
std::vector<Flow> falling_lift(const Flow& flow, double share) {
    std::vector<Flow> flows{flow};
    for (int k = 1; k <= lift_steps; ++k)
        flows.push_back(flow::with_share_of_lift(flow, 1 - (1 - share) * k / lift_steps));
    return flows;
}

/// Follows flows of less and less lift from a trailing edge, up to the length of the wakes or to a body.
MeasuredLine wake_line(std::span<const Flow> flows, Point from, const StreamlineOptions& options) {
    const double chord = flows.front().chord;
    MeasuredLine line;
    line.add(from);
    for (std::size_t k = 0; k + 1 < flows.size(); ++k)
        append_streamline(flows[k], lift_fall_length / lift_steps * chord, options, line);
    append_streamline(flows.back(), layered_length * chord - line.s.back(), options, line);
    append_streamline(flows.back(), wake_length * chord - line.s.back(), rougher, line);
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
        int sizes = 1;
        while (sizes < max_segment && s + sizes * size < end && size_at(s + sizes * size) < size_ratio * size) ++sizes;
        const double next = std::min(s + sizes * size, end);
        chain.push_back({s, {.a = line.at(s), .b = line.at(next), .size = size, .radius = radius_at(s)}});
        s = next;
    }
    return chain;
}

double base_width(const ElementFlow& element) { return distance(element.upper.back().at, element.lower.back().at); }

/// Returns the width of the fluid at rest in a layer that has separated. Such a layer keeps its momentum thickness, so
/// it is what the displacement exceeds that at separation by.
double at_rest_behind(const FlowPoint& end) {
    if (end.state != BoundaryLayerState::separated) return 0;
    return std::max(end.displacement - flow::separation_shape * end.momentum, 0.0);
}

/// Returns the width of the wake: that of a plane wake that begins as wide as the base and both layers, with the
/// momentum thickness far behind, or of the trailing edge where that is less: in front of other elements. Besides,
/// separated layers go on to spread by the fluid at rest below them.
double wake_width(const ElementFlow& element, double behind) {
    const FlowPoint &above = element.upper.back(), &below = element.lower.back();
    double momentum = 0;
    for (const auto* side : {&element.upper, &element.lower})
        momentum += std::min(side->back().momentum, flow::momentum_far_behind(*side));
    return flow::wake_thickness(above.thickness + base_width(element), below.thickness, momentum, behind) +
           std::min(inner_growth_at_rest * behind, at_rest_behind(above) + at_rest_behind(below));
}

/// The wake within the wake, next to the trailing edge.
struct InnerWake {
    double start, growth;  ///< its width at the trailing edge, and the growth of its width per length
    double base;           ///< width of the base
    bool is_split;         ///< whether there are two mixing layers at first
    double split_length;   ///< they meet here

    double width(double s) const { return start + growth * s; }
};

InnerWake inner_wake(const ElementFlow& element) {
    const FlowPoint &above = element.upper.back(), &below = element.lower.back();
    InnerWake inner{};
    inner.start = inner_start * (above.momentum + below.momentum);
    inner.base = base_width(element);
    inner.is_split = inner.base > inner.start;
    inner.split_length = inner.is_split ? mixing_length * inner.base : 0;
    // Where fluid at rest makes half of the displacement, or a base is as wide as the inner wake, the growth is that
    // beside fluid at rest. Bases of half of that width have no effect.
    double at_rest = 2 * inner.base / inner.start - 1;
    for (const FlowPoint* side : {&above, &below})
        at_rest = std::max(at_rest, at_rest_behind(*side) / (flow::separation_shape * side->momentum));
    const double share = std::clamp(at_rest, 0.0, 1.0);
    inner.growth = inner_growth_attached + share * (inner_growth_at_rest - inner_growth_attached);
    return inner;
}

/// Returns how long a wake is where it has come behind all trailing edges.
double length_to_rear(const Flow& flow, const MeasuredLine& line) {
    const Point stream = flow::free_stream(flow.alpha_deg);
    double rear = -HUGE_VAL;
    for (const ElementFlow& element : flow.elements)
        for (const auto* side : {&element.upper, &element.lower}) rear = std::max(rear, dot(side->back().at, stream));
    const auto behind =
        std::find_if(line.points.begin(), line.points.end(), [&](Point p) { return dot(p, stream) >= rear; });
    return behind == line.points.end() ? line.s.back() : line.s[static_cast<std::size_t>(behind - line.points.begin())];
}

/// Returns the part of a line from an arc length on, or its last point.
MeasuredLine part_from(const MeasuredLine& line, double begin) {
    MeasuredLine part;
    part.add(line.at(begin));
    for (std::size_t i = 0; i < line.points.size(); ++i)
        if (line.s[i] > begin) part.add(line.points[i]);
    return part;
}

/// Returns the part of a line up to an arc length.
MeasuredLine part_up_to(const MeasuredLine& line, double end) {
    MeasuredLine part;
    for (std::size_t i = 0; i < line.points.size() && line.s[i] < end; ++i) part.add(line.points[i]);
    part.add(line.at(end));
    return part;
}

/// Returns the line of the mixing layer from a corner of a base, which comes to the middle of the wake after a length.
MeasuredLine line_from_corner(const MeasuredLine& wake, Point corner, double length) {
    constexpr int parts = 8;
    const Point to_corner = corner - wake.points.front();
    MeasuredLine line;
    for (int k = 0; k <= parts; ++k) {
        const double share = static_cast<double>(k) / parts;
        line.add(wake.at(share * length) + (1 - share) * to_corner);
    }
    return line;
}

/// Returns how far one can go from a point in a direction before a wall of another element: at most `length`.
double free_length(const Flow& flow, const ElementFlow& own, Point from, Point direction, double length) {
    const Point to = from + length * direction;
    double least = length;
    for (const ElementFlow& element : flow.elements)
        for (const auto* side : {&element.upper, &element.lower})
            for (std::size_t i = 1; i < side->size() && &element != &own; ++i) {
                const Point a = (*side)[i - 1].at, b = (*side)[i].at;
                const double before = cross(to - from, a - from), after = cross(to - from, b - from);
                if ((before > 0) == (after > 0)) continue;
                const double along = dot(a + before / (before - after) * (b - a) - from, direction);
                if (along > 0) least = std::min(least, along);
            }
    return least;
}

/// Returns the envelope of both shear layers behind an element that the flow has left. It begins beside the first place
/// of separation and follows the free stream:
///
///       ______________ - - - -     half-width 0.6 D + 0.1 s
///      /above
///     | . . . . . . . . . . . . .  middle of the wake
///      \below________ _ _ _ _
///
ElementWake open_wake(const Flow& flow, const ElementFlow& element, const flow::OpenWake& open, double fineness) {
    const double d = open.width;
    const Point middle = midpoint(open.above, open.below);
    const double first = std::min(dot(open.above - middle, open.stream), dot(open.below - middle, open.stream));
    const Point from = middle + first * open.stream;
    MeasuredLine line;
    line.add(from);
    line.add(from + free_length(flow, element, from, open.stream, open_length * d) * open.stream);
    const auto size = [&](double s) {
        const double share = std::max(s / d - open_even_length, 0.0) / (open_length - open_even_length);
        return (open_edge + share * (open_last_edge - open_edge)) * d / fineness;
    };
    const auto half_width = [&](double s) { return open_half_width * d + open_growth * s; };
    ElementWake wake;
    wake.wake = {element.name, line.s.back(), 2 * half_width(0), 2 * half_width(line.s.back()), 0, true};
    wake.outer = make_chain(line, size, half_width, [](double) { return true; });
    return wake;
}

}  // namespace

std::vector<ElementWake> wakes_of_flow(const Flow& flow, double fineness) {
    constexpr double inner_share = 0.5 - outer_share;
    const std::vector<Flow> flows = falling_lift(flow, lift_share),
                            weaker = falling_lift(flow, lift_share - lift_share_range);
    std::vector<ElementWake> wakes;
    for (const ElementFlow& element : flow.elements) {
        if (const auto open = flow::find_open_wake(flow, element)) {
            wakes.push_back(open_wake(flow, element, *open, fineness));
            continue;
        }
        const FlowPoint &above = element.upper.back(), &below = element.lower.back();
        const Point from = midpoint(above.at, below.at);
        const MeasuredLine line = wake_line(flows, from, rough), other = wake_line(weaker, from, rougher);
        const InnerWake inner = inner_wake(element);
        const auto width = [&](double s) { return wake_width(element, s); };
        const double split = std::min(inner.split_length, line.s.back()),
                     rear = std::max(length_to_rear(flow, line), split);
        // The size and the radius on a part of the wake that begins behind a length, and whether it is finer than the
        // whole.
        const auto size_of = [&](const auto& width_at, double begin) {
            return [&, width_at, begin](double s) {
                const double far = growth_behind * std::max(begin + s - rear, 0.0);
                return std::max({width_at(s) / edges_across, far, smallest_size * flow.chord}) / fineness;
            };
        };
        const auto size = size_of(width, 0);
        const auto radius_of = [&](const auto& width_at) {
            return [&, width_at](double s) { return inner_share * width_at(s); };
        };
        const auto is_finer = [&](const auto& width_at, double begin) {
            return
                [&, width_at, begin](double s) { return size_ratio * size_of(width_at, begin)(s) < size(begin + s); };
        };
        ElementWake& wake = wakes.emplace_back();
        wake.wake = {element.name, line.s.back(), width(0), width(line.s.back())};
        wake.line = part_up_to(line, std::min(layered_length * flow.chord, line.s.back())).points;
        wake.outer = make_chain(
            line, size, [&](double s) { return inner_share * width(s) + distance(line.at(s), other.at(s)); },
            [](double) { return true; });
        const auto inner_width = [&](double s) { return inner.width(split + s); };
        wake.inner = make_chain(part_from(line, split), size_of(inner_width, split), radius_of(inner_width),
                                is_finer(inner_width, split));
        for (WakeSource& source : wake.inner) source.begins += split;
        if (!inner.is_split) continue;
        for (const FlowPoint* corner : {&above, &below}) {
            const auto mixing_width = [&](double s) { return inner_start * corner->momentum + inner.growth * s; };
            const auto chain = make_chain(line_from_corner(line, corner->at, split), size_of(mixing_width, 0),
                                          radius_of(mixing_width), is_finer(mixing_width, 0));
            wake.mixing.insert(wake.mixing.end(), chain.begin(), chain.end());
        }
    }
    return wakes;
}

void add_to_fan(const ElementWake& wake, ElementWake& fan) {
    const auto append = [](const std::vector<WakeSource>& more, std::vector<WakeSource>& sources) {
        sources.insert(sources.end(), more.begin(), more.end());
    };
    append(wake.outer, fan.outer);
    append(wake.inner, fan.inner);
    append(wake.mixing, fan.mixing);
    if (fan.wake.element.empty()) fan.wake = wake.wake;
}

void close_gap(const ElementWake& wake, const ElementWake& next, ElementWake& fan) {
    // Capsules on the line in the middle fill what those of both wakes leave between them:
    //
    //      wake  (=======)        next to the trailing edge both overlap,
    //       gap  (       )        so that there is nothing to fill
    //      next  (=======)
    for (const WakeSource& part : wake.outer) {
        const auto beside = std::find_if(next.outer.begin(), next.outer.end(), [&](const WakeSource& other) {
            return other.begins + distance(other.source.a, other.source.b) > part.begins;
        });
        if (beside == next.outer.end()) return;
        const SizeSource &a = part.source, &b = beside->source;
        const double gap = std::max(distance(a.a, b.a), distance(a.b, b.b)) - a.radius - b.radius;
        if (!(gap > 0)) continue;
        fan.outer.push_back({part.begins,
                             {.a = midpoint(a.a, b.a),
                              .b = midpoint(a.b, b.b),
                              .size = std::min(a.size, b.size),
                              .radius = 0.5 * gap}});
    }
}

std::vector<layers::WakeLine> wake_lines(const Flow& flow, std::span<const ElementWake> wakes,
                                         std::span<const layers::WallHeight> heights) {
    std::vector<layers::WakeLine> lines;
    for (std::size_t e = 0; e < wakes.size(); ++e) {
        if (wakes[e].line.size() < 2) continue;
        // The chain of heights round an element begins and ends at its trailing edge.
        const auto is_own = [&](const layers::WallHeight& height) { return height.element == e; };
        const auto above = std::find_if(heights.begin(), heights.end(), is_own);
        const auto below = std::find_if(heights.rbegin(), heights.rend(), is_own);
        const surface::SplineCurve curve({wakes[e].line, false});
        double behind = 0;
        layers::WakeLine line{e, {{wakes[e].line.front(), above->height, below->height}}};
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
