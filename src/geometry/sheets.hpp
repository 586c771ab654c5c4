// Bodies without thickness (Sheet). An outline runs along a sheet to its tip and back, and both sides are a tiny gap
// apart, so that later stages see a simple polygon with a sharp corner at the tip.
//
//     free:    begin =================== tip        standing:   ______  ______   wall
//                                                                     ||
//                                                              begin  ||  end
//                                                                    tip
//
// Source: docs/decisions/0081.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include <lamina/export.hpp>
#include <lamina/geometry.hpp>

namespace lamina::geometry {

/// Coordinates are typed with few digits: ends of sheets and lines stand on what is nearer than this share of its
/// length, of the body for sheets, and of the end's edge for lines at borders of the domain.
inline constexpr double typed_rounding = 1e-3;

/// Returns the sheet that a text NAME:PLACE of the option means, and its text.
Sheet parse_sheet(const std::string& text);
std::string sheet_text(const Sheet& sheet);

/// Throws OptionError for sheets without a legal name of their own, or without length, and for those that are closed,
/// cross themselves or run back on themselves.
void validate_sheets(std::span<const Sheet> sheets);

/// Returns a sheet as an element whose points are its curve, open, for transformations; is_open_sheet() knows it.
Element open_sheet(const Sheet& sheet);
bool is_open_sheet(const Element& element);

/// Puts open sheets among bodies: each is an element of its own, or a part of the outline of the body that it stands
/// on. Throws InputError for those that cross or join bodies, or other sheets.
Geometry with_sheets(Geometry bodies, std::span<const Element> sheets);

/// Returns whether an element is a sheet by itself.
bool is_sheet(const Element& element);

/// Returns the distance of both sides of a sheet with this curve.
LAMINA_EXPORT double sheet_gap(std::span<const Point> curve);

/// The vertices of a sheet in an outline: from `first` to `tip` and on to `last`, counted on beyond the number of
/// points.
struct SheetRange {
    std::size_t first, tip, last;

    /// Returns the number of the edge on the other side of an edge of an outline with n points.
    std::size_t across(std::size_t edge, std::size_t n) const { return (first + last - 1 + n - edge % n) % n; }
};
LAMINA_EXPORT std::vector<SheetRange> sheet_ranges(const Element& element);

/// The origin of a vertex of an outline: a vertex of an earlier outline, or the one across from it on the sheet.
struct FoldedVertex {
    std::size_t from;
    bool is_across = false;
};

/// Makes both sides of all sheets of an element alike again, whose vertices have been chosen anew: like the side that
/// has more of them, or like the first one. Returns where the vertices come from. Lines and corners follow.
LAMINA_EXPORT std::vector<FoldedVertex> fold_again(Element& element);

/// Returns the bodies as the flow before the mesh sees them: sheets are thin sections, and those on walls are left out.
LAMINA_EXPORT Geometry with_thickness(Geometry geometry);

}  // namespace lamina::geometry
