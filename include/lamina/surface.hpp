// Between stages 1 and 2, surface: the given points -> the vertices of the walls (docs/guide.md, "Surface").
#pragma once

#include <cmath>
#include <cstddef>
#include <optional>

#include <lamina/geometry.hpp>

namespace lamina {

/// `automatic` resamples coarse samples of a smooth curve and keeps everything else.
enum class Surface { automatic, keep, resample };

/// Lengths are shares of the element's length (the longer side of its box) where nothing else is said.
struct SurfaceOptions {
    Surface surface = Surface::automatic;
    /// About as many points an element, whatever the limits below; they keep their proportions. Implies `resample`
    /// where `automatic` is asked.
    std::optional<std::size_t> points;
    /// Before anything else every element is smoothed, each point moved by at most this, in units of the input.
    std::optional<double> smooth;
    double max_turning_deg = 10;  ///< at a vertex between two corners
    double max_ratio = 1.2;       ///< of neighbouring spacings, as long as none falls below `least_spacing`
    double gradation = 0.18;      ///< growth of the spacing per unit of arc length, within max_ratio
    double longest_spacing = 0.02;
    /// At convex corners of more than 60 degrees: trailing edges, bases.
    double sharp_corner_spacing = 0.001;
    double corner_spacing = 0.004;  ///< at all other corners
    /// The length of the layer's border edges over the fan of rays at sharp corners, in units of the input: the spacing
    /// there, but from a quarter of `sharp_corner_spacing` to `corner_spacing`.
    std::optional<double> fan_spacing;
    double gap_spacing = 1;       ///< of the distance to the next element, or across a cove
    double least_spacing = 2e-5;  ///< nothing above asks for less
    double tolerance = 5e-5;      ///< of the edges from the curve
};

/// The surface stage. Each element is kept or resampled as the options say, and Element::surface tells which and why.
/// Resampling puts a cubic spline, parametrised by chord length, through the points between corners and divides it by
/// equidistribution of the integral of ds/spacing into a whole number of edges; corners stay vertices, exactly.
/// Precondition: check_simple(). The result passes it, too: an element whose resampled outline would not is kept as
/// given. Mirrored or reversed input gives mirrored points, to rounding. Throws UsageError for options out of range.
/// Source: J. F. Thompson, B. K. Soni, N. P. Weatherill, Handbook of Grid Generation (1999), chapters 3 and 30; C. de
/// Boor, A Practical Guide to Splines (1978), chapter 4.
Pslg prepare_surfaces(Pslg pslg, const SurfaceOptions& options = {});

}  // namespace lamina
