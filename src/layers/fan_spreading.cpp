// Walls are divided finely at corners, and layers are thick there. Columns of parallel rays would be many times as high
// as wide at the front, and the front's edges far shorter than those over the fan:
//
//      _____                 ___
//     |||||||`.             ////|`-.
//     |||||||   \           ////|   `.         front
//     |||||||    |          ////|`.   |
//     |||||||____|          |///|__`.__\      fan of a corner, between the columns on the wall and those on the base
//     wall                  wall
//
// So a part of the fan's angle is given to the columns beside it. What is given widens the narrowest columns first,
// up to one width, as water fills a hollow up to one level (docs/decisions/0040).
#include "layers/fan_spreading.hpp"

#include <algorithm>
#include <cmath>

#include "core/angles.hpp"
#include "layers/mechanisms.hpp"
#include "layers/outline_walk.hpp"

namespace lamina::layers {

namespace {

/// Fans of up to the first angle, such as those at the corners of bases, give up to the second one to either side;
/// wider ones, at sharp trailing edges, the third. Cells at the wall are as skewed as rays lean.
constexpr double max_corner_fan_deg = 120, given_by_corner_fans_deg = 35, given_by_wide_fans_deg = 30;
/// Where the wall turns by more than the first angle, its fan keeps a column. If rows turned by that at one ray, the
/// line between the middles of the long cells on both sides would pass far below the face between them. The middle of a
/// narrow column is next to its faces. It is as wide as any column of a fan, but no wider than the second angle.
constexpr double max_turning_at_ray_deg = 35, max_kept_column_deg = 10;
/// Fans of which less is left would have columns far narrower than those beside them.
constexpr double max_sliver_deg = 2;
/// A stretch of columns ends where the wall turns inwards by more than this.
constexpr double concave_corner_deg = 20;
/// Columns widen up to this share of the distance of the fan's rays at the height of the front.
constexpr double level_share = 0.9;

/// A column beside a fan.
struct FanColumn {
    double edge;    ///< of the wall below
    double width;   ///< at the front, before anything is given to it
    double height;  ///< of the front
    double share;   ///< of what it lacks that this side gives: half of it in the middle between two fans
};

/// Returns whether a stretch of columns ends at this vertex.
bool ends_stretch(const WallVertex& vertex) {
    return vertex.fan || vertex.turning < -core::radians(concave_corner_deg);
}

/// A walk along the outline, away from a fan or another corner.
struct FanSide {
    std::span<const RayVertex> outline;
    std::span<const double> heights;       ///< of the front, one per vertex
    std::span<const WallVertex> vertices;  ///< as they are before any fan is spread
    OutlineWalk walk;                      ///< from the corner's vertex

    /// Returns the number of steps to the next corner; all the way round, it is this one.
    std::size_t steps_to_corner() const {
        for (std::size_t k = 1; k < walk.size; ++k)
            if (ends_stretch(vertices[walk.vertex(k)])) return k;
        return walk.size;
    }
};

/// Returns the columns up to the next corner.
std::vector<FanColumn> columns_to_corner(const FanSide& side) {
    const std::size_t steps = side.steps_to_corner();
    std::vector<FanColumn> columns;
    columns.reserve(steps);
    for (std::size_t k = 0; k < steps; ++k) {
        const std::size_t i = side.walk.edge(k + 1), j = (i + 1) % side.walk.size;
        const WallVertex &a = side.vertices[i], &b = side.vertices[j];
        const double edge = distance(side.outline[i].at, side.outline[j].at);
        const double height = std::max(side.heights[i], side.heights[j]);
        columns.push_back({edge, edge + height * angle_to_next(a, b), height, 1});
    }
    return columns;
}

/// Returns the columns up to the middle between the fan and the next corner.
std::vector<FanColumn> columns_beside(const FanSide& side) {
    std::vector<FanColumn> columns = columns_to_corner(side);
    // Where columns are symmetric, one of them ends in the middle but for rounding.
    constexpr double rounding = 1e-9;
    double length = 0, passed = 0;
    for (const FanColumn& column : columns) length += column.edge;
    std::size_t k = 0;
    for (; k < columns.size() && passed < (0.5 - rounding) * length; ++k) {
        passed += columns[k].edge;
        if (passed > (0.5 + rounding) * length) columns[k].share = 0.5;
    }
    columns.resize(k);
    return columns;
}

/// Returns the angles that the columns must open by to be as wide as the level, up to the first that is. None is larger
/// than the angle at which more rays would be needed.
std::vector<double> openings_to(double level, double max_opening, std::span<const FanColumn> columns) {
    std::vector<double> openings;
    for (const FanColumn& column : columns) {
        if (!(column.height > 0 && column.width < level)) break;
        openings.push_back(column.share * std::min((level - column.width) / column.height, max_opening));
    }
    return openings;
}

double sum(std::span<const double> values) {
    double total = 0;
    for (const double value : values) total += value;
    return total;
}

/// Returns the angles that a fan gives to its columns, `given` radians together at most.
std::vector<double> openings(std::span<const FanColumn> columns, double max_level, double max_opening, double given) {
    std::vector<double> all = openings_to(max_level, max_opening, columns);
    if (sum(all) <= given) return all;
    double low = 0, high = max_level;
    for (const FanColumn& column : columns) low = std::min(low, column.width);  // negative where rays would cross
    for (int halving = 0; halving < 40; ++halving) {
        const double middle = 0.5 * (low + high);
        (sum(openings_to(middle, max_opening, columns)) <= given ? low : high) = middle;
    }
    return openings_to(low, max_opening, columns);
}

/// Returns the angle that a fan of a corner or of a sharp trailing edge gives to one side.
double given_angle(const FanSide& side, double max_ray_angle) {
    const WallVertex& fan = side.vertices[side.walk.start];
    const double angle = fan.turning + fan.tilt[1] - fan.tilt[0];
    double to_both = 2 * core::radians(given_by_wide_fans_deg);
    if (angle <= core::radians(max_corner_fan_deg)) {
        const bool needs_column = fan.turning > core::radians(max_turning_at_ray_deg);
        const double least = needs_column ? std::min(max_ray_angle, core::radians(max_kept_column_deg)) : 0;
        const double kept = std::max(least, fan.turning - 2 * core::radians(given_by_corner_fans_deg));
        to_both = std::max(angle - kept, 0.0);
    }
    // What is left of a fan that leans lies round the bisector, too, which is nearer to one of its sides.
    const double lean = 0.5 * (fan.tilt[0] + fan.tilt[1]);
    return std::clamp(0.5 * to_both + (side.walk.ahead ? lean : -lean), 0.0, to_both);
}

/// Gives a part of a fan's angle to one side.
void spread(const FanSide& side, double max_ray_angle, std::vector<WallVertex>& vertices) {
    const std::vector<FanColumn> columns = columns_beside(side);
    if (columns.empty()) return;
    const double max_opening = level_share * max_ray_angle, given = given_angle(side, max_ray_angle);
    const std::vector<double> angles =
        openings(columns, max_opening * side.heights[side.walk.start], max_opening, given);
    double left = sum(angles);
    for (std::size_t k = 0; k < angles.size(); ++k) {
        WallVertex& vertex = vertices[side.walk.vertex(k)];
        const double tilt = side.walk.ahead ? -left : left;
        if (vertex.fan) {
            vertex.tilt[side.walk.ahead ? 1 : 0] += tilt;
        } else {
            for (double& entry : vertex.tilt) entry += tilt;
        }
        left -= angles[k];
    }
}

/// Turns the two rays into one of a fan of which a sliver is left that it need not keep.
void close_sliver(WallVertex& fan) {
    const double left = fan.turning + fan.tilt[1] - fan.tilt[0];
    if (left >= core::radians(max_sliver_deg) || fan.turning > core::radians(max_turning_at_ray_deg)) return;
    fan.tilt[0] += 0.5 * left;
    fan.tilt[1] = fan.tilt[0] - fan.turning;
}

/// Columns that are narrower than this share of their height, though the fan has given its angle, are widened at the
/// expense of wider ones, which lose up to the second share of their width.
constexpr double wanted_share = 1.0 / 25, most_lost = 0.25;
/// No ray leans by more than this angle for it. Together with what it leans by already, no ray leans by more than
/// max_tilt_between_edges(), or is farther than max_lean_from_normals_deg from the normals of the edges on both sides.
constexpr double max_lean_deg = 25;

/// Returns the largest angle by which the ray of a vertex may lean to either side so that columns widen.
double largest_lean(const WallVertex& vertex) {
    const double from_normals = std::abs(vertex.tilt[0]) + 0.5 * std::abs(vertex.turning);
    const double left = core::radians(max_lean_from_normals_deg) - from_normals;
    const double between_edges = max_tilt_between_edges(vertex.turning) - std::abs(vertex.tilt[0]);
    return std::max(std::min({core::radians(max_lean_deg), between_edges, left}), 0.0);
}

/// Returns the angles by which rays must lean away from a corner, one for each vertex from it to the end of the columns,
/// so that the narrowest columns are as wide as this share of what is wanted: at the expense of those farther
/// from the corner or, where `both`, of those on both sides alike. Empty if rays would have to lean too far.
std::vector<double> leans_to(double level, bool both, std::span<const FanColumn> columns,
                             std::span<const double> max_leans) {
    const std::size_t n = columns.size();
    std::vector<double> away(n + 1, 0.0), towards(n + 1, 0.0);
    const auto lacking = [&](std::size_t k) {
        const FanColumn& column = columns[k];
        const double wanted = level * wanted_share * column.height;
        return std::max(wanted - column.width, -most_lost * std::abs(column.width)) / column.height;
    };
    for (std::size_t k = 0; k < n; ++k) away[k + 1] = std::max(0.0, away[k] + lacking(k));
    for (std::size_t k = n; both && k-- > 0;) towards[k] = std::max(0.0, towards[k + 1] + lacking(k));
    for (std::size_t k = 0; k <= n; ++k) {
        if (both) away[k] = 0.5 * (away[k] - towards[k]);
        if (std::abs(away[k]) > max_leans[k]) return {};
    }
    return away;
}

/// Angles by which rays lean away from a corner, and the level that columns reach by them.
struct Leans {
    double level = 0;
    std::vector<double> angles;
};

/// Returns the leans with the highest level.
Leans highest_leans(bool both, std::span<const FanColumn> columns, std::span<const double> max_leans) {
    Leans best{1, leans_to(1, both, columns, max_leans)};
    if (!best.angles.empty()) return best;
    best.level = 0;
    double high = 1;
    for (int halving = 0; halving < 20; ++halving) {
        const double middle = 0.5 * (best.level + high);
        std::vector<double> angles = leans_to(middle, both, columns, max_leans);
        if (angles.empty()) {
            high = middle;
        } else {
            best = {middle, std::move(angles)};
        }
    }
    return best;
}

/// Widens the columns on one side that are too narrow still, as far as the widest column before the next corner. What
/// lies beyond is the other corner's.
void widen_narrow(const FanSide& side, std::vector<WallVertex>& vertices) {
    std::vector<FanColumn> columns = columns_to_corner(side);
    if (std::any_of(columns.begin(), columns.end(), [](const FanColumn& c) { return !(c.height > 0); })) return;
    const auto widest = std::max_element(columns.begin(), columns.end(), [](const FanColumn& a, const FanColumn& b) {
        return a.width * b.height < b.width * a.height;
    });
    columns.erase(widest, columns.end());
    std::vector<double> max_leans(columns.size() + 1, 0.0);
    for (std::size_t k = 1; k < columns.size(); ++k) max_leans[k] = largest_lean(side.vertices[side.walk.vertex(k)]);
    const Leans both = highest_leans(true, columns, max_leans), away = highest_leans(false, columns, max_leans);
    const Leans& leans = away.level > both.level ? away : both;
    for (std::size_t k = 1; k + 1 < leans.angles.size(); ++k)
        for (double& tilt : vertices[side.walk.vertex(k)].tilt)
            tilt += side.walk.ahead ? leans.angles[k] : -leans.angles[k];
}

}  // namespace

void spread_fans(std::span<const RayVertex> outline, std::span<const double> heights, double max_ray_angle,
                 std::vector<WallVertex>& vertices) {
    const std::vector<WallVertex> before = vertices;
    for (std::size_t i = 0; i < outline.size(); ++i)
        if (before[i].fan)
            for (const bool ahead : {false, true})
                spread({outline, heights, before, {outline.size(), i, ahead}}, max_ray_angle, vertices);
    for (WallVertex& vertex : vertices)
        if (vertex.fan && uses("close_sliver")) close_sliver(vertex);
}

void widen_narrow_columns(std::span<const RayVertex> outline, std::span<const double> heights,
                          std::vector<WallVertex>& vertices) {
    const std::vector<WallVertex> before = vertices;
    for (std::size_t i = 0; i < outline.size(); ++i)
        if (ends_stretch(before[i]))
            for (const bool ahead : {false, true})
                widen_narrow({outline, heights, before, {outline.size(), i, ahead}}, vertices);
}

}  // namespace lamina::layers
