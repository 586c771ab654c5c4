// Changes of the place and shape of elements between reading and meshing: other units, flaps, flow from the right.
//
// Guarantees:
//  1. Outlines stay counter-clockwise and keep their first points, but with a flap, where they begin at the rearmost
//     vertex. Each change is noted in Element::transformations.
//  2. Turns by multiples of 90 degrees are exact but for the rounding of differences.
// Limits:
//  1. The outlines given are simple and counter-clockwise; the result need not be simple: check_simple() finds out.
// Example:
//     const Transformation quarter = parse_transformation("all:rotate:90");
//     const Geometry upright = transformed({{naca_airfoil("0012", 20)}}, std::vector{quarter});
//     assert(bounding_box(upright).height() == 1 && transformation_text(quarter) == "all:rotate:90:0,0");
#pragma once

#include <span>
#include <string>
#include <variant>

#include <lamina/export.hpp>
#include <lamina/point.hpp>

namespace lamina {

struct Geometry;

/// Multiplies the distances from a centre by a factor.
struct Scaling {
    double factor = 1;  ///< > 0
    Point center{};     ///< the point that stays
};

/// Turns an element about a centre.
struct Rotation {
    double angle_deg = 0;  ///< positive counter-clockwise, from -360 to 360
    Point center{};        ///< the point that stays
};

/// Moves an element.
struct Shift {
    Point by{};  ///< what is added to all coordinates
};

/// Mirrors an element in a horizontal line, which turns a section upside down.
struct Mirroring {
    double y = 0;  ///< where the line lies
};

/// Deflects the rear of a section as a plain flap without a gap. Both surfaces are parted at their points nearest to
/// the hinge. Parts that move away from each other are joined by an arc about the hinge, tangent to both; parts that
/// overlap are cut off at their crossing, which becomes a corner. Source: the flaps of M. Drela's XFOIL (1989).
struct FlapDeflection {
    double angle_deg = 0;  ///< positive clockwise, which moves the trailing edge down; from -90 to 90
    Point hinge{};         ///< the point that the rear turns about
};

/// A change of one element, or of all.
struct Transformation {
    std::string element;  ///< name of the element, also as it was given, or "all"
    std::variant<Scaling, Rotation, Shift, Mirroring, FlapDeflection> change;  ///< what happens to it
};

/// Throws OptionError where a number is not finite or not in the range that its struct names.
LAMINA_EXPORT void validate(const Transformation& transformation);
/// Reads "ELEMENT:scale:S[:X,Y]", "ELEMENT:rotate:DEG[:X,Y]", "ELEMENT:shift:DX,DY", "ELEMENT:mirror[:Y]" or
/// "ELEMENT:flap:DEG:X,Y". Throws UsageError with the bare reason.
LAMINA_EXPORT Transformation parse_transformation(const std::string& text);
/// Returns the text that parse_transformation() reads back.
LAMINA_EXPORT std::string transformation_text(const Transformation& transformation);
/// Returns the geometry with its elements changed, in the order of the transformations. Throws OptionError for numbers
/// out of range, names that no element has, and "all" where one of several has that name; InputError where a flap
/// cannot be deflected: a surface is nearest to the hinge at the nose or the tail, or its parts overlap as a whole.
LAMINA_EXPORT Geometry transformed(Geometry geometry, std::span<const Transformation> transformations);

}  // namespace lamina
