#include "geometry/symmetry.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/bounding_box.hpp"
#include "geometry/sheets.hpp"
#include "geometry/unite.hpp"

namespace lamina::geometry {

namespace {

/// A point of the upper part of an outline, from the line of symmetry to it.
struct PartPoint {
    Point at;
    std::size_t line = 0;    ///< Element::lines
    bool is_corner = false;  ///< one of OutlineFeatures::corners
    bool is_given = false;   ///< one of Element::given_corners
    std::size_t part = 0;    ///< index of the one of Element::parts that the edge behind it belongs to
};

using Part = std::vector<PartPoint>;

/// Returns the points of an outline. Those that stand on the line but for rounding are put there.
Part points_of(const Element& element, double y) {
    constexpr double rounding = 1e-9;  // of the extent
    const double near = rounding * core::longer_side(core::bounding_box(element.points));
    const std::vector<std::size_t> parts = parts_of_edges(element);
    Part points;
    for (std::size_t i = 0; i < element.points.size(); ++i) {
        PartPoint p{element.points[i], i < element.lines.size() ? element.lines[i] : 0, false, false, parts[i]};
        if (std::abs(p.at.y - y) <= near) p.at.y = y;
        points.push_back(p);
    }
    for (const std::size_t i : element.features.corners) points[i].is_corner = true;
    for (const std::size_t i : element.given_corners) points[i].is_given = true;
    return points;
}

/// Puts vertices on the line that stand beside it, between one above and one below.
void snap(Part& points, double y) {
    const std::size_t n = points.size();
    for (std::size_t i = 0; i < n; ++i) {
        const Point before = points[(i + n - 1) % n].at, after = points[(i + 1) % n].at;
        const double height = points[i].at.y - y, other = (before.y - y) * (after.y - y);
        if (other < 0 && std::abs(height) < 0.25 * std::min(std::abs(before.y - y), std::abs(after.y - y)))
            points[i].at.y = y;
    }
}

/// Returns where an edge crosses the line; the same from both of its ends.
Point crossing(Point a, Point b, double y) {
    if (a.y > b.y) std::swap(a, b);
    return {a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x), y};
}

/// Returns the parts of an outline above the line, each with its ends on it.
std::vector<Part> parts_above(const Part& points, double y) {
    const std::size_t n = points.size();
    std::vector<Part> parts;
    for (std::size_t i = 0; i < n; ++i) {
        const PartPoint &from = points[i], &first = points[(i + 1) % n];
        if (from.at.y > y || !(first.at.y > y)) continue;
        const auto end = [&](const PartPoint& below, const PartPoint& above) {
            return below.at.y == y ? below : PartPoint{crossing(below.at, above.at, y)};
        };
        Part part{end(from, first)};
        part.front().part = from.part;
        std::size_t k = i + 1;
        for (; points[k % n].at.y > y; ++k) part.push_back(points[k % n]);
        part.push_back(end(points[k % n], points[(k - 1) % n]));
        parts.push_back(std::move(part));
    }
    return parts;
}

/// Gives an element the outline of a part and of its image below.
void set_outline(Element& element, const Part& part, double y) {
    element.points.clear();
    element.lines.clear();
    element.features = {};
    element.given_corners.clear();
    const std::vector<WallPart> parts = std::exchange(element.parts, {});
    const auto begin_part = [&](std::size_t index, Point at) {
        if (!parts.empty() && (element.parts.empty() || element.parts.back().name != parts[index].name))
            element.parts.push_back({parts[index].name, at});
    };
    const auto add = [&](const PartPoint& p, bool is_image) {
        if (p.is_corner) element.features.corners.push_back(element.points.size());
        if (p.is_given) element.given_corners.push_back(element.points.size());
        element.points.push_back(is_image ? image_of(p.at, y) : p.at);
        element.lines.push_back(p.line);
    };
    for (std::size_t i = 0; i < part.size(); ++i) {
        if (i + 1 < part.size()) begin_part(part[i].part, part[i].at);
        add(part[i], false);
    }
    for (std::size_t i = part.size() - 1; i-- > 1;) {
        begin_part(part[i].part, element.points.back());
        add(part[i], true);
    }
    if (part.size() > 1) begin_part(part.front().part, element.points.back());
    element.is_mirrored = true;
}

[[noreturn]] void refuse(const Element& element, Point at, const std::string& reason) {
    throw InputError({element.file, 0, at}, fmt::format("element {} {}", element.name, reason));
}

/// Throws InputError for a part that is no body on the line.
void require_body(const Element& element, const Part& part, double y) {
    const Point first = part.front().at, last = part.back().at;
    if (first.x < last.x)
        refuse(
            element, first,
            fmt::format("encloses a part of the flow with the line of symmetry, from x = {} to {}: close that part of "
                        "the outline, or move the line y = {}",
                        first.x, last.x, y));
    if (first.x == last.x)
        refuse(
            element, first,
            fmt::format("touches the line of symmetry at a single point, ({}, {}): raise the body, or lower it so that "
                        "the line cuts it",
                        first.x, y));
}

/// Throws InputError for sheets of an element that are not above the line.
void require_sheets_above(const Element& element, double y) {
    const std::size_t n = element.points.size();
    for (const SheetRange& range : sheet_ranges(element))
        for (std::size_t i = range.first; i <= range.last; ++i)
            if (const Point p = element.points[i % n]; !(p.y > y))
                refuse(element, p,
                       "has a sheet that the line of symmetry meets: end it above, or give the whole configuration "
                       "without the line");
}

/// Returns the sheets on a part of an outline, and their images.
std::vector<SheetSides> sheets_on(const Part& part, std::span<const SheetSides> sheets, double y) {
    std::vector<SheetSides> result;
    for (const SheetSides& sheet : sheets)
        if (std::any_of(part.begin(), part.end(), [&](const PartPoint& p) { return p.at == sheet.tip; }))
            result.push_back(sheet);
    for (std::size_t k = result.size(); k-- > 0;) {
        const SheetSides& above = result[k];
        result.push_back({above.name, image_of(above.end, y), image_of(above.tip, y), image_of(above.begin, y)});
    }
    return result;
}

/// Adds what is above the line of an element.
void add_above(const Element& element, double y, std::vector<Element>& result) {
    const Part points = points_of(element, y);
    const auto is_above = [&](const PartPoint& p) { return p.at.y > y; };
    if (std::all_of(points.begin(), points.end(), is_above)) {
        result.push_back(element);
        return;
    }
    require_sheets_above(element, y);
    const std::vector<Part> parts = parts_above(points, y);
    if (parts.empty())
        refuse(element, element.points.front(),
               fmt::format("lies below the line of symmetry y = {}, and what is above is kept: remove it, or turn the "
                           "configuration upside down",
                           y));
    for (std::size_t k = 0; k < parts.size(); ++k) {
        require_body(element, parts[k], y);
        Element& part = result.emplace_back(element);
        set_outline(part, parts[k], y);
        part.sheets = sheets_on(parts[k], element.sheets, y);
        if (k == 0) continue;
        part.name += fmt::format("_{}", k + 1);
        for (WallPart& wall : part.parts) wall.name += fmt::format("_{}", k + 1);
    }
}

/// Puts a vertex on the line in place of one above that is the end of an edge across it. The outline there is a
/// parabola through the next two points and their images, unless there is a corner between.
Point end_between(const PartPoint& first, const PartPoint& second, double y) {
    const double a = (first.at.y - y) * (first.at.y - y), b = (second.at.y - y) * (second.at.y - y);
    if (first.is_corner || !(b > a)) return {first.at.x, y};
    return {first.at.x - (second.at.x - first.at.x) * a / (b - a), y};
}

}  // namespace

Geometry with_images(Geometry geometry) {
    if (!is_cut(geometry)) return geometry;
    Geometry images = geometry;
    std::erase_if(images.elements, [](const Element& element) { return element.is_mirrored; });
    for (Element& image : images.elements) image.name += "_image";
    images = transformed(std::move(images), std::vector{Transformation{"all", Mirroring{*geometry.symmetry}}});
    geometry.elements.insert(geometry.elements.end(), images.elements.begin(), images.elements.end());
    return geometry;
}

void mirror_again(Geometry& geometry) {
    const double y = geometry.symmetry.value_or(0);
    for (Element& element : geometry.elements) {
        if (!element.is_mirrored) continue;
        Part points = points_of(element, y);
        snap(points, y);
        std::vector<Part> parts = parts_above(points, y);
        const auto longest = std::max_element(parts.begin(), parts.end(),
                                              [](const Part& a, const Part& b) { return a.size() < b.size(); });
        if (longest == parts.end() || longest->size() < 3)
            refuse(element, element.points.front(), "is too thin at the line of symmetry: raise it, or move the line");
        Part& part = *longest;
        const auto is_vertex = [&](const PartPoint& end) {
            return std::any_of(points.begin(), points.end(), [&](const PartPoint& p) { return p.at == end.at; });
        };
        if (!is_vertex(part.front())) part.front() = {end_between(part[1], part[2], y)};
        if (!is_vertex(part.back())) part.back() = {end_between(part[part.size() - 2], part[part.size() - 3], y)};
        set_outline(element, part, y);
    }
}

}  // namespace lamina::geometry

namespace lamina {

Geometry cut_at_symmetry(Geometry geometry, double y) {
    std::vector<Element> above;
    for (const Element& element : geometry.elements) geometry::add_above(element, y, above);
    geometry.elements = std::move(above);
    geometry.symmetry = y;
    check_simple(geometry);
    return geometry;
}

}  // namespace lamina
