// UGRID files with their .mapbc: plane ones in ASCII, and what FUN3D takes, one cell thick, in ASCII or binary.
// Sources: SimCenter UG_IO, "UGRID 3D grid file type" (order of the numbers, ordering of nodes); FUN3D manual,
// "Boundary conditions" (codes of the .mapbc).
//
// Plane: nodes x y 0, triangles, quadrilaterals, 1 for each of them, then the boundary: a count, and two nodes and the
// number of the marker for each edge.
// FUN3D: the airfoil lies in the x-z plane, y = 0 and y = 1. Node i of the mesh is i + 1 at y = 0, n behind it at y
// = 1. Prisms and hexahedra stand on the face at y = 1, whose normal points to y = 0; faces of the boundary are ordered
// so that normals point into the domain. Markers are numbered from 1; then come the planes y = 0 and y = 1. Read back:
// both, with the markers' names where there is a .mapbc.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <string>

#include <lamina/error.hpp>
#include <lamina/files.hpp>

#include "core/atomic_file.hpp"
#include "core/text.hpp"
#include "io/binary_output.hpp"
#include "io/byte_reader.hpp"
#include "io/formats.hpp"
#include "io/mesh_parts.hpp"
#include "io/text_output.hpp"

namespace lamina::io {

namespace fs = std::filesystem;

namespace {

constexpr int viscous_wall = 4000, far_field = 5000, symmetry_x = 6661, symmetry_y = 6662, symmetry_z = 6663;

enum class Encoding { text, big_endian, little_endian };

Encoding encoding_of(const fs::path& file) {
    const std::string inner = core::extension_of(file.stem());
    return inner == ".b8" ? Encoding::big_endian : inner == ".lb8" ? Encoding::little_endian : Encoding::text;
}

/// "wing.b8.ugrid" -> "wing.mapbc".
fs::path mapbc_of(const fs::path& file) {
    fs::path stem = file;
    stem.replace_extension();
    if (encoding_of(file) != Encoding::text) stem.replace_extension();
    return stem += ".mapbc";
}

// --- Writing

/// A plane of symmetry of the plane mesh is x = constant, or y, which is z in three dimensions.
int code_of(const Mesh& mesh, const Marker& marker) {
    switch (marker.kind) {
        case MarkerKind::wall:
            return viscous_wall;
        case MarkerKind::far_field:
            return far_field;
        case MarkerKind::symmetry: {
            Box box;
            for (const Segment& edge : marker.edges) box.include(mesh.points[edge.a.index()]);
            return box.width() < box.height() ? symmetry_x : symmetry_z;
        }
        case MarkerKind::other:
            break;
    }
    return 0;  // no condition: for the user to say
}

void write_mapbc(const Mesh& mesh, bool with_planes, std::ostream& out) {
    out << mesh.markers.size() + (with_planes ? 2 : 0) << '\n';
    std::size_t number = 0;
    for (const Marker& marker : mesh.markers)
        out << fmt::format("{} {} {}\n", ++number, code_of(mesh, marker), marker.name);
    if (!with_planes) return;
    out << fmt::format("{} {} y0\n", ++number, symmetry_y);
    out << fmt::format("{} {} y1\n", ++number, symmetry_y);
}

void write_plane(const Mesh& mesh, std::ostream& out) {
    out << fmt::format("{} {} {} 0 0 0 0\n", mesh.points.size(), mesh.triangles.size(), mesh.quads.size());
    write_lines(out, mesh.points.size(), [&](LineText& line, std::size_t i) { line << mesh.points[i] << "0"; });
    write_lines(out, mesh.triangles.size(), [&](LineText& line, std::size_t i) {
        for (const VertexId v : mesh.triangles[i].v) line << v.index() + 1;
    });
    write_lines(out, mesh.quads.size(), [&](LineText& line, std::size_t i) {
        for (const VertexId v : mesh.quads[i].v) line << v.index() + 1;
    });
    write_lines(out, mesh.triangles.size() + mesh.quads.size(), [](LineText& line, std::size_t) { line << "1"; });
    std::size_t edges = 0;
    for (const Marker& marker : mesh.markers) edges += marker.edges.size();
    out << edges << '\n';
    for (std::size_t m = 0; m < mesh.markers.size(); ++m)
        write_lines(out, mesh.markers[m].edges.size(), [&](LineText& line, std::size_t i) {
            const Segment& edge = mesh.markers[m].edges[i];
            line << edge.a.index() + 1 << edge.b.index() + 1 << m + 1;
        });
}

/// Sends lists of numbers as lines or as binary records.
class NumberWriter {
public:
    NumberWriter(std::ostream& out, Encoding encoding) : out_(out), encoding_(encoding) {}

    /// put(i, emit) calls emit(value) `each` times; values of one type.
    template <class T, class Put>
    void list(std::size_t n, std::size_t each, Put&& put) {
        if (encoding_ == Encoding::text) {
            write_lines(out_, n, [&](LineText& line, std::size_t i) { put(i, [&](T value) { line << value; }); });
            return;
        }
        const ByteOrder order = encoding_ == Encoding::big_endian ? ByteOrder::big : ByteOrder::little;
        write_records(out_, n, each * stored_size<T>(), [&](char* p, std::size_t i) {
            put(i, [&](T value) {
                if constexpr (std::is_same_v<T, double>)
                    p = store(p, value, order);
                else
                    p = store(p, static_cast<std::int32_t>(value), order);
            });
        });
    }

private:
    template <class T>
    static constexpr std::size_t stored_size() {
        return std::is_same_v<T, double> ? 8 : 4;
    }

    std::ostream& out_;
    Encoding encoding_;
};

void write_one_cell_thick(const Mesh& mesh, Encoding encoding, std::ostream& out) {
    const std::size_t n = mesh.points.size(), triangles = mesh.triangles.size(), quads = mesh.quads.size();
    std::size_t edges = 0;
    for (const Marker& marker : mesh.markers) edges += marker.edges.size();
    const std::array<std::size_t, 7> counts{2 * n, 2 * triangles, edges + 2 * quads, 0, 0, triangles, quads};
    NumberWriter writer(out, encoding);
    writer.list<std::size_t>(1, 7, [&](std::size_t, auto emit) {
        for (const std::size_t count : counts) emit(count);
    });
    writer.list<double>(2 * n, 3, [&](std::size_t i, auto emit) {
        const Point p = mesh.points[i < n ? i : i - n];
        emit(p.x), emit(i < n ? 0.0 : 1.0), emit(p.y);
    });

    // Faces at y = 0 run clockwise in x-z, those at y = 1 counter-clockwise.
    const auto write_planes = [&](const auto& cells) {
        constexpr std::size_t corners = std::size(decltype(cells[0].v){});
        for (const bool lower : {true, false})
            writer.list<std::size_t>(cells.size(), corners, [&](std::size_t i, auto emit) {
                for (std::size_t k = 0; k < corners; ++k)
                    emit(lower ? cells[i].v[corners - 1 - k].index() + 1 : n + cells[i].v[k].index() + 1);
            });
    };
    write_planes(mesh.triangles);
    for (const Marker& marker : mesh.markers)
        writer.list<std::size_t>(marker.edges.size(), 4, [&](std::size_t i, auto emit) {
            const std::size_t a = marker.edges[i].a.index() + 1, b = marker.edges[i].b.index() + 1;
            emit(a), emit(b), emit(n + b), emit(n + a);
        });
    write_planes(mesh.quads);

    const auto write_numbers = [&](std::size_t count, std::size_t number) {
        writer.list<std::size_t>(count, 1, [&](std::size_t, auto emit) { emit(number); });
    };
    const std::size_t markers = mesh.markers.size();
    write_numbers(triangles, markers + 1);
    write_numbers(triangles, markers + 2);
    for (std::size_t m = 0; m < markers; ++m) write_numbers(mesh.markers[m].edges.size(), m + 1);
    write_numbers(quads, markers + 1);
    write_numbers(quads, markers + 2);

    const auto write_volumes = [&](const auto& cells) {
        constexpr std::size_t corners = std::size(decltype(cells[0].v){});
        writer.list<std::size_t>(cells.size(), 2 * corners, [&](std::size_t i, auto emit) {
            for (const std::size_t shift : {n, std::size_t{0}})
                for (std::size_t k = 0; k < corners; ++k) emit(shift + cells[i].v[k].index() + 1);
        });
    };
    write_volumes(mesh.triangles);
    write_volumes(mesh.quads);
}

void write_with_mapbc(const Mesh& mesh, const fs::path& file, bool thick) {
    require_marker_names(mesh, file, "UGRID", " ", 1000);
    if (mesh.points.size() > std::numeric_limits<std::int32_t>::max() / 2)
        throw UsageError(fmt::format("{}: UGRID numbers no more than 2^31 nodes", file.string()));
    const std::array<fs::path, 2> targets{file, mapbc_of(file)};
    core::write_files_atomically(targets, [&](std::span<const fs::path> temporaries) {
        core::write_stream(temporaries[0], targets[0], [&](std::ostream& out) {
            thick ? write_one_cell_thick(mesh, encoding_of(file), out) : write_plane(mesh, out);
        });
        core::write_stream(temporaries[1], targets[1], [&](std::ostream& out) { write_mapbc(mesh, thick, out); });
    });
}

// --- Reading

struct Condition {
    std::string name;
    MarkerKind kind = MarkerKind::other;
};

/// Numbers, codes and names of the boundaries; empty where there is no .mapbc.
std::map<int, Condition> read_mapbc(const fs::path& file) {
    std::map<int, Condition> conditions;
    std::error_code ignored;
    if (!fs::exists(file, ignored)) return conditions;
    const std::string bytes = read_file(file);
    ByteReader in(bytes, file.string());
    const auto n = in.figures<std::size_t>("number of boundaries");
    for (std::size_t i = 0; i < n; ++i) {
        const auto number = in.figures<int>("number of a boundary"), code = in.figures<int>("boundary condition");
        Condition condition{std::string(in.rest_of_line()), MarkerKind::other};
        if (code == viscous_wall || code == 3000) condition.kind = MarkerKind::wall;
        if (code == far_field) condition.kind = MarkerKind::far_field;
        if (code >= symmetry_x && code <= symmetry_z) condition.kind = MarkerKind::symmetry;
        if (condition.name.empty()) in.fail("name of the boundary expected");
        if (!conditions.emplace(number, condition).second) in.fail(fmt::format("boundary {} stands twice", number));
    }
    if (!in.at_end()) in.fail("something follows the last boundary");
    return conditions;
}

class UgridReader {
public:
    UgridReader(const std::string& bytes, const fs::path& file)
        : in_(bytes, file.string()), conditions_(read_mapbc(mapbc_of(file))) {
        const Encoding encoding = encoding_of(file);
        if (encoding != Encoding::text)
            in_.be_binary(encoding == Encoding::big_endian ? ByteOrder::big : ByteOrder::little);
    }

    Mesh read() {
        std::array<std::size_t, 7> counts;
        for (std::size_t& count : counts) {
            const auto value = in_.number<std::int32_t>("count");
            if (value < 0) in_.fail("negative count");
            count = in_.count(static_cast<std::size_t>(value), 4, "count");
        }
        const auto [nodes, triangles, quads, tetrahedra, pyramids, prisms, hexahedra] = counts;
        if (tetrahedra + pyramids > 0) in_.fail("tetrahedra and pyramids: the mesh is not one cell thick");
        in_.count(nodes, 24, "number of nodes");
        for (std::size_t i = 0; i < nodes; ++i) {
            auto& [x, y, z] = nodes_.emplace_back();
            for (double* c : {&x, &y, &z}) {
                *c = in_.number<double>("coordinate");
                if (!std::isfinite(*c)) in_.fail("coordinate is not a finite number");
            }
        }
        const std::vector<Face> faces = read_faces(triangles, quads);
        if (prisms + hexahedra == 0)
            gather_plane(faces);
        else
            gather_one_cell_thick(faces, prisms, hexahedra);
        if (!in_.at_end()) in_.fail("something follows the last number");
        name_markers();
        orient_markers(mesh_);
        return std::move(mesh_);
    }

private:
    struct Face {
        std::size_t corners = 3;
        std::array<std::uint32_t, 4> v{};
        int number = 0;
    };

    std::uint32_t node() {
        const auto number = in_.number<std::int32_t>("node");
        if (number < 1 || static_cast<std::size_t>(number) > nodes_.size())
            in_.fail(fmt::format("node {} where there are {}", number, nodes_.size()));
        return static_cast<std::uint32_t>(number - 1);
    }
    std::vector<Face> read_faces(std::size_t triangles, std::size_t quads) {
        std::vector<Face> faces;
        for (std::size_t i = 0; i < triangles + quads; ++i) {
            Face& face = faces.emplace_back();
            face.corners = i < triangles ? 3 : 4;
            for (std::size_t k = 0; k < face.corners; ++k) face.v[k] = node();
        }
        for (Face& face : faces) face.number = in_.number<std::int32_t>("number of a surface");
        return faces;
    }
    void add_cell(const Face& face, const std::vector<VertexId>& vertex, bool reversed) {
        VertexId v[4];
        for (std::size_t k = 0; k < face.corners; ++k) v[k] = vertex[face.v[reversed ? face.corners - 1 - k : k]];
        if (face.corners == 3)
            mesh_.triangles.push_back({{v[0], v[1], v[2]}});
        else
            mesh_.quads.push_back({{v[0], v[1], v[2], v[3]}});
    }

    void gather_plane(const std::vector<Face>& faces) {
        std::vector<VertexId> vertex;
        for (const auto& [x, y, z] : nodes_) {
            vertex.emplace_back(mesh_.points.size());
            mesh_.points.push_back({x, y});
        }
        for (const Face& face : faces) add_cell(face, vertex, false);
        const auto edges = in_.number<std::int32_t>("number of edges of the boundary");
        for (std::int32_t i = 0; i < edges; ++i) {
            const std::uint32_t a = node(), b = node();
            edges_[in_.number<std::int32_t>("number of a boundary")].push_back({vertex[a], vertex[b]});
        }
    }

    /// Faces with all nodes at the lesser y are the cells, those with two of them the edges of the boundary.
    void gather_one_cell_thick(const std::vector<Face>& faces, std::size_t prisms, std::size_t hexahedra) {
        for (std::size_t i = 0; i < 6 * prisms + 8 * hexahedra; ++i) node();
        double low = HUGE_VAL, high = -HUGE_VAL;
        for (const auto& [x, y, z] : nodes_) low = std::min(low, y), high = std::max(high, y);
        std::vector<VertexId> vertex(nodes_.size());
        for (std::size_t i = 0; i < nodes_.size(); ++i) {
            const auto& [x, y, z] = nodes_[i];
            if (y != low && y != high) in_.fail(fmt::format("node {} lies between the planes of the mesh", i + 1));
            if (y == high) continue;
            vertex[i] = VertexId(mesh_.points.size());
            mesh_.points.push_back({x, z});
        }
        for (const Face& face : faces) {
            std::size_t lower = 0, k = 0;
            for (std::size_t c = 0; c < face.corners; ++c) lower += vertex[face.v[c]].valid();
            if (lower == face.corners) {
                // Inward normals make it clockwise; other programs may not.
                const auto at = [&](std::size_t c) { return mesh_.points[vertex[face.v[c]].index()]; };
                add_cell(face, vertex, cross(at(1) - at(0), at(2) - at(0)) < 0);
            } else if (lower == 2 && face.corners == 4) {
                while (k < 4 && !(vertex[face.v[k]].valid() && vertex[face.v[(k + 1) % 4]].valid())) ++k;
                if (k == 4) in_.fail("a face that does not stand on an edge");
                edges_[face.number].push_back({vertex[face.v[k]], vertex[face.v[(k + 1) % 4]]});
            } else if (lower != 0) {
                in_.fail("a face that does not stand on an edge");
            }
        }
        if (mesh_.triangles.size() != prisms || mesh_.quads.size() != hexahedra)
            in_.fail("the mesh is not one cell thick in y");
    }

    void name_markers() {
        for (auto& [number, edges] : edges_) {
            const auto found = conditions_.find(number);
            Condition condition{fmt::format("boundary{}", number), MarkerKind::other};
            if (found != conditions_.end()) condition = found->second;
            mesh_.markers.push_back({condition.name, condition.kind, std::move(edges)});
        }
    }

    ByteReader in_;
    std::map<int, Condition> conditions_;
    std::vector<std::array<double, 3>> nodes_;
    std::map<int, std::vector<Segment>> edges_;
    Mesh mesh_;
};

}  // namespace

void check_ugrid_writable(const fs::path& file) {
    check_folder_writable(file);
    check_folder_writable(mapbc_of(file));
}

void write_ugrid(const Mesh& mesh, const fs::path& file) { write_with_mapbc(mesh, file, false); }

void write_fun3d(const Mesh& mesh, const fs::path& file) { write_with_mapbc(mesh, file, true); }

Mesh read_ugrid(const std::string& bytes, const fs::path& file) { return UgridReader(bytes, file).read(); }

}  // namespace lamina::io
