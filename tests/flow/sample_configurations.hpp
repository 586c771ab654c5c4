// Configurations of several elements for tests of the flow.
#pragma once

#include <vector>

#include <lamina/geometry.hpp>
#include <lamina/point.hpp>

#include "support/shapes.hpp"

namespace lamina::test {

/// Returns a section with a flap below its trailing edge, from which it is `gap` away.
inline Geometry section_with_flap(double gap) {
    const shapes::Outline flap = shapes::moved(naca_airfoil("4412", 100).points, -0.5, 0.3, {});
    // The flap's highest point lies below the trailing edge of the main section.
    Point top = flap[0];
    for (const Point p : flap)
        if (p.y > top.y) top = p;
    return shapes::geometry({naca_airfoil("0012", 100).points, shapes::moved(flap, 0, 1, Point{1, -gap} - top)});
}

/// Returns a slat with a cove, a main element with a blunt trailing edge and a cove, and a flap, of the proportions of
/// the 30P-30N.
inline Geometry three_elements() {
    const shapes::Outline slat{{0.02, 0.018},   {-0.01, 0.012},   {-0.04, -0.005},  {-0.065, -0.035}, {-0.08, -0.07},
                               {-0.083, -0.09}, {-0.078, -0.105}, {-0.06, -0.115},  {-0.035, -0.118}, {-0.055, -0.1},
                               {-0.06, -0.075}, {-0.05, -0.045},  {-0.025, -0.012}, {0.0, 0.006}};
    shapes::Outline main_element;
    for (const Point p : shapes::section(0.13, 0.004, 60)) {
        // The lower side is cut away behind 0.72, which leaves a cove with a lip.
        const double cut = p.x > 0.72 && p.y < 0 ? 0.008 : -1;
        main_element.push_back({0.05 + 0.85 * p.x, cut > 0 ? 0.85 * (0.004 + 0.1 * (1 - p.x)) - 0.003 : 0.85 * p.y});
    }
    return shapes::geometry(
        {slat, main_element, shapes::moved(naca_airfoil("4412", 80).points, -0.55, 0.3, {0.89, -0.017})});
}

}  // namespace lamina::test
