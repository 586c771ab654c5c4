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
#include <lamina/option.hpp>
#include <lamina/point.hpp>

namespace lamina {

/// Frozen edges (separators, outer borders of layers) are at most this share of h long: refinement makes edges of 0.82
/// h on average, and up to 1.24 sqrt(A) = 0.82 h no refinement vertex encroaches (docs/decisions/0003).
inline constexpr double frozen_share = 0.8;

/// Returns the edge length of the equilateral triangle of this area: the size that bounds triangles to it.
inline double size_for_area(double area) { return std::sqrt(area / 0.43301270189221932); }

/// A shape that asks for a target edge length on it and round it: h(x) <= size + gradation x distance(x, shape). A
/// point inside a box, or within `radius` of the shape, is at distance 0.
struct SizeSource {
    enum class Shape : std::uint8_t {
        segment,  ///< from a to b; a point where they are equal
        box,      ///< axis-parallel; a is the lower and b the upper corner
    };
    Point a, b;
    double size;
    double radius = 0;  ///< a point with a radius is a disc
    Shape shape = Shape::segment;
};

/// Returns the distance from p to the shape; 0 inside it.
LAMINA_EXPORT double distance_to(const SizeSource& source, Point p);
/// Returns the box round the shape, its radius included.
LAMINA_EXPORT Box bounding_box(const SizeSource& source);

/// Reads "box:X0,Y0,X1,Y1,H", "circle:X,Y,R,H" or "line:X0,Y0,X1,Y1,H". Throws UsageError with the bare reason.
LAMINA_EXPORT SizeSource parse_size_source(const std::string& text);
/// Returns the text that parse_size_source() reads back.
LAMINA_EXPORT std::string size_source_text(const SizeSource& source);

/// A mesh with a target edge length at each point, linear inside its triangles. Triangles may overlap, have any
/// orientation and need not cover the domain: beyond them sizes grow by the gradation.
struct SizedMesh {
    std::vector<Point> points;
    std::vector<Triangle> triangles;
    std::vector<double> sizes;  ///< one per point, in units of the input, positive
};

struct SizeFieldOptions {
    double gradation = 0.1;      ///< growth of h per unit of distance from a source
    double max_size = HUGE_VAL;  ///< largest h
};

/// The target edge length h(x). It is evaluated in tens of nanoseconds from a graded quadtree, whatever the number of
/// sources, and is within `relative_error` of the exact minimum over the sources. Copies share the tree.
/// Source: P.-O. Persson, Engineering with Computers 22 (2006); docs/decisions/0016.
class LAMINA_EXPORT SizeField {
public:
    /// Makes a field of the same size everywhere. Throws OptionError unless the size is positive and finite.
    explicit SizeField(double uniform_size);
    /// Makes the field h(x) = min(max_size, min over sources (size + gradation x distance)) inside `domain`; points
    /// outside get the value at the nearest point of the domain. Throws OptionError for sizes that are not positive, a
    /// negative gradation, an empty domain, and where there is neither a source nor a max_size.
    SizeField(std::span<const SizeSource> sources, const SizeFieldOptions& options, const Box& domain);

    double operator()(Point p) const;
    /// Returns the same field, evaluated faster inside a box: the walk down the tree starts at the smallest cell that
    /// holds the box. Points outside the box keep their values.
    SizeField restricted_to(const Box& box) const;
    struct Range {
        double low, high;
    };
    /// Returns the smallest and largest value inside a box. The search ends early, with the range so far, once the
    /// largest exceeds `enough` x the smallest.
    Range range(const Box& box, double enough = HUGE_VAL) const;
    /// Returns the integral of 1 / h^2 over the domain: sqrt(3) / 4 of the number of equilateral triangles of edge h.
    /// Precondition: the field is not uniform, since a uniform field has no domain.
    double inverse_square_integral() const;
    /// Returns the number of leaves of the tree.
    std::size_t cells() const;
    /// Returns the growth per unit of distance that the field was made with; 0 for a uniform field.
    double gradation() const { return gradation_; }
    bool is_uniform() const { return tree_ == nullptr; }

    static constexpr double relative_error = 0.05;

private:
    struct Tree;
    /// The cell of the tree that evaluation starts at: its node, and the position of any point in it.
    struct Start {
        std::uint32_t node = 0;
        int shift = 0;
        std::uint64_t x = 0, y = 0;
    };

    std::shared_ptr<const Tree> tree_;
    Start start_;
    double uniform_ = 0;
    double gradation_ = 0;
};

/// A line of small triangles from each trailing edge, up to the first wall in its way. Sizes grow by a tenth of the
/// gradation along the line and by the gradation beside it.
struct WakeOptions {
    double angle_deg = 0;          ///< to the x axis
    double length = 2;             ///< in chords: extents in x of the whole configuration
    std::optional<double> size{};  ///< at the trailing edge; empty: what the layer's border has there
};

/// Reads "ANGLE[:LENGTH[:SIZE]]". Throws UsageError with the bare reason.
LAMINA_EXPORT WakeOptions parse_wake(const std::string& text);
/// Returns the text that parse_wake() reads back.
LAMINA_EXPORT std::string wake_text(const WakeOptions& wake);

struct SizingOptions {
    SizeFieldOptions field;
    /// Largest h at the outer border of the layers; empty: the border's own edges decide.
    std::optional<double> wall_size{};
    std::vector<SizeSource> sources{};  ///< boxes, discs and lines of the user
    std::optional<WakeOptions> wake{};
    /// Sizes of the user at the points of a mesh. Nowhere in a triangle does h exceed the linear interpolation by more
    /// than a tenth and the relative error of the field.
    std::shared_ptr<const SizedMesh> background{};
};

LAMINA_EXPORT const OptionTable<SizingOptions>& sizing_option_table();

/// Throws OptionError where an option is out of range.
LAMINA_EXPORT void validate(const SizingOptions& options);

/// Returns the growth of the edges of a frozen border per unit of distance that suits a field of this gradation. It is
/// less than the gradation, since edges are divided into whole numbers of pieces.
LAMINA_EXPORT double border_gradation(const SizeFieldOptions& field);

/// Closed loops of points, without the first one again.
using Loops = std::span<const std::vector<Point>>;

/// The bodies as sizes see them.
struct SizedBodies {
    std::vector<std::vector<Point>> walls;  ///< outlines, counter-clockwise
    std::vector<Point> trailing_edges;      ///< where wakes begin
    double chord = 1;                       ///< extent in x of the whole configuration
};

/// Throws OptionError where an option asks by itself for more triangles than 32-bit numbers can tell apart in `domain`.
/// The message says for how many.
LAMINA_EXPORT void require_countable(const SizingOptions& options, const SizedBodies& bodies, const Box& domain);

/// Throws OptionError where the sizes together ask for more triangles than 32-bit numbers can tell apart.
LAMINA_EXPORT void require_countable(const SizeField& size);

/// What asks for sizes beside the outer borders of the layers.
struct SizeRequests {
    std::vector<SizeSource> sources;     ///< all: the user's, wakes and the background mesh
    std::vector<SizeSource> at_borders;  ///< those that may bind at the outer borders of the layers
};

/// Gathers the sources of the options: the user's own, wakes, and the points of the background mesh. `fronts` are the
/// outer ends of the layers before they are divided (fronts() of layers.hpp): a wake without a size begins with the
/// size that they have at the trailing edge.
LAMINA_EXPORT SizeRequests gather_size_requests(const SizingOptions& options, const SizedBodies& bodies, Loops fronts,
                                                const Box& domain);

/// Makes h(x) from the outer borders of the layers, whose edges ask for the size that they are a fit share of
/// (frozen_share), and from further sources.
LAMINA_EXPORT SizeField make_size_field(Loops borders, std::span<const SizeSource> sources,
                                        const SizingOptions& options, const Box& domain);

}  // namespace lamina
