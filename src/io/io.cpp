// The table of formats, and what all of them share.
#include <lamina/io.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include <lamina/error.hpp>

#include "core/atomic_file.hpp"
#include "io/formats.hpp"

namespace lamina {

namespace fs = std::filesystem;

namespace {

struct Format {
    const char* extension;
    void (*write)(const Mesh&, const fs::path&, std::ostream&);
    Mesh (*read)(const std::string&, const fs::path&);
};

constexpr Format formats[] = {
    {".su2", detail::write_su2, detail::read_su2},
    {".vtu", detail::write_vtu, detail::read_vtu},
};

/// By its name where one is given, else by the extension of the file.
const Format& format_of(const fs::path& file, const std::string& name = {}) {
    const std::string extension = name.empty() ? detail::extension_of(file) : "." + name;
    std::string known;
    for (const Format& format : formats) {
        if (extension == format.extension) return format;
        known += fmt::format("{}{}", known.empty() ? "" : ", ", format.extension);
    }
    if (!name.empty())
        throw UsageError(fmt::format("no mesh format is named '{}' (known extensions: {})", name, known));
    throw UsageError(
        fmt::format("{}: no mesh format has the extension '{}' (known: {})", file.string(), extension, known));
}

}  // namespace

namespace detail {

std::string extension_of(const fs::path& file) {
    std::string extension = file.extension().string();
    for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return extension;
}

void orient_markers(Mesh& mesh) {
    // Cells have far more edges than the boundary: look only at those with both ends on a marker.
    std::vector<bool> on_marker(mesh.points.size(), false);
    for (const Marker& marker : mesh.markers)
        for (const Segment& edge : marker.edges) on_marker[edge.a.index()] = on_marker[edge.b.index()] = true;
    std::vector<Segment> of_cells;
    const auto look_at = [&](VertexId a, VertexId b) {
        if (on_marker[a.index()] && on_marker[b.index()]) of_cells.push_back({a, b});
    };
    for (const Triangle& t : mesh.triangles)
        for (int i = 0; i < 3; ++i) look_at(t.v[i], t.v[(i + 1) % 3]);
    for (const Quad& q : mesh.quads)
        for (int i = 0; i < 4; ++i) look_at(q.v[i], q.v[(i + 1) % 4]);
    std::sort(of_cells.begin(), of_cells.end());

    const auto has = [&](VertexId a, VertexId b) {
        return std::binary_search(of_cells.begin(), of_cells.end(), Segment{a, b});
    };
    for (Marker& marker : mesh.markers)
        for (Segment& edge : marker.edges)
            if (!has(edge.a, edge.b) && has(edge.b, edge.a)) std::swap(edge.a, edge.b);
}

}  // namespace detail

void write_mesh(const Mesh& mesh, const fs::path& file, const std::string& format) {
    const Format& found = format_of(file, format);
    check_folder_writable(file);
    write_stream_atomically(file, [&](std::ostream& out) { found.write(mesh, file, out); });
}

Mesh read_mesh(const fs::path& file) {
    const Format& format = format_of(file);
    return format.read(read_whole_file(file), file);
}

void check_writable(const fs::path& file, const std::string& format) {
    format_of(file, format);
    check_folder_writable(file);
}

}  // namespace lamina
