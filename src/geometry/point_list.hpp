// Points in the text of an option: a list of coordinates, or a file of them.
#pragma once

#include <span>
#include <string>
#include <vector>

#include <lamina/export.hpp>
#include <lamina/point.hpp>

namespace lamina::geometry {

/// The points that a text stands for.
struct PointList {
    std::vector<Point> points;
    std::string file{};  ///< that they come from; empty where the text itself holds them
};

/// Returns the points of X0,Y0,X1,Y1[,...], two at least, or of a file with the two coordinates of one in each line, in
/// which empty lines, comments and titles do not count. Throws UsageError for other lists, InputError and IoError for
/// files.
LAMINA_EXPORT PointList parse_point_list(const std::string& text);
/// Returns the text of such points: the name of the file, if there is one.
LAMINA_EXPORT std::string point_list_text(std::span<const Point> points, const std::string& file);

}  // namespace lamina::geometry
