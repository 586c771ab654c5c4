// Changes of the place and shape of elements between reading and meshing: sections that come in other units, flaps to
// be deflected, sections for flow from the right.
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

/// Turns an element about a centre. Turns by multiples of 90 degrees are exact but for the rounding of differences.
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
/// the hinge. Where the parts move away from each other, an arc about the hinge joins them, tangent to both; where they
/// overlap, they are cut off at their crossing, which becomes a corner.
/// Source: the flaps of M. Drela's XFOIL (1989).
struct FlapDeflection {
    double angle_deg = 0;  ///< positive clockwise, which moves the trailing edge down; from -90 to 90
    Point hinge{};         ///< the point that the rear turns about
};

/// The name that stands for all elements in a transformation.
inline constexpr const char* every_element = "all";

/// A change of one element, or of all.
struct Transformation {
    std::string element;  ///< name of the element, also as it was given, or every_element
    std::variant<Scaling, Rotation, Shift, Mirroring, FlapDeflection> change;  ///< what happens to it
};

/// Throws OptionError where a number is not finite or not in the range that its struct names.
LAMINA_EXPORT void validate(const Transformation& transformation);

/// Reads "ELEMENT:scale:S[:X,Y]", "ELEMENT:rotate:DEG[:X,Y]", "ELEMENT:shift:DX,DY", "ELEMENT:mirror[:Y]" or
/// "ELEMENT:flap:DEG:X,Y". Centres are the origin and lines y = 0 unless the text says otherwise. Throws UsageError with
/// the bare reason.
LAMINA_EXPORT Transformation parse_transformation(const std::string& text);
/// Returns the text that parse_transformation() reads back.
LAMINA_EXPORT std::string transformation_text(const Transformation& transformation);

/// Returns the geometry with its elements changed, in the order of the transformations. Outlines stay counter-clockwise
/// and keep their first points; that of a section with a flap begins at the rearmost vertex. Each change is noted in
/// Element::transformations. Does not check that the result is simple: check_simple() does. Throws OptionError for
/// numbers out of range, names that no element has, and every_element where one of several has that name. Throws
/// InputError where a flap cannot be deflected: a surface is nearest to the hinge at the nose or the tail, or its parts
/// overlap as a whole. Precondition: the outlines are simple and counter-clockwise.
LAMINA_EXPORT Geometry transformed(Geometry geometry, std::span<const Transformation> transformations);

}  // namespace lamina
