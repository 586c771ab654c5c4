// The options of the outer region, between layers and far field: the far field, and the subdomains that the region is
// cut into, which are refined independently.
//
// Guarantees:
//  1. Subdomains share frozen borders, so that their triangles fit together whatever the options say.
// Limits:
//  1. A far field nearer to bodies and layers than a hundredth of their extent is an OptionError of generate_mesh().
//     Ground and tunnel walls may be as near as bodies are to each other.
// Example:
//     CaseOptions options{.layer = {.enabled = false}, .far_field = {.size = 10, .ground = 0.5}};
//     assert(generate_mesh({"naca:0012:60"}, options).mesh.markers.back().name == "ground");
//
// Source: J. K. Pardue, thesis (2015), chapter 5; L. Linardakis, N. Chrisochoides, SIAM J. Sci. Comput. 27 (2006).
#pragma once

#include <optional>
#include <variant>
#include <vector>

#include <lamina/export.hpp>
#include <lamina/length.hpp>
#include <lamina/point.hpp>

namespace lamina {

/// The shape of the outer boundary of the domain.
enum class FarFieldShape {
    box,      ///< a square
    circle,   ///< a circle
    outline,  ///< any convex polygon
};

/// How the flow meets a wall on the border of the domain.
enum class OuterWallKind {
    slip,     ///< it slips along the wall, which has no layers
    no_slip,  ///< it sticks to the wall
    moving,   ///< it sticks to the wall, which moves with the free stream
};

/// The first height of the layers on a wall of the domain.
using OuterLayers = std::variant<Length, YPlus>;

/// Options of the far field. It lies round the middle of the configuration.
struct FarFieldOptions {
    FarFieldShape shape = FarFieldShape::box;  ///< which of the other members count
    Length size = 100;                         ///< half-width of the box or radius of the circle
    std::vector<Point> outline{};              ///< corners of the polygon, counter-clockwise, in units of the input
    /// Height of a wind tunnel. Its floor is the ground where there is one, a line of symmetry is in its middle, and
    /// else the configuration is.
    std::optional<Length> tunnel{};
    /// Distance of the tunnel's inlet ahead of the configuration; empty: 10 chords or 3 heights, the larger of both, or
    /// what `size` says where it is not the default.
    std::optional<Length> tunnel_upstream{};
    std::optional<Length> tunnel_downstream{};         ///< of its outlet; empty: 15 chords or 4 heights, likewise
    OuterWallKind tunnel_walls = OuterWallKind::slip;  ///< ceiling, and floor if there is one: none moves
    std::optional<OuterLayers> tunnel_layers{};        ///< on them; empty: as on the bodies
    std::optional<Length> ground{};                    ///< distance of flat ground below the lowest point
    OuterWallKind ground_wall = OuterWallKind::slip;   ///< how the flow meets it
    std::optional<OuterLayers> ground_layers{};        ///< on it; empty: as on the bodies
    /// The line y = Y, in units of the input, that cuts bodies and domain: what is above is kept.
    std::optional<double> symmetry{};
    bool axisymmetric = false;      ///< whether that line is the axis of a body of revolution
    std::optional<Length> pitch{};  ///< distance along y of the blades of a row, of which the configuration is one
    double stagger_deg = 0;         ///< by which it is turned counter-clockwise about the origin, from the axis x
};

/// Throws OptionError where an option is out of range, and where the outline is no convex polygon.
LAMINA_EXPORT void validate(const FarFieldOptions& options);

/// Options of the cuts into subdomains.
struct DecouplingOptions {
    double pieces_target = 50'000;  ///< target number of triangles per subdomain
};

LAMINA_EXPORT void validate(const DecouplingOptions& options);  ///< throws OptionError: an option out of range

}  // namespace lamina
