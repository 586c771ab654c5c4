#include "geometry/orientation_warnings.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "core/bounding_box.hpp"
#include "geometry/element_names.hpp"
#include "geometry/sheets.hpp"
#include "geometry/source_point.hpp"

namespace lamina::geometry {

namespace {

/// Returns the extent in y of an outline at one x.
double thickness_at(const std::vector<Point>& points, double x) {
    double low = HUGE_VAL, high = -HUGE_VAL;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const Point a = points[i], b = points[(i + 1) % points.size()];
        if ((a.x > x) == (b.x > x)) continue;
        const double y = a.y + (x - a.x) / (b.x - a.x) * (b.y - a.y);
        low = std::min(low, y);
        high = std::max(high, y);
    }
    return std::max(0.0, high - low);
}

/// Returns whether an edge at the rearmost vertex is so long that the rear end is a base or a corner, but no nose.
bool has_long_rear_edge(const Element& e, const Box& box) {
    constexpr double max_share = 0.05;
    const std::size_t n = e.points.size();
    const auto rear = std::max_element(e.points.begin(), e.points.end(), lexicographically_less);
    const auto i = static_cast<std::size_t>(rear - e.points.begin());
    return std::max(distance(*rear, e.points[(i + 1) % n]), distance(*rear, e.points[(i + n - 1) % n])) >
           max_share * box.width();
}

/// Returns how much thicker a section is near its rear end than near its front end, at the twentieth part of its
/// length, if its rear end is round; 0 if it is not, and for sections that are not slender or inclined by much.
double rear_to_front(const Element& e, const Box& box) {
    constexpr double share = 0.05, base_share = 0.002, min_roundness = 2, max_height = 0.5;
    if (box.height() > max_height * box.width() || has_long_rear_edge(e, box)) return 0;
    const auto thickness = [&](double s) { return thickness_at(e.points, box.lower.x + s * box.width()); };
    const double rear = thickness(1 - share), front = thickness(share);
    if (thickness(1 - base_share) * min_roundness > rear) return 0;
    return front > 0 ? rear / front : 0;
}

void warn_of_swapped_columns(Element& e, const Box& box) {
    e.warnings.push_back(
        {.code = WarningCode::swapped_columns,
         .at = box.lower,
         .number = box.height() / box.width(),
         .unit = "height / length",
         .message = fmt::format("it stands upright in the flow, {:.3g} high and {:.3g} long; if the columns of {} "
                                "are y and x, swap them: awk '{{ print $2, $1 }}'",
                                box.height(), box.width(), e.file)});
}

void warn_of_reversed_flow(Element& e, const Box& box, double ratio) {
    const auto nose = std::max_element(e.points.begin(), e.points.end(), lexicographically_less);
    e.warnings.push_back(
        {.code = WarningCode::reversed_flow,
         .at = *nose,
         .number = ratio,
         .unit = "rear / front thickness",
         .message = fmt::format("its round nose is at x = {:.6g} and its thin tail at x = {:.6g}, but lamina "
                                "expects flow in the direction of x; if the flow comes from the right, give "
                                "--transform all:rotate:180 --transform all:mirror",
                                box.upper.x, box.lower.x)});
}

}  // namespace

void add_orientation_warnings(Geometry& geometry) {
    constexpr double min_upright = 2;   // height over length
    constexpr double min_reversed = 2;  // thickness near the rear over that near the front
    const Box all = bounding_box(geometry);
    const bool upright = all.height() > min_upright * all.width();
    for (Element& e : geometry.elements) {
        if (is_sheet(e)) continue;  // which may stand as it likes
        if (e.file.starts_with(naca_prefix)) continue;
        const Box box = core::bounding_box(e.points);
        if (upright && box.height() > min_upright * box.width()) {
            warn_of_swapped_columns(e, box);
        } else if (const double ratio = rear_to_front(e, box); ratio > min_reversed) {
            warn_of_reversed_flow(e, box, ratio);
        }
    }
}

}  // namespace lamina::geometry
