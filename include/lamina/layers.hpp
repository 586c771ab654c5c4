// Stages "grow rays", "close the border" and "fill the layer": the anisotropic region next to the walls.
// Source: J. K. Pardue, thesis (2015), chapters 3 and 4.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include <lamina/delaunay.hpp>
#include <lamina/export.hpp>
#include <lamina/geometry.hpp>
#include <lamina/ids.hpp>
#include <lamina/option.hpp>
#include <lamina/point.hpp>
#include <lamina/sizing.hpp>

namespace lamina {

/// The height H(n) of the top of layer n, where h is the first height and r is LayerOptions::growth.
enum class GrowthLaw {
    geometric,    ///< h (r^n - 1) / (r - 1)
    polynomial,   ///< h n^r
    exponential,  ///< T (e^(a n/N) - 1) / (e^a - 1) for N layers of total thickness T; a follows from H(1) = h
    adaptive,     ///< geometric; r of each ray, 1.05 to 1.5, makes the last of N spacings that along the wall
    aflr          ///< five equal spacings; each one after that is 1.05, 1.05^2, ... 1.5, 1.5 ... times the one below
};

/// What stands at a sharp convex corner.
enum class Corners {
    fan,    ///< several rays from the vertex
    refine  ///< one ray from the vertex, and refining rays on the edges beside it
};

/// How the points of the layer are joined. The points are the same (docs/decisions/0012).
enum class LayerTopology {
    delaunay,  ///< constrained Delaunay triangulation
    layered,   ///< the grid of rays and layers, each cell cut in two
    quads,     ///< the same grid with whole cells; triangles in fans, at steps, and where the border is divided
};

/// A first height given by the flow: the top of the first layer lies at this y+ on a flat plate.
struct YPlus {
    double y_plus = 1;
    double reynolds = 0;            ///< of the free stream, based on the chord
    std::optional<double> chord{};  ///< in units of the input; empty: the extent in x of the whole configuration
};

struct LayerOptions {
    bool enabled = true;
    /// Height of the first layer along the ray in units of the input, or the flow that it follows from.
    std::variant<double, YPlus> first_height = 1e-5;
    /// Ratio of the heights of successive layers, or the power of the polynomial law. The other laws do not use it.
    double growth = 1.2;
    GrowthLaw growth_law = GrowthLaw::geometric;
    /// Number of layers on each ray. Empty: up to isotropy, where the height of a layer reaches the distance to the
    /// neighbouring rays.
    std::optional<std::uint32_t> layers = 30;
    std::optional<double> thickness{};  ///< total height beyond which no layer goes; T of the exponential law
    double max_ray_angle_deg = 5;       ///< largest angle between neighbouring rays
    Corners corners = Corners::fan;
    LayerTopology topology = LayerTopology::delaunay;
};

LAMINA_EXPORT const OptionTable<LayerOptions>& layer_option_table();

/// Throws OptionError where an option is out of range, or where the growth law lacks what it needs (exponential: 2
/// layers or more and a thickness; adaptive: layers).
LAMINA_EXPORT void validate(const LayerOptions& options);

/// Growth of the layers with the first height in force.
struct LayerGrowth {
    GrowthLaw law = GrowthLaw::geometric;
    double first_height = 0;
    double growth = 1.2;
    std::optional<std::uint32_t> layers{};
    std::optional<double> thickness{};
};

/// Returns the growth that the options ask for round a configuration of this chord. Throws OptionError where the
/// heights contradict each other: a thickness below the first height, or below what the exponential law needs.
LAMINA_EXPORT LayerGrowth layer_growth(const LayerOptions& options, double chord);

/// Returns the first height whose top lies at this y+ on a flat plate of length `chord` in turbulent flow:
///   y+ chord / (Re sqrt(cf / 2)),  cf = 0.026 / Re^(1/7),  Re = reynolds, based on the chord.
/// Throws OptionError for numbers that are not positive. Source: F. M. White, Fluid Mechanics, 5th edition (2003), p.
/// 467.
LAMINA_EXPORT double first_height_for(double y_plus, double reynolds, double chord);

/// Returns the height of the top of layer n above the wall; 0 for n = 0. For the adaptive law it is the height on a ray
/// whose ratio is growth.growth. Source: thesis 3.3, GrowthLaw.
LAMINA_EXPORT double layer_height(const LayerGrowth& growth, std::uint32_t n);

/// Where a ray starts and where it points.
struct RayLine {
    Point origin;
    Point direction;  ///< unit vector
};

/// The heights of the layers asked for on one ray: a part of LayerHeights::table().
struct HeightColumn {
    std::size_t first = 0;     ///< where the column begins in the table
    std::uint32_t layers = 0;  ///< number of layers asked for
    double growth = 0;         ///< as Ray::growth
    double stretch = 1;        ///< as Ray::stretch
};

/// The heights of the layers asked for, ray by ray. Rays with the same law and growth share a part of the table.
class LayerHeights {
public:
    LayerHeights() = default;
    LayerHeights(std::vector<double> table, std::vector<HeightColumn> columns)
        : table_(std::move(table)), columns_(std::move(columns)) {}

    const HeightColumn& column(std::size_t ray) const { return columns_[ray]; }
    /// Returns the heights on a ray: entry n is the height of layer n, entry 0 is 0, the last is that of the last layer
    /// asked for.
    std::span<const double> of(std::size_t ray) const {
        const HeightColumn& column = columns_[ray];
        return {table_.data() + column.first, column.layers + std::size_t{1}};
    }
    /// Returns the height of all layers asked for on a ray.
    double full(std::size_t ray) const { return of(ray).back(); }
    /// Returns the height of the tallest column.
    LAMINA_EXPORT double tallest() const;
    const std::vector<double>& table() const { return table_; }

private:
    std::vector<double> table_;
    std::vector<HeightColumn> columns_;
};

/// Rays of all elements one after the other. Element e owns the rays [begin[e], begin[e + 1]), closed round the
/// element.
struct LAMINA_EXPORT RaySet {
    std::vector<RayLine> lines;
    std::vector<std::size_t> begin{0};

    std::size_t elements() const { return begin.size() - 1; }
    /// Returns, for each ray, the one that follows counter-clockwise round its element.
    std::vector<std::size_t> following() const;
};

/// The rays and the layers on each. Without layers a ray is a wall vertex without a direction.
struct Rays {
    RaySet set;
    std::vector<char> resampled;  ///< per element: Element::resampled
    bool enabled = true;          ///< LayerOptions::enabled
    LayerGrowth growth;
    LayerHeights heights;               ///< of the layers asked for
    LayerHeights fitted;                ///< the same, stretched to end where the room does
    std::vector<double> limits;         ///< height up to which each ray is free; empty without layers
    std::vector<std::uint32_t> counts;  ///< number of layers on each ray
};

/// Grows rays from the walls: one along the normal of each vertex, fans at sharp corners, refining rays between; finds
/// how far each is free, and how many layers fit on it. Neighbouring rays differ by at most one layer; every cell
/// between them is positively oriented; the fronts are simple and disjoint.
/// Precondition: check_simple(geometry). Throws OptionError for options out of range, for heights below the resolution
/// of the coordinates and for layers absurdly thicker than the input is wide.
LAMINA_EXPORT Rays grow_rays(const Geometry& geometry, const LayerOptions& options, const LayerGrowth& growth);

/// Grows rays with the growth that the options ask for round this geometry.
LAMINA_EXPORT Rays grow_rays(const Geometry& geometry, const LayerOptions& options = {});

/// Returns, per element, the closed polygon through the tips of its rays: the outer border before it is divided.
LAMINA_EXPORT std::vector<std::vector<Point>> fronts(const Rays& rays);

/// How the edges of the outer border are divided. The border is frozen afterwards, so it must suit refinement.
struct BorderOptions {
    /// Largest ratio of the lengths of adjacent edges; 1.4 serves angle bounds up to 30 degrees. Below 2 an edge that
    /// must be halved often makes its neighbours follow, all along the border. Exceeded only where division points
    /// would cross something by rounding.
    double max_ratio = 1.4;
    /// No edge is longer than 1.1 x (length of any other edge) + gradation x distance.
    double gradation = 0.1;
    double max_edge = HUGE_VAL;
    /// Round resampled elements, where an edge would be divided with this for `gradation`, further rays stand on the
    /// wall's edge below, so that rows of cells go on to the wall instead of fanning out below the division points.
    /// Empty: no further rays.
    std::optional<double> ray_gradation{};
    /// No edge is longer than size + gradation x distance of any of these, but for up to a tenth, since division points
    /// shift towards the lengths beside them.
    std::vector<SizeSource> sources{};
};

/// Throws OptionError where an option is out of range.
LAMINA_EXPORT void validate(const BorderOptions& options);

/// Largest factor by which the growth on a ray that was cut short may differ from what was asked for.
inline constexpr double largest_stretch = 1.019;

/// A line of layer points that leaves the wall.
struct Ray {
    VertexId origin;          ///< wall vertex
    Point direction;          ///< unit vector
    std::uint32_t layers;     ///< number of points made on the ray; less than asked for where it was cut short
    std::uint32_t requested;  ///< number of points asked for
    double growth;            ///< r of GrowthLaw on this ray; e^(a/N) for the exponential law
    std::size_t first_point;  ///< Layer::points[first_point + n] lies at height n + 1
    double height_limit;      ///< nothing is placed beyond this height; infinite where nothing is in the way
    /// Each spacing is `stretch` times what the law makes of the spacing below. 1 on rays with all their layers, else
    /// within largest_stretch of 1, so that layers end where the room for them does and not in steps.
    double stretch = 1;
};

/// What became of the layers asked for on some part of the walls. Cells lie between neighbouring rays, one per layer.
struct LayerCoverage {
    std::size_t rays = 0;
    std::size_t incomplete_rays = 0;  ///< with fewer layers than asked for
    std::size_t requested_cells = 0;
    std::size_t made_cells = 0;
};

/// Opposing layers of full height and the triangles between them fit into a space of so many full heights.
inline constexpr double open_space = 3;

struct LAMINA_EXPORT ElementCoverage {
    LayerCoverage all;
    /// Outside slots, coves and tight concave curvature: rays for which an empty circle of open_space x (height of all
    /// layers asked for) across touches the wall at the ray's origin, and cells between two such rays.
    LayerCoverage open;

    ElementCoverage& operator+=(const ElementCoverage& other);
};

/// Edges of walls and outer borders. An edge that both have bounds no layer.
struct LayerEdges {
    std::vector<std::vector<Segment>> walls;  ///< per element, the mesh on their left: clockwise round the body
    std::vector<Segment> region;              ///< edges that bound the layer, the layer on their left
    /// Edges of outer borders between the layer and the outer region: smaller vertex first, sorted.
    std::vector<Segment> interfaces;
};

/// The points of the layer and its outline.
struct Layer {
    /// Wall vertices first (element by element; the vertex of a refining ray stands where it lies on the wall), then
    /// ray points, then division points of the outer border. All distinct. Ray points lie strictly between wall and
    /// border.
    std::vector<Point> points;
    std::size_t wall_points = 0;
    /// Per element: the wall's vertices, counter-clockwise, and its rays in the same order. A fan has several rays of
    /// one origin.
    std::vector<std::vector<VertexId>> walls;
    std::vector<std::vector<Ray>> rays;
    /// Per element: the closed outer border, counter-clockwise, simple and disjoint from the others. Where the layer is
    /// cut short to nothing it runs through wall vertices, and along wall edges between two of them. Where such an edge
    /// is divided, the wall has the division points, too (without rays).
    std::vector<std::vector<VertexId>> borders;
    std::vector<std::uint16_t> layer_of_point;  ///< 0 on the wall, n on layer n; division points: that of the lower end
    std::vector<ElementCoverage> coverage;      ///< per element; empty without layers
    LayerGrowth growth;
    LayerEdges edges;
};

/// Sorts out the edges of the walls and borders of a layer: Layer::edges.
LAMINA_EXPORT LayerEdges layer_edges(const Layer& layer);

/// Places the points on the rays and divides the outer border so that it can be frozen; adds rays where that is asked
/// for. Throws OptionError for options out of range.
LAMINA_EXPORT Layer close_border(Rays rays, const BorderOptions& options = {});

/// Returns, per element, the closed outer border as points.
LAMINA_EXPORT std::vector<std::vector<Point>> border_loops(const Layer& layer);

/// The cells between walls and outer borders, all counter-clockwise, and the pieces that they were made in.
struct LayerCells {
    std::vector<Triangle> triangles;
    std::vector<Quad> quads;
    std::vector<std::uint16_t> triangle_layer, quad_layer;  ///< per cell: its layer from the wall, from 1 on
    std::vector<std::size_t> first_triangle;  ///< of each piece, and the end; empty where there is no layer
    DecompositionStats decomposition;         ///< for LayerTopology::delaunay

    std::size_t pieces() const { return first_triangle.empty() ? 0 : first_triangle.size() - 1; }
};

/// Joins the points of the layer in the topology asked for. Only the Delaunay triangulation is made in several pieces.
LAMINA_EXPORT LayerCells fill_layer(const Layer& layer, LayerTopology topology,
                                    const DecompositionOptions& options = {});

/// Returns what is wrong with a layer made with these options, one line each; empty: every promise above holds. Exact
/// where a sign decides; O(n log n) in practice.
LAMINA_EXPORT std::vector<std::string> check_layer(const Layer& layer, const LayerOptions& options,
                                                   const BorderOptions& border = {});

}  // namespace lamina
