// Stage 1, geometry: airfoil files and NACA names -> Pslg (docs/guide.md, "Input").
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include <lamina/error.hpp>
#include <lamina/point.hpp>

namespace lamina {

/// Something the reader mended, in words fit for a log: "line 12: duplicate of line 11 removed (0.5, 0.1)".
struct Repair {
    std::string text;
};

/// One closed body. points run counter-clockwise, the body on the left of every edge; the first point is not repeated.
struct Element {
    std::string name;    ///< marker name in the mesh: no spaces, at most 32 characters, unique in its Pslg
    std::string file;    ///< as the user gave it; "naca:0012" for generated sections
    std::string title;   ///< the file's own title line, if any
    std::string format;  ///< "selig", "lednicer", "table", "xy", "csv", "naca"
    std::size_t points_read = 0;
    std::vector<Point> points;
    std::vector<std::size_t> lines;  ///< per point: line of the file it was read from, 0 where lamina added it
    std::vector<Repair> repairs;
    std::vector<std::string> surface;  ///< what prepare_surfaces() did, and why; fit for a log
    bool resampled = false;            ///< by prepare_surfaces(): the spacing of the points is lamina's own choice
};

/// Planar straight-line graph: closed, simple, pairwise disjoint bodies.
struct Pslg {
    std::vector<Element> elements;
};

struct GeometryOptions {
    std::vector<std::string> names;  ///< marker names, one an element; empty = file stems, "airfoil" if there is one
    std::size_t naca_points = 200;   ///< surface points of `naca:` inputs that do not say so themselves
};

/// Reads every input (a path, or `naca:DIGITS[:POINTS][:blunt|:sharp]`), repairs, orients and checks them.
/// Coordinates are never scaled or moved. Throws InputError for what cannot be repaired (no or too few points, NaN,
/// a crossing outline, elements that cross or contain each other, coordinates outside the exact range of
/// predicates.hpp), IoError for files that cannot be read.
Pslg read_geometry(std::span<const std::string> inputs, const GeometryOptions& options = {});

/// Reads one file; several elements where it holds several. Steps as in read_geometry, without the checks between
/// files.
std::vector<Element> read_airfoil(const std::filesystem::path& file);

enum class TrailingEdge { sharp, blunt };

/// NACA 4-digit ("0012") or 5-digit ("23012", reflexed "23112") section of unit chord with cosine spacing.
/// Points start at the trailing edge, upper surface first; both surfaces get the same number, so `points` (surface
/// points without the repeated trailing edge and without those inside a base) is rounded up to an even number for
/// `sharp`, to an odd one for `blunt`. The sections of symmetric digits are mirror images exactly. `sharp` closes the
/// tail by the modified last thickness coefficient (-0.1036), `blunt` keeps the published one (-0.1015) and its base
/// edge. Source: Jacobs, Ward, Pinkerton, NACA Report 460 (1933); Jacobs, Pinkerton, NACA Report 537 (1935). Throws
/// UsageError for digits that name no section and for fewer than 6 or more than 10 million points.
Element naca_airfoil(const std::string& digits, std::size_t points, TrailingEdge trailing_edge = TrailingEdge::sharp);

/// Throws InputError where the Pslg is not made of simple, disjoint, counter-clockwise loops that lie side by side; the
/// message names the lines of both edges. Exact (predicates.hpp), O(n log n) in practice.
void check_simple(const Pslg& pslg);

/// Facts about one element that a person wants to see (`lamina info`).
struct ElementSummary {
    Box box;
    double chord = 0;  ///< extent in x
    double area = 0;
    double perimeter = 0;
    double min_spacing = 0;
    double max_spacing = 0;
    double max_spacing_ratio = 0;  ///< of neighbouring edges
    double max_turning_deg = 0;    ///< largest exterior angle, and where
    Point max_turning_at;
    std::size_t sharp_corners = 0;  ///< convex vertices that turn by more than 60 degrees
    /// The convex corner of more than 60 degrees, or the middle of the straight base, that lies farthest downstream (at
    /// the largest x) in the rear half; without either the rearmost vertex.
    Point trailing_edge;
    bool blunt_trailing_edge = false;
};
ElementSummary summarize(const Element& element);

/// The report of `lamina info`: what was read, mended and found, element by element; several lines.
std::string describe(const Pslg& pslg);

}  // namespace lamina
