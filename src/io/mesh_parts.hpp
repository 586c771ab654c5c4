// Parts of a mesh that several formats need, and repairs of meshes that were read.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string_view>
#include <vector>

#include <lamina/mesh.hpp>

namespace lamina::io {

/// The cells of one shape and region. Formats without cell data keep them together.
struct CellBlock {
    std::string_view region;           ///< "layer" or "isotropic"; "fluid" where the mesh has no regions
    std::size_t corners = 3;           ///< 3 or 4
    std::vector<std::uint32_t> cells;  ///< indices of mesh.triangles or mesh.quads, ascending

    /// Returns the vertices of cell i of the block.
    const VertexId* vertices(const MeshView& mesh, std::size_t i) const {
        return corners == 3 ? mesh.triangles[cells[i]].v : mesh.quads[cells[i]].v;
    }
};

/// Returns the blocks of a mesh: triangles before quads, and the layer before the rest. No block is empty.
std::vector<CellBlock> cell_blocks(const MeshView& mesh);

/// Returns the number of edges of all markers.
std::size_t count_marker_edges(const MeshView& mesh);

/// Sets `region` to the region of this name, which is that of a group of cells in a file. Returns false for other
/// names.
bool region_of_name(std::string_view name, Region& region);

/// Throws UsageError unless every marker has a name of its own of at most `max_bytes` bytes, without control characters
/// and without those in `forbidden`.
void require_marker_names(std::span<const Marker> markers, const std::filesystem::path& file, const char* format,
                          std::string_view forbidden, std::size_t max_bytes);

/// Throws UsageError unless every marker has a legal name (marker_names.hpp). It is for formats that programs read
/// which look for markers by name.
void require_legal_marker_names(std::span<const Marker> markers, const std::filesystem::path& file, const char* format);

/// Reverses the marker edges that no cell has in their direction but that one has in the other: some programs write
/// edges of the boundary either way round. Precondition: all indices are in range.
/// A marker that holds edges between cells alone becomes internal.
void orient_markers(const MeshView& cells, std::vector<Marker>& markers);
inline void orient_markers(Mesh& mesh) { orient_markers(mesh, mesh.markers); }

/// Finds the edge that a side face of a mesh one cell thick stands on: two successive corners in the lower plane, which
/// are the valid ones. Returns false where these are not two successive ones of four corners.
bool find_lower_edge(std::span<const VertexId> corners, Segment& edge);

/// Returns the internal markers, or all others.
std::vector<Marker> markers_of_kind(std::span<const Marker> markers, bool internal);

}  // namespace lamina::io
