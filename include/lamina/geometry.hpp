// The bodies of a mesh: airfoil files, NACA names and points in memory become closed outlines.
//
// Guarantees:
//  1. Outlines are closed, simple, pairwise disjoint and counter-clockwise: the body lies on the left of every edge.
//  2. Coordinates change only as the options ask. Element::repairs tells what was repaired (docs/reference/input.md).
//  3. Input that cannot be repaired is an InputError with file, line and place: no or too few points, NaN, an outline
//     that crosses itself, elements that cross or contain each other, coordinates outside the exact range.
// Example:
//     const std::vector<Point> diamond{{1, 0}, {0.5, 0.1}, {0, 0}, {0.5, -0.1}};
//     const Geometry geometry = make_geometry({naca_airfoil("0012", 100), element_of_points(diamond, "diamond")},
//         {.names = {"wing", "tail"}, .transformations = {{"tail", Shift{{1.5, 0}}}}});
//     assert(geometry.elements[0].points.size() == 100 && bounding_box(geometry).upper.x == 2.5);
#pragma once

#include <cstddef>
#include <vector>

#include <lamina/conditions.hpp>
#include <lamina/error.hpp>
#include <lamina/transformation.hpp>
#include <lamina/warning.hpp>

namespace lamina {

/// The base of a blunt trailing edge: the indices of its two corners in the outline, in the order of the outline.
struct Base {
    std::size_t first;  ///< the corner at which the base begins
    std::size_t last;   ///< the corner at which it ends
};

/// Places of an outline that later stages need to know.
struct OutlineFeatures {
    std::vector<std::size_t> corners;  ///< indices of the vertices that are no samples of a smooth curve, ascending
    std::optional<Base> base{};        ///< empty where the trailing edge is not blunt
    /// The rearmost sharp corner (above 60 degrees) or the middle of the base; else the rearmost vertex.
    Point trailing_edge{};
};

/// A part of the wall of bodies that were joined (GeometryOptions::unite), which has a marker of its own.
struct WallPart {
    std::string name;  ///< of its marker: that of the body that it comes from. Several parts may have one name
    Point begin;       ///< the vertex that it begins at, counter-clockwise; it ends where the next one begins
};

/// A body without thickness: a sail, a splitter plate, a Gurney strip. An end that is nearer to the wall of another
/// body than a thousandth of that body's length, or inside it, stands on that wall.
struct Sheet {
    std::string name;             ///< of its marker
    std::vector<Point> points{};  ///< from one end to the other, two at least
    std::string file{};           ///< that the points come from; empty where they are given by themselves
};

/// Both sides of a sheet in an outline, which runs along it to its tip and back. They are a tiny gap apart, which is
/// closed when the mesh is made.
struct SheetSides {
    std::string name;  ///< of its marker
    Point begin;       ///< the vertex where the outline begins to run along it: its foot on a wall, or its first tip
    Point tip;         ///< the one where it turns back
    Point end;         ///< where it is back: `begin` itself, or a vertex beside it on the wall
};

/// One closed body.
struct Element {
    std::string name;        ///< name of its marker in the mesh: a legal one (marker_names.hpp)
    std::string given_name;  ///< the name that the options or its file give it, which may be no legal one
    std::string file;        ///< as the user gave it; "naca:0012" for generated sections
    std::string title;       ///< the title line of the file, if it has one
    /// "selig", "lednicer", "table", "xy", "csv", "naca", "points", "dxf", "svg", "iges", "step" or "sheet".
    std::string format;
    std::string unit;             ///< the unit of length that the file names, such as "mm"; empty where it names none
    std::size_t points_read = 0;  ///< number of points in the file; 0 for generated sections
    std::vector<Point> points;    ///< the outline; the first point is not repeated
    /// Per point: its line in the file, or its number, from 1, among points in memory; 0 where lamina added the point.
    std::vector<std::size_t> lines;
    std::vector<std::string> repairs;          ///< by the reader: "line 12: duplicate of line 11 removed (0.5, 0.1)"
    std::vector<std::string> transformations;  ///< what transformed() did, in order
    std::vector<Warning> warnings;             ///< by the reader; their messages do not name the element
    std::vector<std::string> surface_notes;    ///< changes that prepare_surfaces() made to the points, and why
    bool samples_of_curve = false;  ///< whether they are many samples, of which a wall takes as many as it needs
    /// Indices of points, ascending, that are corners however little the outline turns there: those that a flap makes,
    /// and where the two parts of the mean line of a NACA section meet.
    std::vector<std::size_t> given_corners;
    bool resampled = false;  ///< whether prepare_surfaces() chose the spacing of points, of all or of some stretches
    bool smooth = false;     ///< whether the outline is smooth but at few corners, and its points are evenly spaced
    /// Whether prepare_surfaces() kept the points since those asked for would have crossed.
    bool surface_restored = false;
    OutlineFeatures features;  ///< set by prepare_surfaces()
    /// Whether the part of the outline below Geometry::symmetry is the image of that above, which the line cut off. The
    /// outline then begins on the line, at the tail.
    bool is_mirrored = false;
    std::vector<WallPart> parts{};     ///< of bodies that were joined, or on which sheets stand; empty for others
    std::vector<SheetSides> sheets{};  ///< the sheet that it is, or those that stand on it
};

/// An element and the box round its points.
struct ElementBox {
    std::string name;        ///< of the element
    std::string given_name;  ///< the name that it came with
    Box box;                 ///< round its points
};

/// Bodies that are closed, simple and pairwise disjoint.
struct Geometry {
    std::vector<Element> elements;  ///< in the order of the inputs
    /// The box round the elements without GeometryOptions' rotations and flaps, whose width is the chord. Empty where
    /// nothing is turned, and where the configuration stood upright.
    std::optional<Box> unturned_box{};
    /// The boxes round all elements and sheets of make_geometry(), likewise without rotations and flaps, and before
    /// they are joined or cut: what the chord of an element is found by.
    std::vector<ElementBox> unturned_elements{};
    std::optional<double> symmetry{};  ///< the line of symmetry y = Y that cut_at_symmetry() cut the bodies at
    std::optional<double> pitch{};     ///< distance along y of the copies in a row, as blade_row() rounded it
};

/// Keeps of all bodies what is above the line y = Y. Those that the line cuts, or that stand on it, end on it exactly
/// and are whole again by their images below (Element::is_mirrored); one that it cuts to several parts becomes several
/// elements. Throws InputError for a body below the line, one that touches it at a single point, and one that encloses
/// a part of the flow with it.
LAMINA_EXPORT Geometry cut_at_symmetry(Geometry geometry, double y);
/// Makes the bodies one blade of an endless row along y, turned counter-clockwise about the origin by the stagger
/// angle. Geometry::pitch becomes the pitch rounded to 41 significant bits, so that it can be added to coordinates of
/// the border between blades exactly. Throws OptionError where neighbours are not above and below each other with some
/// room between along y, and for a row more than 4000 pitches away from y = 0.
LAMINA_EXPORT Geometry blade_row(Geometry geometry, double pitch, double stagger_deg);

LAMINA_EXPORT Box bounding_box(const Geometry& geometry);  ///< the box round all elements
/// Returns the box whose width is the reference chord: Geometry::unturned_box, else bounding_box().
LAMINA_EXPORT Box reference_box(const Geometry& geometry);
/// Returns the conditions of the flow round bodies, as reference_conditions() of a box does. The chord is the given
/// one, or the extent in x of FlowConditions::chord_element, or of reference_box(). Throws OptionError for an element
/// that there is not.
LAMINA_EXPORT ReferenceConditions reference_conditions(const FlowConditions& conditions, const Geometry& geometry);

/// The ways to make a blunt trailing edge sharp.
enum class TailSharpening {
    extend,  ///< both sides go on straight to where they meet, which makes the chord longer
    blend,   ///< both sides move towards each other, as for a gap of 0
};

/// The gap of a trailing edge, in chords of its element, and the distance from the trailing edge over which the sides
/// move, from 0 (the trailing edge alone) to 1 (in proportion to the distance from the leading edge). Source: the
/// command TGAP of M. Drela's XFOIL (1989).
struct TrailingEdgeGap {
    double gap = 0;       ///< >= 0
    double distance = 1;  ///< from 0 to 1
};

/// Options of read_geometry().
struct GeometryOptions {
    /// Marker names, one per element; empty: file stems, or "airfoil" for one element. Those that are not legal are
    /// changed (marker_names.hpp), with a warning of the element.
    std::vector<std::string> names{};
    std::size_t naca_points = 0;  ///< of `naca:` inputs without a number; 0: many samples of the formula
    bool close = false;           ///< whether open outlines are closed by straight edges, however long
    bool unite = false;           ///< whether bodies that overlap or touch are joined, after the transformations
    bool mirror_half = false;     ///< whether files hold one half of symmetric sections, which is mirrored
    std::optional<TailSharpening> sharpen_te{};     ///< how blunt trailing edges become sharp; empty: they stay blunt
    std::optional<TrailingEdgeGap> open_te{};       ///< the gap of all trailing edges; empty: as they are
    std::vector<Transformation> transformations{};  ///< applied in this order, and after these: transformed()
    /// Bodies without thickness beside those of the inputs. Transformations may name them, and apply before they are
    /// put on walls.
    std::vector<Sheet> sheets{};
};

LAMINA_EXPORT void validate(const GeometryOptions& options);  ///< throws OptionError: an option out of range
/// Reads every input, which is a path, "-" for standard input, or `naca:DIGITS[:POINTS][:blunt|:extended]`, and makes
/// the geometry. Throws IoError, too, for files that cannot be read.
LAMINA_EXPORT Geometry read_geometry(std::span<const std::string> inputs, const GeometryOptions& options = {});
/// Reads the inputs of read_geometry() and repairs their elements, which do not have names yet. Two files in a row that
/// hold one surface each, with both ends in common, are one element.
LAMINA_EXPORT std::vector<Element> read_inputs(std::span<const std::string> inputs,
                                               const GeometryOptions& options = {});
/// Returns the element of an outline in memory, which does not have a name yet: closed or open at a base, of either
/// direction, or the two surfaces one behind the other. `source` stands for the file in messages, and points for lines.
LAMINA_EXPORT Element element_of_points(std::span<const Point> points, const std::string& source,
                                        const GeometryOptions& options = {});
/// Makes the geometry of elements and sheets: names, transforms and checks them. Throws UsageError for a wrong number
/// of names, for repeated names and for those that no element has, InputError also for transformations that cannot be
/// made.
LAMINA_EXPORT Geometry make_geometry(std::vector<Element> elements, const GeometryOptions& options = {});

/// The trailing edges of NACA sections.
enum class TrailingEdge {
    sharp,     ///< the last thickness coefficient is -0.1036, which closes the trailing edge
    blunt,     ///< the last thickness coefficient is the published one, -0.1015, which leaves a base
    extended,  ///< the published thickness is continued to where it vanishes, at x = 1.0089, and scaled back to x = 1
};

/// Returns the NACA 4-digit ("0012") or 5-digit ("23012", reflexed "23112") section of unit chord with cosine spacing,
/// from the trailing edge over the upper surface first. Both surfaces get the same number, so `points` (without the
/// repeated trailing edge and those inside a base) is rounded up to an even number, for `blunt` to an odd one. Surfaces
/// of symmetric sections are mirror images exactly. Throws UsageError for digits that name no section and for fewer
/// than 6 or more than 10 million points. Source: Jacobs, Ward, Pinkerton, NACA Report 460 (1933); Jacobs, Pinkerton,
/// NACA Report 537 (1935); `extended`: the NACA 0012 of the NASA Turbulence Modeling Resource, 11.894 % thick.
LAMINA_EXPORT Element naca_airfoil(const std::string& digits, std::size_t points,
                                   TrailingEdge trailing_edge = TrailingEdge::sharp);
/// Throws InputError unless the outlines are simple, counter-clockwise and disjoint, and none lies inside another. The
/// message names the lines of both edges in conflict. Exact; O(n log n) in practice.
LAMINA_EXPORT void check_simple(const Geometry& geometry);

}  // namespace lamina
