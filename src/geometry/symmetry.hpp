// Bodies that a line of symmetry cuts.
#pragma once

#include <algorithm>

#include <lamina/export.hpp>
#include <lamina/geometry.hpp>

namespace lamina::geometry {

/// Returns the image of a point in the line of symmetry at this y.
inline Point image_of(Point p, double y) { return {p.x, 2 * y - p.y}; }

/// Returns whether a line of symmetry cuts a body.
inline bool is_cut(const Geometry& geometry) {
    return std::any_of(geometry.elements.begin(), geometry.elements.end(),
                       [](const Element& element) { return element.is_mirrored; });
}

/// Returns the bodies that a line of symmetry cuts with all others and, behind these, the images of the others: what
/// the flow meets. Elements are in their order and names end in "_image". The geometry itself where the line cuts no
/// body.
LAMINA_EXPORT Geometry with_images(Geometry geometry);

/// Makes the lower parts of mirrored elements (Element::is_mirrored), whose vertices have been chosen anew, images of
/// the upper ones again, with vertices on the line exactly. Their corners follow; no other features are set.
LAMINA_EXPORT void mirror_again(Geometry& geometry);

}  // namespace lamina::geometry
