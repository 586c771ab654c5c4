// Mesh files whose bytes can be made part by part: what the writers that stream and those of several processes have in
// common.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <ostream>
#include <span>
#include <string>
#include <vector>

#include <lamina/mesh_sink.hpp>

#include "mesh/shared_parts.hpp"

namespace lamina::io {

/// A stretch of a file: a text, then the bytes of all parts for a section if one is given, then `count` records that
/// anybody can make.
struct FileStretch {
    std::string text{};
    std::optional<std::size_t> section{};
    std::size_t count = 0, record_bytes = 0;
    std::function<void(char* at, std::size_t i)> fill{};  ///< stores record i

    /// Writes the records.
    void write_records(std::ostream& out) const;
};

/// A format whose files are an alternation of texts and of sections, to which each part adds bytes.
class MeshLayout {
public:
    MeshLayout() = default;
    MeshLayout(const MeshLayout&) = delete;
    MeshLayout& operator=(const MeshLayout&) = delete;
    virtual ~MeshLayout() = default;

    virtual std::size_t sections() const = 0;
    /// Returns what a part adds to each section. May be called on several threads at once.
    virtual MeshSink::Bytes format(const MeshPart& part) const = 0;
    /// Returns the sizes of these, in a fraction of the time.
    virtual std::vector<std::size_t> sizes(const MeshPart& part) const = 0;
    /// Returns them without the part, where they follow from how much is in it; nothing where they do not.
    virtual std::optional<std::vector<std::size_t>> sizes(const mesh::PartCounts&) const { return std::nullopt; }
    /// Throws UsageError for marker names that the format cannot hold.
    virtual void require_names(std::span<const Marker> markers) const = 0;
    /// Returns all of the file, for sections of these sizes. The stretches may refer to the frame.
    virtual std::vector<FileStretch> stretches(const MeshFrame& frame,
                                               std::span<const std::uint64_t> section_sizes) const = 0;
};

std::unique_ptr<MeshLayout> su2_layout(const std::filesystem::path& file);
std::unique_ptr<MeshLayout> vtu_layout(const std::filesystem::path& file);

/// Opens a sink that collects each section in a temporary file. It leaves internal markers out unless the format has
/// them.
std::unique_ptr<MeshSink> open_layout_sink(std::unique_ptr<MeshLayout> layout, const std::filesystem::path& file,
                                           bool has_internal_markers);

}  // namespace lamina::io
