// The far field as a shape, and boxes inside it.
#include "decoupling/far_field.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <lamina/error.hpp>
#include <lamina/predicates.hpp>

#include "core/bounding_box.hpp"
#include "core/rounding.hpp"

namespace lamina::decoupling {

namespace {

/// Calls visit(corner, vector to the next corner) for each edge of the outline.
template <class Visit>
void for_each_edge(std::span<const Point> outline, Visit visit) {
    for (std::size_t i = 0; i < outline.size(); ++i) visit(outline[i], outline[(i + 1) % outline.size()] - outline[i]);
}

/// Returns the smallest distance between the sides of a box and those of a box around it; negative where that box is
/// not around it.
double room_between(const Box& inner, const Box& outer) {
    return std::min({inner.lower.x - outer.lower.x, inner.lower.y - outer.lower.y, outer.upper.x - inner.upper.x,
                     outer.upper.y - inner.upper.y});
}

/// Throws OptionError where the far field is so wide that coordinates there do not resolve the bodies: sizes round the
/// bodies could not be told from those far away.
void require_resolved(const Box& bodies, const FarField& far_field, const char* option) {
    constexpr double max_extents = 1e12;
    if (!(core::longer_side(far_field.box()) <= max_extents * core::longer_side(bodies)))
        throw OptionError(option, "is more than 1e12 times as wide as the configuration");
}

/// Returns the distance of the box of the bodies from the far field; negative where the far field does not enclose it.
/// Walls that do not touch the bodies do not count.
double room_around(const Box& bodies, const FarField& far_field) {
    if (far_field.pitch > 0) {
        const Box domain = far_field.box();
        return std::min(bodies.lower.x - domain.lower.x, domain.upper.x - bodies.upper.x);
    }
    if (far_field.has_walls()) {
        const bool is_above = far_field.is_half || far_field.floor < bodies.lower.y;
        if (!(is_above && bodies.upper.y < far_field.ceiling)) return -HUGE_VAL;
        const Box domain = far_field.box();
        const double above = std::isfinite(far_field.ceiling) ? HUGE_VAL : domain.upper.y - bodies.upper.y;
        return std::min({bodies.lower.x - domain.lower.x, domain.upper.x - bodies.upper.x, above});
    }
    double room = room_between(bodies, far_field.box());
    for (const Point corner : bodies.corners()) {
        if (far_field.shape == FarFieldShape::circle)
            room = std::min(room, far_field.radius - distance(corner, far_field.center));
        for_each_edge(far_field.outline,
                      [&](Point a, Point along) { room = std::min(room, cross(along, corner - a) / length(along)); });
    }
    return room;
}

/// Returns the smallest distance of the far field from the bodies that triangles of a good shape can fill: edges of
/// walls are up to twice as long (SpacingOptions::max_spacing), and below that angles are too small.
double least_room(const Box& bodies) { return 0.01 * core::longer_side(bodies); }

/// Returns the far field with the walls that the options ask for, from upstream to downstream:
///
///          ceiling  ________________________
///                  |                        |
///           inlet  |     ,=--.__            |  outlet
///                  |________________________|
///            floor
///
/// Of a tunnel with a line of symmetry in its middle the half above is left.
FarField between_walls(FarField box, const Box& bodies, double chord, const FarFieldOptions& options) {
    const double radius = box.radius;
    double floor = box.center.y - radius, ceiling = box.center.y + radius;
    if (options.tunnel) {
        const double half = 0.5 * in_units(*options.tunnel, chord);
        floor = box.center.y - half;
        ceiling = box.center.y + half;
    }
    if (options.ground) {
        const double height = ceiling - floor;
        floor = bodies.lower.y - in_units(*options.ground, chord);
        if (options.tunnel) ceiling = floor + height;
    }
    if (options.symmetry) {
        floor = *options.symmetry;
        if (options.tunnel) ceiling = floor + 0.5 * in_units(*options.tunnel, chord);
        box.is_half = true;
    }
    if (!((box.is_half || floor < bodies.lower.y) && bodies.upper.y < ceiling))
        throw OptionError(
            options.tunnel ? "tunnel" : "ground",
            fmt::format("does not enclose the configuration, which lies from y = {:.6g} to {:.6g}, while the "
                        "domain lies from {:.6g} to {:.6g}: make {}",
                        bodies.lower.y, bodies.upper.y, floor, ceiling,
                        options.tunnel ? "the tunnel higher" : "--far-field larger"));
    box.floor = floor;
    if (options.tunnel) box.ceiling = ceiling;
    box.shape = FarFieldShape::outline;
    double left = box.center.x - radius, right = box.center.x + radius;
    if (options.tunnel && options.size == FarFieldOptions{}.size) {
        // What a body does to the flow between walls falls by a factor of 23 over one height, so that nothing of it is
        // left there (e^(-pi x / H)). Wakes are longer.
        constexpr double least_ahead = 10, heights_ahead = 3, least_behind = 15, heights_behind = 4;
        const double height = in_units(*options.tunnel, chord);
        left = bodies.lower.x - std::max(least_ahead * chord, heights_ahead * height);
        right = bodies.upper.x + std::max(least_behind * chord, heights_behind * height);
    }
    if (options.tunnel_upstream) left = bodies.lower.x - in_units(*options.tunnel_upstream, chord);
    if (options.tunnel_downstream) right = bodies.upper.x + in_units(*options.tunnel_downstream, chord);
    box.outline = {{left, floor}, {right, floor}, {right, ceiling}, {left, ceiling}};
    box.center = {0.5 * (left + right), 0.5 * (floor + ceiling)};
    return box;
}

/// Returns the far field of a row: a box between inlet and outlet that encloses the borders to both neighbours.
FarField in_row(FarField box, const Box& bodies, double chord, const FarFieldOptions& options) {
    // What blades do to the flow falls by a factor of 535 over one pitch (e^(-2 pi x / pitch)). Wakes are longer.
    constexpr double least_ahead = 2, pitches_ahead = 1.5, least_behind = 3, pitches_behind = 2;
    const double radius = box.radius;
    const double pitch = in_units(*options.pitch, chord);
    box.pitch = core::rounded_to_multiple(pitch, core::border_step(pitch));
    const bool is_default = options.size == FarFieldOptions{}.size;
    const double left =
        is_default ? bodies.lower.x - std::max(least_ahead * chord, pitches_ahead * box.pitch) : box.center.x - radius;
    const double right = is_default ? bodies.upper.x + std::max(least_behind * chord, pitches_behind * box.pitch)
                                    : box.center.x + radius;
    const double below = bodies.lower.y - 2 * box.pitch, above = bodies.upper.y + 2 * box.pitch;
    box.shape = FarFieldShape::outline;
    box.outline = {{left, below}, {right, below}, {right, above}, {left, above}};
    box.center = {0.5 * (left + right), bodies.center().y};
    return box;
}

}  // namespace

Box inscribed_box(const FarField& far_field) {
    const Box around = far_field.box();
    if (far_field.shape == FarFieldShape::box) return around;
    constexpr double share = 0.8;  // of the largest square that fits in; the rest is room beyond its corners
    double half = 0;
    if (far_field.shape == FarFieldShape::circle) {
        half = far_field.radius / std::sqrt(2.0);
    } else {
        half = core::longer_side(around);
        for_each_edge(far_field.outline, [&](Point a, Point along) {
            half = std::min(half, cross(along, far_field.center - a) / (std::abs(along.x) + std::abs(along.y)));
        });
    }
    half *= share;
    return {far_field.center - Point{half, half}, far_field.center + Point{half, half}};
}

bool leaves_room(const FarField& far_field, const Box& bodies) {
    return room_around(bodies, far_field) > least_room(bodies);
}

std::optional<Box> near_body_box(const Box& bodies, const Box& outermost, const FarField& far_field) {
    const double extent = core::longer_side(bodies);
    if (!leaves_room(far_field, bodies))
        throw OptionError("far_field",
                          fmt::format("leaves {:.3g} units of the input beside the bodies and their layers, but {:.3g} "
                                      "are needed, a hundredth of their extent",
                                      std::max(0.0, room_around(bodies, far_field)), least_room(bodies)));
    if (far_field.has_walls() || room_between(bodies, outermost) < 1.5 * extent) return std::nullopt;
    const double margin = 0.5 * extent;
    return Box{bodies.lower - Point{margin, margin}, bodies.upper + Point{margin, margin}};
}

Box FarField::box() const {
    if (shape != FarFieldShape::outline) return {center - Point{radius, radius}, center + Point{radius, radius}};
    Box box;
    for (const Point p : outline) box.include(p);
    return box;
}

FarField place_far_field(const Box& bodies, double chord, const FarFieldOptions& options) {
    validate(options);
    FarField far_field{options.shape, bodies.center(), in_units(options.size, chord)};
    if (options.shape != FarFieldShape::outline) {
        require_resolved(bodies, far_field, "far_field");
        if (options.pitch) return in_row(far_field, bodies, chord, options);
        return options.tunnel || options.ground || options.symmetry ? between_walls(far_field, bodies, chord, options)
                                                                    : far_field;
    }
    far_field.outline = options.outline;
    for_each_edge(far_field.outline, [&](Point a, Point along) {
        if (!(orient2d(a, a + along, far_field.center) > 0))
            throw OptionError("far_field_outline", "does not enclose the middle of the configuration");
    });
    require_resolved(bodies, far_field, "far_field_outline");
    return far_field;
}

}  // namespace lamina::decoupling
