// Stages "make the layer" and "fill the layer". The layer is the anisotropic region next to the walls:
// make_layer() -> Layer, fill_layer() -> LayerCells.
// Source: J. K. Pardue, thesis (2015), chapters 3 and 4.
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include <lamina/conditions.hpp>
#include <lamina/delaunay.hpp>
#include <lamina/export.hpp>
#include <lamina/geometry.hpp>
#include <lamina/ids.hpp>
#include <lamina/length.hpp>
#include <lamina/point.hpp>
#include <lamina/sizing.hpp>

namespace lamina {

/// The law by which heights grow along a ray. H(n) is the height of the top of layer n above the wall, h the first
/// height and r LayerOptions::growth. The spacings are the differences H(n) - H(n - 1). src/layers/growth_laws.cpp
/// holds the one table of the laws: a further law gets an enumerator here and a row there.
enum class GrowthLaw {
    geometric,    ///< H(n) = h (r^n - 1) / (r - 1)
    polynomial,   ///< H(n) = h n^r
    exponential,  ///< H(n) = T (e^(a n/N) - 1) / (e^a - 1) for N layers of total thickness T; a follows from H(1) = h
    /// Geometric, with an r for each ray: the one, from 1.05 to 1.5, with which the last of the N layers is as high as
    /// the ray is away from its neighbours.
    adaptive,
    aflr  ///< five equal spacings; each one after that is 1.05, 1.05^2, ... 1.5, 1.5 ... times the one below
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

/// A first height that follows from the flow (conditions.hpp): the top of the first layer lies at this y+ on a flat
/// plate.
struct YPlus {
    double y_plus = 1;  ///< height of the first layer in units of the viscous length
};

/// Neighbouring rays of jagged walls diverge by up to this angle (LayerOptions::max_ray_angle_deg), in degrees.
inline constexpr double max_jagged_ray_angle_deg = 20;

/// Options of the layer.
struct LayerOptions {
    bool enabled = true;  ///< false: the outer region begins at the walls
    /// Height of the first layer above the wall, or the y+ that it follows from.
    std::variant<Length, YPlus> first_height = Length{1e-5};
    /// Ratio of the heights of successive layers, or the power of the polynomial law. The other laws do not use it.
    double growth = 1.2;
    GrowthLaw growth_law = GrowthLaw::geometric;  ///< the law by which heights grow
    /// Number of layers on each ray. Empty: each ray gets layers up to isotropy, where the spacing reaches the distance
    /// to the neighbouring rays.
    std::optional<std::uint32_t> layers{};
    std::optional<Length> thickness{};  ///< height above the wall beyond which no layer goes; T of the exponential law
    /// Largest angle between neighbouring rays. On jagged walls (Layer::jagged) it may be max_jagged_ray_angle_deg, and
    /// more where rays converge.
    double max_ray_angle_deg = 5;
    CornerRays corners = CornerRays::fan;  ///< the rays at sharp convex corners
    /// Whether each fan has the rays of half a turn, equal_fan_parts() + 1. Every other vertex then has one ray, whatever
    /// the angle to its neighbours, so that walls with equal numbers of vertices and fans have equal numbers of rays.
    bool equal_fans = false;
    LayerTopology topology = LayerTopology::layered;  ///< how points are joined to cells
    bool wake_layers = false;                         ///< whether layers up to isotropy go on along LayerGrowth::wakes
};

/// Returns the number of parts of each fan with LayerOptions::equal_fans: as many as half a turn needs for none to exceed
/// the largest angle between rays. Corners turn by less.
LAMINA_EXPORT std::uint32_t equal_fan_parts(const LayerOptions& options);

/// Throws OptionError where an option is out of range, or where the growth law lacks a number that it needs
/// (exponential: 2 layers or more and a thickness; adaptive: a number of layers).
LAMINA_EXPORT void validate(const LayerOptions& options);

/// A height at a point of a wall.
struct WallHeight {
    std::size_t element;  ///< index in Geometry::elements
    Point at;             ///< on the wall, or near to it
    double height;        ///< above the wall, in units of the input
};

/// A point of a wake, and the heights that layers reach at least on both sides of it, in units of the input.
struct WakePoint {
    Point at;      ///< on the line of the wake
    double left;   ///< height on the left of the direction in which the line runs
    double right;  ///< height on its right
};

/// The line of a wake: points so close that it may be taken for straight between them, from the trailing edge of an
/// element on.
struct WakeLine {
    std::size_t element;            ///< index in Geometry::elements
    std::vector<WakePoint> points;  ///< two or more
};

/// The growth law and its numbers, with the first height as a length.
struct LayerGrowth {
    GrowthLaw law = GrowthLaw::geometric;   ///< LayerOptions::growth_law
    double first_height = 0;                ///< in units of the input; on elements without one of their own
    double growth = 1.2;                    ///< LayerOptions::growth
    std::optional<std::uint32_t> layers{};  ///< LayerOptions::layers
    std::optional<double> thickness{};      ///< LayerOptions::thickness, in units of the input
    std::vector<double> first_heights{};    ///< one per element, in units of the input; empty: no element has its own
    /// Heights that columns up to isotropy reach at least, where there is room: those of the flow's boundary layers.
    /// Each element has none, or a closed chain of them in the order of its wall; they are linear in between.
    std::vector<WallHeight> least_heights{};
    /// Lines along which the layers of both sides go on behind a sharp trailing edge or a base, at most one per element
    /// (LayerOptions::wake_layers).
    std::vector<WakeLine> wakes{};
    /// CaseOptions::fineness: least heights are reached with so many times the usual number of layers.
    double fineness = 1;

    /// Returns the first height on an element.
    double first_height_on(std::size_t element) const {
        return first_heights.empty() ? first_height : first_heights[element];
    }
};

/// Returns the growth that the options request in these conditions, with LayerGrowth::first_heights if there are any.
/// Throws OptionError where a y+ is given without a Reynolds number, and where the heights contradict each other: a
/// thickness below a first height, or too small for the exponential law.
LAMINA_EXPORT LayerGrowth layer_growth(const LayerOptions& options, const ReferenceConditions& conditions,
                                       std::vector<double> first_heights = {});

/// Returns the largest first height on any element.
LAMINA_EXPORT double largest_first_height(const LayerGrowth& growth);

/// Returns the growth on one element as though it were alone: with its own first height and least heights, as element
/// 0. Functions of a growth that know no elements take this one.
LAMINA_EXPORT LayerGrowth growth_on_element(const LayerGrowth& growth, std::size_t element);

/// Returns the first height whose top lies at this y+ on a flat plate of length `chord` in turbulent flow:
///   y+ chord / (Re sqrt(cf / 2)),  cf = 0.026 / Re^(1/7),  Re = reynolds, based on the chord.
/// Throws OptionError for numbers that are not positive. Source: F. M. White, Fluid Mechanics, 5th edition (2003), p.
/// 467.
LAMINA_EXPORT double first_height_for(double y_plus, double reynolds, double chord);

/// Returns the height of the top of layer n above the wall; 0 for n = 0. For the adaptive law it is the height on a ray
/// whose ratio is growth.growth. Source: thesis 3.3, GrowthLaw.
LAMINA_EXPORT double layer_height(const LayerGrowth& growth, std::uint32_t n);

/// Returns the height of all requested layers where it is the same on every ray. Empty where the spacing of the rays
/// decides: for layers up to isotropy and for the adaptive law.
LAMINA_EXPORT std::optional<double> requested_height(const LayerGrowth& growth);

/// The place where a ray stands.
enum class RayPlace : std::uint8_t {
    wall,      ///< on a wall
    wake,      ///< on a wake behind a trailing edge
    wake_end,  ///< at the end of a wake, where no layers are left
};

/// How the edges of the fronts are divided, which makes them outer borders. Borders are frozen afterwards: refinement
/// does not split their edges, so these must be short and even enough for it.
struct BorderOptions {
    /// Largest ratio of the lengths of adjacent edges; 1.4 serves angle bounds up to 30 degrees. Where it is below 2,
    /// halving an edge often forces its neighbours to be halved, and so on all along the border. The ratio is exceeded
    /// only where rounding would make division points cross something.
    double max_ratio = 1.4;
    /// No edge is longer than 1.1 x (length of any other edge) + gradation x distance, nor than 1.29 times that over a
    /// cell of the grid on a resampled wall: a point on the top of a flat one makes an angle near 180 degrees.
    double gradation = 0.1;
    double max_edge = HUGE_VAL;  ///< largest length of an edge, in units of the input
    /// No edge is longer than size + gradation x distance of any of these sources. An edge may exceed that by up to a
    /// tenth, since division points shift towards the lengths beside them.
    std::vector<SizeSource> sources{};
};

/// Throws OptionError where an option is out of range.
LAMINA_EXPORT void validate(const BorderOptions& options);

/// A line of layer points that leaves the wall.
struct Ray {
    VertexId origin;                  ///< wall vertex, or vertex of a wake
    Point direction;                  ///< unit vector
    std::uint32_t layers;             ///< number of layers made; less than requested where the ray is cut short
    std::uint32_t requested;          ///< number of layers requested
    double growth;                    ///< r of GrowthLaw on this ray; e^(a/N) for the exponential law
    std::size_t first_point;          ///< Layer::points[first_point + n] lies at the top of layer n + 1
    double height_limit;              ///< no point lies beyond this height; infinite where nothing is in the way
    RayPlace place = RayPlace::wall;  ///< where it stands
    /// The wall's vertices between this ray and the next one: a sharp concave corner and those so near to it that no first
    /// layer fits between its sides. They have no rays. Empty elsewhere.
    std::vector<VertexId> corner_after{};

    /// Returns the vertex at the top of layer n; the wall vertex for n = 0. Precondition: n <= layers.
    VertexId vertex(std::uint32_t n) const { return n == 0 ? origin : VertexId(first_point + n - 1); }
    /// Returns the vertex at the end of the ray.
    VertexId tip() const { return vertex(layers); }
};

/// The numbers of rays and cells on some part of the walls. Cells lie between neighbouring rays, one per layer.
struct LayerCoverage {
    std::size_t rays = 0;             ///< number of rays
    std::size_t incomplete_rays = 0;  ///< rays with fewer layers than requested
    std::size_t requested_cells = 0;  ///< number of cells if every ray had all its layers
    std::size_t made_cells = 0;       ///< number of cells made
};

/// The boundary layers of two opposing walls, and triangles between them, fit into a gap that is this many times as
/// wide as one of the two is high.
inline constexpr double open_space = 3;

/// The coverage of one element.
struct LAMINA_EXPORT ElementCoverage {
    LayerCoverage all;  ///< the whole wall, without its wake
    /// The part outside slots, coves and tight concave curvature. It consists of the rays at whose origin an empty
    /// circle touches the wall, open_space x (height of all layers requested) in diameter, and of the cells between two
    /// of these rays.
    LayerCoverage open;
    Point worst_in_the_open{};  ///< origin of the ray in the open that lacks the largest share of its layers, if any

    /// Adds the numbers of another element. The place is left as it is.
    ElementCoverage& operator+=(const ElementCoverage& other);
};

/// The edges of walls and outer borders. An edge that belongs to a wall and to an outer border has no layer beside it.
struct LayerEdges {
    std::vector<std::vector<Segment>>
        walls;                    ///< one list per element, the mesh on the left: clockwise round the element
    std::vector<Segment> region;  ///< edges that bound the layer, the layer on their left
    /// Edges of outer borders between the layer and the outer region. Each has its smaller vertex first; sorted.
    std::vector<Segment> interfaces;
};

/// The space between a blunt base and the point behind it where both sides of a wake meet, cut into strips between
/// chains of points that run from the right to the left of the flow.
struct LayerCore {
    std::size_t element = 0;                    ///< index of the element
    std::vector<std::vector<VertexId>> chains;  ///< the first one is the base, the last one a point
    /// Indices of the chains that end at stations, which are the origins of rays, ascending. The chains between have
    /// the ends of the chain before.
    std::vector<std::size_t> stations;
};

/// The end of a cleft, where a strip of triangles joins the fronts on both sides of a sharp corner.
struct LayerCleft {
    std::size_t element = 0;  ///< its element
    std::size_t corner = 0;   ///< the ray before the corner (Ray::corner_after), among those of the element
    std::size_t first = 0;    ///< the first ray of the strip
    std::size_t last = 0;     ///< its last ray
    /// The outer border from the tip of `first` to that of `last`, both included.
    std::vector<VertexId> outer_edge{};
};

/// The points of the layer and its outline.
struct Layer {
    /// The wall vertices come first, element by element and in the order of the wall, those of refining rays included;
    /// then come the vertices of wakes, the ray points, and the division points of the outer border. All points are
    /// distinct. Ray points lie strictly between wall and border.
    std::vector<Point> points;
    std::size_t wall_points = 0;  ///< number of wall vertices
    /// One list per element: the wall vertices, counter-clockwise.
    std::vector<std::vector<VertexId>> walls;
    /// One list per element: the rays, in the order of the wall. The rays of a fan share one origin, and so do those on
    /// both sides of a wake.
    std::vector<std::vector<Ray>> rays;
    /// One list per element: the closed outer border, counter-clockwise, simple and disjoint from the others. It goes
    /// through the tips of all rays but those inside closed clefts. Where the rays have no layers, the border runs
    /// through wall vertices, and along wall edges between two of them. If such an edge is divided, its division points
    /// belong to the wall, too (without rays).
    std::vector<std::vector<VertexId>> borders;
    /// One number per point: 0 on the wall and on the line of a wake, n at the top of layer n. Division points have
    /// that of the lower end of the edge that they divide.
    std::vector<std::uint16_t> layer_of_point;
    std::vector<ElementCoverage> coverage;  ///< one per element; empty if the layer is disabled
    LayerGrowth growth;                     ///< the growth that was requested
    std::vector<LayerCore> cores;           ///< the spaces behind bases, parts of the layer
    std::vector<LayerCleft> clefts;         ///< those that are closed, parts of the layer, in the order of the rays
    LayerEdges edges;                       ///< layer_edges() of this layer
    /// One per element: whether it is resampled between so many corners that it is not smooth, as iced ones are.
    std::vector<char> jagged{};
};

/// Returns the edges of the walls and borders of a layer: Layer::edges.
LAMINA_EXPORT LayerEdges layer_edges(const Layer& layer);

/// Makes the layer of these walls. From each vertex of the wall one ray leaves along the normal; sharp corners have fans or
/// refining rays. Each ray gets the layers that fit before something is in its way. Neighbouring rays differ by at most one
/// layer, every cell between them is positively oriented, and the fronts are simple and disjoint. The fronts are divided and
/// become outer borders that can be frozen. Precondition: check_simple(geometry). Throws OptionError for options out of range,
/// for heights below the resolution of the coordinates and for layers absurdly thicker than the input is wide.
/// Source: J. K. Pardue, thesis (2015), chapter 3.
LAMINA_EXPORT Layer make_layer(const Geometry& geometry, const LayerOptions& options, const LayerGrowth& growth,
                               const BorderOptions& border = {});

/// Makes the layer with the growth that the options request round this geometry; its extent in x is the chord.
LAMINA_EXPORT Layer make_layer(const Geometry& geometry, const LayerOptions& options = {},
                               const BorderOptions& border = {});

/// Neighbouring columns end evenly where their ends differ in height by at most this share of a last cell.
inline constexpr double even_border_step = 1.0 / 3;

/// How evenly the layer ends. A column lies between two neighbouring rays.
struct BorderSteps {
    std::size_t columns = 0;         ///< number of columns in which layers were requested
    std::size_t full_columns = 0;    ///< number of those with all their layers on both rays
    std::size_t uneven_columns = 0;  ///< number of columns whose two ends differ by more than even_border_step
    double max_step = 0;             ///< largest difference, over the higher last spacing of the two rays
    Point max_step_at{};             ///< end of the first of these rays
};

/// Measures how evenly a layer ends.
LAMINA_EXPORT BorderSteps border_steps(const Layer& layer);

/// Returns, for each element, the points of its closed outer border.
LAMINA_EXPORT std::vector<std::vector<Point>> border_loops(const Layer& layer);

/// The cells between walls and outer borders, all counter-clockwise, and the pieces that they were made in.
struct LayerCells {
    std::vector<Triangle> triangles;  ///< counter-clockwise
    std::vector<Quad> quads;          ///< counter-clockwise
    /// One per triangle: its layer, counted from 1 at the wall. It is that of the triangle's highest corner with
    /// LayerTopology::delaunay, and that of the grid cell that the triangle is part of with the others.
    std::vector<std::uint16_t> triangle_layer;
    std::vector<std::uint16_t> quad_layer;  ///< one per quad: its layer from the wall, from 1 on
    /// One per triangle of a grid: the column that it is part of, between two neighbouring rays, with the number of the
    /// first of them among the rays of all elements; no_column behind bases and in closed clefts. Empty for
    /// LayerTopology::delaunay.
    std::vector<std::uint32_t> triangle_column;
    std::vector<std::uint32_t> quad_column;   ///< the same, one per quad
    std::vector<std::size_t> first_triangle;  ///< of each piece, then the end; empty where there is no layer
    DecompositionStats decomposition;         ///< for LayerTopology::delaunay
    /// Whether cells of a grid would have crossed each other, so that all cells are those of LayerTopology::delaunay.
    bool grid_refused = false;

    /// The column of a cell that stands between no rays.
    static constexpr std::uint32_t no_column = 0xffffffffu;

    /// Returns the number of pieces.
    std::size_t pieces() const { return first_triangle.empty() ? 0 : first_triangle.size() - 1; }
};

/// Joins the points of the layer in this topology. Only the Delaunay triangulation is made in several pieces. Where
/// layers are so thick that cells of the grid cross each other, all are those of LayerTopology::delaunay.
LAMINA_EXPORT LayerCells fill_layer(const Layer& layer, LayerTopology topology,
                                    const DecompositionOptions& options = {});

/// Returns the defects of a layer that was made with these options, one line each; empty: every promise above holds.
/// Exact where a sign decides; O(n log n) in practice.
LAMINA_EXPORT std::vector<std::string> check_layer(const Layer& layer, const LayerOptions& options,
                                                   const BorderOptions& border = {});

}  // namespace lamina
