// The vertices of the walls: the points that were read are kept, or replaced by points on a smooth curve through them.
//
// Guarantees:
//  1. Corners stay vertices exactly. The result passes check_simple(), as the geometry given has to.
//  2. Mirrored or reversed input gives mirrored points, up to rounding.
//  3. Element::surface_notes tells what was done to each element, and why.
// Limits:
//  1. Where the resampled outline would cross itself or another one, the straight edges between the given points are
//     divided instead of the spline; one that still crosses is kept as given (OptionError with `exact_points`).
// Example:
//     const Geometry coarse = make_geometry({naca_airfoil("0012", 40)});
//     const Element wall = prepare_surfaces(coarse, {.points = 200, .exact_points = true}).elements[0];
//     assert(wall.points.size() == 200 && wall.resampled && wall.features.trailing_edge == (Point{1, 0}));
//
// Source: Thompson, Soni, Weatherill, Handbook of Grid Generation (1999), chapters 3 and 30; C. de Boor, A Practical
// Guide to Splines (1978), chapter 4.
#pragma once

#include <lamina/geometry.hpp>
#include <lamina/length.hpp>

namespace lamina {

/// The ways to treat the given points.
enum class SurfaceTreatment {
    automatic,  ///< samples of a smooth curve that are coarser than a wall needs are resampled, others kept
    keep,       ///< kept exactly
    resample,   ///< replaced by new points on a spline through them
};

/// The two sides of an element, between its trailing and its leading edge, the point farthest from it.
enum class SurfaceSide {
    both,
    upper,  ///< the side that the outline runs over first, from the trailing edge on
    lower,  ///< the other one
};

/// The largest spacing at a station of an element.
struct StationSpacing {
    std::string element;                   ///< its name, or "all"
    SurfaceSide side = SurfaceSide::both;  ///< which sides have it
    double station = 0;                    ///< along the chord, from 0 at the leading edge to 1 at the trailing edge
    double spacing = 0;                    ///< in lengths of the element, > 0
};

/// Numbers of wall edges on both sides of an element.
struct SideEdges {
    std::size_t upper = 0;              ///< of the side that the outline runs over first
    std::size_t lower = 0;              ///< of the other one
    std::optional<std::size_t> base{};  ///< of the base, of equal length; empty: one for 50 of the others
    std::string element = "all";        ///< its name, or "all"
};

/// Options of prepare_surfaces(). Lengths are shares of the element's length, the longer side of the tightest box round
/// it, unless a comment says otherwise. `points` and the spacings at both edges make `automatic` resample.
struct SurfaceOptions {
    SurfaceTreatment treatment = SurfaceTreatment::automatic;  ///< whether points are kept or replaced
    std::optional<std::size_t> points{};  ///< wall vertices per element, about; all spacings keep their proportions
    /// Whether each element gets exactly `points` vertices: edges are shared out among the stretches between corners by
    /// the integrals of ds / spacing. Needs `points`, and no treatment `keep`.
    bool exact_points = false;
    /// Edges of bases, of equal length, with `exact_points`; empty: one for 50 of the others.
    std::optional<std::size_t> base_edges{};
    /// Exact numbers of edges on the sides of elements, the last ones given of those of its name, else of those of all.
    /// Elements without are treated as without this. Excludes `points`.
    std::vector<SideEdges> side_edges{};
    std::vector<StationSpacing> station_spacings{};  ///< spacings at stations; they make `automatic` resample
    std::optional<Length> smooth{};  ///< points are smoothed first, and move by at most this; empty: no smoothing
    /// Whether walls whose points are kept on request follow a spline through these, where cells are curved; others do
    /// so in any case.
    bool curve_kept = false;
    double max_turning_deg = 10;  ///< largest turning at a vertex between two corners
    double max_ratio = 1.2;       ///< largest ratio of neighbouring spacings, where none is below min_spacing
    double gradation = 0.18;      ///< growth of the spacing per unit of arc length, within max_ratio
    double max_spacing = 0.02;    ///< largest spacing
    std::optional<double> leading_edge_spacing{};   ///< largest, at the point farthest from the trailing edge
    std::optional<double> trailing_edge_spacing{};  ///< at the trailing edge, in place of those at corners below
    double sharp_corner_spacing = 0.001;            ///< at corners that turn by more than 60 degrees
    double corner_spacing = 0.004;                  ///< at all other corners
    double gap_spacing = 1;     ///< as a share of the distance to the next element, or across a cove
    double min_spacing = 2e-5;  ///< smallest spacing, even where another option asks for less
    double tolerance = 5e-5;    ///< largest distance of an edge from the curve
};

LAMINA_EXPORT void validate(const SurfaceOptions& options);  ///< throws OptionError: an option out of range
/// Keeps or resamples each stretch of each element between two corners, as the options say, and finds the features of
/// the elements. Resampling puts a cubic spline, parametrised by chord length, through the points between corners and
/// divides it into a whole number of edges that take equal shares of the integral of ds / spacing. `chord` is the
/// reference chord; empty: the extent in x of the geometry. Throws OptionError for options out of range.
LAMINA_EXPORT Geometry prepare_surfaces(Geometry geometry, const SurfaceOptions& options = {},
                                        std::optional<double> chord = {});
/// Returns several lines on each element: its source, measures, repairs, transformations and notes (`lamina info`).
LAMINA_EXPORT std::string describe(const Geometry& geometry);

}  // namespace lamina
