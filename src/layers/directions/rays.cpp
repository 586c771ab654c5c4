// Vertex normals, fans and refining rays. Source: J. K. Pardue, thesis (2015), chapter 3 and section 3.1.
#include "layers/directions/rays.hpp"
#include "geometry/sharp_corner.hpp"

#include <algorithm>
#include <cmath>

#include "core/angles.hpp"
#include "core/segments.hpp"
#include "layers/directions/leans.hpp"
#include "layers/mechanisms.hpp"
#include "layers/parameters.hpp"
#include "layers/stages.hpp"

namespace lamina::layers {

namespace {

/// Slack on the number of parts of an angle, so that an angle of exactly the limit is not divided.
constexpr double part_slack = 1e-9;

/// Returns into how many equal parts an angle must be divided for none to exceed the limit; at least 1.
std::size_t angle_parts(double angle, double limit) {
    return std::max<std::size_t>(1, static_cast<std::size_t>(std::ceil(std::abs(angle) / limit - part_slack)));
}

/// Returns the outward bisector at a vertex. The sum of the two normals vanishes as the edges fold onto each other; the
/// difference of the tangents, which then takes its place, does not.
Point bisector(Point tangent_before, Point tangent_after, double turning) {
    if (std::abs(turning) < 0.5 * core::pi) return unit(-perpendicular(tangent_before) - perpendicular(tangent_after));
    return turning > 0 ? unit(tangent_before - tangent_after) : unit(tangent_after - tangent_before);
}

/// Returns lines by their angles from a direction.
std::vector<LineAtVertex> sorted_lines(std::span<const LineFoot> feet, Point middle) {
    std::vector<LineAtVertex> lines;
    for (const LineFoot& foot : feet) lines.push_back({core::angle_between(middle, foot.direction), foot});
    std::sort(lines.begin(), lines.end(),
              [](const LineAtVertex& a, const LineAtVertex& b) { return a.angle < b.angle; });
    return lines;
}

/// Sets the lines that end at a vertex, and the leans that they ask for. One line in front of both edges has one ray;
/// others have a fan.
void set_lines(std::span<const RayVertex> outline, std::size_t i, WallVertex& vertex) {
    const std::size_t n = outline.size();
    const RayVertex &at = outline[i], &before = outline[(i + n - 1) % n], &after = outline[(i + 1) % n];
    std::vector<LineFoot> feet(at.feet.begin(), at.feet.end());
    // A trailing edge with a wake is two vertices, one on either side.
    if (before.place != RayPlace::wall || after.place != RayPlace::wall)
        std::erase_if(feet, [&](const LineFoot& foot) {
            return !core::inside_wedge(at.at, before.at, after.at, at.at + foot.direction);
        });
    vertex.lines = sorted_lines(feet, vertex.bisector);
    if (vertex.lines.empty()) return;
    const Point first = vertex.lines.front().foot.direction;
    vertex.fan |=
        vertex.lines.size() > 1 || !(dot(vertex.normal_before, first) > 0) || !(dot(vertex.normal_after, first) > 0);
    for (const bool is_last : {false, true})
        vertex.lean[is_last] = vertex.fan ? fan_bounds(vertex, is_last).clamped(0) : vertex.lines.front().angle;
}

/// Returns the vertices of the outline with their normals, not smoothed yet.
std::vector<WallVertex> wall_vertices(std::span<const RayVertex> outline, const LayerOptions& options,
                                      double min_fan_turning_deg) {
    const std::size_t n = outline.size();
    std::vector<WallVertex> vertices(n);
    Point before = unit(outline[0].at - outline[n - 1].at);
    for (std::size_t i = 0; i < n; ++i) {
        const Point after = unit(outline[(i + 1) % n].at - outline[i].at);
        const bool wall = outline[i].place == RayPlace::wall, end = outline[i].place == RayPlace::wake_end;
        const double turning = end ? core::pi : core::angle_between(before, after);
        const bool fan = wall && options.corners == CornerRays::fan && turning > core::radians(min_fan_turning_deg);
        vertices[i] = {turning, -perpendicular(before), -perpendicular(after), bisector(before, after, turning), fan};
        if (!outline[i].feet.empty()) set_lines(outline, i, vertices[i]);
        before = after;
    }
    return vertices;
}

Point leaning(Point direction, double lean) { return lean == 0 ? direction : unit(core::rotated(direction, lean)); }

Point first_direction(const WallVertex& v) { return leaning(v.fan ? v.normal_before : v.bisector, v.lean[0]); }
Point last_direction(const WallVertex& v) { return leaning(v.fan ? v.normal_after : v.bisector, v.lean[1]); }

/// Returns half of the angle between the first and the last ray of a fan, in radians.
double half_fan(const WallVertex& v) { return 0.5 * (v.turning + v.lean[1] - v.lean[0]); }

/// A ray that a fan must have.
struct FanRay {
    double angle;  ///< from the middle of the fan
    Point direction;
    double line_room;  ///< RayLine::line_room
};

/// Returns into how many parts the angles between these rays are divided, so that none exceeds the largest angle; or as
/// many in all as are asked for.
std::vector<std::size_t> parts_of_fan(std::span<const FanRay> fan, double max_angle,
                                      std::optional<std::uint32_t> in_all) {
    std::vector<std::size_t> parts;
    for (std::size_t k = 1; k < fan.size(); ++k)
        parts.push_back(in_all ? 1 : angle_parts(fan[k].angle - fan[k - 1].angle, max_angle));
    if (!in_all || parts.empty()) return parts;
    const auto angle_of_part = [&](std::size_t k) {
        return (fan[k + 1].angle - fan[k].angle) / static_cast<double>(parts[k]);
    };
    for (std::size_t sum = parts.size(); sum < *in_all; ++sum) {
        std::size_t widest = 0;
        for (std::size_t k = 1; k < parts.size(); ++k)
            if (angle_of_part(k) > angle_of_part(widest)) widest = k;
        ++parts[widest];
    }
    return parts;
}

/// Adds these rays and those between. They are copies of `ray` but for their directions.
void add_fan(const RayLine& ray, Point middle, std::span<const FanRay> fan, std::span<const std::size_t> parts,
             std::vector<RayLine>& rays) {
    const auto add = [&](Point direction, double line_room) {
        rays.push_back(ray);
        rays.back().direction = direction;
        rays.back().line_room = line_room;
    };
    for (std::size_t k = 0; k < fan.size(); ++k) {
        add(fan[k].direction, fan[k].line_room);
        for (std::size_t part = 1; k + 1 < fan.size() && part < parts[k]; ++part) {
            const double share = static_cast<double>(part), rest = static_cast<double>(parts[k] - part);
            const double angle = (rest * fan[k].angle + share * fan[k + 1].angle) / static_cast<double>(parts[k]);
            add(unit(core::rotated(middle, angle)), 0);
        }
    }
}

/// Returns the rays along lines.
std::vector<FanRay> rays_along(std::span<const LineAtVertex> lines) {
    std::vector<FanRay> rays;
    for (const LineAtVertex& line : lines) rays.push_back({line.angle, line.foot.direction, line.foot.room});
    return rays;
}

/// Returns the rays that the fan of a vertex with lines must have: those along lines, and the first and the last one of
/// a fan unless a line is there.
std::vector<FanRay> rays_at_lines(const WallVertex& vertex) {
    constexpr double same = 0x1p-11;  // radians; leans are rounded to half of it
    std::vector<FanRay> rays = rays_along(vertex.lines);
    if (!vertex.fan) return rays;
    const double first = vertex.lean[0] - 0.5 * vertex.turning, last = vertex.lean[1] + 0.5 * vertex.turning;
    if (first < rays.front().angle - same) rays.insert(rays.begin(), {first, first_direction(vertex), 0});
    if (last > rays.back().angle + same) rays.push_back({last, last_direction(vertex), 0});
    return rays;
}

/// Adds the ray or the fan of a vertex, which has `fan_parts` parts, or as many as max_angle asks for. The angles of a
/// fan are counted from the bisector, not from one side to the other, so that mirrored input gives mirrored rays.
void add_vertex_rays(const RayVertex& at, const WallVertex& vertex, double max_angle,
                     std::optional<std::uint32_t> fan_parts, std::vector<RayLine>& rays) {
    const auto add = [&](Point direction) {
        rays.push_back({at.at, direction, at.place, at.opening, at.least_height});
    };
    if (!vertex.lines.empty()) {
        const std::vector<FanRay> fan = rays_at_lines(vertex);
        add_fan({at.at, {}, at.place, at.opening, at.least_height}, vertex.bisector, fan,
                parts_of_fan(fan, max_angle, fan_parts), rays);
        return;
    }
    add(first_direction(vertex));
    if (!vertex.fan) return;
    const double half = half_fan(vertex), middle = 0.5 * (vertex.lean[0] + vertex.lean[1]);
    const std::size_t parts = fan_parts ? *fan_parts : angle_parts(2 * half, max_angle);
    for (std::size_t k = 1; k < parts; ++k) {
        const double share = (2.0 * static_cast<double>(k) - static_cast<double>(parts)) / static_cast<double>(parts);
        add(unit(core::rotated(vertex.bisector, middle + share * half)));
    }
    add(last_direction(vertex));
}

/// What decides on the rays between two vertices of a wall.
struct Refinement {
    double max_angle;  ///< by which neighbouring rays diverge at most
    const PlaceOnWall& place;
    double height;  ///< of the layers between the vertices; infinite where it is not known yet
};

/// Returns the largest distance between the curve of an edge and its chords, if it is divided into so many parts.
double largest_bend(Point from, Point to, std::size_t parts, const PlaceOnWall& place) {
    double largest = 0;
    for (std::size_t k = 0; k < parts; ++k) {
        const auto at = [&](double step) {
            return place(from, to, (static_cast<double>(k) + step) / static_cast<double>(parts));
        };
        const Point begin = k == 0 ? from : at(0).value_or(from), end = k + 1 == parts ? to : at(1).value_or(to);
        // Curves with an inflection are on their chord in the middle.
        for (const double step : {0.25, 0.5, 0.75})
            if (const std::optional<Point> on_curve = at(step))
                largest = std::max(largest, core::distance_to_segment(*on_curve, begin, end));
    }
    return largest;
}

/// Returns into how many parts the curve of an edge must be divided for each to bend by no more than a share of the
/// layers' height: cells of higher order follow it, and where the border divides their tops, the bend fades out below.
std::size_t parts_of_curve(Point from, Point to, const Refinement& refinement) {
    if (!refinement.place || refinement.height <= 0) return 1;
    // Parts of an arc bend by the square of their share of it. At a nose one part bends more than the others, so that
    // more are needed than one look says. On smooth curves parts * sqrt(bend) is bounded: this ends.
    const auto needed = [&](std::size_t parts) {
        const double bend = largest_bend(from, to, parts, refinement.place) / (max_bend_of_walls * refinement.height);
        return static_cast<std::size_t>(
            std::max(1.0, std::ceil(static_cast<double>(parts) * std::sqrt(bend) - part_slack)));
    };
    std::size_t parts = 1;
    for (std::size_t next = needed(parts); next > parts; next = needed(parts)) parts = next;
    return parts;
}

/// Adds the rays between two others that diverge by more than the largest angle, or whose wall bends, evenly spaced on
/// the wall. Points on rays that converge come nearer to each other by themselves.
void add_refining_rays(const RayLine& first, const RayLine& last, const Refinement& refinement,
                       std::vector<RayLine>& rays) {
    const Point from = first.origin, to = last.origin, normal = -perpendicular(unit(to - from));
    // Rays stay within 90 degrees of the edge's normal, so that the difference of the two angles needs no wrapping.
    const double first_angle = core::angle_between(normal, first.direction),
                 last_angle = core::angle_between(normal, last.direction);
    const double opening = last_angle - first_angle;
    const std::size_t of_angle = opening > 0 ? angle_parts(opening, refinement.max_angle) : 1;
    const std::size_t parts = std::max(of_angle, parts_of_curve(from, to, refinement));
    for (std::size_t k = 1; k < parts; ++k) {
        const double part = static_cast<double>(k), whole = static_cast<double>(parts), rest = whole - part;
        const auto between = [&](double a, double b) { return (rest * a + part * b) / whole; };
        Point origin{between(from.x, to.x), between(from.y, to.y)};
        if (refinement.place) origin = refinement.place(from, to, part / whole).value_or(origin);
        // The edge may be too short to be divided in floating point.
        if (origin == rays.back().origin || origin == to || origin == from) continue;
        rays.push_back({.origin = origin,
                        .direction = unit(core::rotated(normal, between(first_angle, last_angle))),
                        .least_height = between(first.least_height, last.least_height)});
    }
}

}  // namespace

std::vector<RayLine> make_rays(std::span<const RayVertex> outline, OutlineKind kind, const LayerOptions& options,
                               const LayerGrowth& growth, std::span<const double> heights, const PlaceOnWall& place) {
    const double min_fan_turning_deg = kind == OutlineKind::smooth && !options.equal_fans
                                           ? std::min(geometry::sharp_corner_deg, 2 * options.max_ray_angle_deg)
                                           : geometry::sharp_corner_deg;
    std::vector<WallVertex> vertices = wall_vertices(outline, options, min_fan_turning_deg);
    if (!heights.empty() && uses("leans")) lean_rays(outline, heights, kind, options, growth, vertices);
    const double max_angle = core::radians(options.max_ray_angle_deg);
    std::optional<std::uint32_t> fan_parts;
    if (options.equal_fans) fan_parts = equal_fan_parts(options);
    std::vector<RayLine> rays;
    rays.reserve(2 * outline.size());
    for (std::size_t i = 0; i < outline.size(); ++i) {
        const std::size_t next = (i + 1) % outline.size();
        add_vertex_rays(outline[i], vertices[i], max_angle, fan_parts, rays);
        rays.back().corner_after = outline[i].corner_after;
        if (!outline[i].corner_after.empty()) continue;
        if (options.equal_fans || outline[i].place != RayPlace::wall || outline[next].place != RayPlace::wall) continue;
        // Columns beside a line open by its lean, on edges however short: rays would ask for a finer wall, and so on.
        if (!vertices[i].lines.empty() || !vertices[next].lines.empty()) continue;
        const RayLine after{.origin = outline[next].at,
                            .direction = first_direction(vertices[next]),
                            .least_height = outline[next].least_height};
        const double height = heights.empty() ? HUGE_VAL : std::min(heights[i], heights[next]);
        add_refining_rays(RayLine(rays.back()), after, {most_opening(kind, options), place, height}, rays);
    }
    return rays;
}

void add_rays_along_lines(Point at, Point normal, std::span<const LineFoot> feet, double max_angle,
                          std::vector<RayLine>& rays) {
    const std::vector<FanRay> fan = rays_along(sorted_lines(feet, normal));
    add_fan({at, {}}, normal, fan, parts_of_fan(fan, max_angle, {}), rays);
}

std::uint32_t equal_fan_parts(const LayerOptions& options) {
    return static_cast<std::uint32_t>(angle_parts(core::pi, core::radians(options.max_ray_angle_deg)));
}

}  // namespace lamina::layers
