// Measures of one element.
#pragma once

#include <cstddef>

#include <lamina/geometry.hpp>
#include <lamina/point.hpp>

namespace lamina::surface {

/// Facts about one element (`lamina info`).
struct ElementSummary {
    Box box;                           ///< the box round the element
    double chord = 0;                  ///< extent in x
    double area = 0;                   ///< area of the body
    double perimeter = 0;              ///< length of the outline
    double min_spacing = 0;            ///< length of the shortest edge
    double max_spacing = 0;            ///< length of the longest edge
    double max_spacing_ratio = 0;      ///< largest ratio of the lengths of neighbouring edges
    double max_turning_deg = 0;        ///< largest exterior angle
    Point max_turning_at;              ///< a vertex with that angle
    std::size_t sharp_corners = 0;     ///< number of convex vertices that turn by more than sharp_corner_deg
    Point trailing_edge;               ///< as in OutlineFeatures
    bool blunt_trailing_edge = false;  ///< whether the trailing edge is a base with two corners
};

/// Measures an element.
ElementSummary summarize(const Element& element);

}  // namespace lamina::surface
