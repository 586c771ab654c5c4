// Files that hold one half of a symmetric section.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "geometry/source_point.hpp"

namespace lamina::geometry {

/// Returns the ordinate of the line of symmetry of a run that may be one half of a symmetric section, from nose to tail
/// or back: both ends stand on it, or one of them on y = 0, and all points on one side. Empty for other runs.
std::optional<double> symmetry_line(const std::vector<SourcePoint>& points);

/// Returns whether a closed outline, whose first point is not repeated, is one half of a symmetric section that a
/// straight side closes: this side, of one edge or several, runs along x from end to end, and a round nose is square to
/// it.
bool is_closed_half(const std::vector<SourcePoint>& points);

/// Returns the outline of a symmetric section of which `points` are one half, open or closed by edges on the line of
/// symmetry. It is closed where the tail is sharp. Throws InputError, which names `file`, for other points.
std::vector<SourcePoint> mirrored_half(std::vector<SourcePoint> points, const std::string& file);

}  // namespace lamina::geometry
