// The linear system of an implicit step: 4 x 4 blocks on the diagonal and for each pair of neighbours.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "flow/euler/dual_mesh.hpp"
#include "flow/euler/flux.hpp"

namespace lamina::flow::euler {

/// A block in single precision by columns, which is as good for a step that is not exact anyway, and faster.
struct Block {
    alignas(16) std::array<float, 16> columns;
};

/// The matrix. Its memory serves one step after the other.
struct BlockSystem {
    std::vector<Matrix4> diagonal;         ///< per vertex, by rows
    std::vector<Block> diagonal_inverses;  ///< per vertex
    std::vector<Block> beside;             ///< per neighbour, at the places of DualMesh::neighbours
};

/// Fills the system with the Jacobian of the first-order residual of Roe's scheme, and divides areas by time steps
/// `radii / cfl` (radii: sums of the wave speeds through the faces of each control volume).
void assemble(const DualMesh& mesh, std::span<const Four> states, const Four& free_stream,
              std::span<const double> radii, double cfl, BlockSystem& system);

/// Returns the approximate solution for this right-hand side after a number of symmetric Gauss-Seidel sweeps, forwards
/// and backwards through the vertices, from 0. Source: A. Jameson, D. A. Caughey, AIAA 2001-2673; D. Sharov,
/// K. Nakahashi, AIAA J. 36 (1998), for the order of unstructured meshes.
void solve(const DualMesh& mesh, const BlockSystem& system, std::span<const Four> right_hand_side, int sweeps,
           std::vector<std::array<float, 4>>& solution);

}  // namespace lamina::flow::euler
