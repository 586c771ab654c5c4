#include "geometry/drawings/plane.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include <lamina/error.hpp>

namespace lamina::geometry {

namespace {

/// A plane is as thick as this share of the drawing.
constexpr double thickness_share = 1e-6;

using Coordinates = std::array<double, 3>;
Coordinates coordinates_of(Point3 p) { return {p.x, p.y, p.z}; }

/// The coordinates of the plane in the order in which planes are looked for: of planes z = C, x and y.
struct Axes {
    std::size_t across, first, second;
};
constexpr std::array<Axes, 3> all_axes{{{2, 0, 1}, {1, 0, 2}, {0, 1, 2}}};
constexpr std::array<const char*, 3> names{"x", "y", "z"};

/// The box round the control points of curves, and its longest side.
struct Box3 {
    Coordinates lower{HUGE_VAL, HUGE_VAL, HUGE_VAL}, upper{-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};

    void include(Point3 p) {
        const Coordinates c = coordinates_of(p);
        for (std::size_t i = 0; i < 3; ++i) {
            lower[i] = std::min(lower[i], c[i]);
            upper[i] = std::max(upper[i], c[i]);
        }
    }
    double side(std::size_t axis) const { return upper[axis] - lower[axis]; }
    double longest() const { return std::max({side(0), side(1), side(2)}); }
};

Box3 box_of(const SpaceCurve& curve) {
    Box3 box;
    for (const Point3& p : curve.control) box.include(p);
    return box;
}

/// Curves that lie in one plane.
struct Plane {
    Axes axes{};
    double at = 0;
    std::vector<std::size_t> curves;
    double length = 0;  ///< of the polygons of their control points
};

double length_of(const SpaceCurve& curve) {
    double sum = 0;
    for (std::size_t i = 1; i < curve.control.size(); ++i) sum += length(curve.control[i] - curve.control[i - 1]);
    return sum;
}

/// Returns the planes across an axis that hold curves, by ascending coordinate. Straight lines along one axis lie in
/// planes of both others, and count where there are curves that do not.
std::vector<Plane> planes_across(const Axes& axes, const std::vector<DrawnCurve>& curves,
                                 const std::vector<Box3>& boxes, double thickness) {
    std::vector<std::size_t> flat;
    for (std::size_t i = 0; i < curves.size(); ++i)
        if (boxes[i].side(axes.across) <= thickness) flat.push_back(i);
    std::stable_sort(flat.begin(), flat.end(), [&](std::size_t a, std::size_t b) {
        return boxes[a].lower[axes.across] < boxes[b].lower[axes.across];
    });
    std::vector<Plane> planes;
    for (const std::size_t i : flat) {
        const double at = boxes[i].lower[axes.across];
        if (planes.empty() || at - planes.back().at > thickness) planes.push_back({axes, at, {}, 0});
        planes.back().curves.push_back(i);
        planes.back().length += length_of(curves[i].curve);
    }
    for (Plane& plane : planes) std::sort(plane.curves.begin(), plane.curves.end());
    return planes;
}

/// Returns whether the curves of a plane are all along one line.
bool is_line(const Plane& plane, const std::vector<Box3>& boxes, double thickness) {
    Box3 box;
    for (const std::size_t i : plane.curves) {
        box.include({boxes[i].lower[0], boxes[i].lower[1], boxes[i].lower[2]});
        box.include({boxes[i].upper[0], boxes[i].upper[1], boxes[i].upper[2]});
    }
    return box.side(plane.axes.first) <= thickness || box.side(plane.axes.second) <= thickness;
}

PlaneCurve flattened(SpaceCurve curve, const Axes& axes) {
    PlaneCurve flat;
    flat.degree = curve.degree;
    flat.knots = std::move(curve.knots);
    flat.weights = std::move(curve.weights);
    flat.first = curve.first;
    flat.last = curve.last;
    flat.control.reserve(curve.control.size());
    for (const Point3& p : curve.control) {
        const Coordinates c = coordinates_of(p);
        flat.control.push_back({c[axes.first], c[axes.second]});
    }
    return flat;
}

}  // namespace

std::vector<FlatCurve> in_plane(Drawing drawing, const std::string& file, std::vector<std::string>& notes) {
    std::vector<DrawnCurve>& curves = drawing.curves;
    std::vector<Box3> boxes;
    Box3 all;
    for (const DrawnCurve& drawn : curves) {
        boxes.push_back(box_of(drawn.curve));
        for (const Point3& p : drawn.curve.control) all.include(p);
    }
    const double thickness = thickness_share * all.longest();
    std::optional<Plane> best;
    for (const Axes& axes : all_axes)
        for (Plane& plane : planes_across(axes, curves, boxes, thickness))
            if (!is_line(plane, boxes, thickness) && (!best || plane.length > (1 + thickness_share) * best->length))
                best = std::move(plane);
    if (!best)
        throw InputError({file, curves.front().line, {}},
                         "the curves lie in no plane x = C, y = C or z = C that holds an outline");
    const Axes axes = best->axes;
    if (axes.across != 2 || best->curves.size() < curves.size())
        notes.push_back(
            fmt::format("the plane {} = {:.6g}, with {} and {} as coordinates{}", names[axes.across], best->at,
                        names[axes.first], names[axes.second],
                        best->curves.size() < curves.size()
                            ? fmt::format("; {} curves off it left out", curves.size() - best->curves.size())
                            : ""));
    std::vector<FlatCurve> flat;
    flat.reserve(best->curves.size());
    for (const std::size_t i : best->curves)
        flat.push_back({flattened(std::move(curves[i].curve), axes), curves[i].line, std::move(curves[i].layer)});
    return flat;
}

}  // namespace lamina::geometry
