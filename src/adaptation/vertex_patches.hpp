// The isotropic cells of a mesh, and the cells and vertices round each vertex.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <lamina/mesh.hpp>
#include <lamina/solution.hpp>

namespace lamina::adaptation {

/// Returns, per cell (triangles, then quads), whether it lies beyond the layer. Regions are those of the mesh or, where
/// it has none, estimate_regions(), and then two rings of cells round the layer do not count; a mesh without a layer is
/// isotropic everywhere.
std::vector<char> isotropic_cells(const Mesh& mesh);

/// Returns the field of this name. Throws OptionError about an option where there is none.
const SolutionField& field_named(const Solution& solution, const std::string& name, const std::string& option);
/// Throws OptionError where a field has another number of values than the mesh has vertices or cells.
void require_fitting(const Mesh& mesh, const SolutionField& field);

/// The chosen cells at each vertex.
class VertexCells {
public:
    /// `chosen` says per cell whether it counts. Keeps a reference to the mesh.
    VertexCells(const Mesh& mesh, std::span<const char> chosen);

    /// Returns the chosen cells at a vertex, ascending.
    std::span<const std::uint32_t> at(std::size_t vertex) const {
        return {cells_.data() + first_[vertex], cells_.data() + first_[vertex + 1]};
    }
    /// Returns the corners of a cell.
    std::span<const VertexId> corners(std::size_t cell) const;

private:
    const Mesh& mesh_;
    std::vector<std::size_t> first_;    ///< per vertex: where its cells begin; then the end
    std::vector<std::uint32_t> cells_;  ///< of all vertices, one after the other
};

/// Finds the vertices within some edges of a vertex.
class PatchSearch {
public:
    /// Keeps a reference to the cells.
    PatchSearch(const VertexCells& cells, std::size_t vertices) : cells_(cells), mark_(vertices, 0) {}

    /// Begins at a vertex.
    void begin(std::size_t vertex);
    /// Adds the vertices one edge, or one diagonal of a quad, further away. Returns whether there are any.
    bool grow();
    /// Returns the vertices found, the nearest ones first.
    const std::vector<std::uint32_t>& vertices() const { return found_; }

private:
    const VertexCells& cells_;
    std::vector<std::uint32_t> mark_;  ///< per vertex: the round in which it was last found
    std::uint32_t round_ = 0;
    std::vector<std::uint32_t> found_;
    std::size_t grown_ = 0;  ///< the neighbours of the vertices before this one have been found
};

}  // namespace lamina::adaptation
