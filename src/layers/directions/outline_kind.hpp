// The kinds of outlines: how the vertices that rays start from were chosen, and all that depends on it.
#pragma once

#include <lamina/geometry.hpp>

#include "layers/parameters.hpp"

namespace lamina::layers {

/// How the vertices of an outline were chosen.
enum class OutlineKind {
    given,   ///< those of the input, of which nothing is known
    smooth,  ///< smooth but at few corners (Element::smooth)
    jagged,  ///< resampled between many corners, as iced ones are
};

/// Returns the kind of an element's outline.
inline OutlineKind outline_kind(const Element& element) {
    if (element.smooth) return OutlineKind::smooth;
    return element.resampled ? OutlineKind::jagged : OutlineKind::given;
}

/// A row of the table of kinds: all that distinguishes one from the others.
struct OutlineRules {
    /// Whether columns are to be as wide as wanted_width_in_openings says. Rays of points that were given stay near
    /// their normals: they must not meet, and no more.
    bool widens_columns;
    /// Columns may open to this angle without more rays, if LayerOptions::max_ray_angle_deg is less.
    double max_ray_angle_deg;
    bool blunt_fans;       ///< whether corners have fans that are blunter than sharp ones
    bool rayless_corners;  ///< whether sharp concave corners have no rays (corners.hpp)
};

/// Returns the row of a kind.
inline const OutlineRules& rules_of(OutlineKind kind) {
    static constexpr OutlineRules given{
        .widens_columns = false, .max_ray_angle_deg = 0, .blunt_fans = false, .rayless_corners = false};
    static constexpr OutlineRules smooth{
        .widens_columns = true, .max_ray_angle_deg = 0, .blunt_fans = true, .rayless_corners = false};
    static constexpr OutlineRules jagged{.widens_columns = true,
                                         .max_ray_angle_deg = max_jagged_ray_angle_deg,
                                         .blunt_fans = false,
                                         .rayless_corners = true};
    if (kind == OutlineKind::given) return given;
    return kind == OutlineKind::smooth ? smooth : jagged;
}

}  // namespace lamina::layers
