#include "flow/contour.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>

#include "core/angles.hpp"
#include "core/bounding_box.hpp"
#include "core/rounding.hpp"
#include "core/segments.hpp"
#include "flow/coves.hpp"
#include "geometry/inside.hpp"
#include "geometry/sheets.hpp"
#include "geometry/trailing_edge.hpp"
#include "surface/clearance.hpp"
#include "surface/corners.hpp"
#include "surface/spline.hpp"

namespace lamina::flow {

namespace {

// Spacings are shares of the extent of the element.
constexpr double max_spacing = 0.02;
constexpr double min_spacing = 2e-4;
constexpr double end_spacing = 0.0015;    ///< at the trailing edge
constexpr double corner_spacing = 0.004;  ///< at other corners
constexpr double gradation = 0.12;        ///< growth of the spacing per unit of arc length
constexpr double gap_share = 0.5;         ///< spacing over the distance to the next element
constexpr double max_turning_deg = 6;     ///< of the outline from the middle of a panel to that of the next one
constexpr double max_panels = 300;        ///< per element; beyond that all spacings grow alike

constexpr double least_base = 1e-4;      ///< bases shorter than this share of the extent count as sharp
constexpr double min_rounded_deg = 90;   ///< a trailing edge with a larger interior angle counts as rounded
constexpr double min_corner_deg = 5;     ///< corners that turn less are left to the curve
constexpr std::size_t max_corners = 24;  ///< outlines with more corners are ragged: panels cut across them
constexpr std::size_t max_parts_of_edge = 32;
constexpr double max_part = 0.004;  ///< largest length of the parts of the curve, as a share of the extent

/// An outline cut open at its trailing edge.
struct OpenOutline {
    std::vector<Point> points;    ///< from the trailing edge to the trailing edge
    std::vector<bool> is_corner;  ///< per point; ends are corners
    bool blunt = false;
    bool rounded = false;
};

std::size_t nearest_vertex(std::span<const Point> points, Point p) {
    const auto nearer = [&](Point a, Point b) { return squared_length(a - p) < squared_length(b - p); };
    return static_cast<std::size_t>(std::min_element(points.begin(), points.end(), nearer) - points.begin());
}

/// The rear end of an outline: the vertices at which it begins and ends, which are equal at a sharp trailing edge.
struct RearEnd {
    std::size_t first, last;
    bool rounded;
};

/// Returns the stretch of edges round a vertex that face to the rear: whose normals are within 60 degrees of the
/// direction from the farthest vertex to this one.
RearEnd facing_rear(std::span<const Point> points, std::size_t at) {
    constexpr double cosine = 0.5;
    const std::size_t n = points.size();
    std::size_t nose = 0;
    for (std::size_t i = 0; i < n; ++i)
        if (distance(points[i], points[at]) > distance(points[nose], points[at])) nose = i;
    const Point axis = unit(points[at] - points[nose]);
    const auto faces_rear = [&](std::size_t i) {
        return dot(-perpendicular(unit(points[(i + 1) % n] - points[i])), axis) > cosine;
    };
    RearEnd end{at, at, false};
    while (faces_rear((end.first + n - 1) % n)) end.first = (end.first + n - 1) % n;
    while (faces_rear(end.last)) end.last = (end.last + 1) % n;
    return end;
}

/// Returns the base, the sharp vertex, or the middle of the round at the trailing edge. A rear end with corners has its
/// base between the outermost of them, though it may bulge: a wall that is steep towards the trailing edge faces the
/// rear, too. One without a corner, or as wide as half of the body, is round.
RearEnd find_rear_end(std::span<const Point> points, const OutlineFeatures& features, double extent) {
    if (features.base && features.trailing_edge == midpoint(points[features.base->first], points[features.base->last]))
        return {features.base->first, features.base->last, false};
    constexpr double max_base = 0.5, min_base_corner_deg = 30;
    const std::size_t n = points.size();
    const auto turning = [&](std::size_t i) {
        return core::degrees(core::angle_between(points[i] - points[(i + n - 1) % n], points[(i + 1) % n] - points[i]));
    };
    const auto is_corner = [&](std::size_t i) { return turning(i) > min_base_corner_deg; };
    const RearEnd end = facing_rear(points, nearest_vertex(points, features.trailing_edge));
    if (end.first == end.last) return {end.first, end.last, turning(end.first) < 180 - min_rounded_deg};
    double width = 0;
    bool has_corner = is_corner(end.last);
    for (std::size_t i = end.first; i != end.last; i = (i + 1) % n) {
        width += distance(points[i], points[(i + 1) % n]);
        has_corner = has_corner || is_corner(i);
    }
    if (has_corner && width < max_base * extent) {
        RearEnd base = end;
        while (!is_corner(base.first)) base.first = (base.first + 1) % n;
        while (!is_corner(base.last)) base.last = (base.last + n - 1) % n;
        return base;
    }
    // The vertex nearest to the middle of the stretch.
    std::size_t middle = end.first, at = end.first;
    double nearest = HUGE_VAL;
    for (double s = 0; at != end.last; at = (at + 1) % n) {
        if (std::abs(s - 0.5 * width) < nearest * (1 - 1e-9)) {
            nearest = std::abs(s - 0.5 * width);
            middle = at;
        }
        s += distance(points[at], points[(at + 1) % n]);
    }
    return {middle, middle, true};
}

OpenOutline cut_open(const Element& element, double extent) {
    const std::vector<Point>& points = element.points;
    const std::size_t n = points.size();
    OutlineFeatures features = element.features;
    if (features.corners.empty()) features.corners = surface::find_corners(element);
    geometry::find_trailing_edge(points, features);
    const RearEnd rear = find_rear_end(points, features, extent);

    const Point lower_end = points[rear.first], upper_end = points[rear.last];
    OpenOutline outline;
    outline.rounded = rear.rounded;
    outline.blunt = distance(lower_end, upper_end) > least_base * extent;
    std::vector<bool> is_corner(n);
    for (const std::size_t i : features.corners) is_corner[i] = true;
    const std::size_t edges = rear.first == rear.last ? n : (rear.first + n - rear.last) % n;
    for (std::size_t k = 0; k <= edges; ++k) {
        const std::size_t i = (rear.last + k) % n;
        outline.points.push_back(points[i]);
        outline.is_corner.push_back(is_corner[i] || k == 0 || k == edges);
    }
    if (!outline.blunt) outline.points.front() = outline.points.back() = midpoint(lower_end, upper_end);
    return outline;
}

/// Returns the distance of a point from the other elements; infinity where there are none.
double distance_to_others(Point p, std::size_t own, const Geometry& geometry) {
    double least = HUGE_VAL;
    for (std::size_t e = 0; e < geometry.elements.size(); ++e) {
        const std::vector<Point>& points = geometry.elements[e].points;
        for (std::size_t i = 0; e != own && i < points.size(); ++i)
            least = std::min(least, core::distance_to_segment(p, points[i], points[(i + 1) % points.size()]));
    }
    return least;
}

/// Returns whether an outline and one of the other elements have a point of each other inside.
bool overlaps_others(std::span<const Point> outline, std::size_t own, const Geometry& geometry) {
    const auto is_in = [](std::span<const Point> points, std::span<const Point> around) {
        return std::any_of(points.begin(), points.end(), [&](Point p) { return geometry::contains(around, p); });
    };
    for (std::size_t e = 0; e < geometry.elements.size(); ++e)
        if (const std::vector<Point>& points = geometry.elements[e].points;
            e != own && (is_in(points, outline) || is_in(outline, points)))
            return true;
    return false;
}

/// Fairs the coves of both sides (fair_cove()), unless the curves would run into other elements, as with flaps that are
/// drawn in.
void fair_both_coves(OpenOutline& outline, std::size_t own, const Geometry& geometry, double extent) {
    const double to_next = distance_to_others(outline.points.front(), own, geometry);
    OpenOutline faired = outline;
    for (int side = 0; side < 2; ++side) {
        fair_cove(faired.points, faired.is_corner, extent, to_next);
        std::reverse(faired.points.begin(), faired.points.end());
        std::reverse(faired.is_corner.begin(), faired.is_corner.end());
    }
    if (faired.points == outline.points || overlaps_others(faired.points, own, geometry)) return;
    outline = std::move(faired);
}

/// A short part of the curve through an outline.
struct CurvePart {
    std::size_t run, piece;  ///< of the splines
    double from, to;         ///< shares of the piece
};

/// Splines through an outline between its corners, as a chain of short parts.
struct OutlineCurve {
    std::vector<surface::SplineCurve> runs;
    std::vector<CurvePart> parts;
    std::vector<Point> ends;           ///< of the parts: one more than these
    std::vector<double> s;             ///< arc length at the ends
    std::vector<std::size_t> corners;  ///< indices of ends that have to be nodes, the first and the last one included

    Point at(std::size_t part, double share) const {
        const CurvePart& p = parts[part];
        return runs[p.run].at(p.piece, p.from + share * (p.to - p.from));
    }
};

OutlineCurve make_curve(const OpenOutline& outline, double extent) {
    OutlineCurve curve;
    curve.ends.push_back(outline.points.front());
    curve.s.push_back(0);
    curve.corners.push_back(0);
    std::size_t begin = 0;
    for (std::size_t end = 1; end < outline.points.size(); ++end) {
        if (!outline.is_corner[end]) continue;
        const auto first = outline.points.begin();
        curve.runs.emplace_back(surface::SmoothRun{
            {first + static_cast<std::ptrdiff_t>(begin), first + static_cast<std::ptrdiff_t>(end) + 1}, false});
        for (std::size_t edge = begin; edge < end; ++edge) {
            const double length = distance(outline.points[edge], outline.points[edge + 1]);
            const auto count = static_cast<std::size_t>(
                std::clamp(std::ceil(length / (max_part * extent)), 1.0, static_cast<double>(max_parts_of_edge)));
            for (std::size_t k = 0; k < count; ++k) {
                const auto share = [&](std::size_t i) { return static_cast<double>(i) / static_cast<double>(count); };
                curve.parts.push_back({curve.runs.size() - 1, edge - begin, share(k), share(k + 1)});
                const Point p = curve.at(curve.parts.size() - 1, 1);
                curve.s.push_back(curve.s.back() + distance(curve.ends.back(), p));
                curve.ends.push_back(p);
            }
        }
        curve.corners.push_back(curve.ends.size() - 1);
        begin = end;
    }
    return curve;
}

/// Returns the angle by which the curve turns at an end of parts that is not the first or last one.
double turning_at(const OutlineCurve& curve, std::size_t i) {
    return core::angle_between(curve.ends[i] - curve.ends[i - 1], curve.ends[i + 1] - curve.ends[i]);
}

/// Leaves those corners that have to be nodes: none but the ends where the outline is ragged.
void select_corners(OutlineCurve& curve) {
    const std::size_t last = curve.corners.back();
    std::erase_if(curve.corners, [&](std::size_t i) {
        return i != 0 && i != last && std::abs(core::degrees(turning_at(curve, i))) <= min_corner_deg;
    });
    if (curve.corners.size() > max_corners) curve.corners = {0, last};
}

/// Returns the direction of the curve at the middle of each part, as an angle that does not jump by full turns, and
/// that leaves out the turning at corners.
std::vector<double> directions(const OutlineCurve& curve) {
    std::vector<double> angle{0};
    std::size_t next_corner = 1;
    for (std::size_t i = 1; i < curve.parts.size(); ++i) {
        const bool is_corner = curve.corners[next_corner] == i;
        if (is_corner) ++next_corner;
        angle.push_back(angle.back() + (is_corner ? 0 : turning_at(curve, i)));
    }
    return angle;
}

/// Returns, per end of a part, the largest panel centred there over whose length the curve turns by no more than a
/// panel may. The net turning counts: that of zigzags within the length cancels.
std::vector<double> spacing_by_turning(const OutlineCurve& curve, double extent) {
    const std::vector<double> angle = directions(curve);
    const std::size_t n = angle.size();
    const auto middle = [&](std::size_t part) { return 0.5 * (curve.s[part] + curve.s[part + 1]); };
    std::vector<double> spacing(curve.ends.size(), 0.0);
    constexpr double step = 0.8;
    for (double h = max_spacing * extent; h > min_spacing * extent; h *= step) {
        // Positions only grow, so that the part round each is found from that round the last one.
        const auto reader = [&, part = std::size_t{0}](double s) mutable {
            while (part + 2 < n && middle(part + 1) <= s) ++part;
            if (n < 2 || s <= middle(0)) return angle.front();
            if (s >= middle(n - 1)) return angle.back();
            const double share = (s - middle(part)) / (middle(part + 1) - middle(part));
            return angle[part] + share * (angle[part + 1] - angle[part]);
        };
        auto before = reader, behind = reader;
        for (std::size_t i = 0; i < spacing.size(); ++i) {
            const double turning = behind(curve.s[i] + 0.5 * h) - before(curve.s[i] - 0.5 * h);
            if (spacing[i] == 0 && std::abs(turning) <= core::radians(max_turning_deg)) spacing[i] = h;
        }
    }
    for (double& h : spacing) h = std::max(h, min_spacing * extent);
    return spacing;
}

std::vector<double> panel_spacing(const OutlineCurve& curve, std::size_t element, double extent,
                                  const surface::ClearanceSearch& walls, bool is_alone) {
    std::vector<double> spacing = spacing_by_turning(curve, extent);
    const std::size_t n = spacing.size();
    for (std::size_t k = 0; k < curve.corners.size(); ++k) {
        const bool is_end = k == 0 || k + 1 == curve.corners.size();
        double& h = spacing[curve.corners[k]];
        h = std::min(h, (is_end ? end_spacing : corner_spacing) * extent);
    }
    if (!is_alone) {
        const double reach = max_spacing * extent / gap_share;
        for (std::size_t i = 0; i < n; ++i) {
            // The element's own walls, which only count beyond the reach, are left out.
            const double room = walls.clearance(element, curve.ends[i], {}, reach, reach);
            spacing[i] = std::min(spacing[i], std::max(gap_share * room, min_spacing * extent));
        }
    }
    const auto step = [&](std::size_t i) { return gradation * (curve.s[i + 1] - curve.s[i]); };
    for (std::size_t i = 0; i + 1 < n; ++i) spacing[i + 1] = std::min(spacing[i + 1], spacing[i] + step(i));
    for (std::size_t i = n - 1; i-- > 0;) spacing[i] = std::min(spacing[i], spacing[i + 1] + step(i));
    return spacing;
}

/// Places nodes so that panels take equal shares of the integral of ds / spacing between two corners. All spacings grow
/// alike where there would be more than `most` panels.
std::vector<Point> place_nodes(const OutlineCurve& curve, std::span<const double> spacing, double most) {
    std::vector<double> panels{0};  // the integral, per end of a part
    for (std::size_t i = 0; i < curve.parts.size(); ++i)
        panels.push_back(panels.back() + 0.5 * (curve.s[i + 1] - curve.s[i]) * (1 / spacing[i] + 1 / spacing[i + 1]));
    const double scale = std::min(1.0, most / panels.back());
    std::vector<Point> nodes{curve.ends.front()};
    for (std::size_t k = 0; k + 1 < curve.corners.size(); ++k) {
        const std::size_t first = curve.corners[k], last = curve.corners[k + 1];
        const double from = panels[first], all = panels[last] - from;
        const double count = std::max(1.0, std::round(scale * all));
        std::size_t part = first;
        for (double i = 1; i < count; ++i) {
            const double target = from + all * (i / count);
            while (part + 1 < last && panels[part + 1] <= target) ++part;
            const double in_part = panels[part + 1] - panels[part];
            nodes.push_back(
                curve.at(part, core::rounded_place((target - panels[part]) / in_part, 1 / (scale * in_part))));
        }
        nodes.push_back(curve.ends[last]);
    }
    return nodes;
}

}  // namespace

std::vector<Contour> make_contours(const Geometry& given, const ContourOptions& options) {
    const Geometry geometry = geometry::with_thickness(given);
    const surface::ClearanceSearch walls(geometry);
    const double most = std::min(max_panels, options.most_panels / static_cast<double>(geometry.elements.size()));
    std::vector<Contour> contours;
    for (std::size_t e = 0; e < geometry.elements.size(); ++e) {
        const Element& element = geometry.elements[e];
        const double extent = core::longer_side(core::bounding_box(element.points));
        OpenOutline outline = cut_open(element, extent);
        if (options.fair_coves) fair_both_coves(outline, e, geometry, extent);
        OutlineCurve curve = make_curve(outline, extent);
        select_corners(curve);
        const std::vector<double> spacing = panel_spacing(curve, e, extent, walls, geometry.elements.size() == 1);
        contours.push_back({place_nodes(curve, spacing, most), outline.blunt, outline.rounded, extent});
        if (geometry::is_sheet(given.elements[e])) contours.back().sharp_nose = element.points.front();
    }
    return contours;
}

}  // namespace lamina::flow
