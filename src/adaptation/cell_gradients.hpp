// Linear functions in the cells of a mesh, from values at their middles.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <lamina/mesh.hpp>
#include <lamina/solution.hpp>

#include "adaptation/vertex_patches.hpp"

namespace lamina::adaptation {

/// Returns the values in the cells: those given, or means over the corners.
std::vector<double> cell_values(const Mesh& mesh, const SolutionField& field);

/// Returns the middles of all cells.
std::vector<Point> cell_middles(const Mesh& mesh);

/// Finds gradients in cells by least squares over the cells that share a vertex with each, with weights of the inverse
/// square of distances, which copes with the stretched cells of curved layers. Source: D. J. Mavriplis, AIAA 2003-3986.
class CellReconstruction {
public:
    explicit CellReconstruction(const Mesh& mesh)
        : middles_(cell_middles(mesh)), cells_(mesh, std::vector<char>(middles_.size(), 1)) {}

    /// Returns the gradient of a field in each cell.
    std::vector<Point> gradients(std::span<const double> values) const;
    /// Returns the middle of a cell.
    Point middle(std::size_t cell) const { return middles_[cell]; }

private:
    void find_neighbours(std::size_t cell, std::vector<std::uint32_t>& beside) const;
    Point gradient(std::size_t cell, const std::vector<std::uint32_t>& beside, std::span<const double> values) const;

    std::vector<Point> middles_;
    VertexCells cells_;
};

}  // namespace lamina::adaptation
