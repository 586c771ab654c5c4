// The proof of all cells of a curved mesh, one by one.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include <lamina/curved_mesh.hpp>

namespace lamina::mesh {

/// A cell that is proved invalid, or not proved.
struct DoubtfulCell {
    std::uint32_t cell;  ///< triangles, then quadrilaterals
    bool is_invalid;
};

/// A cell whose scaled determinant is below least_scaled_determinant.
struct SqueezedCell {
    std::uint32_t cell;  ///< triangles, then quadrilaterals
    double scaled;       ///< 0 for doubtful cells
};

/// A smaller ratio of determinants is worth less bend: curve_cells() leaves it only where straight cells are that bad.
inline constexpr double least_scaled_determinant = 0.02;

/// What is proved of the cells of a mesh, or of a part of them.
struct CellProofs {
    static constexpr std::size_t bins = 100;

    std::vector<DoubtfulCell> doubtful;         ///< ascending
    std::vector<SqueezedCell> squeezed;         ///< ascending
    double min_scaled = HUGE_VAL;               ///< smallest scaled determinant
    std::uint32_t worst = 0;                    ///< the cell that has it
    std::array<std::size_t, bins> histogram{};  ///< of scaled determinants
};

/// Proves each cell valid, invalid or neither. Parallel. Precondition: all numbers of nodes are in range.
LAMINA_EXPORT CellProofs prove_cells(const MeshView& mesh, const CurvedNodes& nodes);

/// Returns what check_curved() says of cells.
LAMINA_EXPORT CurvedCheck check_of(const MeshView& mesh, const CellProofs& proofs);

}  // namespace lamina::mesh
