// Bodies that a line of symmetry cuts.
#pragma once

#include <lamina/export.hpp>
#include <lamina/geometry.hpp>

namespace lamina::geometry {

/// Makes the lower parts of mirrored elements (Element::is_mirrored), whose vertices have been chosen anew, images of the
/// upper ones again, with vertices on the line exactly. Their corners follow; no other features are set.
LAMINA_EXPORT void mirror_again(Geometry& geometry);

}  // namespace lamina::geometry
