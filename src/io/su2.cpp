// Writes and reads the native ASCII format of the SU2 solver: the sections NDIME, NELEM, NPOIN and NMARK, each followed
// by its lines. Source: SU2 documentation, "Mesh File", and the behaviour of SU2's reader. Types of cells have the
// numbers of VTK: 3 line, 5 triangle, 9 quadrilateral. Vertices are numbered from 0. Indices at the ends of lines are
// optional.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <string_view>

#include <lamina/error.hpp>
#include <lamina/files.hpp>

#include "core/marker_names.hpp"
#include "io/formats.hpp"
#include "io/mesh_arrays.hpp"
#include "io/mesh_parts.hpp"
#include "io/su2_lines.hpp"
#include "io/text_lines.hpp"
#include "io/vtk_cell_types.hpp"

namespace lamina::io {

namespace {

/// Reads the sections in any order. It looks up NPOIN first, so that a vertex index out of range is reported with its
/// line.
template <class Target>
class Su2Reader {
public:
    /// Fills the target, a Mesh or MeshArrays. `forget(place)` says that the bytes before this place are no longer
    /// needed.
    Su2Reader(
        std::string_view bytes, const std::string& file, Target& target,
        std::function<void(std::size_t)> forget = [](std::size_t) {})
        : in_(bytes, file, '%'),
          bytes_(bytes.size()),
          points_(find_npoin(bytes, file, forget)),
          mesh_(target),
          forget_(std::move(forget)) {}

    void read() {
        while (in_.next()) {
            const auto key = in_.key();
            if (!key) in_.fail(fmt::format("'{}' belongs to no section", in_.text().substr(0, 30)));
            if (*key == "NDIME")
                read_dimension();
            else if (*key == "NELEM")
                read_cells();
            else if (*key == "NPOIN")
                read_points();
            else if (*key == "NMARK")
                announced_markers_ = read_count(announced_markers_, "NMARK");
            else if (*key == "MARKER_TAG")
                read_tag();
            else if (*key == "MARKER_ELEMS")
                read_marker();
            // Other keys (NZONE, AOA ...) are skipped: they say nothing about the mesh of one zone.
        }
        require_complete();
        orient_markers(view_of(mesh_), mesh_.markers);
    }

private:
    static std::size_t find_npoin(std::string_view bytes, const std::string& file,
                                  const std::function<void(std::size_t)>& forget) {
        TextLines in(bytes, file, '%');
        while (in.next()) {
            if (in.line() % lines_between == 0) forget(bytes.size() - in.bytes_left());
            if (in.key() == "NPOIN") return in.number<std::size_t>("number of points");
        }
        in.fail("the file ends without NPOIN=");
    }

    void require_complete() const {
        for (const auto& [given, name] : {std::pair{dimension_, "NDIME"}, std::pair{cells_, "NELEM"},
                                          std::pair{points_read_, "NPOIN"}, std::pair{announced_markers_, "NMARK"}})
            if (!given) in_.fail(fmt::format("the file ends without {}=", name));
        if (open_tag_) in_.fail(fmt::format("marker '{}' has no MARKER_ELEMS=", mesh_.markers.back().name));
        if (*announced_markers_ != mesh_.markers.size())
            in_.fail(fmt::format("NMARK= {}, but {} markers follow", *announced_markers_, mesh_.markers.size()));
    }

    /// Reads the number of lines of a section; `before` is the number of an earlier section of this name.
    std::size_t read_count(const std::optional<std::size_t>& before, const char* name) {
        if (before) in_.fail(fmt::format("a second {}=", name));
        const auto n = in_.number<std::size_t>("count");
        // A line has at least two bytes, so a damaged count is refused before memory is asked for.
        if (n > in_.bytes_left() / 2 + 1) in_.fail(fmt::format("{}= {}, but the file is shorter than that", name, n));
        return n;
    }
    void next_line(std::size_t i, std::size_t n, const char* section) {
        if (i % lines_between == 0) forget_(bytes_ - in_.bytes_left());
        if (!in_.next()) in_.fail(fmt::format("the file ends after {} of {} lines of {}", i, n, section));
    }
    VertexId vertex() {
        const auto index = in_.number<std::size_t>("vertex index");
        if (index >= points_) in_.fail(fmt::format("vertex index {} where NPOIN= {}", index, points_));
        return VertexId(index);
    }
    /// Reads the rest of a line: an index or nothing.
    void end_line() {
        if (!in_.at_end()) in_.number<std::size_t>("index or end of line");
        if (!in_.at_end()) in_.fail(fmt::format("end of line expected, found '{}'", in_.text().substr(0, 30)));
    }

    void read_dimension() {
        dimension_ = in_.number<std::size_t>("dimension");
        if (*dimension_ != 2) in_.fail(fmt::format("NDIME= {}: only two-dimensional meshes can be read", *dimension_));
    }
    void read_cells() {
        cells_ = read_count(cells_, "NELEM");
        reserve_cells(mesh_, *cells_);
        for (std::size_t i = 0; i < *cells_; ++i) {
            next_line(i, *cells_, "NELEM");
            const auto type = in_.number<unsigned>("cell type");
            if (type == vtk_triangle) {
                const VertexId a = vertex(), b = vertex(), c = vertex();
                mesh_.triangles.push_back({{a, b, c}});
            } else if (type == vtk_quad) {
                const VertexId a = vertex(), b = vertex(), c = vertex(), d = vertex();
                mesh_.quads.push_back({{a, b, c, d}});
            } else {
                in_.fail(fmt::format("cell type {}: only 5 (triangle) and 9 (quadrilateral) can be read", type));
            }
            end_line();
        }
    }
    void read_points() {
        points_read_ = read_count(points_read_, "NPOIN");
        mesh_.points.reserve(*points_read_);
        for (std::size_t i = 0; i < *points_read_; ++i) {
            next_line(i, *points_read_, "NPOIN");
            const auto x = in_.number<double>("coordinate"), y = in_.number<double>("coordinate");
            if (!std::isfinite(x) || !std::isfinite(y)) in_.fail("coordinate is not a finite number");
            mesh_.points.push_back({x, y});
            end_line();
        }
    }
    void read_tag() {
        if (open_tag_) in_.fail(fmt::format("marker '{}' has no MARKER_ELEMS=", mesh_.markers.back().name));
        if (in_.text().empty()) in_.fail("a marker without a name");
        mesh_.markers.push_back({std::string(in_.text()), core::kind_of_name(in_.text()), {}});
        open_tag_ = true;
    }
    void read_marker() {
        if (!open_tag_) in_.fail("MARKER_ELEMS= without a MARKER_TAG= before it");
        open_tag_ = false;
        const std::size_t n = read_count({}, "MARKER_ELEMS");
        for (std::size_t i = 0; i < n; ++i) {
            next_line(i, n, "MARKER_ELEMS");
            if (const auto type = in_.number<unsigned>("type of boundary edge"); type != vtk_line)
                in_.fail(fmt::format("boundary edge of type {}: only 3 (line) can be read", type));
            const VertexId a = vertex(), b = vertex();
            mesh_.markers.back().edges.push_back({a, b});
            end_line();
        }
    }

    static constexpr std::size_t lines_between = 1 << 20;  ///< lines between two calls of forget_

    TextLines in_;
    std::size_t bytes_;   ///< size of the file
    std::size_t points_;  ///< number of points that the file announces
    Target& mesh_;
    std::function<void(std::size_t)> forget_;
    std::optional<std::size_t> dimension_, cells_, points_read_, announced_markers_;  ///< of the sections read so far
    bool open_tag_ = false;  ///< whether the last marker has a name, but no edges yet
};

}  // namespace

void write_su2(const MeshView& mesh, const std::filesystem::path& file, std::ostream& out) {
    require_su2_marker_names(mesh.markers, file);
    const std::size_t triangles = mesh.triangles.size(), cells = triangles + mesh.quads.size();
    out << "NDIME= 2\nNELEM= " << cells << '\n';
    write_lines(out, cells, [&](LineText& line, std::size_t i) {
        if (i < triangles)
            put_su2_cell(line, mesh.triangles[i], i);
        else
            put_su2_cell(line, mesh.quads[i - triangles], i);
    });
    out << "NPOIN= " << mesh.points.size() << '\n';
    write_lines(out, mesh.points.size(),
                [&](LineText& line, std::size_t i) { put_su2_point(line, mesh.points[i], i); });
    write_su2_markers(mesh.markers, out);
}

void require_su2_marker_names(std::span<const Marker> markers, const std::filesystem::path& file) {
    require_legal_marker_names(markers, file, "SU2");
}

void write_su2_markers(std::span<const Marker> markers, std::ostream& out) {
    out << "NMARK= " << markers.size() << '\n';
    for (const Marker& marker : markers) {
        out << "MARKER_TAG= " << marker.name << "\nMARKER_ELEMS= " << marker.edges.size() << '\n';
        write_lines(out, marker.edges.size(), [&](LineText& line, std::size_t i) {
            line << std::size_t{vtk_line} << marker.edges[i].a.index() << marker.edges[i].b.index();
        });
    }
}

Mesh read_su2(const std::string& bytes, const std::filesystem::path& file) {
    Mesh mesh;
    Su2Reader<Mesh>(bytes, file.string(), mesh).read();
    return mesh;
}

void read_su2_arrays(const std::filesystem::path& file, MeshArrays& arrays) {
    const core::FileBytes mapped(file);
    // The number of points stands behind the cells, so the cells are gone through twice.
    Su2Reader<MeshArrays>(mapped.bytes(), input_name(file), arrays, [&](std::size_t place) {
        mapped.forget_before(place);
    }).read();
}

}  // namespace lamina::io
