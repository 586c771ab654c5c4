// Stage "prepare": the points that were read -> the vertices of the walls (docs/reference/input.md, "Surface").
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <lamina/geometry.hpp>
#include <lamina/length.hpp>

namespace lamina {

/// The ways to treat the given points.
enum class SurfaceTreatment {
    automatic,  ///< samples of a smooth curve that are coarser than a wall needs are resampled, others kept
    keep,       ///< kept exactly
    resample,   ///< replaced by new points on a spline through them
};

/// Options of prepare_surfaces(). Lengths are shares of the element's length, the longer side of the tightest box round it,
/// unless a comment says otherwise.
struct SurfaceOptions {
    SurfaceTreatment treatment = SurfaceTreatment::automatic;  ///< whether points are kept or replaced
    /// Wall vertices per element, about; all spacings below keep their proportions. Makes `automatic` resample.
    std::optional<std::size_t> points{};
    /// Whether each element gets exactly `points` vertices. Makes `points` a promise; the edges are shared out among the
    /// stretches between corners by the integrals of ds / spacing. Needs `points`, and no treatment `keep`.
    bool exact_points = false;
    /// Number of equal edges of the base of each element that has one (docs/glossary.md), with `exact_points`. Empty: a
    /// fiftieth of `points`.
    std::optional<std::size_t> base_edges{};
    /// The points are smoothed first; each moves by at most this length. Empty: no smoothing.
    std::optional<Length> smooth{};
    double max_turning_deg = 10;  ///< largest turning at a vertex between two corners
    double max_ratio = 1.2;       ///< largest ratio of neighbouring spacings, where none is below min_spacing
    double gradation = 0.18;      ///< growth of the spacing per unit of arc length, within max_ratio
    double max_spacing = 0.02;    ///< largest spacing
    /// The largest spacing at the leading edge, which is the point of the outline farthest from its trailing edge.
    /// Makes `automatic` resample. Empty: as the other options ask.
    std::optional<double> leading_edge_spacing{};
    /// The spacing at the trailing edge, in place of those at corners below. Makes `automatic` resample.
    std::optional<double> trailing_edge_spacing{};
    double sharp_corner_spacing = 0.001;  ///< at sharp corners (sharp_corner_deg)
    double corner_spacing = 0.004;        ///< at all other corners
    double gap_spacing = 1;               ///< as a share of the distance to the next element, or across a cove
    double min_spacing = 2e-5;            ///< smallest spacing, even where another option asks for less
    double tolerance = 5e-5;              ///< largest distance of an edge from the curve
};

/// Throws OptionError where an option is out of range.
LAMINA_EXPORT void validate(const SurfaceOptions& options);

/// Limits on the spacing of a wall that come from the layer over it. They hold beside the options of the surface; the
/// stricter limit wins.
struct SpacingLimits {
    double max_turning_deg = HUGE_VAL;  ///< as in SurfaceOptions
    double gradation = HUGE_VAL;        ///< as in SurfaceOptions
    /// Length, in units of the input, of the layer's border edges over the fan of rays at sharp corners. The spacing at
    /// sharp corners equals it, between a quarter of sharp_corner_spacing and corner_spacing.
    std::optional<double> fan_spacing{};
    std::vector<double> fan_spacings{};  ///< one per element, in place of fan_spacing; empty: no element has its own
    /// Number of equal parts of each fan. The lengths above are those over rays that are max_turning_deg apart.
    std::optional<std::uint32_t> fan_parts{};
    std::vector<WallSpacing> walls{};  ///< spacings of stretches of resampled walls; they grow by the gradation beside
};

/// Keeps or resamples each stretch of each element between two corners, as the options say, and finds the features of
/// the elements. Element::surface_notes tells what was done, and why. Resampling puts a cubic spline, parametrised by
/// chord length, through the points between corners and divides it into a whole number of edges that take equal shares
/// of the integral of ds / spacing; corners stay vertices exactly. Where the resampled outline would cross itself or
/// another one, the given points stay vertices, and the straight edges between them are divided instead of the spline;
/// an element that still crosses is kept as given, which is an error where
/// an exact number of vertices is asked for. Mirrored or reversed input gives mirrored points, up to rounding.
/// `chord` is the reference chord; empty: the extent in x of the geometry. Precondition: check_simple(); the result
/// passes it, too. Throws OptionError for options out of range.
/// Source: J. F. Thompson, B. K. Soni, N. P. Weatherill, Handbook of Grid Generation (1999), chapters 3 and 30; C. de
/// Boor, A Practical Guide to Splines (1978), chapter 4.
LAMINA_EXPORT Geometry prepare_surfaces(Geometry geometry, const SurfaceOptions& options = {},
                                        const SpacingLimits& limits = {}, std::optional<double> chord = {});

/// Facts about one element for a person to read (`lamina info`).
struct ElementSummary {
    Box box;                           ///< the box round the element
    double chord = 0;                  ///< extent in x
    double area = 0;                   ///< area of the body
    double perimeter = 0;              ///< length of the outline
    double min_spacing = 0;            ///< length of the shortest edge
    double max_spacing = 0;            ///< length of the longest edge
    double max_spacing_ratio = 0;      ///< largest ratio of the lengths of neighbouring edges
    double max_turning_deg = 0;        ///< largest exterior angle
    Point max_turning_at;              ///< a vertex with that angle
    std::size_t sharp_corners = 0;     ///< number of convex vertices that turn by more than sharp_corner_deg
    Point trailing_edge;               ///< as in OutlineFeatures
    bool blunt_trailing_edge = false;  ///< whether the trailing edge is a base with two corners
};

/// Measures an element.
LAMINA_EXPORT ElementSummary summarize(const Element& element);

/// Returns several lines of text on each element: its source, its measures, repairs, transformations and
/// notes (`lamina info`).
LAMINA_EXPORT std::string describe(const Geometry& geometry);

}  // namespace lamina
