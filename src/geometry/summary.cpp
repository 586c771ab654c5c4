// What a person wants to know about an element, as numbers and as text.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <lamina/geometry.hpp>
#include <optional>

#include "core/reproducible_math.hpp"
#include "geometry/base.hpp"
#include "geometry/corners.hpp"

namespace lamina {

namespace {

constexpr double sharp_corner_deg = 60;

std::vector<double> turnings_deg(const std::vector<Point>& points) {
    std::vector<double> result = turnings(points);
    for (double& angle : result) angle = degrees(angle);
    return result;
}

/// The rearmost sharp corner behind the middle of the element that is none of the base's; else the base's middle; else
/// the rearmost vertex (of equal ones the lowest).
Point find_trailing_edge(const std::vector<Point>& points, const std::vector<double>& turnings, const Box& box,
                         const std::optional<Base>& base) {
    std::optional<Point> corner;
    Point rearmost = points[0];
    for (std::size_t i = 0; i < points.size(); ++i) {
        const Point p = points[i];
        if (p.x > rearmost.x || (p.x == rearmost.x && p.y < rearmost.y)) rearmost = p;
        const bool sharp = turnings[i] > sharp_corner_deg && p.x > box.center().x;
        if (sharp && !(base && (i == base->first || i == base->last)) && (!corner || p.x > corner->x)) corner = p;
    }
    if (!base) return corner.value_or(rearmost);
    const Point middle = midpoint(points[base->first], points[base->last]);
    return corner && corner->x > middle.x ? *corner : middle;
}

}  // namespace

ElementSummary summarize(const Element& element) {
    ElementSummary s;
    const std::vector<Point>& points = element.points;
    const std::size_t n = points.size();
    if (n < 3) return s;
    for (Point p : points) s.box.include(p);
    s.chord = s.box.width();

    s.min_spacing = HUGE_VAL;
    double before = distance(points[n - 1], points[0]);
    for (std::size_t i = 0; i < n; ++i) {
        const Point a = points[i], b = points[(i + 1) % n];
        const double spacing = distance(a, b);
        s.perimeter += spacing;
        s.area += 0.5 * cross(a - points[0], b - points[0]);
        s.min_spacing = std::min(s.min_spacing, spacing);
        s.max_spacing = std::max(s.max_spacing, spacing);
        s.max_spacing_ratio = std::max({s.max_spacing_ratio, spacing / before, before / spacing});
        before = spacing;
    }

    const std::vector<double> turnings = turnings_deg(points);
    for (std::size_t i = 0; i < n; ++i) {
        if (std::abs(turnings[i]) > s.max_turning_deg) {
            s.max_turning_deg = std::abs(turnings[i]);
            s.max_turning_at = points[i];
        }
        if (turnings[i] > sharp_corner_deg) ++s.sharp_corners;
    }
    const std::optional<Base> base = find_base(points);
    s.blunt_trailing_edge = base.has_value();
    s.trailing_edge = find_trailing_edge(points, turnings, s.box, base);
    return s;
}

std::string describe(const Pslg& pslg) {
    std::string text;
    const auto out = std::back_inserter(text);
    for (const Element& e : pslg.elements) {
        const ElementSummary s = summarize(e);
        fmt::format_to(out, "{}\n", e.name);
        fmt::format_to(out, "  file           {} ({})\n", e.file, e.format);
        if (!e.title.empty()) fmt::format_to(out, "  title          {}\n", e.title);
        if (e.points_read > 0) {
            fmt::format_to(out, "  points         {} read, {} in the outline\n", e.points_read, e.points.size());
        } else {
            fmt::format_to(out, "  points         {} generated\n", e.points.size());
        }
        fmt::format_to(out, "  box            x {:.6g} to {:.6g}, y {:.6g} to {:.6g}\n", s.box.lower.x, s.box.upper.x,
                       s.box.lower.y, s.box.upper.y);
        fmt::format_to(out, "  chord          {:.6g}, perimeter {:.6g}, area {:.6g}\n", s.chord, s.perimeter, s.area);
        fmt::format_to(out, "  spacing        {:.4g} to {:.4g}, neighbours differ by up to a factor {:.4g}\n",
                       s.min_spacing, s.max_spacing, s.max_spacing_ratio);
        fmt::format_to(out, "  turning        at most {:.4g} degrees, at ({:.6g}, {:.6g}); {} sharp corner{}\n",
                       s.max_turning_deg, s.max_turning_at.x, s.max_turning_at.y, s.sharp_corners,
                       s.sharp_corners == 1 ? "" : "s");
        fmt::format_to(out, "  trailing edge  {}, at ({:.6g}, {:.6g})\n", s.blunt_trailing_edge ? "blunt" : "not blunt",
                       s.trailing_edge.x, s.trailing_edge.y);
        if (e.repairs.empty()) {
            fmt::format_to(out, "  repairs        none\n");
        } else {
            for (std::size_t i = 0; i < e.repairs.size(); ++i)
                fmt::format_to(out, "  {:<14} {}\n", i == 0 ? "repairs" : "", e.repairs[i].text);
        }
        for (std::size_t i = 0; i < e.surface.size(); ++i)
            fmt::format_to(out, "  {:<14} {}\n", i == 0 ? "surface" : "", e.surface[i]);
    }
    return text;
}

}  // namespace lamina
