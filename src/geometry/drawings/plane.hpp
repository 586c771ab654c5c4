// The plane of a drawing: outlines lie in a plane of two axes.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "geometry/drawings/drawing.hpp"

namespace lamina::geometry {

/// A curve of the plane of the outlines.
struct FlatCurve {
    PlaneCurve curve;
    std::uint32_t line = 0;
    std::string layer;
};

/// A plane of two axes that holds curves of a drawing.
struct DrawnPlane {
    std::size_t across = 2;           ///< the number of the axis whose coordinate is constant
    double at = 0;                    ///< that coordinate
    std::vector<std::size_t> curves;  ///< numbers of those that lie in it, ascending
};

/// Returns the planes z = C, whose coordinates are x and y, y = C, with x and z, and x = C, with y and z, that may hold
/// outlines: first the one with the longest curves that are not straight, as at the ends of a wing, then the longest
/// straight ones; of equal ones that of the least C. At most eight. Throws InputError where there is none.
std::vector<DrawnPlane> planes_of(const Drawing& drawing, const std::string& file);

/// Returns the curves of a plane, in its coordinates.
std::vector<FlatCurve> curves_in(const DrawnPlane& plane, const Drawing& drawing);

/// Returns what users should know of the choice of a plane.
std::vector<std::string> notes_on(const DrawnPlane& plane, const Drawing& drawing);

}  // namespace lamina::geometry
