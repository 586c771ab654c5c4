// The target edge length h(x) of the isotropic region, which walls, sources, wakes and background meshes ask for.
//
// Guarantees:
//  1. h is within SizeField::relative_error of the smallest size that any source asks for.
//  2. A field is evaluated in tens of nanoseconds, however many sources there are, and on any threads at once.
//  3. Options that by themselves ask for far more triangles than limits or 32-bit numbers allow are refused beforehand.
// Example:
//     const SizeSource disc{.a = {0, 0}, .b = {0, 0}, .size = 0.1, .radius = 1};
//     const SizeField h(std::vector{disc}, {.gradation = 0.5, .max_size = 1}, Box{{-9, -9}, {9, 9}});
//     assert(std::abs(h({2, 0}) / 0.6 - 1) < SizeField::relative_error && h({9, 9}) > 0.95);
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <lamina/export.hpp>
#include <lamina/ids.hpp>
#include <lamina/length.hpp>
#include <lamina/point.hpp>

namespace lamina {

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

/// A wall as a closed chain of points along it, with the spacing, the first height and the thickness of the layer that
/// a solution asks for at each. All lists have one entry per point.
struct SizedWall {
    std::vector<Point> points{};        ///< on the wall, or near to it
    std::vector<double> spacings{};     ///< largest distance of the wall's vertices, in units of the input
    std::vector<double> units{};        ///< height above the wall at which y+ is 1
    std::vector<double> thicknesses{};  ///< of the boundary layer
};

/// A mesh with a target edge length at each point, linear inside its triangles, which may overlap, have any orientation
/// and need not cover the domain: beyond them sizes grow by the gradation.
struct SizedMesh {
    std::vector<Point> points;        ///< vertices
    std::vector<Triangle> triangles;  ///< indices into points
    std::vector<double> sizes;        ///< one per point, in units of the input, positive
    /// Growth of sizes per unit of distance, in place of SizingOptions::gradation. A background mesh that has one, such
    /// as that of solution_sizes(), decides on all sizes beyond the layers, without wakes of the flow before the mesh.
    /// Walls, layers and their borders change only where it asks for shorter edges.
    std::optional<double> gradation{};
    /// Walls that a solution has asked something of. Their spacings count beside those of the flow before the mesh;
    /// their first heights, where these are given by y+, and their thicknesses take the place of its own.
    std::vector<SizedWall> walls{};
};

/// Options of a size field.
struct SizeFieldOptions {
    double gradation = 0.1;      ///< growth of h per unit of distance from a source
    double max_size = HUGE_VAL;  ///< largest h, in units of the input
};

/// The target edge length h(x), as a graded quadtree, which copies share. Source: P.-O. Persson, Engineering with
/// Computers 22 (2006).
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
    /// Returns the same field, evaluated faster inside a box.
    SizeField restricted_to(const Box& box) const;
    /// The values in some part of a field.
    struct Range {
        double low;   ///< the smallest one
        double high;  ///< the largest one
    };
    /// Returns the smallest and largest value inside a box, or in a part where their ratio exceeds `max_ratio`.
    Range range(const Box& box, double max_ratio = HUGE_VAL) const;
    /// Returns the integral of 1 / h^2 over the domain: sqrt(3) / 4 of the number of equilateral triangles of edge h.
    /// Precondition: the field is not uniform.
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

/// Returns the field of the sizes of a mesh: inside its triangles h exceeds the linear interpolation nowhere by more
/// than a tenth plus the relative error of the field. Throws OptionError, too, for a mesh that is not well formed, and
/// for one whose sizes ask for more triangles than 32-bit numbers can tell apart.
LAMINA_EXPORT SizeField size_field_of_mesh(const SizedMesh& mesh, const SizeFieldOptions& options, const Box& domain);

/// A line of small triangles from each trailing edge, up to the first wall in its way. Sizes grow by a tenth of the
/// gradation along the line and by the gradation beside it.
struct WakeOptions {
    std::optional<double> angle_deg{};  ///< to the x axis; empty: the angle of attack
    Length length = 2;                  ///< along the line
    std::optional<Length> size{};       ///< at the trailing edge; empty: the size there without a wake
};

/// Options of the stage "size".
struct SizingOptions {
    double gradation = 0.1;            ///< growth of h per unit of distance from walls and sources
    std::optional<Length> far_size{};  ///< largest h; empty: unbounded
    /// Largest h at the outer border of the layers; empty: the border's own edges decide.
    std::optional<Length> wall_size{};
    std::vector<SizeSource> sources{};  ///< boxes, discs and lines of the user
    std::vector<WakeOptions> wakes{};   ///< behind every trailing edge all of them
    /// Sizes of the user at the points of a mesh, as size_field_of_mesh() takes them.
    std::shared_ptr<const SizedMesh> background{};
};

LAMINA_EXPORT void validate(const SizingOptions& options);  ///< throws OptionError: an option out of range

}  // namespace lamina
