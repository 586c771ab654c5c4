#include "io/ugrid.hpp"

#include <string>

#include <lamina/files.hpp>

#include "core/file_name.hpp"
#include "io/formats.hpp"

namespace lamina::io {

UgridEncoding encoding_of(const std::filesystem::path& file) {
    const std::string inner_extension = core::extension_of(file.stem());
    if (inner_extension == ".b8") return UgridEncoding::big_endian;
    return inner_extension == ".lb8" ? UgridEncoding::little_endian : UgridEncoding::ascii;
}

std::filesystem::path mapbc_of(const std::filesystem::path& file) {
    std::filesystem::path stem = file;
    stem.replace_extension();
    if (encoding_of(file) != UgridEncoding::ascii) stem.replace_extension();
    return stem += ".mapbc";
}

std::vector<std::filesystem::path> ugrid_files(const std::filesystem::path& file) { return {file, mapbc_of(file)}; }

}  // namespace lamina::io
