// Facts about an element for a person to read, as numbers and as text.
#include <lamina/surface.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "core/bounding_box.hpp"
#include "core/reproducible_math.hpp"
#include "core/text.hpp"
#include "geometry/sharp_corner.hpp"
#include "geometry/trailing_edge.hpp"
#include "surface/corners.hpp"
#include "surface/notes.hpp"
#include "surface/summary.hpp"

namespace lamina::surface {

ElementSummary summarize(const Element& element) {
    ElementSummary s;
    const std::vector<Point>& points = element.points;
    const std::size_t n = points.size();
    if (n < 3) return s;
    s.box = core::bounding_box(points);
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

    const std::vector<double> turning = turning_angles(points);
    for (std::size_t i = 0; i < n; ++i) {
        const double turning_deg = core::degrees(turning[i]);
        if (std::abs(turning_deg) > s.max_turning_deg) {
            s.max_turning_deg = std::abs(turning_deg);
            s.max_turning_at = points[i];
        }
        if (turning_deg > geometry::sharp_corner_deg) ++s.sharp_corners;
    }
    OutlineFeatures features;
    geometry::find_trailing_edge(points, features);
    s.blunt_trailing_edge = features.base.has_value();
    s.trailing_edge = features.trailing_edge;
    return s;
}

}  // namespace lamina::surface

namespace lamina {

using namespace surface;

std::string describe(const Geometry& geometry) {
    std::string text;
    const auto out = std::back_inserter(text);
    const auto out_list = [&](const char* label, const std::vector<std::string>& lines) {
        for (std::size_t i = 0; i < lines.size(); ++i)
            fmt::format_to(out, "  {:<14} {}\n", i == 0 ? label : "", lines[i]);
    };
    for (const Element& e : geometry.elements) {
        const ElementSummary s = summarize(e);
        fmt::format_to(out, "{}\n", e.name);
        fmt::format_to(out, "  file           {} ({})\n", e.file, e.format);
        if (!e.title.empty()) fmt::format_to(out, "  title          {}\n", e.title);
        if (!e.unit.empty()) fmt::format_to(out, "  unit           {}, as the file says\n", e.unit);
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
        fmt::format_to(out, "  turning        at most {:.4g} degrees, at ({:.6g}, {:.6g}); {}\n", s.max_turning_deg,
                       s.max_turning_at.x, s.max_turning_at.y, core::counted(s.sharp_corners, "sharp corner"));
        fmt::format_to(out, "  trailing edge  {}, at ({:.6g}, {:.6g})\n", s.blunt_trailing_edge ? "blunt" : "not blunt",
                       s.trailing_edge.x, s.trailing_edge.y);
        out_list("repairs", e.repairs.empty() ? std::vector<std::string>{"none"} : e.repairs);
        out_list("transformed", e.transformations);
        std::vector<std::string> warnings;
        for (const Warning& warning : e.warnings) warnings.push_back(warning.message);
        out_list("warnings", warnings);
        out_list("surface", e.surface_notes);
    }
    return text;
}

}  // namespace lamina
