// Stage 2, layers: rays along wall normals, points along rays, and the outer border of the boundary layer.
// Source: J. K. Pardue, thesis (2015), chapter 3.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <lamina/geometry.hpp>
#include <lamina/ids.hpp>
#include <lamina/point.hpp>
#include <lamina/sizing.hpp>

namespace lamina {

/// Height H(n) of layer n, h the first height, r LayerOptions::growth:
enum class GrowthLaw {
    geometric,    ///< h (r^n - 1) / (r - 1)
    polynomial,   ///< h n^r
    exponential,  ///< T (e^(a n/N) - 1) / (e^a - 1) for N layers of total thickness T; a follows from H(1) = h
    adaptive,     ///< geometric, r of each ray such that the last of N spacings is that along the wall; 1.05 to 1.5
    aflr          ///< five equal spacings, each one after that 1.05, 1.05^2, ... 1.5, 1.5 ... times the one below
};
enum class Corners { fan, refine };

/// How the layer's points are joined; the points are the same. docs/decisions/0012.
enum class LayerTopology {
    delaunay,  ///< constrained Delaunay triangulation
    layered,   ///< the grid of rays and layers, each cell cut in two
    quads,     ///< the same grid, its cells whole; triangles in fans, at steps, and where the border is divided
};

struct LayerOptions {
    bool enabled = true;
    double first_height = 1e-5;  ///< of the first layer, along the ray, in units of the input
    /// Ratio of the heights of successive layers, or the power of the polynomial law; > 1. The other laws have no use
    /// for it.
    double growth = 1.2;
    GrowthLaw growth_law = GrowthLaw::geometric;
    /// Layers on each ray. None: up to isotropy, where the height of a layer reaches the distance to the neighbouring
    /// rays.
    std::optional<std::uint32_t> layers = 30;
    std::optional<double> thickness;  ///< stop each ray at this total height; the exponential law's T
    double max_ray_angle_deg = 5;     ///< between neighbouring rays
    /// Convex corners that turn by more than 60 degrees: a fan from the vertex, or refining rays beside it.
    Corners corners = Corners::fan;
    LayerTopology topology = LayerTopology::delaunay;
    /// Largest ratio of the lengths of adjacent edges of the outer border; 1.4 serves angle bounds up to 30 degrees.
    /// Below 2 an edge that must be halved often makes its neighbours follow, all along the border. Exceeded only
    /// where division points would cross something by rounding.
    double border_ratio = 1.4;
    /// Edges of the outer border are split until none is longer than 1.1 x (length of any other) + gradation x
    /// distance.
    double border_gradation = 0.1;
    /// Edges of the outer border are split until none is longer than this.
    double longest_border_edge = HUGE_VAL;
    /// Round resampled elements, where an edge of the outer border would be split with this for `border_gradation`,
    /// further rays stand on the wall's edge below: rows of cells go on to the wall instead of fanning out below the
    /// split points. Adds vertices to the walls.
    std::optional<double> ray_gradation = {};
    /// Edges of the outer border are split until none is longer than size + border_gradation x distance of any of these
    /// (but for up to a tenth, since cuts shift towards the lengths beside them).
    std::vector<SizeSource> border_sources = {};
};

/// Factor within which growth may differ from what was asked for on rays that were cut short.
inline constexpr double largest_stretch = 1.019;

/// A line of layer points that leaves the wall.
struct Ray {
    VertexId origin;          ///< wall vertex
    Point direction;          ///< unit vector
    std::uint32_t layers;     ///< points made on the ray; less than asked where it was truncated
    std::uint32_t requested;  ///< points asked for
    double growth;            ///< r of GrowthLaw on this ray; e^(a/N) for the exponential law
    std::size_t first_point;  ///< Layer::points[first_point + n] lies at height n + 1
    double height_limit;      ///< nothing is placed beyond this height; infinite where nothing is in the way
    /// Each spacing is to the one below as the law says, times this: 1 on rays with all their layers, else within
    /// largest_stretch of 1, so that layers end where the space for them does and not in steps.
    double stretch = 1;
};

/// What became of the layers asked for on some part of the walls. Cells lie between neighbouring rays, one a layer.
struct LayerCoverage {
    std::size_t rays = 0;
    std::size_t incomplete_rays = 0;  ///< with fewer layers than asked for
    std::size_t requested_cells = 0;
    std::size_t made_cells = 0;
};

/// Opposing layers of full height and the triangles between them fit in a space of so many full heights.
inline constexpr double open_space = 3;

struct ElementCoverage {
    LayerCoverage all;
    /// Outside slots, coves and tight concave curvature: rays for which an empty circle of open_space x (height of all
    /// layers asked for) across touches the wall at the ray's origin, and cells between two such rays.
    LayerCoverage open;

    ElementCoverage& operator+=(const ElementCoverage& other);
};

/// Everything the later stages need of the layer.
struct Layer {
    /// Wall vertices first (element by element; a refining ray's vertex stands where it lies on the wall), then ray
    /// points, then split points of the outer border. All distinct. Ray points lie strictly between wall and border.
    std::vector<Point> points;
    std::size_t wall_points = 0;
    /// Per element: the wall's vertices, counter-clockwise, and its rays in the same order (a fan has several rays of
    /// one origin).
    std::vector<std::vector<VertexId>> walls;
    std::vector<std::vector<Ray>> rays;
    /// Per element: the closed outer border, counter-clockwise, simple and disjoint from the others. Where the layer is
    /// truncated to nothing it runs through wall vertices, and along wall edges between two of them: an edge that both
    /// loops have bounds no layer. Where such an edge is split, the wall has the split points, too (without rays).
    std::vector<std::vector<VertexId>> borders;
    std::vector<std::uint16_t> layer_of_point;  ///< 0 on the wall, n on layer n; split points: that of the lower end
    /// Per element; empty without layers.
    std::vector<ElementCoverage> coverage;
};

/// First height whose top lies at this y+ on a flat plate of the length `chord` in turbulent flow:
///   y+ chord / (Re sqrt(cf / 2)),  cf = 0.026 / Re^(1/7),  Re = reynolds, based on the chord.
/// Source: F. M. White, Fluid Mechanics, 5th edition (2003), p. 467. Throws UsageError for numbers that are not
/// positive.
double first_height_for(double y_plus, double reynolds, double chord);

/// Height of the n-th layer's top, n >= 0, above the wall (height 0 at n = 0); for the adaptive law on a ray where r is
/// options.growth. Source: thesis 3.3, GrowthLaw.
double layer_height(const LayerOptions& options, std::uint32_t n);

/// Makes rays, truncates them where they would meet, places the points and the outer border. Precondition: pslg passes
/// check_simple(). Neighbouring rays differ by at most one layer; every cell between them is positively oriented.
/// Throws UsageError for heights <= 0, growth <= 1 and the like, for laws without what they need (exponential: layers
/// and a thickness above layers x first_height; adaptive: layers), for heights below the resolution of the coordinates
/// and for layers absurdly thicker than the input is wide.
/// With enabled = false no rays: the walls alone, their edges split like those of any border, and borders equal to
/// them.
Layer make_layer(const Pslg& pslg, const LayerOptions& options = {});

/// What is wrong with a layer made with these options, each in one line; empty = every promise above holds. Exact where
/// a sign decides. O(n log n) in practice.
std::vector<std::string> validate(const Layer& layer, const LayerOptions& options);

}  // namespace lamina
