// The public functions for mesh files. They choose a row of the table of formats and call its functions.
#include <lamina/io.hpp>

#include <fmt/format.h>

#include <lamina/error.hpp>
#include <lamina/files.hpp>

#include "io/formats.hpp"
#include "io/mesh_parts.hpp"

namespace lamina {

using namespace io;

namespace fs = std::filesystem;

namespace {

/// Returns the format to write. Of those with the extension of the file it is one in space where there is a span.
const FormatRow& format_of(const fs::path& file, const WriteOptions& options) {
    const FormatRow& first = find_format(file, options.format);
    if (options.span <= 0 || first.takes_span || !options.format.empty()) return first;
    for (const FormatRow& row : format_table())
        if (row.takes_span && row.extensions == first.extensions) return row;
    return first;
}

}  // namespace

void write_mesh(const MeshView& mesh, const fs::path& file, const WriteOptions& options) {
    check_writable(file, options);
    const FormatRow& format = format_of(file, options);
    if (format.internal_markers) return format.write(mesh, file, options);
    const std::vector<Marker> markers = markers_of_kind(mesh.markers, false);
    MeshView boundary_alone = mesh;
    boundary_alone.markers = markers;
    format.write(boundary_alone, file, options);
}

void require_curved_format(const fs::path& file, const WriteOptions& options, unsigned order,
                           NodeDistribution distribution) {
    const FormatRow& format = format_of(file, options);
    if (options.span > 0) throw UsageError("curved cells have no span: leave the order or the span out");
    if (options.wall_distance) throw UsageError("wall distances are those from straight walls: leave the order out");
    const bool is_lobatto = order > 2 && distribution == NodeDistribution::gauss_lobatto;
    const auto holds = [&](const FormatRow& row) {
        return row.write_curved != nullptr && (!is_lobatto || row.gauss_lobatto);
    };
    if (holds(format)) return;
    std::string names;
    for (const FormatRow& row : format_table())
        if (holds(row)) names += (names.empty() ? "" : ", ") + std::string(row.name);
    if (format.write_curved == nullptr)
        throw UsageError(
            fmt::format("format '{}' holds straight cells: those with curved ones are {}", format.name, names));
    throw UsageError(
        fmt::format("format '{}' has evenly spaced nodes: those with Gauss and Lobatto's are {}", format.name, names));
}

void write_curved_mesh(const MeshView& mesh, const CurvedNodes& nodes, const fs::path& file,
                       const WriteOptions& options) {
    require_curved_format(file, options, nodes.order, nodes.distribution);
    check_writable(file, options);
    format_of(file, options).write_curved(mesh, nodes, file, options);
}

CurvedMesh read_curved_mesh(const fs::path& file, const ReadOptions& options) {
    const FormatRow& format = format_to_read(file, options.format);
    return format.read_curved != nullptr ? format.read_curved(file) : CurvedMesh{format.read(file), {}};
}

std::vector<Warning> lost_marker_warnings(std::span<const Marker> markers, const fs::path& file,
                                          const WriteOptions& options) {
    const FormatRow& format = format_of(file, options);
    const std::vector<Marker> lines = markers_of_kind(markers, true);
    if (format.internal_markers || lines.empty()) return {};
    std::string names;
    for (const Marker& line : lines) names += (names.empty() ? "" : ", ") + line.name;
    return {{.code = WarningCode::unsuited_to_solver,
             .number = static_cast<double>(lines.size()),
             .unit = "markers",
             .message = fmt::format("{}: format {} has no markers inside the mesh: {} left out; the edges are there",
                                    file.string(), format.name, names)}};
}

Mesh read_mesh(const fs::path& file, const ReadOptions& options) {
    return format_to_read(file, options.format).read(file);
}

void check_writable(const fs::path& file, const WriteOptions& options) {
    const FormatRow& format = format_of(file, options);
    require_span(options);
    if (options.span > 0 && !format.takes_span) {
        std::string names;
        for (const FormatRow& row : format_table())
            if (row.takes_span) names += (names.empty() ? "" : ", ") + std::string(row.name);
        throw UsageError(fmt::format("format '{}' holds plane meshes: those with a span are {}", format.name, names));
    }
    if (format.check != nullptr) return format.check(file);
    for (const fs::path& written : format.files(file, options)) check_folder_writable(written);
}

void require_streamable(const fs::path& file, const WriteOptions& options) {
    const FormatRow& format = format_of(file, options);
    if (options.span > 0) throw UsageError("a mesh with a span is written as a whole: leave --stream or mpirun out");
    if (format.layout != nullptr) return;
    std::string names;
    for (const FormatRow& row : format_table())
        if (row.layout != nullptr) names += (names.empty() ? "" : ", ") + std::string(row.name);
    throw UsageError(fmt::format("format '{}' is written as a whole: a mesh is streamed as {}", format.name, names));
}

void require_shareable(const fs::path& file, const WriteOptions& options) {
    if (options.span > 0 || format_of(file, options).write_shared == nullptr) require_streamable(file, options);
}

std::unique_ptr<MeshSink> open_mesh_sink(const fs::path& file, const WriteOptions& options) {
    require_streamable(file, options);
    check_writable(file, options);
    const FormatRow& format = format_of(file, options);
    return open_layout_sink(format.layout(file), file, format.internal_markers);
}

std::vector<fs::path> output_files(const fs::path& file, const WriteOptions& options) {
    return format_of(file, options).files(file, options);
}

bool takes_parts(const fs::path& file, const WriteOptions& options) { return format_of(file, options).takes_parts; }

std::string format_name(const fs::path& file, const WriteOptions& options) {
    try {
        return format_of(file, options).name;
    } catch (const UsageError&) {
        return {};
    }
}

std::vector<MeshFormat> mesh_formats() {
    std::vector<MeshFormat> formats;
    for (const FormatRow& row : format_table())
        formats.push_back({row.name, row.extensions, row.description, row.read != nullptr, row.quads, row.one_stream,
                           row.internal_markers});
    return formats;
}

}  // namespace lamina
