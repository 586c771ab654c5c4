// What the program asks of formats, by way of their table.
#include <lamina/io.hpp>

#include "core/atomic_file.hpp"
#include "io/formats.hpp"

namespace lamina {

namespace fs = std::filesystem;

void write_mesh(const Mesh& mesh, const fs::path& file, const WriteOptions& options) {
    check_writable(file, options);
    detail::format_of(file, options.format).write(mesh, file, options);
}

Mesh read_mesh(const fs::path& file) { return detail::format_of(file).read(file); }

void check_writable(const fs::path& file, const WriteOptions& options) {
    for (const fs::path& target : detail::format_of(file, options.format).targets(file)) check_folder_writable(target);
}

std::vector<MeshFormat> mesh_formats() {
    std::vector<MeshFormat> formats;
    for (const detail::Format& format : detail::formats())
        formats.push_back({format.name, format.extensions, format.holds});
    return formats;
}

}  // namespace lamina
