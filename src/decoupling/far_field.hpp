// The far field round a configuration, and boxes inside it, for the rings of the decoupling.
#pragma once

#include <cmath>
#include <optional>
#include <vector>

#include <lamina/decoupling.hpp>
#include <lamina/export.hpp>
#include <lamina/point.hpp>

namespace lamina::decoupling {

/// The far field round a configuration, in units of the input.
struct FarField {
    FarFieldShape shape = FarFieldShape::box;  ///< which of the other members count
    Point center;                              ///< middle of the configuration
    double radius = 0;                         ///< half-width of the box or radius of the circle
    std::vector<Point> outline{};              ///< corners of the polygon
    double floor = -HUGE_VAL;                  ///< y of the wall below: ground, or the floor of a tunnel
    double ceiling = HUGE_VAL;                 ///< y of the wall above: the ceiling of a tunnel
    bool is_half = false;                      ///< whether the floor is a line of symmetry, on which bodies may stand

    double pitch = 0;  ///< of a row of blades, between whose copies the domain ends; 0: there is none

    /// Returns whether there is a wall below, and perhaps one above, or whether the domain is a part of a row. The
    /// border of the domain then is the last one of those between which the decoupling cuts: layers may stand on it.
    bool has_walls() const { return std::isfinite(floor) || pitch > 0; }
    /// Returns the box round the far field.
    LAMINA_EXPORT Box box() const;
};

/// Places the far field round the box of all bodies; `chord` is the reference chord. Throws OptionError where an option
/// is out of range, where an outline does not enclose the middle of that box, and where a tunnel does not enclose it.
LAMINA_EXPORT FarField place_far_field(const Box& bodies, double chord, const FarFieldOptions& options = {});

/// Returns the outermost box of the rings: the far field itself where it is a box, otherwise a square about the centre
/// of 0.8 times the size of the largest one that fits in.
Box inscribed_box(const FarField& far_field);

/// Returns whether the far field encloses the bodies at a distance of a hundredth of their extent, but for walls, which
/// may be as near as bodies are to each other.
LAMINA_EXPORT bool leaves_room(const FarField& far_field, const Box& bodies);

/// Returns the near-body box, which stands half the extent of `bodies` away from them, inside the outermost box.
/// Returns nothing where the far field leaves little room, because rings between boxes so near to each other would have
/// sharp corners. Throws OptionError unless leaves_room().
std::optional<Box> near_body_box(const Box& bodies, const Box& outermost, const FarField& far_field);

}  // namespace lamina::decoupling
