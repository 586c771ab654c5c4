// The table of formats.
#include <fmt/format.h>

#include <algorithm>

#include <lamina/error.hpp>
#include <lamina/files.hpp>

#include "core/atomic_file.hpp"
#include "core/text.hpp"
#include "io/formats.hpp"

namespace lamina::io {

namespace fs = std::filesystem;

namespace {

/// A writer of one file from one that sends to a stream.
template <auto write_to_stream>
void write_file(const Mesh& mesh, const fs::path& file, const WriteOptions&) {
    core::write_stream_atomically(file, [&](std::ostream& out) { write_to_stream(mesh, file, out); });
}

template <auto parse>
Mesh read_bytes_of(const fs::path& file) {
    return parse(lamina::read_file(file), file);
}

template <bool version_4, bool binary>
void write_msh_variant(const Mesh& mesh, const fs::path& file, std::ostream& out) {
    write_msh(mesh, file, {version_4, binary}, out);
}

template <bool adf, bool three_coordinates>
void write_cgns_variant(const Mesh& mesh, const fs::path& file, const WriteOptions&) {
    write_cgns(mesh, file, {adf, three_coordinates});
}

template <bool compressed>
void write_vtu_variant(const Mesh& mesh, const fs::path& file, const WriteOptions& options) {
    core::write_stream_atomically(file, [&](std::ostream& out) {
        write_vtu(mesh, {compressed, options.wall_distance}, out);
    });
}

/// A writer that sees to its files itself.
template <auto write>
void write_files(const Mesh& mesh, const fs::path& file, const WriteOptions&) {
    write(mesh, file);
}

std::vector<Format> make_table() {
    std::vector<Format> table;
    const auto add = [&](const char* name, std::vector<std::string> extensions, const char* holds, auto write,
                         Mesh (*read)(const fs::path&), auto check) {
        table.push_back({name, std::move(extensions), holds, write, read, true, check});
    };
    constexpr auto msh = read_bytes_of<read_msh>;
    add("su2", {".su2"}, "SU2 native mesh, ASCII", write_file<write_su2>, read_bytes_of<read_su2>,
        check_folder_writable);
    add("cgns", {".cgns"}, "CGNS, HDF5", write_cgns_variant<false, false>, read_cgns, check_folder_writable);
    add("cgns-3d", {".cgns"}, "CGNS, HDF5, with CoordinateZ = 0", write_cgns_variant<false, true>, read_cgns,
        check_folder_writable);
    add("cgns-adf", {".cgns"}, "CGNS, ADF", write_cgns_variant<true, false>, read_cgns, check_folder_writable);
    add("msh41", {".msh"}, "Gmsh MSH 4.1, ASCII", write_file<write_msh_variant<true, false>>, msh,
        check_folder_writable);
    add("msh41-binary", {".msh"}, "Gmsh MSH 4.1, binary", write_file<write_msh_variant<true, true>>, msh,
        check_folder_writable);
    add("msh22", {".msh"}, "Gmsh MSH 2.2, ASCII", write_file<write_msh_variant<false, false>>, msh,
        check_folder_writable);
    add("msh22-binary", {".msh"}, "Gmsh MSH 2.2, binary", write_file<write_msh_variant<false, true>>, msh,
        check_folder_writable);
    add("msh22-extruded", {".msh"}, "Gmsh MSH 2.2, ASCII, one cell thick, for gmshToFoam",
        write_file<write_msh_extruded>, nullptr, check_folder_writable);
    add("vtu", {".vtu"}, "VTK unstructured grid, raw binary, for ParaView", write_vtu_variant<false>,
        read_bytes_of<read_vtu>, check_folder_writable);
    add("vtu-zlib", {".vtu"}, "VTK unstructured grid, compressed by zlib", write_vtu_variant<true>,
        read_bytes_of<read_vtu>, check_folder_writable);
    add("openfoam", {"polyMesh"}, "OpenFOAM polyMesh folder, ASCII, one cell thick", write_files<write_openfoam>,
        read_openfoam, check_openfoam_writable);
    add("ugrid", {".ugrid"}, "UGRID, plane, ASCII, with .mapbc", write_files<write_ugrid>, read_bytes_of<read_ugrid>,
        check_ugrid_writable);
    add("fun3d", {".b8.ugrid", ".lb8.ugrid"}, "UGRID for FUN3D, one cell thick, with .mapbc", write_files<write_fun3d>,
        read_bytes_of<read_ugrid>, check_ugrid_writable);
    add("triangle", {".node", ".ele"}, "Triangle's .node, .ele, .edge and .poly", write_files<write_triangle_mesh>,
        read_triangle_mesh, check_triangle_writable);
    table.back().quads = false;
    return table;
}

}  // namespace

const std::vector<Format>& formats() {
    static const std::vector<Format> table = make_table();
    return table;
}

const Format& format_of(const fs::path& file, const std::string& name) {
    const fs::path last = file.has_filename() ? file : file.parent_path();  // of "case/polyMesh/", too
    const std::string ending = core::lower_case(name.empty() ? last.filename().string() : "." + name);
    const Format* found = nullptr;
    std::size_t longest = 0;
    std::string names;
    std::vector<std::string> extensions;
    for (const Format& format : formats()) {
        if (name == format.name) return format;
        names += fmt::format("{}{}", names.empty() ? "" : ", ", format.name);
        for (const std::string& extension : format.extensions) {
            if (std::find(extensions.begin(), extensions.end(), extension) == extensions.end())
                extensions.push_back(extension);
            if (ending.ends_with(core::lower_case(extension)) && extension.size() > longest) {
                found = &format;
                longest = extension.size();
            }
        }
    }
    if (found != nullptr) return *found;
    if (!name.empty()) throw UsageError(fmt::format("no mesh format is named '{}' (known: {})", name, names));
    throw UsageError(fmt::format("{}: no mesh format has the extension '{}' (known: {})", file.string(),
                                 core::extension_of(file), fmt::join(extensions, ", ")));
}

}  // namespace lamina::io
