// Stage "read": airfoil files and NACA names -> Geometry (docs/reference/input.md, "Input").
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <lamina/error.hpp>
#include <lamina/export.hpp>
#include <lamina/point.hpp>
#include <lamina/transformation.hpp>
#include <lamina/warning.hpp>

namespace lamina {

/// A convex vertex of an outline that turns by more than this many degrees is a sharp corner: a trailing edge, or a
/// corner of a blunt base.
inline constexpr double sharp_corner_deg = 60;

/// The base of a blunt trailing edge: the indices of its two corners in the outline, in the order of the outline.
struct Base {
    std::size_t first;  ///< the corner at which the base begins
    std::size_t last;   ///< the corner at which it ends
};

/// Places of an outline that later stages need to know.
struct OutlineFeatures {
    std::vector<std::size_t> corners;  ///< indices of the vertices that are no samples of a smooth curve, ascending
    std::optional<Base> base{};        ///< empty where the trailing edge is not blunt
    /// The sharp corner, or the middle of the base, that lies farthest downstream (at the largest x) in the rear half
    /// of the body; the rearmost vertex where there is neither.
    Point trailing_edge{};
};

/// One closed body.
struct Element {
    std::string name;             ///< name of its marker in the mesh: as legal_marker_names() makes it
    std::string given_name;       ///< the name that the options or its file give it, which may be no legal one
    std::string file;             ///< as the user gave it; "naca:0012" for generated sections
    std::string title;            ///< the title line of the file, if it has one
    std::string format;           ///< "selig", "lednicer", "table", "xy", "csv", "naca" or "points"
    std::string unit;             ///< the unit of length that the file names, such as "mm"; empty where it names none
    std::size_t points_read = 0;  ///< number of points in the file; 0 for generated sections
    /// The outline, counter-clockwise: the body lies on the left of every edge. The first point is not repeated.
    std::vector<Point> points;
    /// Per point: its line in the file, or its number, from 1, among points in memory; 0 where lamina added the point.
    std::vector<std::size_t> lines;
    std::vector<std::string> repairs;  ///< repairs by the reader: "line 12: duplicate of line 11 removed (0.5, 0.1)"
    std::vector<std::string> transformations;  ///< what transformed() did, in order
    std::vector<Warning> warnings;             ///< by the reader; their messages do not name the element
    std::vector<std::string> surface_notes;    ///< changes that prepare_surfaces() made to the points, and why
    /// Whether the points are many samples of a curve, exact or smoothed, of which prepare_surfaces() takes as many as a wall needs.
    bool samples_of_curve = false;
    /// Indices of points, ascending, that are corners however little the outline turns there: those that a flap makes,
    /// and where the two parts of the mean line of a NACA section meet.
    std::vector<std::size_t> given_corners;
    bool resampled = false;  ///< whether prepare_surfaces() chose the spacing of points, of all or of some stretches
    /// Whether the outline is smooth but at few corners, as iced ones are not, and its points are evenly spaced: they are
    /// resampled, or prepare_surfaces() kept them though it need not.
    bool smooth = false;
    /// Whether prepare_surfaces() kept the points although the options ask for others, which would have crossed.
    bool surface_restored = false;
    OutlineFeatures features;  ///< set by prepare_surfaces()
};

/// Bodies that are closed, simple and pairwise disjoint.
struct Geometry {
    std::vector<Element> elements;  ///< in the order of the inputs
    /// The box round the elements without GeometryOptions' rotations and flaps: its width is the chord of the
    /// configuration before it is turned. Empty where nothing is turned, and where the configuration stood upright.
    std::optional<Box> unturned_box{};
};

/// Returns the box round all elements.
LAMINA_EXPORT Box bounding_box(const Geometry& geometry);

/// Returns the box whose width is the reference chord, for reference_conditions(): Geometry::unturned_box, else
/// bounding_box().
LAMINA_EXPORT Box reference_box(const Geometry& geometry);

/// Options of read_geometry().
struct GeometryOptions {
    std::vector<std::string>
        names{};  ///< marker names, one per element; empty: file stems, or "airfoil" for one element. Those that are
                  ///< not legal are changed (marker_names.hpp), with a warning of the element
    /// Surface points of `naca:` inputs that do not give their number; 0: many samples of the formula, of which
    /// prepare_surfaces() takes as many as a wall needs (Element::samples_of_curve).
    std::size_t naca_points = 0;
    bool close = false;        ///< whether open outlines are closed by straight edges, however long
    bool mirror_half = false;  ///< whether files hold one half of symmetric sections, which is mirrored
    std::vector<Transformation> transformations{};  ///< applied in this order: transformed()
};

/// Throws OptionError where an option is out of range.
LAMINA_EXPORT void validate(const GeometryOptions& options);

/// Reads every input, which is a path, "-" for standard input, or `naca:DIGITS[:POINTS][:blunt|:extended]`, and
/// repairs, orients, names, transforms and checks its elements. Coordinates change only as the options ask. Throws
/// InputError for input that cannot be repaired (no or too few points, NaN, an outline that crosses itself, elements
/// that cross or contain each other, coordinates outside the exact range of predicates.hpp) or transformed, IoError for
/// files that cannot be read, UsageError for a wrong number of names, for repeated names and for those that no element
/// has.
LAMINA_EXPORT Geometry read_geometry(std::span<const std::string> inputs, const GeometryOptions& options = {});

/// Reads the inputs of read_geometry() and repairs their elements, which do not have names yet. Two files in a row that
/// hold one surface each, with both ends in common, are one element. Throws as read_geometry() does.
LAMINA_EXPORT std::vector<Element> read_inputs(std::span<const std::string> inputs,
                                               const GeometryOptions& options = {});

/// Returns the element of an outline in memory, which does not have a name yet. It may be anything that an outline in a
/// file may be: closed or open at a base, of either direction, or the two surfaces one behind the other; it is repaired
/// likewise. `source` stands for the file in messages, where lines are points, counted from 1. Throws InputError for
/// points that cannot be repaired, among them numbers that are not finite or outside the exact range of predicates.hpp.
LAMINA_EXPORT Element element_of_points(std::span<const Point> points, const std::string& source,
                                        const GeometryOptions& options = {});

/// Makes the geometry of elements from read_inputs() and element_of_points(): names, transforms and checks them. Throws
/// as read_geometry() does.
LAMINA_EXPORT Geometry make_geometry(std::vector<Element> elements, const GeometryOptions& options = {});

/// Reads one file, which may hold several elements. Takes the same steps and throws the same errors as read_geometry().
LAMINA_EXPORT std::vector<Element> read_airfoil(const std::filesystem::path& file);

/// The trailing edges of NACA sections.
enum class TrailingEdge {
    sharp,     ///< the last thickness coefficient is -0.1036, which closes the trailing edge
    blunt,     ///< the last thickness coefficient is the published one, -0.1015, which leaves a base
    extended,  ///< the published thickness is continued to where it vanishes, at x = 1.0089, and scaled back to x = 1
};

/// A stretch of the wall of an element, with the largest spacing of its vertices there.
struct WallSpacing {
    std::size_t element;  ///< index in Geometry::elements
    Point a;              ///< one end of the stretch, on the wall or near to it
    Point b;              ///< the other end
    double spacing;       ///< in units of the input
};

/// Returns the NACA 4-digit ("0012") or 5-digit ("23012", reflexed "23112") section of unit chord with cosine spacing.
/// The points start at the trailing edge and run over the upper surface first. Both surfaces get the same number, so
/// `points` (surface points without the repeated trailing edge and without those inside a base) is rounded up to an
/// even number for `sharp` and `extended`, and to an odd one for `blunt`. The surfaces of symmetric sections are mirror
/// images exactly. Throws UsageError for digits that name no section and for fewer than 6 or more than 10 million
/// points. Source: Jacobs, Ward, Pinkerton, NACA Report 460 (1933); Jacobs, Pinkerton, NACA Report 537 (1935);
/// `extended`: the NACA 0012 of the NASA Turbulence Modeling Resource, 11.894 % thick.
LAMINA_EXPORT Element naca_airfoil(const std::string& digits, std::size_t points,
                                   TrailingEdge trailing_edge = TrailingEdge::sharp);

/// Throws InputError unless the outlines are simple, counter-clockwise and disjoint, and none lies inside another. The
/// message names the lines of both edges in conflict. Exact (predicates.hpp); O(n log n) in practice.
LAMINA_EXPORT void check_simple(const Geometry& geometry);

}  // namespace lamina
