// Sheets among bodies: each is cut where it leaves a body, put on the wall that it ends at, and becomes an outline or a
// part of one.
#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include <lamina/error.hpp>

#include "core/angles.hpp"
#include "core/bounding_box.hpp"
#include "core/box_tree.hpp"
#include "core/segments.hpp"
#include "geometry/inside.hpp"
#include "geometry/sheet_curve.hpp"
#include "geometry/sheets.hpp"
#include "geometry/unite.hpp"

namespace lamina::geometry {

namespace {

/// A place on the wall of a body: on the edge behind a vertex, or at a vertex.
struct Foot {
    std::size_t element, edge;
    Point at;
    bool at_vertex = false;
};

[[noreturn]] void refuse_at(const Element& sheet, Point at, const std::string& reason) {
    throw InputError({sheet.file, 0, at}, fmt::format("sheet {} {}", sheet.name, reason));
}

/// Returns the share of the segment a-b at which it crosses c-d, which it meets.
double share_at_crossing(Point a, Point b, Point c, Point d) {
    const double across = cross(b - a, d - c);
    return across == 0 ? 0 : std::clamp(cross(c - a, d - c) / across, 0.0, 1.0);
}

std::optional<std::size_t> body_round(const Geometry& bodies, Point p) {
    for (std::size_t e = 0; e < bodies.elements.size(); ++e) {
        const std::vector<Point>& outline = bodies.elements[e].points;
        if (core::bounding_box(outline).contains(p) && contains(outline, p)) return e;
    }
    return std::nullopt;
}

/// Returns the place on this edge that is nearest to p: its ends, where they are as near as rounding.
Foot foot_on(const Geometry& bodies, std::size_t element, std::size_t edge, Point p, double rounding) {
    const std::vector<Point>& outline = bodies.elements[element].points;
    const std::size_t next = (edge + 1) % outline.size();
    const Point a = outline[edge], b = outline[next];
    const double t = core::share_along(p, a, b);
    const Point at = a + t * (b - a);
    if (distance(at, a) <= rounding) return {element, edge, a, true};
    if (distance(at, b) <= rounding) return {element, next, b, true};
    return {element, edge, at};
}

/// Returns the place on a wall that an end of a sheet of this length stands on, as far as coordinates are typed.
std::optional<Foot> foot_near(const Geometry& bodies, Point end, double length, double rounding) {
    constexpr double most = 0.05;  // of the sheet
    std::optional<Foot> foot;
    double nearest = most * length;
    for (std::size_t e = 0; e < bodies.elements.size(); ++e) {
        const std::vector<Point>& p = bodies.elements[e].points;
        const double own = typed_rounding * core::longer_side(core::bounding_box(p));
        for (std::size_t i = 0; i < p.size(); ++i) {
            const double d = core::distance_to_segment(end, p[i], p[(i + 1) % p.size()]);
            if (!(d < own && d < nearest)) continue;
            nearest = d;
            foot = foot_on(bodies, e, i, end, rounding);
        }
    }
    return foot;
}

/// Cuts the first part of a curve off, which lies inside a body. Returns where it leaves the wall of that; nothing
/// where it begins on the wall.
std::optional<Foot> cut_inside(const Geometry& bodies, std::size_t body, const Element& sheet,
                               std::vector<Point>& curve, double rounding) {
    const std::vector<Point>& p = bodies.elements[body].points;
    std::size_t outside = 1;
    while (outside < curve.size() && contains(p, curve[outside])) ++outside;
    if (outside == curve.size())
        refuse_at(sheet, curve[0],
                  "lies inside element " + bodies.elements[body].name + ": move it out, or leave it out");
    const Point from = curve[outside], to = curve[outside - 1];
    double nearest = HUGE_VAL;
    std::optional<Foot> foot;
    for (std::size_t i = 0; i < p.size(); ++i) {
        const Point a = p[i], b = p[(i + 1) % p.size()];
        if (!core::segments_meet(from, to, a, b)) continue;
        const double t = share_at_crossing(from, to, a, b);
        if (!(t < nearest)) continue;
        nearest = t;
        foot = foot_on(bodies, body, i, from + t * (to - from), rounding);
    }
    if (foot) curve.erase(curve.begin(), curve.begin() + static_cast<std::ptrdiff_t>(outside) - 1);
    return foot;
}

/// Returns the wall that the first point of a curve stands on, and puts it there.
std::optional<Foot> stand(const Geometry& bodies, const Element& sheet, std::vector<Point>& curve) {
    constexpr double rounding = 1e-6, too_near = 0.01;  // of its length
    const double length = curve_length(curve);
    std::optional<Foot> foot;
    if (const auto body = body_round(bodies, curve.front()))
        foot = cut_inside(bodies, *body, sheet, curve, rounding * length);
    if (!foot) foot = foot_near(bodies, curve.front(), length, rounding * length);
    if (!foot) return foot;
    // The foot may have come nearer to the next points than these are to each other.
    while (curve.size() > 2 && distance(curve[1], foot->at) < too_near * length &&
           distance(curve[1], foot->at) < 0.5 * distance(curve[1], curve[2]))
        curve.erase(curve.begin() + 1);
    curve.front() = foot->at;
    return foot;
}

/// Throws InputError unless a sheet leaves the wall at its foot at an angle, and on the outer side.
void require_outside(const Geometry& bodies, const Foot& foot, const Element& sheet, const std::vector<Point>& curve) {
    constexpr double least_sine = 0.05;  // of the angle to the wall
    const std::vector<Point>& p = bodies.elements[foot.element].points;
    const std::size_t n = p.size();
    const Point before = foot.at_vertex ? p[(foot.edge + n - 1) % n] : p[foot.edge], after = p[(foot.edge + 1) % n];
    const Point along = unit(curve[1] - foot.at);
    const auto runs_along = [&](Point to) {
        const Point wall = unit(to - foot.at);
        return dot(wall, along) > 0 && std::abs(cross(wall, along)) < least_sine;
    };
    if (core::inside_wedge(foot.at, after, before, curve[1]))
        refuse_at(sheet, foot.at, "runs into element " + bodies.elements[foot.element].name + ": end it at the wall");
    if (runs_along(before) || runs_along(after))
        refuse_at(
            sheet, foot.at,
            "runs along the wall of element " + bodies.elements[foot.element].name + ": turn it away, or leave a gap");
}

constexpr const char* give_line = "leave a gap, or give one of them as --line NAME:two-sided:..., without layers";

/// Returns what a sheet is to do that crosses or touches an edge of an element.
std::string crossing_reason(const Element& element, std::size_t edge) {
    const std::vector<SheetRange> ranges = sheet_ranges(element);
    const std::size_t n = element.points.size();
    for (std::size_t k = 0; k < ranges.size(); ++k)
        if (const std::size_t i = edge < ranges[k].first ? edge + n : edge; i < ranges[k].last)
            return fmt::format("crosses or touches sheet {}: {}", element.sheets[k].name, give_line);
    return fmt::format("crosses or touches {}: end it at the wall, or leave a gap", element.name);
}

/// Throws InputError where a sheet crosses or touches walls or other sheets, but at its foot.
void require_clear(const Geometry& bodies, const std::optional<Foot>& foot, const Element& sheet,
                   const std::vector<Point>& curve) {
    if (const auto body = body_round(bodies, curve.back()))
        refuse_at(sheet, curve.back(), "ends inside element " + bodies.elements[*body].name);
    const core::BoxTree tree = tree_of_curve(curve, false);
    for (std::size_t e = 0; e < bodies.elements.size(); ++e) {
        const std::vector<Point>& p = bodies.elements[e].points;
        for (std::size_t i = 0; i < p.size(); ++i) {
            const Point a = p[i], b = p[(i + 1) % p.size()];
            const bool at_foot = foot && foot->element == e &&
                                 (i == foot->edge || (foot->at_vertex && (i + 1) % p.size() == foot->edge));
            tree.overlaps(core::bounding_box(a, b), [&](std::size_t k) {
                const Point from = curve[k], to = curve[k + 1];
                if ((k > 0 || !at_foot) && core::segments_meet(from, to, a, b))
                    refuse_at(sheet, from + share_at_crossing(from, to, a, b) * (to - from),
                              crossing_reason(bodies.elements[e], i));
            });
        }
    }
}

/// Returns the vertices of the second side of a sheet from its tip to its begin, both left out.
std::vector<Point> way_back(const std::vector<Point>& curve) {
    std::vector<Point> points = beside_curve(curve, sheet_gap(curve));
    std::reverse(points.begin(), points.end());
    return {points.begin() + 1, points.end() - 1};
}

/// Makes a sheet an outline of its own.
Element free_sheet(Element sheet, const std::vector<Point>& curve) {
    sheet.points = curve;
    const std::vector<Point> back = way_back(curve);
    sheet.points.insert(sheet.points.end(), back.begin(), back.end());
    if (sheet.lines.size() != curve.size()) sheet.lines.clear();
    sheet.lines.resize(sheet.points.size(), 0);
    sheet.given_corners = {0, curve.size() - 1};
    sheet.sheets = {{sheet.name, curve.front(), curve.back(), curve.front()}};
    return sheet;
}

/// An outline whose edges have names: those of the markers that they belong to.
struct NamedOutline {
    std::vector<Point> points;
    std::vector<std::size_t> lines;
    std::vector<char> is_given;
    std::vector<std::string> names;

    void add(Point p, std::size_t line, bool given, const std::string& name) {
        points.push_back(p);
        lines.push_back(line);
        is_given.push_back(given ? 1 : 0);
        names.push_back(name);
    }
};

/// Returns the vertex of the wall behind a sheet: so far beside its foot that the edges of both sides do not meet, in
/// the wedge between the sheet and the wall that ends at `after`.
Point end_beside_foot(const std::vector<Point>& curve, Point after, double gap) {
    const Point foot = curve[0], along = unit(curve[1] - foot), wall = unit(after - foot);
    const double turn = core::angle_between(along, wall), wedge = turn > 0 ? turn : turn + 2 * core::pi;
    if (wedge < 0.5 * core::pi) return foot + gap / cross(along, wall) * wall;
    return foot + gap * (wedge > 1.5 * core::pi ? core::rotated(along, 0.5 * wedge) : perpendicular(along));
}

/// Puts a sheet into the outline of the body that it stands on.
///
///     ---- a ------------ b ---        ---- a -- begin  end -- b ---
///                                                  |    |
///                                                  | tip|
void put_on_wall(const Element& sheet, const std::vector<Point>& curve, const Foot& foot, Element& body) {
    const std::vector<std::size_t> parts = parts_of_edges(body);
    const double gap = sheet_gap(curve);
    const Point end = end_beside_foot(curve, body.points[(foot.edge + 1) % body.points.size()], gap);
    NamedOutline outline;
    const auto add_sheet = [&](std::size_t line, const std::string& wall) {
        outline.add(foot.at, line, true, sheet.name);
        for (std::size_t k = 1; k + 1 < curve.size(); ++k) outline.add(curve[k], 0, false, sheet.name);
        outline.add(curve.back(), 0, true, sheet.name);
        for (const Point p : way_back(curve)) outline.add(p, 0, false, sheet.name);
        outline.add(end, 0, true, wall);
    };
    for (std::size_t i = 0; i < body.points.size(); ++i) {
        const std::string& name = body.parts.empty() ? body.name : body.parts[parts[i]].name;
        const std::size_t line = i < body.lines.size() ? body.lines[i] : 0;
        const bool here = i == foot.edge;
        if (!(here && foot.at_vertex))
            outline.add(body.points[i], line,
                        std::binary_search(body.given_corners.begin(), body.given_corners.end(), i), name);
        if (here) add_sheet(foot.at_vertex ? line : 0, name);
    }
    body.points = std::move(outline.points);
    body.lines = std::move(outline.lines);
    body.given_corners.clear();
    body.parts.clear();
    const std::size_t n = body.points.size();
    for (std::size_t i = 0; i < n; ++i) {
        if (outline.is_given[i] != 0) body.given_corners.push_back(i);
        if (outline.names[i] != outline.names[(i + n - 1) % n])
            body.parts.push_back({outline.names[i], body.points[i]});
    }
    body.sheets.push_back({sheet.name, foot.at, curve.back(), end});
    body.transformations.push_back(fmt::format("sheet {} put on the wall", sheet.name));
}

/// Throws InputError for a sheet with the name of something else.
void require_own_name(const Geometry& bodies, const Element& sheet) {
    for (const Element& body : bodies.elements) {
        bool is_used = body.name == sheet.name;
        for (const WallPart& part : body.parts) is_used = is_used || part.name == sheet.name;
        if (is_used) refuse_at(sheet, sheet.points[0], "has the name of another element");
    }
}

/// Returns where a sheet stands on a wall, if it does, and lets its curve begin there. Throws InputError where it
/// stands on walls at both ends.
std::optional<Foot> foot_of(const Geometry& bodies, const Element& sheet, std::vector<Point>& curve) {
    const std::optional<Foot> first = stand(bodies, sheet, curve);
    std::reverse(curve.begin(), curve.end());
    const std::optional<Foot> last = stand(bodies, sheet, curve);
    if (first && last)
        refuse_at(sheet, last->at,
                  first->element == last->element
                      ? "stands on the wall at both ends, and encloses a part of the flow: leave a gap"
                      : "joins two elements: leave a gap");
    if (last) return last;
    std::reverse(curve.begin(), curve.end());
    return first;
}

/// Throws InputError for a sheet that stands on another one of the same element.
void require_wall_below(const Element& sheet, const Foot& foot, const Element& body) {
    for (const SheetRange& range : sheet_ranges(body)) {
        const std::size_t n = body.points.size(), edge = foot.edge < range.first ? foot.edge + n : foot.edge;
        if (edge < range.last && (edge > range.first || !foot.at_vertex || is_sheet(body)))
            refuse_at(sheet, foot.at, fmt::format("stands on another sheet: give one sheet for both, {}", give_line));
    }
}

}  // namespace

Geometry with_sheets(Geometry bodies, std::span<const Element> sheets) {
    for (const Element& sheet : sheets) {
        require_own_name(bodies, sheet);
        std::vector<Point> curve = sheet.points;
        const std::optional<Foot> foot = foot_of(bodies, sheet, curve);
        // An outline without a vertex between its tips would have none on its way back.
        if (curve.size() == 2) curve.insert(curve.begin() + 1, midpoint(curve[0], curve[1]));
        if (foot) require_outside(bodies, *foot, sheet, curve);
        require_clear(bodies, foot, sheet, curve);
        if (!foot) {
            bodies.elements.push_back(free_sheet(sheet, curve));
            continue;
        }
        Element& body = bodies.elements[foot->element];
        require_wall_below(sheet, *foot, body);
        put_on_wall(sheet, curve, *foot, body);
    }
    return bodies;
}

}  // namespace lamina::geometry
