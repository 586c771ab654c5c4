// The files of J. R. Shewchuk's Triangle: .node (vertices), .ele (triangles), .poly (segments, holes, regions), .edge.
//
// Guarantees:
//  1. Numbers are written with 17 significant digits. No file gets its name before all are complete.
// Limits:
//  1. Indices are those of the arrays; the files count from first_index, 0 or 1.
// Example:
//     const TriangleOutput output{.points = {{0, 0}, {1, 0}, {0, 1}}, .segments = {{VertexId{0u}, VertexId{1u}}}};
//     write_triangle_files(output, "corner", true);
//     const TriangleInput input = read_triangle_files("corner.poly");
//     assert(input.points == output.points && input.segments == output.segments && input.first_index == 1);
//
// Source: https://www.cs.cmu.edu/~quake/triangle.html, "File formats".
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <lamina/export.hpp>
#include <lamina/ids.hpp>
#include <lamina/point.hpp>

namespace lamina {

/// An attribute, and a bound on the area of triangles, for the region that holds a point.
struct TriangleRegion {
    Point at;              ///< a point inside the region
    double attribute = 0;  ///< given to each triangle of the region
    double max_area = -1;  ///< largest area of a triangle; no bound unless positive
};

/// The contents of a .node or .poly file.
struct TriangleInput {
    std::size_t first_index = 1;             ///< 0 or 1
    std::vector<Point> points;               ///< the vertices
    std::size_t attribute_count = 0;         ///< number of attributes of each point
    std::vector<double> attributes;          ///< attribute_count numbers per point
    std::vector<long> markers;               ///< per point; empty where the file has none
    std::vector<Segment> segments;           ///< constrained edges
    std::vector<long> segment_markers;       ///< per segment; empty where the file has none
    std::vector<Point> holes;                ///< a point inside each hole
    std::vector<TriangleRegion> regions;     ///< of the last section of the file
    std::filesystem::path point_file;        ///< the .node file where a .poly refers to it
    std::vector<std::size_t> lines;          ///< per point: its line in point_file
    std::filesystem::path segment_file;      ///< empty for a .node file
    std::vector<std::size_t> segment_lines;  ///< per segment: its line in segment_file
    std::vector<std::size_t> hole_lines;     ///< per hole: its line in segment_file
};

/// Whether files may hold equal points.
enum class EqualPoints { refuse, accept };
/// Reads a .poly or .node file; `format`, "poly" or "node", says which it is where the extension does not. A .poly file
/// without vertices takes those of the .node file with its stem; on standard input ("-") it must hold them. Segments
/// from a vertex to itself are kept. Throws IoError, InputError with file and line, UsageError for other formats.
LAMINA_EXPORT TriangleInput read_triangle_files(const std::filesystem::path& file, const std::string& format = {},
                                                EqualPoints equal = EqualPoints::refuse);

/// The contents of the files to write.
struct TriangleOutput {
    std::size_t first_index = 1;                ///< 0 or 1: the number of the first point in the files
    std::vector<Point> points{};                ///< the vertices
    std::size_t attribute_count = 0;            ///< number of attributes of each point
    std::vector<double> attributes{};           ///< attribute_count numbers per point
    std::vector<long> markers{};                ///< per point; empty: none are written
    std::vector<Triangle> triangles{};          ///< indices into points
    std::vector<double> triangle_attributes{};  ///< per triangle; empty: none are written
    std::vector<Segment> segments{};            ///< indices into points
    std::vector<long> segment_markers{};        ///< per segment; empty: none are written
    std::vector<Point> holes{};                 ///< a point inside each hole
    std::vector<TriangleRegion> regions{};      ///< of the .poly file
    std::vector<std::string> comments{};        ///< lines at the head of the .poly file
    std::vector<Segment> edges{};               ///< of the .edge file; empty: none is written
    std::vector<long> edge_markers{};           ///< per edge
};

/// Sets the marker of each vertex and segment on the boundary of the triangles to 1 where it is 0, as Triangle does.
/// Throws InputError unless each point and segment has a marker, and for indices out of range.
LAMINA_EXPORT void mark_boundary(TriangleOutput& output);
/// Returns the files that write_triangle_files() writes where there are no edges.
LAMINA_EXPORT std::vector<std::filesystem::path> triangle_files(const std::filesystem::path& stem, bool with_poly);
/// Writes STEM.node and STEM.ele, STEM.poly if with_poly is set, and STEM.edge if there are edges. Throws IoError;
/// InputError for counts that do not agree, indices out of range and numbers that are not finite.
LAMINA_EXPORT void write_triangle_files(const TriangleOutput& output, const std::filesystem::path& stem,
                                        bool with_poly);

}  // namespace lamina
