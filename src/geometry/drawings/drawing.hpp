// Drawings: DXF, SVG, IGES and STEP as lists of curves, which nothing has joined or sampled yet.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "geometry/drawings/curve.hpp"

namespace lamina::geometry {

/// A curve of a drawing.
struct DrawnCurve {
    SpaceCurve curve;  ///< without defects
    std::uint32_t line = 0;
    std::string layer;  ///< or the name of a group; empty: none
};

/// The curves of a drawing, and how many entities of other kinds were left out.
struct Drawing {
    std::vector<DrawnCurve> curves;
    std::string unit;                             ///< of length, such as "mm"; empty: it names none
    std::map<std::string, std::size_t> left_out;  ///< kinds of entities that are no curves, and how many there are
    std::size_t control_points = 0;               ///< of all curves
};

/// The readers of texts whose format is known. Each throws InputError, with the line, for damaged numbers and for
/// curves that are defined by nothing. What a drawing declares allocates nothing: lists grow as their entries are read.
Drawing read_dxf(std::string_view text, const std::string& file);
Drawing read_svg(std::string_view text, const std::string& file);
Drawing read_iges(std::string_view text, const std::string& file);
Drawing read_step(std::string_view text, const std::string& file);

/// The largest numbers of curves and control points of a drawing. Blocks that are inserted again and again reach them.
inline constexpr std::size_t max_drawn_curves = 1'000'000, max_control_points = 4'000'000;

/// Returns whether a curve without defects is a point, which the drawing then counts as left out: as in a file that has
/// nothing but the names of shapes, so that it takes no more memory than they do.
bool leave_out_point(Drawing& drawing, const SpaceCurve& curve);

/// Adds a curve to a drawing, unless it is a point. Throws InputError where it has a defect, which names `what` it is,
/// or where a drawing has too many curves.
void add_curve(Drawing& drawing, DrawnCurve curve, const std::string& what, const std::string& file);

/// Returns the number of a text in a drawing, with an exponent of either letter. Throws InputError.
double drawn_number(std::string_view text, const std::string& file, std::uint32_t line);

/// Returns a number that counts something or names an entity. Throws InputError.
std::size_t drawn_count(std::string_view text, const std::string& file, std::uint32_t line);

}  // namespace lamina::geometry
