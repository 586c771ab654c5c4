// What the program asks of formats, by way of their table.
#include <lamina/io.hpp>

#include "io/formats.hpp"

namespace lamina {

namespace fs = std::filesystem;

void write_mesh(const Mesh& mesh, const fs::path& file, const WriteOptions& options) {
    check_writable(file, options);
    detail::format_of(file, options.format).write(mesh, file, options);
}

Mesh read_mesh(const fs::path& file) {
    std::error_code ignored;
    if (fs::exists(detail::poly_mesh_folder(file) / "faces", ignored)) return detail::read_openfoam(file);
    return detail::format_of(file).read(file);
}

void check_writable(const fs::path& file, const WriteOptions& options) {
    detail::format_of(file, options.format).check(file);
}

std::vector<MeshFormat> mesh_formats() {
    std::vector<MeshFormat> formats;
    for (const detail::Format& format : detail::formats())
        formats.push_back({format.name, format.extensions, format.holds, format.read != nullptr, format.quads});
    return formats;
}

}  // namespace lamina
