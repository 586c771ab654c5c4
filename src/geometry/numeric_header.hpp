// Rows of whole numbers before coordinates: the counts of a Lednicer file, or a title.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "geometry/coordinate_blocks.hpp"

namespace lamina::geometry {

/// The numbers of points that a Lednicer file announces for its surfaces.
struct SurfaceCounts {
    std::size_t upper, lower;

    std::size_t total() const { return upper + lower; }
};

/// Returns whether all rows of a run have the same number of columns, other than that of a row before them.
bool have_other_columns(PointSpan run, const RowPoint& before);

/// Returns whether a point lies outside of the box round others by more than the extent of that box.
bool lies_far_from(Point p, PointSpan points);

/// Returns the counts of a Lednicer file where the first point of `points`, all that is left of a section, can only be
/// such counts: whole numbers that either fit exactly or lie well outside the section itself. In per cent of the chord,
/// (100, 2) may be a point. Throws InputError, which names `file`, for counts of more points than follow.
std::optional<SurfaceCounts> read_counts(PointSpan points, const std::string& file);

/// Returns why the first row of a document, with which `points` begin, is no pair of coordinates and no counts of a
/// Lednicer file, but a title such as "23 012" or the number of points; nothing where it may be either.
std::optional<std::string> why_title(PointSpan points, const CoordinateDocument& document);

}  // namespace lamina::geometry
