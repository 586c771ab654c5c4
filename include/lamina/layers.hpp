// The options of the layer: the anisotropic cells next to the walls, in rows of given heights along rays that leave the
// wall; and the numbers that tell how much of it was made.
//
// Guarantees of the layer that generate_mesh() makes:
//  1. Each ray gets the layers that fit before something is in its way: ElementCoverage tells which do.
//  2. Neighbouring rays differ by at most one layer, every cell between them is positively oriented, and the fronts
//     (the polygons through the ends of the rays) neither cross themselves nor each other.
// Limits:
//  1. Layers absurdly thicker than the input is wide, and heights below the resolution of the coordinates, are an
//     OptionError.
// Example:
//     LayerOptions options{.first_height = YPlus{1}, .growth = 1.15, .layers = 30};
//     validate(options);
//     options.growth_law = GrowthLaw::exponential;  // which needs a thickness
//     try { validate(options); assert(false); } catch (const OptionError& e) { assert(e.option() == "thickness"); }
//
// Source: J. K. Pardue, thesis (2015), chapters 3 and 4; y+: F. M. White, Fluid Mechanics, 5th edition (2003), p. 467.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <variant>

#include <lamina/export.hpp>
#include <lamina/length.hpp>
#include <lamina/point.hpp>

namespace lamina {

/// The law by which heights grow along a ray. H(n) is the height of the top of layer n above the wall, h the first
/// height and r LayerOptions::growth. The spacings are the differences H(n) - H(n - 1).
enum class GrowthLaw {
    geometric,    ///< H(n) = h (r^n - 1) / (r - 1)
    polynomial,   ///< H(n) = h n^r
    exponential,  ///< H(n) = T (e^(a n/N) - 1) / (e^a - 1) for N layers of total thickness T; a follows from H(1) = h
    adaptive,     ///< geometric, with an r for each ray, from 1.05 to 1.5, so that its last layer is as high as wide
    aflr          ///< five equal spacings; each one after that is 1.05, 1.05^2, ... 1.5, 1.5 ... times the one below
};

/// The rays at a sharp convex corner.
enum class CornerRays {
    fan,    ///< several rays from the vertex
    refine  ///< one ray from the vertex, and refining rays on the edges beside it
};

/// How the points of the layer are joined to cells. All three use the same points.
enum class LayerTopology {
    delaunay,  ///< constrained Delaunay triangulation
    layered,   ///< the grid of rays and layers, each cell cut into two triangles
    quads,     ///< the grid with whole cells; triangles in fans, where the number of layers changes, and on the border
};

/// Options of the layer.
struct LayerOptions {
    bool enabled = true;                                      ///< false: isotropic triangles begin at the walls
    std::variant<Length, YPlus> first_height = Length{1e-5};  ///< above the wall, or the y+ that it follows from
    double growth = 1.2;  ///< ratio of the heights of successive layers, or the power of the polynomial law
    GrowthLaw growth_law = GrowthLaw::geometric;  ///< the law by which heights grow
    std::optional<std::uint32_t> layers{};  ///< on each ray; empty: up to isotropy, where cells are as high as wide
    std::optional<Length> thickness{};  ///< height above the wall beyond which no layer goes; T of the exponential law
    /// By which neighbouring rays diverge at most; up to 20 degrees on walls as jagged as iced ones. Rays out of
    /// concave corners converge by what these turn.
    double max_ray_angle_deg = 5;
    CornerRays corners = CornerRays::fan;  ///< the rays at sharp convex corners
    bool equal_fans = false;  ///< whether each fan has the rays of half a turn, and every other vertex one ray
    LayerTopology topology = LayerTopology::layered;  ///< how points are joined to cells
    bool wake_layers = false;  ///< whether layers up to isotropy go on behind trailing edges, along the flow's wakes
};

/// Throws OptionError where an option is out of range, or where the growth law lacks a number that it needs
/// (exponential: 2 layers or more and a thickness; adaptive: a number of layers).
LAMINA_EXPORT void validate(const LayerOptions& options);

/// The numbers of rays and cells on some part of the walls. Cells lie between neighbouring rays, one per layer.
struct LayerCoverage {
    std::size_t rays = 0;             ///< number of rays
    std::size_t incomplete_rays = 0;  ///< rays with fewer layers than requested
    std::size_t requested_cells = 0;  ///< number of cells if every ray had all its layers
    std::size_t made_cells = 0;       ///< number of cells made
};

/// The coverage of one element.
struct LAMINA_EXPORT ElementCoverage {
    LayerCoverage all;  ///< the whole wall, without its wake
    /// The part outside slots, coves and tight concave curvature: the rays at whose origin an empty circle touches the
    /// wall, three times the height of all layers requested in diameter, and the cells between two of these rays.
    LayerCoverage open;
    Point worst_in_the_open{};  ///< origin of the ray in the open that lacks the largest share of its layers, if any

    /// Adds the numbers of another element. The place is left as it is.
    ElementCoverage& operator+=(const ElementCoverage& other);
};

/// How evenly the layer ends. A column lies between two neighbouring rays.
struct BorderSteps {
    std::size_t columns = 0;         ///< number of columns in which layers were requested
    std::size_t full_columns = 0;    ///< number of those with all their layers on both rays
    std::size_t uneven_columns = 0;  ///< those whose ends differ by more than a third of a last cell's height
    double max_step = 0;             ///< largest difference, over the higher last spacing of the two rays
    Point max_step_at{};             ///< end of the first of these rays
};

}  // namespace lamina
