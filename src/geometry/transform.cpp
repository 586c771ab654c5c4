// Transformations of elements.
#include <lamina/geometry.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <lamina/error.hpp>

#include "core/angles.hpp"
#include "geometry/element_names.hpp"
#include "geometry/plain_flap.hpp"
#include "geometry/sheets.hpp"
#include "geometry/source_point.hpp"
#include "geometry/unite.hpp"

namespace lamina::geometry {

namespace {

/// Moves the points of an element, where its parts and sheets begin and end, and the places of its warnings.
template <class Map>
void map_points(Element& e, Map map) {
    for (Point& p : e.points) p = map(p);
    for (WallPart& part : e.parts) part.begin = map(part.begin);
    for (SheetSides& sheet : e.sheets)
        for (Point* p : {&sheet.begin, &sheet.tip, &sheet.end}) *p = map(*p);
    for (Warning& warning : e.warnings)
        if (warning.at) warning.at = map(*warning.at);
}

/// Lets each part of the wall begin where it ended, for an outline that runs the other way.
void reverse_parts(Element& e) {
    if (e.parts.empty()) return;
    const std::vector<std::size_t> part_of_edge = parts_of_edges(e);
    const std::size_t n = e.points.size();
    std::vector<WallPart> reversed;
    for (std::size_t i = 0; i < n; ++i) {
        const std::size_t part = part_of_edge[(i + n - 1) % n];  // that ends at point i, if another one begins there
        if (part != part_of_edge[i]) reversed.push_back({e.parts[part].name, e.points[i]});
    }
    e.parts = std::move(reversed);
}

/// Puts an element that was mirrored back into counter-clockwise order; the first point stays first.
void reverse_order(Element& e) {
    if (is_open_sheet(e)) return;
    reverse_parts(e);
    for (SheetSides& sheet : e.sheets) std::swap(sheet.begin, sheet.end);
    for (std::size_t& corner : e.given_corners) corner = (e.points.size() - corner) % e.points.size();
    std::sort(e.given_corners.begin(), e.given_corners.end());
    std::reverse(e.points.begin() + 1, e.points.end());
    if (!e.lines.empty()) std::reverse(e.lines.begin() + 1, e.lines.end());
}

/// Returns the cosine and the sine of an angle, which are 0, 1 and -1 exactly at multiples of 90 degrees.
Point direction(double angle_deg) {
    const double quarters = std::floor(angle_deg / 90 + 0.5);
    Point result = core::rotated({1, 0}, core::radians(angle_deg - 90 * quarters));
    const int turns = (static_cast<int>(quarters) % 4 + 4) % 4;
    for (int k = 0; k < turns; ++k) result = perpendicular(result);
    return result;
}

/// Changes an element and returns what was done, as a note.
struct Change {
    Element& element;

    std::string operator()(const Scaling& s) const {
        map_points(element, [&](Point p) { return s.center + s.factor * (p - s.center); });
        if (s.factor != 1) element.unit.clear();
        return fmt::format("scaled by {} about {}", s.factor, coordinates(s.center));
    }
    std::string operator()(const Rotation& r) const {
        const Point d = direction(r.angle_deg);
        map_points(element, [&](Point p) {
            const Point arm = p - r.center;
            return r.center + Point{arm.x * d.x - arm.y * d.y, arm.x * d.y + arm.y * d.x};
        });
        return fmt::format("rotated by {} degrees about {}", r.angle_deg, coordinates(r.center));
    }
    std::string operator()(const Shift& s) const {
        map_points(element, [&](Point p) { return p + s.by; });
        return fmt::format("shifted by {}", coordinates(s.by));
    }
    std::string operator()(const Mirroring& m) const {
        map_points(element, [&](Point p) { return Point{p.x, 2 * m.y - p.y}; });
        reverse_order(element);
        return fmt::format("mirrored in the line y = {}", m.y);
    }
    std::string operator()(const FlapDeflection& f) const {
        if (is_open_sheet(element) || !element.sheets.empty())
            throw InputError(
                {element.file, 0, f.hinge},
                fmt::format("element {} is a sheet, or one stands on it: give the points of the deflected one",
                            element.name));
        if (!element.parts.empty())
            throw InputError({element.file, 0, f.hinge},
                             fmt::format("element {} is a union of bodies: deflect their flaps before they are joined",
                                         element.name));
        std::vector<SourcePoint> outline;
        for (std::size_t i = 0; i < element.points.size(); ++i)
            outline.push_back(
                {element.points[i], element.lines.empty() ? 0 : static_cast<std::uint32_t>(element.lines[i])});
        for (const std::size_t corner : element.given_corners) outline[corner].is_corner = true;
        outline = with_deflected_flap(outline, f, element);
        element.points.clear();
        element.lines.clear();
        element.given_corners.clear();
        for (const SourcePoint& p : outline) {
            if (p.is_corner) element.given_corners.push_back(element.points.size());
            element.points.push_back(p.at);
            element.lines.push_back(p.line);
        }
        // Only a tail that was cut has a warning with a place by now, and it turns with the flap.
        for (Warning& warning : element.warnings)
            if (warning.at && warning.at->x > f.hinge.x)
                warning.at = f.hinge + core::rotated(*warning.at - f.hinge, -core::radians(f.angle_deg));
        return fmt::format("flap deflected by {} degrees about {}", f.angle_deg, coordinates(f.hinge));
    }
};

}  // namespace

}  // namespace lamina::geometry

namespace lamina {

using namespace geometry;

Geometry transformed(Geometry geometry, std::span<const Transformation> transformations) {
    for (const Transformation& transformation : transformations) {
        validate(transformation);
        require_known_element(geometry, transformation.element, "transform");
        for (Element& e : geometry.elements)
            if (stands_for(transformation.element, e))
                e.transformations.push_back(std::visit(Change{e}, transformation.change));
    }
    return geometry;
}

}  // namespace lamina
