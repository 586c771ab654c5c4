// The XML header of VTU files and the arrays that it announces: what the writer of whole meshes and the one of parts
// have in common. vtu_write.cpp describes the format.
#pragma once

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <new>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <lamina/mesh.hpp>
#include <lamina/sizing.hpp>

#include "core/parallel.hpp"
#include "io/binary_output.hpp"
#include "io/mesh_layout.hpp"
#include "io/vtk_cell_types.hpp"

namespace lamina::io {

template <class T>
constexpr const char* vtu_type_name() {
    if constexpr (std::is_same_v<T, double>) return "Float64";
    if constexpr (std::is_same_v<T, float>) return "Float32";
    if constexpr (std::is_same_v<T, std::int64_t>) return "Int64";
    if constexpr (std::is_same_v<T, std::uint32_t>) return "UInt32";
    if constexpr (std::is_same_v<T, std::uint16_t>) return "UInt16";
    if constexpr (std::is_same_v<T, std::uint8_t>) return "UInt8";
}

/// Collects the XML header and the arrays that it announces, and writes both. Raw arrays are computed only when they
/// are written.
class VtuWriter {
public:
    explicit VtuWriter(bool compress) : compress_(compress) {}

    std::string xml;

    /// Announces an array of tuples x components values; value(i) returns value i.
    template <class T, class F>
    void add_array(const char* name, std::size_t tuples, std::size_t components, F value, bool in_field_data = false) {
        announce<T>(name, tuples, components, in_field_data);
        const std::size_t count = tuples * components;
        const auto fill = [value = std::move(value)](char* p, std::size_t i) { store(p, static_cast<T>(value(i))); };
        FileStretch array;
        if (compress_) {
            array.text = compressed(count, sizeof(T), fill);
        } else {
            array.text = length_text(count * sizeof(T));
            array.count = count;
            array.record_bytes = sizeof(T);
            array.fill = fill;
            offset_ += sizeof(std::uint64_t) + count * sizeof(T);
        }
        appended_.push_back(std::move(array));
    }
    /// Announces an array of so many bytes that a section holds, but for these at its end. Precondition: no
    /// compression.
    template <class T>
    void add_section(const char* name, std::size_t components, std::size_t section, std::size_t bytes,
                     std::string end) {
        announce<T>(name, 0, components, false);
        offset_ += sizeof(std::uint64_t) + bytes + end.size();
        appended_.push_back({.text = length_text(bytes + end.size()), .section = section});
        if (!end.empty()) appended_.push_back({.text = std::move(end)});
    }
    /// Returns the file.
    std::vector<FileStretch> take() {
        std::vector<FileStretch> stretches;
        stretches.push_back({.text = xml + "  <AppendedData encoding=\"raw\">\n_"});
        std::move(appended_.begin(), appended_.end(), std::back_inserter(stretches));
        stretches.push_back({.text = "\n  </AppendedData>\n</VTKFile>\n"});
        return stretches;
    }
    /// Writes a file without sections.
    void write(std::ostream& out) {
        for (const FileStretch& stretch : take()) {
            out << stretch.text;
            stretch.write_records(out);
        }
    }

private:
    static std::string length_text(std::uint64_t bytes) {
        std::string text(sizeof bytes, '\0');
        store(text.data(), bytes);
        return text;
    }

    template <class T>
    void announce(const char* name, std::size_t tuples, std::size_t components, bool in_field_data) {
        xml += fmt::format("        <DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" ", vtu_type_name<T>(),
                           name, components);
        if (in_field_data) xml += fmt::format("NumberOfTuples=\"{}\" ", tuples);
        xml += fmt::format("format=\"appended\" offset=\"{}\"/>\n", offset_);
    }

    /// Returns an array as it is stored in the file, and moves the offset of the next one behind it.
    template <class F>
    std::string compressed(std::size_t count, std::size_t size, F&& fill) {
        constexpr std::size_t block_bytes = 1 << 18;
        constexpr int level = 4;
        const std::size_t block = block_bytes / size, blocks = (count + block - 1) / block;
        const std::vector<std::string> parts =
            core::parallel_blocks(count, block, [&](std::size_t begin, std::size_t end) {
                std::string plain((end - begin) * size, '\0');
                for (std::size_t i = begin; i < end; ++i) fill(plain.data() + (i - begin) * size, i);
                uLongf length = compressBound(plain.size());
                std::string part(length, '\0');
                if (compress2(reinterpret_cast<Bytef*>(part.data()), &length,
                              reinterpret_cast<const Bytef*>(plain.data()), plain.size(), level) != Z_OK)
                    throw std::bad_alloc();
                part.resize(length);
                return part;
            });
        std::string bytes(8 * (3 + blocks), '\0');
        char* p = bytes.data();
        for (const std::size_t value : {blocks, block_bytes, count % block * size}) p = store(p, std::uint64_t{value});
        for (const std::string& part : parts) p = store(p, std::uint64_t{part.size()});
        for (const std::string& part : parts) bytes += part;
        offset_ += bytes.size();
        return bytes;
    }

    bool compress_;
    std::vector<FileStretch> appended_;  ///< the arrays
    std::size_t offset_ = 0;             ///< offset of the next array
};

/// Returns the number of vertices of cell i and of all cells before it, where the triangles come first, then the other
/// inner cells, which are quads, then the lines.
inline std::size_t vtu_offset(std::size_t i, std::size_t triangles, std::size_t inner) {
    const std::size_t n = i + 1;
    return 3 * std::min(n, triangles) + 4 * (std::clamp(n, triangles, inner) - triangles) +
           2 * (std::max(n, inner) - inner);
}
/// Returns the type of cell i.
inline VtkCellType vtu_type(std::size_t i, std::size_t triangles, std::size_t inner) {
    return i < triangles ? vtk_triangle : i < inner ? vtk_quad : vtk_line;
}

/// Returns the tags before the field data.
std::string vtu_head(bool compressed);

/// Adds the names and kinds of the markers, the constraints and, where they are known, the gradation of sizes and the
/// walls.
void add_vtu_field_data(std::span<const Marker> markers, std::span<const Segment> constraints, const SizedMesh* sizes,
                        VtuWriter& vtu);

}  // namespace lamina::io
