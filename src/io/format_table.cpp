// The table of formats: the one place that lists them.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <utility>

#include <lamina/error.hpp>
#include <lamina/files.hpp>

#include "core/atomic_file.hpp"
#include "core/file_name.hpp"
#include "core/suggestion.hpp"
#include "core/text.hpp"
#include "io/formats.hpp"

namespace lamina::io {

namespace fs = std::filesystem;

namespace {

// --- Adapters between the functions of the formats and the columns of the table

/// Writes one file by a function that writes to a stream.
template <auto write_to_stream>
void write_one_file(const MeshView& mesh, const fs::path& file, const WriteOptions&) {
    core::write_stream_atomically(file, [&](std::ostream& out) { write_to_stream(mesh, file, out); });
}

std::vector<fs::path> one_file(const fs::path& file, const WriteOptions&) { return {file}; }

/// Returns several files by a function that knows their names.
template <auto files>
std::vector<fs::path> named_files(const fs::path& file, const WriteOptions&) {
    return files(file);
}

/// Writes several files by a function that sees to them itself.
template <auto write>
void write_files(const MeshView& mesh, const fs::path& file, const WriteOptions&) {
    write(mesh, file);
}

template <auto parse>
auto read_one_file(const fs::path& file) {
    return parse(read_file(file), input_name(file));
}

template <bool version_4, bool binary>
void write_curved_msh(const MeshView& mesh, const CurvedNodes& nodes, const fs::path& file, const WriteOptions&) {
    core::write_stream_atomically(file, [&](std::ostream& out) {
        write_msh(mesh, nodes, file, {version_4, binary}, out);
    });
}
template <bool version_4, bool binary>
void write_straight_msh(const MeshView& mesh, const fs::path& file, const WriteOptions& options) {
    write_curved_msh<version_4, binary>(mesh, {}, file, options);
}

/// Writes one file by a function that writes curved cells to a stream.
template <auto write_to_stream>
void write_one_curved_file(const MeshView& mesh, const CurvedNodes& nodes, const fs::path& file, const WriteOptions&) {
    core::write_stream_atomically(file, [&](std::ostream& out) { write_to_stream(mesh, nodes, file, out); });
}
template <auto write_to_stream>
void write_one_straight_file(const MeshView& mesh, const fs::path& file, const WriteOptions& options) {
    write_one_curved_file<write_to_stream>(mesh, {}, file, options);
}

template <bool compressed>
void write_curved_vtu_variant(const MeshView& mesh, const CurvedNodes& nodes, const fs::path& file,
                              const WriteOptions&) {
    core::write_stream_atomically(file, [&](std::ostream& out) { write_curved_vtu(mesh, nodes, compressed, out); });
}

template <bool binary>
void write_fluent_variant(const MeshView& mesh, const fs::path& file, std::ostream& out) {
    write_fluent(mesh, file, binary, out);
}

void write_extruded_msh(const MeshView& mesh, const fs::path& file, const WriteOptions& options) {
    const Extrusion extrusion = extrusion_of(mesh, file, options);
    core::write_stream_atomically(file, [&](std::ostream& out) { write_msh_extruded(mesh, file, extrusion, out); });
}

template <bool compressed>
void write_vtu_variant(const MeshView& mesh, const fs::path& file, const WriteOptions& options) {
    const Extrusion extrusion = extrusion_of(mesh, file, options);
    core::write_stream_atomically(file, [&](std::ostream& out) {
        if (options.span > 0)
            write_vtu_extruded(mesh, extrusion, compressed, out);
        else
            write_vtu(mesh, {compressed, options.wall_distance}, out);
    });
}

std::vector<fs::path> pvtu_targets(const fs::path& file, const WriteOptions& options) {
    return pvtu_files(file, options.parts);
}
void write_pvtu_parts(const MeshView& mesh, const fs::path& file, const WriteOptions& options) {
    write_pvtu(mesh, file, options.parts);
}

std::vector<fs::path> openfoam_targets(const fs::path& file, const WriteOptions& options) {
    std::vector<fs::path> files{poly_mesh_folder(file)};
    if (options.parts > 1) files.push_back(openfoam_parts_file(file));
    return files;
}
void write_openfoam_parts(const MeshView& mesh, const fs::path& file, const WriteOptions& options) {
    write_openfoam(mesh, file, extrusion_of(mesh, file, options), options.parts);
}

void write_thick_ugrid(const MeshView& mesh, const fs::path& file, const WriteOptions& options) {
    write_fun3d(mesh, file, extrusion_of(mesh, file, options));
}

#ifdef LAMINA_WITH_CGNS
template <bool adf, bool three_coordinates>
void write_cgns_variant(const MeshView& mesh, const fs::path& file, const WriteOptions& options) {
    const Extrusion extrusion = extrusion_of(mesh, file, options);
    write_cgns(mesh, {}, file, {adf, three_coordinates, options.span > 0 ? &extrusion : nullptr});
}

template <bool adf, bool three_coordinates>
void write_curved_cgns_variant(const MeshView& mesh, const CurvedNodes& nodes, const fs::path& file,
                               const WriteOptions&) {
    write_cgns(mesh, nodes, file, {adf, three_coordinates, nullptr});
}
#endif

// --- The rows

FormatRow su2_row() {
    return {.name = "su2",
            .extensions = {".su2"},
            .description = "SU2 native mesh, ASCII",
            .write = write_one_file<write_su2>,
            .files = one_file,
            .read = read_one_file<read_su2>,
            .read_stored = read_su2_arrays,
            .layout = su2_layout,
            .one_stream = true};
}

/// Returns no rows where this build is without CGNS.
std::vector<FormatRow> cgns_rows() {
    std::vector<FormatRow> rows;
#ifdef LAMINA_WITH_CGNS
    const auto add = [&]<bool adf, bool three_coordinates>(const char* name, const char* description) {
        rows.push_back({.name = name,
                        .extensions = {".cgns"},
                        .description = description,
                        .write = write_cgns_variant<adf, three_coordinates>,
                        .files = one_file,
                        .write_curved = write_curved_cgns_variant<adf, three_coordinates>,
                        .read_curved = read_curved_cgns,
                        .read = read_cgns,
                        .takes_span = true,
                        .internal_markers = true});
    };
    add.operator()<false, false>("cgns", "CGNS, HDF5");
    add.operator()<false, true>("cgns-3d", "CGNS, HDF5, with CoordinateZ = 0");
    add.operator()<true, false>("cgns-adf", "CGNS, ADF");
#endif
    return rows;
}

std::vector<FormatRow> msh_rows() {
    std::vector<FormatRow> rows;
    const auto add = [&]<bool version_4, bool binary>(const char* name, const char* description) {
        rows.push_back({.name = name,
                        .extensions = {".msh"},
                        .description = description,
                        .write = write_straight_msh<version_4, binary>,
                        .files = one_file,
                        .write_curved = write_curved_msh<version_4, binary>,
                        .read_curved = read_one_file<read_curved_msh>,
                        .read = read_one_file<read_msh>,
                        .read_sizes = read_msh_sizes,
                        .one_stream = true,
                        .internal_markers = true});
    };
    add.operator()<true, false>("msh41", "Gmsh MSH 4.1, ASCII");
    add.operator()<true, true>("msh41-binary", "Gmsh MSH 4.1, binary");
    add.operator()<false, false>("msh22", "Gmsh MSH 2.2, ASCII");
    add.operator()<false, true>("msh22-binary", "Gmsh MSH 2.2, binary");
    rows.push_back({.name = "msh22-extruded",
                    .extensions = {".msh"},
                    .description = "Gmsh MSH 2.2, ASCII, in space, for gmshToFoam",
                    .write = write_extruded_msh,
                    .files = one_file,
                    .read = read_one_file<read_msh>,
                    .takes_span = true,
                    .one_stream = true});
    return rows;
}

std::vector<FormatRow> vtu_rows() {
    std::vector<FormatRow> rows;
    const auto add = [&]<bool compressed>(const char* name, const char* description) {
        rows.push_back({.name = name,
                        .extensions = {".vtu"},
                        .description = description,
                        .write = write_vtu_variant<compressed>,
                        .files = one_file,
                        .write_curved = write_curved_vtu_variant<compressed>,
                        .read_curved = read_one_file<read_curved_vtu>,
                        .read = read_one_file<read_vtu>,
                        .read_stored = read_vtu_arrays,
                        .read_sizes = read_vtu_sizes,
                        .takes_span = true,
                        .one_stream = true,
                        .internal_markers = true});
    };
    add.operator()<false>("vtu", "VTK unstructured grid, raw binary, for ParaView");
    rows.back().layout = vtu_layout;
    add.operator()<true>("vtu-zlib", "VTK unstructured grid, compressed by zlib");
    rows.push_back({.name = "pvtu",
                    .extensions = {".pvtu"},
                    .description = "VTK unstructured grid in parts (--parts), each a VTU file",
                    .write = write_pvtu_parts,
                    .files = pvtu_targets,
                    .write_shared = write_shared_pvtu,
                    .takes_parts = true});
    return rows;
}

FormatRow openfoam_row() {
    return {.name = "openfoam",
            .extensions = {"polyMesh"},
            .description = "OpenFOAM polyMesh folder, ASCII, in space",
            .write = write_openfoam_parts,
            .files = openfoam_targets,
            .check = check_openfoam_writable,
            .read = read_openfoam,
            .recognizes = holds_openfoam_mesh,
            .takes_parts = true,
            .takes_span = true,
            .internal_markers = true};
}

std::vector<FormatRow> fluent_rows() {
    std::vector<FormatRow> rows;
    const auto add = [&](const char* name, const char* description, auto write) {
        rows.push_back({.name = name,
                        .extensions = {".cas"},
                        .description = description,
                        .write = write,
                        .files = one_file,
                        .read = read_one_file<read_fluent>,
                        .one_stream = true,
                        .internal_markers = true});
    };
    add("fluent", "Ansys Fluent mesh, ASCII", write_one_file<write_fluent_variant<false>>);
    rows.back().recognizes = holds_fluent_mesh;
    add("fluent-binary", "Ansys Fluent mesh, binary", write_one_file<write_fluent_variant<true>>);
    return rows;
}

std::vector<FormatRow> ugrid_rows() {
    std::vector<FormatRow> rows;
    const auto add = [&](const char* name, const std::vector<std::string>& extensions, const char* description,
                         auto write) {
        rows.push_back({.name = name,
                        .extensions = extensions,
                        .description = description,
                        .write = write,
                        .files = named_files<ugrid_files>,
                        .read = read_one_file<read_ugrid>});
    };
    add("ugrid", {".ugrid"}, "UGRID, plane, ASCII, with .mapbc", write_files<write_ugrid>);
    add("fun3d", {".b8.ugrid", ".lb8.ugrid"}, "UGRID for FUN3D, in space, with .mapbc", write_thick_ugrid);
    rows.back().takes_span = true;
    return rows;
}

FormatRow mfem_row() {
    return {.name = "mfem",
            .extensions = {".mesh"},
            .description = "MFEM mesh 1.0, ASCII",
            .write = write_one_straight_file<write_mfem>,
            .files = one_file,
            .write_curved = write_one_curved_file<write_mfem>,
            .one_stream = true,
            .gauss_lobatto = true};
}

FormatRow nektar_row() {
    return {.name = "nektar",
            .extensions = {".xml"},
            .description = "Nektar++ geometry, XML",
            .write = write_one_straight_file<write_nektar>,
            .files = one_file,
            .write_curved = write_one_curved_file<write_nektar>,
            .read_curved = read_one_file<read_curved_nektar>,
            .read = read_one_file<read_nektar>,
            .one_stream = true,
            .internal_markers = true,
            .gauss_lobatto = true};
}

FormatRow triangle_row() {
    return {.name = "triangle",
            .extensions = {".node", ".ele"},
            .description = "Triangle's .node, .ele, .edge and .poly",
            .write = write_files<write_triangle_mesh>,
            .files = named_files<triangle_mesh_files>,
            .read = read_triangle_mesh,
            .quads = false};
}

std::vector<FormatRow> make_table() {
    std::vector<FormatRow> table;
    const auto add = [&](const std::vector<FormatRow>& rows) { table.insert(table.end(), rows.begin(), rows.end()); };
    add({su2_row()});
    add(cgns_rows());
    add(msh_rows());
    add(vtu_rows());
    add({openfoam_row()});
    add(ugrid_rows());
    add(fluent_rows());
    add({triangle_row()});
    add({mfem_row()});
    add({nektar_row()});
    return table;
}

std::vector<std::string> stream_formats() {
    std::vector<std::string> names;
    for (const FormatRow& row : format_table())
        if (row.one_stream) names.emplace_back(row.name);
    return names;
}

// --- Formats that lamina knows but that this build may leave out

/// Throws UsageError where a name, or the ending of a file's name, stands for CGNS and this build is without it.
void refuse_missing_cgns(const fs::path& file, const std::string& name, const std::string& ending) {
    constexpr std::array<const char*, 3> cgns_names{"cgns", "cgns-3d", "cgns-adf"};
    const bool is_cgns =
        ending.ends_with(".cgns") || std::find(cgns_names.begin(), cgns_names.end(), name) != cgns_names.end();
    if (is_cgns && cgns_rows().empty())
        throw UsageError(fmt::format("{}: this lamina was built without CGNS",
                                     name.empty() ? file.string() : fmt::format("format '{}'", name)));
}

/// Returns a name of ours for what other programs call a format, or the closest name that is known.
std::string meant_format(const std::string& name, const std::vector<std::string>& names) {
    static constexpr std::array<std::pair<const char*, const char*>, 10> other_names{{{"gmsh", "msh41"},
                                                                                      {"gmsh2", "msh22"},
                                                                                      {"gmsh4", "msh41"},
                                                                                      {"vtk", "vtu"},
                                                                                      {"paraview", "vtu"},
                                                                                      {"foam", "openfoam"},
                                                                                      {"hdf5", "cgns"},
                                                                                      {"aflr", "ugrid"},
                                                                                      {"ansys", "fluent"},
                                                                                      {"nektar++", "nektar"}}};
    for (const auto& [other, ours] : other_names)
        if (core::lower_case(name) == other) return ours;
    return closest_word(name, names);
}

/// Returns the format of this name, or with this extension; where no name is given, by the name of the file.
const FormatRow& look_up(const fs::path& file, const std::string& name) {
    for (const FormatRow& row : format_table())
        if (name == row.name) return row;

    // A path may end in a separator: "case/polyMesh/".
    const fs::path last = file.has_filename() ? file : file.parent_path();
    const std::string ending = core::lower_case(name.empty() ? last.filename().string() : "." + name);
    const FormatRow* found = nullptr;
    std::size_t found_length = 0;
    std::vector<std::string> names, extensions;
    for (const FormatRow& row : format_table()) {
        names.emplace_back(row.name);
        for (const std::string& extension : row.extensions) {
            if (std::find(extensions.begin(), extensions.end(), extension) == extensions.end())
                extensions.push_back(extension);
            if (ending.ends_with(core::lower_case(extension)) && extension.size() > found_length) {
                found = &row;
                found_length = extension.size();
            }
        }
    }
    if (found != nullptr) return *found;
    refuse_missing_cgns(file, name, ending);
    if (!name.empty())
        throw UsageError(fmt::format("no mesh format is named '{}'{} (known: {})", name,
                                     did_you_mean(meant_format(name, names)), fmt::join(names, ", ")));
    const std::string extension = core::extension_of(file);
    throw UsageError(fmt::format("{}: no mesh format has the extension '{}'{} (known: {})", file.string(), extension,
                                 did_you_mean(closest_word(extension, extensions)), fmt::join(extensions, ", ")));
}

}  // namespace

const std::vector<FormatRow>& format_table() {
    static const std::vector<FormatRow> table = make_table();
    return table;
}

const FormatRow& find_format(const fs::path& file, const std::string& name) {
    if (!is_standard_stream(file)) return look_up(file, name);
    if (name.empty()) throw UsageError("'-' has no extension that tells the format: name the format");
    const FormatRow& format = look_up(file, name);
    if (!format.one_stream)
        throw UsageError(
            fmt::format("format '{}' is not one stream of bytes, so standard input and output cannot carry "
                        "it ({} can)",
                        format.name, fmt::join(stream_formats(), ", ")));
    return format;
}

const FormatRow& format_to_read(const fs::path& file, const std::string& name) {
    if (name.empty())
        for (const FormatRow& format : format_table())
            if (format.recognizes != nullptr && format.recognizes(file)) return format;
    const FormatRow& format = find_format(file, name);
    if (format.read == nullptr) throw UsageError(fmt::format("format '{}' is only written, not read", format.name));
    return format;
}

}  // namespace lamina::io
