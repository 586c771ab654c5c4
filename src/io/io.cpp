// What the program asks of formats, by way of their table.
#include <lamina/io.hpp>

#include "io/formats.hpp"

namespace lamina {

using namespace io;

namespace fs = std::filesystem;

void write_mesh(const Mesh& mesh, const fs::path& file, const WriteOptions& options) {
    check_writable(file, options);
    format_of(file, options.format).write(mesh, file, options);
}

Mesh read_mesh(const fs::path& file) {
    std::error_code ignored;
    if (fs::exists(poly_mesh_folder(file) / "faces", ignored)) return read_openfoam(file);
    return format_of(file).read(file);
}

void check_writable(const fs::path& file, const WriteOptions& options) { format_of(file, options.format).check(file); }

std::vector<MeshFormat> mesh_formats() {
    std::vector<MeshFormat> formats;
    for (const Format& format : io::formats())
        formats.push_back({format.name, format.extensions, format.holds, format.read != nullptr, format.quads});
    return formats;
}

}  // namespace lamina
