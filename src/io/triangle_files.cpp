// Reads and writes the files of Triangle.
#include <lamina/triangle_files.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include <lamina/error.hpp>
#include <lamina/files.hpp>
#include <lamina/predicates.hpp>

#include "core/arguments.hpp"
#include "core/atomic_file.hpp"
#include "io/file_names.hpp"
#include "io/text_lines.hpp"
#include "io/text_output.hpp"
#include "io/triangle_elements.hpp"
#include "mesh/adjacency.hpp"

namespace lamina::io {

namespace fs = std::filesystem;

namespace {

// --- Reading

/// The lines of one of Triangle's files.
class NumberLines : public TextLines {
public:
    NumberLines(std::string_view bytes, std::string file) : TextLines(bytes, std::move(file), '#', " \t\r,\f\v") {}

    using TextLines::next;
    /// Goes to the next line; `contents` names it in errors.
    void next(const char* contents) {
        if (!next()) fail(fmt::format("the file ends where {} is expected", contents));
    }
    double real(const char* meaning) {
        const auto value = number<double>(meaning);
        if (!std::isfinite(value)) fail(fmt::format("{} is not a finite number", meaning));
        return value;
    }
    Point point() {
        const double x = real("coordinate"), y = real("coordinate");
        if (!in_exact_range({x, y})) fail("coordinates outside the exact range");
        return {x, y};
    }
    template <class T>
    T number_or(T otherwise, const char* meaning) {
        return at_end() ? otherwise : number<T>(meaning);
    }
    /// Reads the number of lines that follow. A line has at least two bytes, so a damaged count is refused before
    /// memory is asked for.
    std::size_t count(const char* meaning) {
        const auto n = number<std::size_t>(meaning);
        if (n > bytes_left() / 2 + 1) fail(fmt::format("{}: {}, but the file is shorter than that", meaning, n));
        return n;
    }
    void end_line() {
        if (!at_end()) fail(fmt::format("end of line expected, found '{}'", text().substr(0, 30)));
    }
};

/// Reads "vertices dimension attributes markers", and "index x y [attributes] [marker]" for each vertex. Returns
/// whether there are any.
bool read_vertices(NumberLines& in, TriangleInput& input) {
    in.next("the number of vertices");
    const std::size_t n = in.count("number of vertices");
    if (in.number_or<std::size_t>(2, "dimension") != 2) in.fail("only two-dimensional vertices can be read");
    input.attribute_count = in.number_or<std::size_t>(0, "number of attributes");
    if (input.attribute_count > 1000) in.fail("more than 1000 attributes a vertex");
    const auto markers = in.number_or<std::size_t>(0, "number of boundary markers");
    if (markers > 1) in.fail("the number of boundary markers must be 0 or 1");
    in.end_line();
    for (std::size_t i = 0; i < n; ++i) {
        in.next("a vertex");
        const auto index = in.number<std::size_t>("vertex index");
        if (i == 0) {
            if (index > 1) in.fail(fmt::format("vertices are numbered from 0 or 1, not from {}", index));
            input.first_index = index;
        }
        if (index != input.first_index + i)
            in.fail(fmt::format("vertex index {} where {} is expected", index, input.first_index + i));
        input.points.push_back(in.point());
        for (std::size_t a = 0; a < input.attribute_count; ++a) input.attributes.push_back(in.real("attribute"));
        if (markers == 1) input.markers.push_back(in.number<long>("boundary marker"));
        in.end_line();
        input.lines.push_back(in.line());
    }
    return n > 0;
}

/// Returns whether the file is a .poly file, by its format or, without one, by its extension; else it is a .node file.
bool is_poly(const fs::path& file, const std::string& format) {
    const std::string kind = format.empty() ? file.extension().string() : "." + format;
    if (kind == ".poly") return true;
    if (kind == ".node") return false;
    if (!format.empty()) throw UsageError(fmt::format("format '{}': must be node or poly", format));
    throw UsageError(is_standard_stream(file) ? "'-' has no extension that tells the format: name it, node or poly"
                                              : fmt::format("{}: neither a .node nor a .poly file", file.string()));
}

void refuse_duplicates(const TriangleInput& input) {
    std::vector<std::size_t> order(input.points.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    std::sort(order.begin(), order.end(), [&](std::size_t l, std::size_t r) {
        const Point a = input.points[l], b = input.points[r];
        return a == b ? l < r : lexicographically_less(a, b);
    });
    for (std::size_t i = 1; i < order.size(); ++i) {
        const std::size_t first = order[i - 1], second = order[i];
        if (input.points[first] == input.points[second])
            throw InputError({input.point_file.string(), input.lines[second], input.points[second]},
                             fmt::format("vertices {} and {} (line {}) are the same, which --merge takes for one",
                                         second + input.first_index, first + input.first_index, input.lines[first]));
    }
}

void read_segments(NumberLines& in, TriangleInput& input) {
    in.next("the number of segments");
    const std::size_t n = in.count("number of segments");
    const auto markers = in.number_or<std::size_t>(0, "number of boundary markers");
    if (markers > 1) in.fail("the number of boundary markers must be 0 or 1");
    in.end_line();
    const auto vertex = [&] {
        const auto index = in.number<std::size_t>("vertex index");
        if (index < input.first_index || index - input.first_index >= input.points.size())
            in.fail(fmt::format("vertex index {}, but vertices are numbered from {} to {}", index, input.first_index,
                                input.first_index + input.points.size() - 1));
        return VertexId{index - input.first_index};
    };
    for (std::size_t i = 0; i < n; ++i) {
        in.next("a segment");
        in.number<std::size_t>("segment index");
        const VertexId a = vertex(), b = vertex();
        input.segments.push_back({a, b});
        if (markers == 1) input.segment_markers.push_back(in.number<long>("boundary marker"));
        in.end_line();
        input.segment_lines.push_back(in.line());
    }
}

void read_holes_and_regions(NumberLines& in, TriangleInput& input) {
    in.next("the number of holes");
    const std::size_t holes = in.count("number of holes");
    in.end_line();
    for (std::size_t i = 0; i < holes; ++i) {
        in.next("a hole");
        in.number<std::size_t>("hole index");
        input.holes.push_back(in.point());
        in.end_line();
        input.hole_lines.push_back(in.line());
    }
    if (!in.next()) return;
    const std::size_t regions = in.count("number of regions");
    in.end_line();
    for (std::size_t i = 0; i < regions; ++i) {
        in.next("a region");
        in.number<std::size_t>("region index");
        TriangleRegion region;
        region.at = in.point();
        // A single number is the attribute and the area bound at once, as in Triangle.
        region.attribute = in.real("regional attribute");
        region.max_area = in.at_end() ? region.attribute : in.real("area bound");
        in.end_line();
        input.regions.push_back(region);
    }
    if (in.next()) in.fail("something follows the last region");
}

// --- Writing

LineText& put(LineText& line, Point p) { return line.general(p.x).general(p.y); }

void write_node(const TriangleOutput& contents, std::ostream& out) {
    out << fmt::format("{} 2 {} {}\n", contents.points.size(), contents.attribute_count,
                       contents.markers.empty() ? 0 : 1);
    const auto put_vertex = [&](LineText& line, std::size_t i) {
        put(line << i + contents.first_index, contents.points[i]);
        for (std::size_t a = 0; a < contents.attribute_count; ++a)
            line.general(contents.attributes[i * contents.attribute_count + a]);
        if (!contents.markers.empty()) line << contents.markers[i];
    };
    write_lines(out, contents.points.size(), put_vertex, default_line_bytes + 30 * contents.attribute_count);
}

void write_ele(const TriangleOutput& contents, std::ostream& out) {
    out << fmt::format("{} 3 {}\n", contents.triangles.size(), contents.triangle_attributes.empty() ? 0 : 1);
    write_lines(out, contents.triangles.size(), [&](LineText& line, std::size_t i) {
        line << i + contents.first_index;
        for (const VertexId v : contents.triangles[i].v) line << v.index() + contents.first_index;
        if (!contents.triangle_attributes.empty()) line.general(contents.triangle_attributes[i]);
    });
}

/// Writes segments or edges: their number, and a line "index a b [marker]" for each.
void write_pairs(const TriangleOutput& contents, const std::vector<Segment>& pairs, const std::vector<long>& markers,
                 std::ostream& out) {
    out << fmt::format("{} {}\n", pairs.size(), markers.empty() ? 0 : 1);
    write_lines(out, pairs.size(), [&](LineText& line, std::size_t i) {
        line << i + contents.first_index << pairs[i].a.index() + contents.first_index
             << pairs[i].b.index() + contents.first_index;
        if (!markers.empty()) line << markers[i];
    });
}

/// Writes a .poly file without vertices, which are in the .node file.
void write_poly(const TriangleOutput& contents, std::ostream& out) {
    for (const std::string& comment : contents.comments) out << "# " << comment << '\n';
    out << fmt::format("0 2 {} {}\n", contents.attribute_count, contents.markers.empty() ? 0 : 1);
    write_pairs(contents, contents.segments, contents.segment_markers, out);
    out << contents.holes.size() << '\n';
    write_lines(out, contents.holes.size(),
                [&](LineText& line, std::size_t i) { put(line << i + contents.first_index, contents.holes[i]); });
    if (contents.regions.empty()) return;
    out << contents.regions.size() << '\n';
    write_lines(out, contents.regions.size(), [&](LineText& line, std::size_t i) {
        put(line << i + contents.first_index, contents.regions[i].at)
            .general(contents.regions[i].attribute)
            .general(contents.regions[i].max_area);
    });
}

// --- Checks

/// Throws InputError where there are not as many attributes and markers as things that they belong to.
void require_counts(const TriangleOutput& output) {
    const std::size_t points = output.points.size();
    core::require_count(output.attributes.size(), "attributes", output.attribute_count * points,
                        "numbers, since points have " + std::to_string(output.attribute_count) + " each");
    const auto require_all_or_none = [](std::size_t count, const char* things, std::size_t expected,
                                        const char* others) {
        if (count != 0) core::require_count(count, things, expected, others);
    };
    require_all_or_none(output.markers.size(), "markers", points, "points");
    require_all_or_none(output.triangle_attributes.size(), "attributes", output.triangles.size(), "triangles");
    require_all_or_none(output.segment_markers.size(), "markers", output.segments.size(), "segments");
    require_all_or_none(output.edge_markers.size(), "markers", output.edges.size(), "edges");
}

/// Throws InputError for counts that do not agree, for indices out of range and for numbers that are not finite.
void require_writable(const TriangleOutput& output) {
    if (output.first_index > 1)
        throw InputError({}, fmt::format("files count from 0 or 1, not from {}", output.first_index));
    require_counts(output);
    core::require_indices_below(output.points.size(), output.triangles);
    core::require_indices_below(output.points.size(), output.segments);
    core::require_indices_below(output.points.size(), output.edges);
    const auto is_finite = [](Point p) { return std::isfinite(p.x) && std::isfinite(p.y); };
    const auto finite = [](double x) { return std::isfinite(x); };
    const bool all = std::all_of(output.points.begin(), output.points.end(), is_finite) &&
                     std::all_of(output.holes.begin(), output.holes.end(), is_finite) &&
                     std::all_of(output.attributes.begin(), output.attributes.end(), finite) &&
                     std::all_of(output.triangle_attributes.begin(), output.triangle_attributes.end(), finite) &&
                     std::all_of(output.regions.begin(), output.regions.end(), [&](const TriangleRegion& r) {
                         return is_finite(r.at) && finite(r.attribute) && finite(r.max_area);
                     });
    if (!all) throw InputError({}, "a coordinate, an attribute or an area is not a finite number");
}

}  // namespace

std::vector<Triangle> read_triangle_elements(const fs::path& file, std::size_t first_index, std::size_t points) {
    if (first_index > 1) throw InputError({}, fmt::format("files count from 0 or 1, not from {}", first_index));
    const std::string bytes = read_file(file);
    NumberLines in(bytes, file.string());
    in.next("the number of triangles");
    const std::size_t n = in.count("number of triangles");
    if (in.number_or<std::size_t>(3, "number of vertices per triangle") != 3)
        in.fail("only triangles of three vertices can be read");
    const auto attributes = in.number_or<std::size_t>(0, "number of attributes");
    in.end_line();
    std::vector<Triangle> triangles(n);
    for (Triangle& triangle : triangles) {
        in.next("a triangle");
        in.number<std::size_t>("triangle index");
        for (VertexId& v : triangle.v) {
            const auto index = in.number<std::size_t>("vertex index");
            if (index < first_index || index - first_index >= points)
                in.fail(fmt::format("vertex index {} where there are {} vertices", index, points));
            v = VertexId(index - first_index);
        }
        for (std::size_t a = 0; a < attributes; ++a) in.real("attribute");
        in.end_line();
    }
    if (in.next()) in.fail("something follows the last triangle");
    return triangles;
}

}  // namespace lamina::io

namespace lamina {

using namespace io;

TriangleInput read_triangle_files(const fs::path& file, const std::string& format, EqualPoints equal) {
    const bool has_segments = is_poly(file, format);
    TriangleInput input;
    const std::string bytes = read_file(file);
    NumberLines in(bytes, input_name(file));
    input.point_file = input_name(file);
    const bool has_vertices = read_vertices(in, input);
    if (has_segments) {
        input.segment_file = input_name(file);
        if (!has_vertices && is_standard_stream(file)) in.fail("no vertices, which must stand before the segments");
        if (!has_vertices) {
            input.point_file = fs::path(file).replace_extension(".node");
            const std::string nodes = read_file(input.point_file);
            NumberLines vertices(nodes, input.point_file.string());
            read_vertices(vertices, input);
        }
        read_segments(in, input);
        read_holes_and_regions(in, input);
    } else if (in.next()) {
        in.fail("something follows the last vertex");
    }
    if (equal == EqualPoints::refuse) refuse_duplicates(input);
    return input;
}

void mark_boundary(TriangleOutput& output) {
    core::require_count(output.markers.size(), "markers", output.points.size(), "points");
    core::require_count(output.segment_markers.size(), "markers", output.segments.size(), "segments");
    core::require_indices_below(output.points.size(), output.triangles);
    core::require_indices_below(output.points.size(), output.segments);
    Mesh mesh;
    mesh.points.swap(output.points);
    mesh.triangles.swap(output.triangles);
    const mesh::CellEdges edges(mesh);
    const mesh::Adjacency adjacency = mesh::find_adjacency(mesh);
    for (const std::uint32_t edge : adjacency.boundary)
        for (const VertexId v : {edges.origin(edge), edges.target(edge)})
            if (output.markers[v.index()] == 0) output.markers[v.index()] = 1;
    const std::vector<std::uint32_t> segment_edges = mesh::find_edges(mesh, output.segments);
    for (std::size_t i = 0; i < output.segments.size(); ++i) {
        const std::uint32_t edge = segment_edges[i];
        if (output.segment_markers[i] == 0 && edge != mesh::no_edge && adjacency.twin[edge] == mesh::no_edge)
            output.segment_markers[i] = 1;
    }
    mesh.points.swap(output.points);
    mesh.triangles.swap(output.triangles);
}

std::vector<fs::path> triangle_files(const fs::path& stem, bool with_poly) {
    std::vector<fs::path> files{with_suffix(stem, ".node"), with_suffix(stem, ".ele")};
    if (with_poly) files.push_back(with_suffix(stem, ".poly"));
    return files;
}

void write_triangle_files(const TriangleOutput& output, const fs::path& stem, bool with_poly) {
    require_writable(output);
    std::vector<fs::path> targets = triangle_files(stem, with_poly);
    std::vector<void (*)(const TriangleOutput&, std::ostream&)> writers{write_node, write_ele};
    if (with_poly) writers.push_back(write_poly);
    if (!output.edges.empty()) {
        targets.push_back(with_suffix(stem, ".edge"));
        writers.push_back([](const TriangleOutput& contents, std::ostream& out) {
            write_pairs(contents, contents.edges, contents.edge_markers, out);
        });
    }
    core::write_files_atomically(targets, [&](std::span<const fs::path> temporaries) {
        for (std::size_t i = 0; i < targets.size(); ++i)
            core::write_stream(temporaries[i], targets[i], [&](std::ostream& out) { writers[i](output, out); });
    });
}

}  // namespace lamina
