// Points with the lines of the file that hold them.
#pragma once

#include <cstdint>
#include <string>

#include <lamina/point.hpp>

#include "core/bounding_box.hpp"

namespace lamina::geometry {

struct SourcePoint {
    Point at;
    std::uint32_t line = 0;  ///< counts from 1; 0: not in the file
    bool is_corner = false;  ///< whether it is one of Element::given_corners
};

/// Returns the longer side of the box round points, which are SourcePoints or derived from them; 0 without points.
template <class Points>
double extent(const Points& points) {
    Box box;
    for (const SourcePoint& p : points) box.include(p.at);
    return points.empty() ? 0 : core::longer_side(box);
}

/// Returns a point as text, "(0.5, 0.1)", with enough digits to find it in the file; -0 reads 0.
std::string coordinates(Point p);

}  // namespace lamina::geometry
