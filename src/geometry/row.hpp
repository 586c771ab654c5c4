// The blades of a row, which are copies of each other along y, and the channel between two of them.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <lamina/export.hpp>
#include <lamina/geometry.hpp>

namespace lamina::geometry {

/// The room between the outlines of a blade and those of the copy below it, in columns of equal width over the extent
/// of the blade in x.
struct Channel {
    double left = 0;           ///< x where the first column begins
    double width = 0;          ///< of a column
    std::vector<double> low;   ///< per column: the largest y of the copy below; -infinity where no outline is
    std::vector<double> high;  ///< per column: the smallest y of the blade; infinity where no outline is

    /// Returns x in the middle of a column.
    double middle(std::size_t column) const { return left + (static_cast<double>(column) + 0.5) * width; }
    /// Returns the column where the channel is narrowest.
    std::size_t narrowest() const;
};

/// Returns the channel below the blade with these outlines.
LAMINA_EXPORT Channel channel_below(std::span<const std::vector<Point>> outlines, double pitch, std::size_t columns);

/// Returns how far those copies are along y that a blade can see: its neighbours, and of several elements all that are
/// as near as the configuration is high. Empty without a row.
LAMINA_EXPORT std::vector<double> shifts_in_row(const Geometry& geometry);

/// Returns a point moved along y.
inline Point moved(Point p, double by) { return {p.x, p.y + by}; }
/// Returns points moved along y.
inline std::vector<Point> moved(std::vector<Point> points, double by) {
    for (Point& p : points) p = moved(p, by);
    return points;
}

}  // namespace lamina::geometry
