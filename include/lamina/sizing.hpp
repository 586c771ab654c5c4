// Stage "size": the target edge length h(x) of the isotropic region.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <lamina/export.hpp>
#include <lamina/ids.hpp>
#include <lamina/length.hpp>
#include <lamina/point.hpp>

namespace lamina {

struct WorkLimits;  // limits.hpp

/// Frozen edges (separators, outer borders of layers) are at most this share of h long. Refinement makes edges of h on
/// average, and no vertex that it has to place encroaches upon a frozen edge of up to 1.06 h where h is constant.
inline constexpr double frozen_share = 1.0;

/// The area of an equilateral triangle divided by its squared edge: sqrt(3) / 4.
inline constexpr double equilateral_area = 0.43301270189221932;

/// Returns the size that bounds the areas of triangles to this one, where max_area_ratio (RefineOptions) is as given.
inline double size_for_area(double area, double max_area_ratio) {
    return std::sqrt(area / (max_area_ratio * equilateral_area));
}

/// A shape that requests a target edge length on it and round it: h(p) <= size + gradation x distance(p, shape). A
/// point inside a box, or within `radius` of the shape, is at distance 0.
struct SizeSource {
    /// The shape between a and b. It lies in the box that they span.
    enum class Shape : std::uint8_t {
        segment,  ///< from a to b; a point where they are equal
        box,      ///< axis-parallel; a is the lower and b the upper corner
    };
    Point a;                       ///< one end of the segment, or the lower left corner of the box
    Point b;                       ///< the other end of the segment, or the upper right corner of the box
    double size;                   ///< requested edge length, in units of the input
    double radius = 0;             ///< in units of the input; a point with a radius is a disc
    Shape shape = Shape::segment;  ///< whether a and b mean a segment or a box
};

/// Returns the distance from p to the shape; 0 inside it.
LAMINA_EXPORT double distance_to(const SizeSource& source, Point p);
/// Returns the box round the shape, its radius included.
LAMINA_EXPORT Box bounding_box(const SizeSource& source);

/// Reads "box:X0,Y0,X1,Y1,H", "circle:X,Y,R,H" or "line:X0,Y0,X1,Y1,H", where H is the size. Throws UsageError with the
/// bare reason.
LAMINA_EXPORT SizeSource parse_size_source(const std::string& text);
/// Returns the text that parse_size_source() reads back.
LAMINA_EXPORT std::string size_source_text(const SizeSource& source);

/// A mesh with a target edge length at each point, linear inside its triangles. Triangles may overlap, have any
/// orientation and need not cover the domain: beyond them sizes grow by the gradation.
struct SizedMesh {
    std::vector<Point> points;        ///< vertices
    std::vector<Triangle> triangles;  ///< indices into points
    std::vector<double> sizes;        ///< one per point, in units of the input, positive
    /// Growth of sizes per unit of distance from walls, borders and sources, in place of SizingOptions::gradation. A
    /// background mesh that has one, such as that of solution_sizes(), decides on all sizes beyond the layers: the wakes
    /// that the flow before the mesh finds are left out. Walls, layers and the edges of their borders stay as they are
    /// without it, but where it asks for shorter edges.
    std::optional<double> gradation{};
};

/// Options of a size field.
struct SizeFieldOptions {
    double gradation = 0.1;      ///< growth of h per unit of distance from a source
    double max_size = HUGE_VAL;  ///< largest h, in units of the input
};

/// The target edge length h(x). It is evaluated in tens of nanoseconds from a graded quadtree, whatever the number of
/// sources, and is within `relative_error` of the exact minimum over the sources. Copies share the tree.
/// Source: P.-O. Persson, Engineering with Computers 22 (2006).
class LAMINA_EXPORT SizeField {
public:
    /// Makes a field of the same size everywhere. Throws OptionError unless the size is positive and finite.
    explicit SizeField(double uniform_size);
    /// Makes the field h(x) = min(max_size, min over sources (size + gradation x distance)) inside `domain`; points
    /// outside get the value at the nearest point of the domain. Throws OptionError for sizes that are not positive, a
    /// negative gradation, an empty domain, and where there is neither a source nor a max_size.
    SizeField(std::span<const SizeSource> sources, const SizeFieldOptions& options, const Box& domain);

    /// Returns h(p) in units of the input.
    double operator()(Point p) const;
    /// Returns the same field, evaluated faster inside a box: the walk down the tree starts at the smallest cell that
    /// holds the box. Points outside the box keep their values.
    SizeField restricted_to(const Box& box) const;
    /// The values in some part of a field.
    struct Range {
        double low;   ///< the smallest one
        double high;  ///< the largest one
    };
    /// Returns the smallest and largest value inside a box. The search ends early, with the range so far, once the
    /// largest exceeds `max_ratio` x the smallest.
    Range range(const Box& box, double max_ratio = HUGE_VAL) const;
    /// Returns the integral of 1 / h^2 over the domain: sqrt(3) / 4 of the number of equilateral triangles of edge h.
    /// Precondition: the field is not uniform, since a uniform field has no domain.
    double inverse_square_integral() const;
    /// Returns the number of leaves of the tree.
    std::size_t cells() const;
    /// Returns the growth per unit of distance that the field was made with; 0 for a uniform field.
    double gradation() const { return gradation_; }
    /// Returns whether the field was made with the same size everywhere.
    bool is_uniform() const { return tree_ == nullptr; }

    /// Bound of the relative difference from the exact minimum over the sources.
    static constexpr double relative_error = 0.05;

private:
    struct Tree;
    /// The cell of the tree at which evaluation starts.
    struct Start {
        std::uint32_t node = 0;      ///< the node of the cell
        int shift = 0;               ///< a slot of the node has sides of 2^shift keys
        std::uint64_t x = 0, y = 0;  ///< the key of any point in the cell
    };

    std::shared_ptr<const Tree> tree_;
    Start start_;
    double uniform_ = 0;
    double gradation_ = 0;
};

/// A line of small triangles from each trailing edge, up to the first wall in its way. Sizes grow by a tenth of the
/// gradation along the line and by the gradation beside it.
struct WakeOptions {
    std::optional<double> angle_deg{};  ///< to the x axis; empty: the angle of attack
    Length length = 2;                  ///< along the line
    std::optional<Length> size{};       ///< at the trailing edge; empty: the size there without a wake
};

/// Reads "ANGLE[:LENGTH[:SIZE]]", where ANGLE may be "auto". Throws UsageError with the bare reason.
LAMINA_EXPORT WakeOptions parse_wake(const std::string& text);
/// Returns the text that parse_wake() reads back.
LAMINA_EXPORT std::string wake_text(const WakeOptions& wake);

/// Options of the stage "size".
struct SizingOptions {
    double gradation = 0.1;            ///< growth of h per unit of distance from walls and sources
    std::optional<Length> far_size{};  ///< largest h; empty: unbounded
    /// Largest h at the outer border of the layers; empty: the border's own edges decide.
    std::optional<Length> wall_size{};
    std::vector<SizeSource> sources{};  ///< boxes, discs and lines of the user
    std::vector<WakeOptions> wakes{};   ///< behind every trailing edge all of them
    /// Sizes of the user at the points of a mesh. Inside its triangles h exceeds the linear interpolation nowhere by
    /// more than a tenth plus the relative error of the field.
    std::shared_ptr<const SizedMesh> background{};
};

/// Throws OptionError where an option is out of range.
LAMINA_EXPORT void validate(const SizingOptions& options);

/// Returns the growth of sizes per unit of distance beyond the layers: SizedMesh::gradation of the background mesh, or
/// SizingOptions::gradation.
LAMINA_EXPORT double field_gradation(const SizingOptions& options);

/// Returns the growth of the edges of a frozen border per unit of distance that suits a field of this gradation. It is
/// less than the gradation, since edges are divided into whole numbers of pieces.
LAMINA_EXPORT double border_gradation(double gradation);

/// Closed loops of points. The first point of a loop is not repeated at its end.
using Loops = std::span<const std::vector<Point>>;

/// The facts about the bodies that sizes depend on.
struct SizedBodies {
    std::vector<std::vector<Point>> walls;  ///< outlines, counter-clockwise
    std::vector<Point> trailing_edges;      ///< where wakes begin
    double chord = 1;                       ///< reference chord, which lengths of the options count
    double alpha_deg = 0;                   ///< angle of attack: the direction of wakes that have none of their own
};

/// Throws LimitError where an option by itself requests far more triangles in `domain` than the limits allow, or than
/// 32-bit numbers can tell apart. It takes no time. The message says how many.
LAMINA_EXPORT void require_within_limits(const SizingOptions& options, const SizedBodies& bodies, const Box& domain,
                                         const WorkLimits& limits);

/// Sources of the size field, besides the outer borders of the layers.
struct SizeRequests {
    std::vector<SizeSource> sources;     ///< all of them: the user's, wakes and points of the background mesh
    std::vector<SizeSource> at_borders;  ///< the sources that may shorten edges of the outer borders
};

/// Gathers the sources of the options: the user's own, wakes, and the points of the background mesh. `fronts` are the
/// fronts of the layers (fronts() of layers.hpp): a wake without a size begins with the size that they and the other
/// sources request at the trailing edge. Throws OptionError where the background mesh is not well formed or requests
/// more triangles than 32-bit numbers can tell apart.
LAMINA_EXPORT SizeRequests gather_size_requests(const SizingOptions& options, const SizedBodies& bodies, Loops fronts,
                                                const Box& domain);

/// Makes h(x) from the outer borders of the layers and from further sources. An edge of a border requests its length
/// divided by frozen_share, or more beside an edge that would otherwise be too long for the field; never more than
/// wall_size. `chord` is the reference chord.
LAMINA_EXPORT SizeField make_size_field(Loops borders, std::span<const SizeSource> sources,
                                        const SizingOptions& options, double chord, const Box& domain);

}  // namespace lamina
