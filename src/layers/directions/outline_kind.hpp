// The kinds of outlines: how the vertices that rays start from were chosen, and all that depends on it.
#pragma once

#include <cmath>

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
    /// Width that columns should have at the front, over the angle that they may open by, in heights of the front:
    /// where layers end at isotropy, and where their number is given. Such layers end lower or higher than where cells
    /// are as high as wide, and rays of points that were given stay near their normals: there the rays must not meet,
    /// and no more.
    double wanted_width, wanted_width_of_given_layers;
    /// Widths are measured at this many heights of the front where layers end at isotropy.
    double measured_fronts;
    double width_weight;  ///< weight of a lack of wanted width
    /// Columns may open to this angle without more rays, if LayerOptions::max_ray_angle_deg is less.
    double max_ray_angle_deg;
    bool refine_converging;  ///< whether rays are added where rays converge by more than they may diverge
    bool blunt_fans;         ///< whether corners have fans that are blunter than sharp ones
    bool rayless_corners;    ///< whether sharp concave corners have no rays (corners.hpp)
};

/// Returns the row of a kind.
inline const OutlineRules& rules_of(OutlineKind kind) {
    static constexpr OutlineRules given{.wanted_width = -HUGE_VAL,
                                        .wanted_width_of_given_layers = -HUGE_VAL,
                                        .measured_fronts = 1,
                                        .width_weight = weight_on_smooth,
                                        .max_ray_angle_deg = 0,
                                        .refine_converging = true,
                                        .blunt_fans = false,
                                        .rayless_corners = false};
    static constexpr OutlineRules smooth{.wanted_width = wanted_width_in_openings,
                                         .wanted_width_of_given_layers = -HUGE_VAL,
                                         .measured_fronts = 1,
                                         .width_weight = weight_on_smooth,
                                         .max_ray_angle_deg = 0,
                                         .refine_converging = true,
                                         .blunt_fans = true,
                                         .rayless_corners = false};
    static constexpr OutlineRules jagged{.wanted_width = wanted_width_in_openings,
                                         .wanted_width_of_given_layers = wanted_width_in_openings,
                                         .measured_fronts = fronts_on_jagged,
                                         .width_weight = 1,
                                         .max_ray_angle_deg = max_jagged_ray_angle_deg,
                                         .refine_converging = false,
                                         .blunt_fans = false,
                                         .rayless_corners = true};
    if (kind == OutlineKind::given) return given;
    return kind == OutlineKind::smooth ? smooth : jagged;
}

}  // namespace lamina::layers
