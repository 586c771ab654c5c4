// The layer and its cells, as values: make_layer() -> Layer, fill_layer() -> LayerCells.
// Source: J. K. Pardue, thesis (2015), chapters 3 and 4.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <lamina/export.hpp>
#include <lamina/geometry.hpp>
#include <lamina/ids.hpp>
#include <lamina/layers.hpp>
#include <lamina/point.hpp>
#include <lamina/sizing.hpp>
#include <lamina/triangulation.hpp>

#include "layers/growth.hpp"

namespace lamina::layers {

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
    /// No edge is longer than size + gradation x distance of any of these sources.
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
    bool along_line = false;          ///< whether it runs along a line inside the domain, of which it is a part
    /// The wall's vertices between this ray and the next one: a sharp concave corner and those so near to it that no
    /// first layer fits between its sides. They have no rays. Empty elsewhere.
    std::vector<VertexId> corner_after{};

    /// Returns the vertex at the top of layer n; the wall vertex for n = 0. Precondition: n <= layers.
    VertexId vertex(std::uint32_t n) const { return n == 0 ? origin : VertexId(first_point + n - 1); }
    /// Returns the vertex at the end of the ray.
    VertexId tip() const { return vertex(layers); }
};

/// On which side of a ray there is none of the layer.
enum class BareSide { before, after };

/// Returns how the border runs along a ray with one layer, where one beside it has the same origin and no layer: after
/// it or before it. The border may divide the edge that it has in common with the ray.
///
///         tip _____ border              the ray before or after this one, at the
///        ____/| ray                     same vertex of the wall, has no layer
///     ______/_|______ wall
///
inline std::optional<BareSide> bare_side_of(std::span<const Ray> rays, std::size_t i) {
    const std::size_t n = rays.size();
    const auto is_bare = [&](std::size_t k) { return rays[k].layers == 0 && rays[k].origin == rays[i].origin; };
    if (rays[i].layers != 1) return {};
    if (is_bare((i + n - 1) % n)) return BareSide::before;
    if (is_bare((i + 1) % n)) return BareSide::after;
    return {};
}

/// The edges of walls and outer borders. An edge that belongs to a wall and to an outer border has no layer beside it.
struct LayerEdges {
    std::vector<std::vector<Segment>> walls;  ///< one list per element, the mesh on the left: clockwise round the body
    std::vector<Segment> region;              ///< edges that bound the layer, the layer on their left
    std::vector<Segment> sides;               ///< those of them on the sides of the domain, beside outer walls
    std::vector<Segment> symmetry;            ///< those of them on the line of symmetry, before and behind bodies
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
    /// Number of outer walls, which are the last elements: their walls, rays and borders lead from one side of the
    /// domain to the other, and none of them is closed.
    std::size_t outer_walls = 0;

    /// One per element: whether its wall and its border lead from one place on the border of the domain to another, as
    /// those of outer walls do, and of bodies that a line of symmetry cuts. Empty: none does.
    std::vector<char> open{};

    /// Returns whether an element is an outer wall.
    bool is_outer(std::size_t element) const { return element + outer_walls >= borders.size(); }
    /// Returns whether wall and border of an element are open.
    bool is_open(std::size_t element) const { return !open.empty() && open[element] != 0; }
};

/// Returns the edges of the walls and borders of a layer: Layer::edges.
LAMINA_EXPORT LayerEdges layer_edges(const Layer& layer);

/// Makes the layer of these walls. From each vertex of the wall one ray leaves along the normal; sharp corners have
/// fans or refining rays. Each ray gets the layers that fit before something is in its way. Neighbouring rays differ by
/// at most one layer, every cell between them is positively oriented, and the fronts are simple and disjoint. The
/// fronts are divided and become outer borders that can be frozen. Precondition: check_simple(geometry). Throws
/// OptionError for options out of range, for heights below the resolution of the coordinates and for layers absurdly
/// thicker than the input is wide.
/// Source: J. K. Pardue, thesis (2015), chapter 3.
LAMINA_EXPORT Layer make_layer(const Geometry& geometry, const LayerOptions& options, const LayerGrowth& growth,
                               const BorderOptions& border = {});

/// Makes the layer with the growth that the options request round this geometry; its extent in x is the chord.
LAMINA_EXPORT Layer make_layer(const Geometry& geometry, const LayerOptions& options = {},
                               const BorderOptions& border = {});

/// Measures how evenly a layer ends.
LAMINA_EXPORT BorderSteps border_steps(const Layer& layer);

/// Returns, for each element, the points of its outer border as a closed loop: that of an outer wall runs there and
/// back.
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
/// Exact where a sign decides; O(n log n) in practice. Precondition: there are no outer walls.
LAMINA_EXPORT std::vector<std::string> check_layer(const Layer& layer, const LayerOptions& options,
                                                   const BorderOptions& border = {});

}  // namespace lamina::layers
