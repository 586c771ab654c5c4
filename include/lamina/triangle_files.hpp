// The files of J. R. Shewchuk's Triangle: .node (vertices), .ele (triangles), .poly (segments, holes, regions).
// Source: https://www.cs.cmu.edu/~quake/triangle.html, "File formats".
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include <lamina/export.hpp>
#include <lamina/ids.hpp>
#include <lamina/point.hpp>

namespace lamina {

/// A regional attribute and, where positive, the largest area of a triangle in the region that holds the point.
struct TriangleRegion {
    Point at;
    double attribute = 0;
    double max_area = -1;
};

/// What a .node or .poly file holds. Indices are those of the arrays; the files count from `first_index`.
struct TriangleInput {
    std::size_t first_index = 1;  ///< 0 or 1
    std::vector<Point> points;
    std::size_t attribute_count = 0;
    std::vector<double> attributes;  ///< attribute_count for each point
    std::vector<long> markers;       ///< of the points; empty where the file has none
    std::vector<Segment> segments;
    std::vector<long> segment_markers;  ///< empty where the file has none
    std::vector<Point> holes;
    std::vector<TriangleRegion> regions;

    std::filesystem::path point_file;    ///< the .node file where a .poly refers to it
    std::vector<std::size_t> lines;      ///< of the points, in point_file
    std::filesystem::path segment_file;  ///< empty for a .node file
    std::vector<std::size_t> segment_lines;
    std::vector<std::size_t> hole_lines;
};

/// Reads a .poly or .node file, by extension. A .poly without vertices takes those of the .node file of its stem.
/// Comments from # to
/// the end of the line and blank lines are skipped. Throws IoError, InputError with file and line, UsageError for other
/// extensions.
LAMINA_EXPORT TriangleInput read_triangle_files(const std::filesystem::path& file);

/// What is written; arrays as in TriangleInput.
struct TriangleOutput {
    std::size_t first_index = 1;
    std::vector<Point> points;
    std::size_t attribute_count = 0;
    std::vector<double> attributes;
    std::vector<long> markers;
    std::vector<Triangle> triangles;
    std::vector<double> regional;  ///< one attribute a triangle; empty = none
    std::vector<Segment> segments;
    std::vector<long> segment_markers;
    std::vector<Point> holes;
    std::vector<TriangleRegion> regions;
    std::vector<std::string> comments;  ///< lines at the head of the .poly file
    std::vector<Segment> edges;         ///< of the .edge file; empty = none is written
    std::vector<long> edge_markers;
};

/// The triangles of a .ele file over so many points. Throws IoError, InputError with file and line.
LAMINA_EXPORT std::vector<Triangle> read_triangle_elements(const std::filesystem::path& file, std::size_t first_index,
                                                           std::size_t points);

/// Gives the marker 1 to each vertex and segment on the boundary of the triangles that has no marker (marker 0), as
/// Triangle does.
LAMINA_EXPORT void mark_boundary(TriangleOutput& output);

/// Writes STEM.node and STEM.ele, STEM.poly if asked for, and STEM.edge if there are edges: numbers with 17 significant
/// digits, no file before all are complete. Throws IoError.
LAMINA_EXPORT void write_triangle_files(const TriangleOutput& output, const std::filesystem::path& stem,
                                        bool with_poly);

}  // namespace lamina
