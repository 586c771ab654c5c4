#include "geometry/drawings/plane.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include <lamina/error.hpp>

#include "core/text.hpp"

namespace lamina::geometry {

namespace {

/// A plane is as thick as this share of the drawing.
constexpr double thickness_share = 1e-6;

using Coordinates = std::array<double, 3>;
Coordinates coordinates_of(Point3 p) { return {p.x, p.y, p.z}; }

/// The axes of a plane.
struct Axes {
    std::size_t first, second;
};
Axes axes_of(std::size_t across) { return {across == 0 ? 1u : 0u, across == 2 ? 1u : 2u}; }

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

/// A plane with the lengths of the polygons of its control points.
struct MeasuredPlane {
    DrawnPlane plane;
    double curved = 0, length = 0;
};

double length_of(const SpaceCurve& curve) {
    double sum = 0;
    for (std::size_t i = 1; i < curve.control.size(); ++i) sum += length(curve.control[i] - curve.control[i - 1]);
    return sum;
}

/// Returns the planes across an axis that hold curves, by ascending coordinate.
std::vector<MeasuredPlane> planes_across(std::size_t axis, const std::vector<DrawnCurve>& curves,
                                         const std::vector<Box3>& boxes, double thickness) {
    std::vector<std::size_t> flat;
    for (std::size_t i = 0; i < curves.size(); ++i)
        if (boxes[i].side(axis) <= thickness) flat.push_back(i);
    std::stable_sort(flat.begin(), flat.end(),
                     [&](std::size_t a, std::size_t b) { return boxes[a].lower[axis] < boxes[b].lower[axis]; });
    std::vector<MeasuredPlane> planes;
    for (const std::size_t i : flat) {
        const double at = boxes[i].lower[axis];
        if (planes.empty() || at - planes.back().plane.at > thickness) planes.push_back({{axis, at, {}}, 0, 0});
        MeasuredPlane& plane = planes.back();
        plane.plane.curves.push_back(i);
        plane.length += length_of(curves[i].curve);
        if (!curves[i].curve.is_straight()) plane.curved += length_of(curves[i].curve);
    }
    for (MeasuredPlane& plane : planes) std::sort(plane.plane.curves.begin(), plane.plane.curves.end());
    return planes;
}

/// Returns whether the curves of a plane are all along one line.
bool is_line(const DrawnPlane& plane, const std::vector<Box3>& boxes, double thickness) {
    Box3 box;
    for (const std::size_t i : plane.curves) {
        box.include({boxes[i].lower[0], boxes[i].lower[1], boxes[i].lower[2]});
        box.include({boxes[i].upper[0], boxes[i].upper[1], boxes[i].upper[2]});
    }
    const Axes axes = axes_of(plane.across);
    return box.side(axes.first) <= thickness || box.side(axes.second) <= thickness;
}

PlaneCurve flattened(const SpaceCurve& curve, const Axes& axes) {
    PlaneCurve flat{curve.degree, curve.knots, {}, curve.weights, curve.first, curve.last};
    flat.control.reserve(curve.control.size());
    for (const Point3& p : curve.control) {
        const Coordinates c = coordinates_of(p);
        flat.control.push_back({c[axes.first], c[axes.second]});
    }
    return flat;
}

}  // namespace

std::vector<DrawnPlane> planes_of(const Drawing& drawing, const std::string& file) {
    constexpr std::size_t most = 8;
    const std::vector<DrawnCurve>& curves = drawing.curves;
    std::vector<Box3> boxes;
    Box3 all;
    for (const DrawnCurve& drawn : curves) {
        boxes.push_back(box_of(drawn.curve));
        for (const Point3& p : drawn.curve.control) all.include(p);
    }
    const double thickness = thickness_share * all.longest();
    std::vector<MeasuredPlane> planes;
    for (const std::size_t axis : {2, 1, 0})
        for (MeasuredPlane& plane : planes_across(axis, curves, boxes, thickness))
            if (!is_line(plane.plane, boxes, thickness)) planes.push_back(std::move(plane));
    // Lengths that differ by rounding are equal.
    const auto rounded = [&](double length) { return std::floor(length / (1e3 * thickness) + 0.5); };
    std::stable_sort(planes.begin(), planes.end(), [&](const MeasuredPlane& a, const MeasuredPlane& b) {
        return std::pair(rounded(a.curved), rounded(a.length)) > std::pair(rounded(b.curved), rounded(b.length));
    });
    if (planes.empty())
        throw InputError({file, curves.front().line, {}},
                         "the curves lie in no plane x = C, y = C or z = C that holds an outline");
    std::vector<DrawnPlane> result;
    for (std::size_t i = 0; i < std::min(most, planes.size()); ++i) result.push_back(std::move(planes[i].plane));
    return result;
}

std::vector<FlatCurve> curves_in(const DrawnPlane& plane, const Drawing& drawing) {
    std::vector<FlatCurve> flat;
    flat.reserve(plane.curves.size());
    for (const std::size_t i : plane.curves) {
        const DrawnCurve& drawn = drawing.curves[i];
        flat.push_back({flattened(drawn.curve, axes_of(plane.across)), drawn.line, drawn.layer});
    }
    return flat;
}

std::vector<std::string> notes_on(const DrawnPlane& plane, const Drawing& drawing) {
    constexpr std::array<const char*, 3> names{"x", "y", "z"};
    const std::size_t off = drawing.curves.size() - plane.curves.size();
    const Axes axes = axes_of(plane.across);
    if (plane.across == 2 && off == 0) return {};
    return {fmt::format("the plane {} = {:.6g}, with {} and {} as coordinates; {} off it left out", names[plane.across],
                        plane.at, names[axes.first], names[axes.second], core::counted(off, "curve"))};
}

}  // namespace lamina::geometry
