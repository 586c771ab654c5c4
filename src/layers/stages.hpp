// The stages of the layer, and what goes from one to the next: grow_rays() -> Rays, close_border() -> Layer.
// docs/layer.md says how rays are made.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <lamina/geometry.hpp>
#include <lamina/layers.hpp>
#include <lamina/point.hpp>

#include "geometry/wall_spacing.hpp"
#include "layers/layer.hpp"
#include "layers/parameters.hpp"

namespace lamina::layers {

/// The origin and the direction of a ray.
struct RayLine {
    Point origin;                     ///< a point of the wall, or of a wake
    Point direction;                  ///< unit vector
    RayPlace place = RayPlace::wall;  ///< where it stands
    /// Its first height over the one wanted: above 1 along wakes, below 1 where a wall has no room
    /// (docs/layer.md).
    double opening = 1;
    double least_height = 0;  ///< that of its column: LayerGrowth::least_heights or WakePoint
    /// Height along the ray over the height above the wall's edges beside it, which the growth law gives: 1 for a ray
    /// along their normals, 1.41 for one out of a cove corner of 90 degrees; at most max_slant.
    double slant = 1;
    /// The ray bends away from its line, by half of this vector at the height half_shift and by all of it far from the
    /// wall, so that the first layer has its height above both edges at a corner out of which the ray leans; zero
    /// elsewhere (docs/layer.md).
    Point shift{};
    double half_shift = 0;  ///< 0 where all layers are shifted by the same vector
    /// The wall's vertices between this ray and the next one, in their order: a sharp concave corner and those so near
    /// to it that no first layer fits between its sides. They have no rays. Empty elsewhere (docs/layer.md).
    std::vector<Point> corner_after{};
    bool on_symmetry = false;       ///< whether it lies in the line of symmetry, and so do all its points, exactly
    double line_room = 0;           ///< LineFoot::room where it runs along an inner line; else 0
    double most_height = HUGE_VAL;  ///< OuterWall::thickest on outer walls

    /// Returns its point at a height above 0 along its direction.
    Point at(double height) const { return origin + (height * direction + height / (height + half_shift) * shift); }
};

/// A stretch makes a column of layers end at a given height, with a given last spacing. Layers up to `above` keep their
/// heights. The growth from layer to layer above it is that of the law times `factor`, times factor * change, times
/// factor * change^2, and so on.
struct Stretch {
    double factor = 1;        ///< 1, with a change of 1, where nothing is stretched
    double change = 1;        ///< 1 where the last spacing is free
    std::uint32_t above = 0;  ///< at least 1 where anything is stretched: the first layer never is
};

/// The column of heights on one ray: a part of LayerHeights::table().
struct HeightColumn {
    std::size_t first = 0;           ///< index in the table where the column begins
    std::uint32_t layers = 0;        ///< number of layers up to the front
    std::uint32_t asked_layers = 0;  ///< number of layers up to the asked height
    bool cut = false;                ///< whether the front is lower than the asked height
    double growth = 0;               ///< as Ray::growth
    Stretch stretch{};               ///< of its upper half; none with all the layers of a requested number
};

/// The heights of layers up to the front, ray by ray.
class LayerHeights {
public:
    LayerHeights() = default;
    /// Makes heights from a table and the column of each ray. Precondition: the columns lie within the table.
    LayerHeights(std::vector<double> table, std::vector<HeightColumn> columns)
        : table_(std::move(table)), columns_(std::move(columns)) {}

    /// Returns the column of a ray.
    const HeightColumn& column(std::size_t ray) const { return columns_[ray]; }
    /// Returns the heights on a ray. Entry n is the height of layer n, and entry 0 is 0.
    std::span<const double> of(std::size_t ray) const {
        const HeightColumn& column = columns_[ray];
        return {table_.data() + column.first, column.layers + std::size_t{1}};
    }
    /// Returns the heights of all columns, one column after the other.
    const std::vector<double>& table() const { return table_; }

private:
    std::vector<double> table_;
    std::vector<HeightColumn> columns_;
};

/// The rays of all elements, one element after the other. Element e owns the rays [begin[e], begin[e + 1]) in
/// counter-clockwise order; the first one follows the last. An element with a wake begins at the left side of its
/// trailing edge, and its last rays are those of the wake, out to its end and back. A sharp trailing edge then is the
/// origin of a ray on either side; a base has no rays.
struct RaySet {
    std::vector<RayLine> lines;         ///< the rays
    std::vector<std::size_t> begin{0};  ///< the first ray of each element, then the number of rays

    /// Returns the number of elements.
    std::size_t elements() const { return begin.size() - 1; }
    /// Returns, for each ray, the index of the ray that follows counter-clockwise round its element.
    std::vector<std::size_t> following() const;
};

/// The space between a blunt base and the point behind it where both sides of a wake meet, cut into strips between
/// chains of points that run from the right to the left of the flow.
struct WakeCore {
    std::size_t element = 0;                 ///< index of the element
    std::vector<std::vector<Point>> chains;  ///< the first one is the base, the last one a point
    /// Indices of the chains that end at stations, which are the origins of rays, ascending. The chains between have
    /// the ends of the chain before.
    std::vector<std::size_t> stations;
};

/// Returns the place on the curve of a wall at a share, in (0, 1), of the way from one of its points to the next one,
/// counter-clockwise; nothing where the wall is straight there.
using PlaceOnWall = std::function<std::optional<Point>(Point from, Point to, double share)>;

/// The rays and the number of layers on each. If the layer is disabled, each wall vertex has one ray without a
/// direction and without layers.
struct Rays {
    RaySet set;                   ///< origins and directions
    std::vector<char> resampled;  ///< one per element: Element::resampled
    /// One per element: whether it is resampled between so many corners that it is not smooth, as iced ones are. Rays
    /// stand at its vertices alone, lest neighbouring edges differ by whole factors (docs/layer.md).
    std::vector<char> jagged;
    bool enabled = true;  ///< LayerOptions::enabled
    /// LayerOptions::topology. Last layers of quadrilaterals stay lower than others, since faces between them would be
    /// more skewed (docs/layer.md). Tops of cells of the grid on resampled walls stay whole where they are little
    /// longer than asked for: a point on a flat one makes an angle near 180 degrees, where a Delaunay triangulation
    /// joins it to points farther below.
    LayerTopology topology = LayerTopology::layered;
    LayerGrowth growth;                 ///< the growth that was requested
    std::vector<double> asked;          ///< height along each ray at which its layers are to end; empty if disabled
    std::vector<double> limits;         ///< height beyond which something is in a ray's way; empty if disabled
    std::vector<double> front;          ///< height at which the columns end, at most the asked one; empty if disabled
    LayerHeights heights;               ///< the columns up to the front
    std::vector<std::uint32_t> counts;  ///< number of layers on each ray
    std::vector<double> wake_lengths;   ///< one per element: length of the wake with layers, 0 without
    std::vector<WakeCore> cores;        ///< behind bases of elements whose layers go on along a wake
    /// One per element: the number behind its last ray in the domain. All rays of a body are there, unless a line of
    /// symmetry cuts it.
    std::vector<std::size_t> domain_ends;
    std::size_t outer_walls = 0;  ///< number of elements behind the bodies that are outer walls
    /// Number of last elements, images in a line of symmetry, copies in a row of blades or obstacles: none is in the
    /// domain.
    std::size_t images = 0;
    /// Number of copies of all bodies in a row of blades, with which images begin: their rays are as high. 0: no row.
    std::size_t copies = 0;
    PlaceOnWall place_on_wall{};  ///< where the wall's edges are divided; empty: on the straight edges

    /// Returns the number of elements of which a part is in the domain.
    std::size_t shown() const { return set.elements() - images; }
    /// Returns whether an element is an outer wall.
    bool is_outer(std::size_t element) const { return element + outer_walls >= shown() && element < shown(); }
    /// Lowers values of rays to the smallest of their copies in a row.
    template <class T>
    void lower_to_copies(std::vector<T>& values) const {
        const std::size_t n = set.begin[shown()], end = (copies + 1) * n;
        for (std::size_t i = n; i < end; ++i) values[i % n] = std::min(values[i % n], values[i]);
        for (std::size_t i = n; i < end; ++i) values[i] = values[i % n];
    }
    /// Returns the number behind the last ray of an element in the domain.
    std::size_t domain_end(std::size_t element) const { return domain_ends[element]; }
    /// Returns whether a part of an element is beyond the domain.
    bool is_open(std::size_t element) const { return domain_ends[element] < set.begin[element + 1]; }
};

/// A straight wall on the border of the domain, as the ground is. For the rays it is a plate that goes on beyond both
/// sides of the domain, so that layers on it end there as they would in the middle of a wall; what lies beyond the
/// sides is left out of the layer.
struct OuterWall {
    /// The outline of the plate, counter-clockwise. It begins with the part of the wall that bounds the domain.
    std::vector<Point> points;
    std::size_t in_domain = 0;   ///< number of points on that part
    double first_height = 0;     ///< of its layers, in units of the input; 0: it has none
    double thickest = HUGE_VAL;  ///< of its layers up to isotropy, in units of the input
};

/// The end of a line inside the domain at a vertex of a wall. The ray there runs along the line, whose edges become
/// edges of cells of the layer.
struct LineFoot {
    Point at;         ///< the vertex
    Point direction;  ///< of the line, away from the wall; a unit vector
    double room = 0;  ///< height along the line up to which the layer may go
};

/// Lines and outlines inside the domain that rays must not reach. They have no layers themselves.
struct Obstacles {
    std::vector<std::vector<Point>> outlines;  ///< simple and counter-clockwise, or the two ends of a line
    /// The feet of lines on walls; those of one vertex follow each other.
    std::vector<LineFoot> feet{};
    std::vector<Point> bare{};  ///< other vertices of walls at which rays have no layers
};

/// Grows rays from the walls: one along the normal of each vertex, fans at sharp corners and refining rays between
/// them. Finds the limit of each ray and the number of layers that fit below it. Neighbouring rays differ by at most
/// one layer, every cell between them is positively oriented, and the fronts are simple and disjoint. Precondition:
/// check_simple(geometry). Throws OptionError for options out of range, for heights below the resolution of the
/// coordinates and for layers absurdly thicker than the input is wide. Outer walls become elements behind those of the
/// geometry. Rays of bodies with a line of symmetry are images of each other; those on the line lie in it. Rays of
/// copies in a row of blades are as high as each other. Obstacles have no layers; in a row they come with their copies.
/// Refining rays stand on curved walls, and so do points that divide their edges later.
Rays grow_rays(const Geometry& geometry, const LayerOptions& options, const LayerGrowth& growth,
               std::span<const OuterWall> outer_walls = {}, const Obstacles& obstacles = {},
               const PlaceOnWall& place_on_wall = {});

/// A circle.
struct Circle {
    Point middle;       ///< its middle
    double radius = 0;  ///< in units of the input
};

/// Lowers the limits of the rays that end in one of these circles to a part of their heights, leads the limits over to
/// those beside, and finds the numbers of layers anew. No rays are added where numbers of layers change. Returns, for
/// each circle, how many rays with layers end in it.
std::vector<std::size_t> shorten_rays(std::span<const Circle> places, Rays& rays);

/// Returns, for each element, its front: the closed polygon through the tips of its rays, counter-clockwise. Beyond the
/// domain that of an outer wall is the wall.
std::vector<std::vector<Point>> fronts(const Rays& rays);

/// Returns the spacings of resampled walls with which their fronts would need no division by these options, wherever
/// they need one: limits for the stage "prepare". Throws OptionError for options out of range.
std::vector<geometry::WallSpacing> wall_spacings(const Rays& rays, const BorderOptions& options);

/// Places the points on the rays and divides the fronts, which become outer borders that can be frozen. Throws
/// OptionError for options out of range.
Layer close_border(const Rays& rays, const BorderOptions& options = {});

/// A cell of a layer with a large angle.
struct ObtuseCell {
    std::uint32_t column;  ///< LayerCells::triangle_column or quad_column
    std::uint16_t layer;   ///< LayerCells::triangle_layer or quad_layer
};

/// Returns the cells of a layer that have an angle above this one, which is obtuse, but for those of columns with a ray
/// that is nearer than its supplement to the walls on both sides: they cannot do without. Cells behind bases and of
/// LayerTopology::delaunay have no columns, so none of them is found.
std::vector<ObtuseCell> obtuse_cells(const Layer& layer, const LayerCells& cells, double max_angle_deg);

/// Lowers the limits of the rays beside these cells so that columns end below them, but for the first layer; leads the
/// limits over to those beside, and finds the numbers of layers anew, as shorten_rays() does. Returns whether it
/// changed any.
bool end_columns_below(std::span<const ObtuseCell> cells, Rays& rays);

}  // namespace lamina::layers
