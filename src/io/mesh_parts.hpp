// What several formats ask of a mesh, or of a file's contents before they become one.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string_view>
#include <vector>

#include <lamina/mesh.hpp>

namespace lamina::io {

/// Cells of one shape and region, which formats without cell data keep together.
struct CellBlock {
    std::string_view region;           ///< "layer", "isotropic"; "fluid" where the mesh has no regions
    std::size_t corners = 3;           ///< 3 or 4
    std::vector<std::uint32_t> cells;  ///< indices of mesh.triangles or mesh.quads, ascending

    /// The vertices of cell i of the block.
    const VertexId* vertices(const Mesh& mesh, std::size_t i) const {
        return corners == 3 ? mesh.triangles[cells[i]].v : mesh.quads[cells[i]].v;
    }
};

/// Triangles before quads, the layer before the rest; no empty block.
std::vector<CellBlock> cell_blocks(const Mesh& mesh);

/// The region of this name, for cells read from a format that names groups of cells. False for other names.
bool region_of_name(std::string_view name, Region& region);

/// Formats that hold no kinds: the one that the name says, whatever its case, punctuation and digits.
MarkerKind kind_of_name(std::string_view name);

/// Throws UsageError unless every marker has a name of its own, at most `longest` bytes long and without control
/// characters and those in `forbidden`.
void require_marker_names(const Mesh& mesh, const std::filesystem::path& file, const char* format,
                          std::string_view forbidden, std::size_t longest);

/// Some programs write boundary edges either way round: turns those that no cell has in this direction, but one has
/// in the other. Precondition: indices in range.
void orient_markers(Mesh& mesh);

}  // namespace lamina::io
