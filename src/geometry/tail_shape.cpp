// Source: M. Drela, XFOIL (1989), command TGAP.
#include "geometry/tail_shape.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <lamina/error.hpp>

#include "core/reproducible_math.hpp"
#include "geometry/sharp_corner.hpp"
#include "geometry/source_point.hpp"
#include "geometry/trailing_edge.hpp"

namespace lamina::geometry {

namespace {

/// Sides that meet farther behind the base than this many chords are parallel, about.
constexpr double max_extension = 0.25;

/// An outline from the upper corner of its trailing edge over both sides to the lower one, without points of the base.
/// A sharp trailing edge is both corners.
struct OpenOutline {
    std::vector<SourcePoint> points;
    Point leading_edge, trailing_edge;

    double chord() const { return distance(leading_edge, trailing_edge); }
    Point gap() const { return points.front().at - points.back().at; }
    bool is_sharp() const { return points.front().at == points.back().at; }
};

[[noreturn]] void refuse_tail(const Element& e, Point at, const std::string& reason) {
    throw InputError({e.file, 0, at}, fmt::format("element {}: {}", e.name, reason));
}

OpenOutline opened(const Element& e) {
    OutlineFeatures features;
    find_trailing_edge(e.points, features);
    const std::size_t n = e.points.size();
    const auto [first, last] = tail_corners(e.points, features);
    if (first == last && core::degrees(turning_angles(e.points)[first]) < sharp_corner_deg)
        refuse_tail(e, features.trailing_edge,
                    fmt::format("it has no trailing edge to change: its rear is neither a base nor a corner of more "
                                "than {} degrees",
                                sharp_corner_deg));
    OpenOutline outline;
    outline.trailing_edge = midpoint(e.points[first], e.points[last]);
    const std::size_t count = (last + n - first) % n;
    for (std::size_t k = 0; k <= (count == 0 ? n : count); ++k) {
        const std::size_t i = (first + k) % n;
        const bool is_corner = std::binary_search(e.given_corners.begin(), e.given_corners.end(), i);
        outline.points.push_back(
            {e.points[i], i < e.lines.size() ? static_cast<std::uint32_t>(e.lines[i]) : 0, is_corner});
    }
    outline.leading_edge = e.points[farthest_vertex(e.points, outline.trailing_edge)];
    return outline;
}

/// Moves both sides apart, or towards each other, until their ends have this gap, in chords.
void move_sides(OpenOutline& outline, const TrailingEdgeGap& wanted) {
    constexpr double most = 15;  // of the exponent
    const Point chord = outline.trailing_edge - outline.leading_edge, gap = outline.gap();
    const Point across = unit(outline.is_sharp() ? perpendicular(chord) : gap);
    const double change = wanted.gap * length(chord) - length(gap);
    const auto nose = std::find_if(outline.points.begin(), outline.points.end(),
                                   [&](const SourcePoint& p) { return p.at == outline.leading_edge; });
    const auto moved = [&](Point p) {
        const double station = std::clamp(dot(p - outline.leading_edge, chord) / squared_length(chord), 0.0, 1.0);
        const double exponent = wanted.distance > 0 ? std::min((1 - station) * (1 / wanted.distance - 1), most)
                                : station < 1       ? most
                                                    : 0.0;
        return 0.5 * change * station * core::exp_reproducible(-exponent) * across;
    };
    for (auto p = outline.points.begin(); p != outline.points.end(); ++p) {
        if (p == nose) continue;
        p->at = p < nose ? p->at + moved(p->at) : p->at - moved(p->at);
    }
    if (wanted.gap == 0) outline.points.front().at = outline.points.back().at = outline.trailing_edge;
}

/// Continues both sides straight to where they meet.
void extend_sides(OpenOutline& outline, const Element& e) {
    constexpr double max_edges = 64;
    const std::vector<SourcePoint>& p = outline.points;
    const double gap = length(outline.gap());
    // Neighbours nearer than the gap tell little on the direction, since they are rounded.
    const auto before = [&](std::size_t end, bool is_upper) {
        std::size_t k = 1;
        const auto at = [&](std::size_t j) { return p[is_upper ? end + j : end - j].at; };
        while (k + 1 < p.size() / 2 && distance(at(k), p[end].at) < gap) ++k;
        return p[end].at - at(k);
    };
    const Point upper = p.front().at, lower = p.back().at;
    const Point along_upper = unit(before(0, true)), along_lower = unit(before(p.size() - 1, false));
    // upper + s along_upper = lower + t along_lower
    const double across = cross(along_upper, along_lower);
    const double s = across != 0 ? cross(lower - upper, along_lower) / across : -1;
    const double t = across != 0 ? cross(lower - upper, along_upper) / across : -1;
    const double most = max_extension * outline.chord();
    if (!(s > 0 && t > 0 && s <= most && t <= most))
        refuse_tail(e, outline.trailing_edge,
                    fmt::format("its sides do not meet within {} chords behind the base: give --sharpen-te blend",
                                max_extension));
    const Point tip = upper + s * along_upper;
    const auto continuation = [&](Point from, Point neighbour) {
        const double edges = std::clamp(std::ceil(distance(from, tip) / distance(from, neighbour)), 1.0, max_edges);
        std::vector<SourcePoint> points;  // from the corner on, the tip among them
        for (double k = 1; k < edges; ++k) points.push_back({from + k / edges * (tip - from)});
        points.push_back({tip});
        return points;
    };
    std::vector<SourcePoint> extended = continuation(upper, p[1].at), rear = continuation(lower, p[p.size() - 2].at);
    std::reverse(extended.begin(), extended.end());
    extended.insert(extended.end(), p.begin(), p.end());
    extended.insert(extended.end(), rear.begin(), rear.end());
    outline.points = std::move(extended);
}

/// Puts the points back into the element, with a base of edges about as long as those beside it.
void close(Element& e, const OpenOutline& outline) {
    constexpr double max_edges = 64;
    const std::vector<SourcePoint>& p = outline.points;
    e.points.clear();
    e.lines.clear();
    e.given_corners.clear();
    for (std::size_t i = 0; i < p.size() - (outline.is_sharp() ? 1 : 0); ++i) {
        if (p[i].is_corner) e.given_corners.push_back(i);
        e.points.push_back(p[i].at);
        e.lines.push_back(p[i].line);
    }
    if (outline.is_sharp()) return;
    const Point upper = p.front().at, lower = p.back().at;
    const double neighbour = std::min(distance(upper, p[1].at), distance(lower, p[p.size() - 2].at));
    const double edges = std::clamp(std::floor(distance(upper, lower) / neighbour + 0.5), 1.0, max_edges);
    for (double k = 1; k < edges; ++k) {
        e.points.push_back(lower + k / edges * (upper - lower));
        e.lines.push_back(0);
    }
}

}  // namespace

void shape_tail(Element& element, const GeometryOptions& options) {
    if (!options.sharpen_te && !options.open_te) return;
    OpenOutline outline = opened(element);
    const double chord = outline.chord(), before = length(outline.gap()) / chord;
    if (options.sharpen_te && outline.is_sharp()) return;
    std::string note;
    if (options.sharpen_te == TailSharpening::extend) {
        extend_sides(outline, element);
        note = fmt::format("trailing edge of {:.3g} chords made sharp: both sides continued by {:.3g} chords", before,
                           distance(outline.points.front().at, outline.trailing_edge) / chord);
    } else {
        const TrailingEdgeGap gap = options.open_te.value_or(TrailingEdgeGap{0, 1});
        move_sides(outline, gap);
        note = fmt::format("gap of the trailing edge changed from {:.3g} to {:.3g} chords", before, gap.gap);
    }
    close(element, outline);
    element.transformations.push_back(std::move(note));
}

}  // namespace lamina::geometry
