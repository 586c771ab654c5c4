#include "mesh/prove_cells.hpp"

#include <algorithm>
#include <cassert>
#include <utility>

#include "core/parallel.hpp"
#include "mesh/cell_text.hpp"
#include "mesh/curved_nodes.hpp"
#include "mesh/defects.hpp"
#include "mesh/jacobian_bounds.hpp"

namespace lamina::mesh {

namespace {

void add_proof(std::size_t cell, const JacobianBounds& bounds, CellProofs& proofs) {
    if (bounds.verdict != CellVerdict::valid)
        proofs.doubtful.push_back({static_cast<std::uint32_t>(cell), bounds.verdict == CellVerdict::invalid});
    const double scaled = bounds.scaled();
    assert(scaled >= 0 && scaled <= 1);
    if (scaled < least_scaled_determinant) proofs.squeezed.push_back({static_cast<std::uint32_t>(cell), scaled});
    ++proofs.histogram[std::min(static_cast<std::size_t>(scaled * CellProofs::bins), CellProofs::bins - 1)];
    if (scaled >= proofs.min_scaled) return;
    proofs.min_scaled = scaled;
    proofs.worst = static_cast<std::uint32_t>(cell);
}

void append_proofs(const CellProofs& block, CellProofs& all) {
    all.doubtful.insert(all.doubtful.end(), block.doubtful.begin(), block.doubtful.end());
    all.squeezed.insert(all.squeezed.end(), block.squeezed.begin(), block.squeezed.end());
    for (std::size_t i = 0; i < CellProofs::bins; ++i) all.histogram[i] += block.histogram[i];
    if (block.min_scaled >= all.min_scaled) return;
    all.min_scaled = block.min_scaled;
    all.worst = block.worst;
}

/// Returns the lower end of the bin that holds the first percentile.
double first_percentile(const CellProofs& proofs, std::size_t cells) {
    std::size_t bin = 0, below = proofs.histogram[0];
    while (bin + 1 < CellProofs::bins && below * 100 < cells) below += proofs.histogram[++bin];
    return static_cast<double>(bin) / static_cast<double>(CellProofs::bins);
}

}  // namespace

CellProofs prove_cells(const MeshView& mesh, const CurvedNodes& nodes) {
    const CellEdges cells(mesh);
    const auto blocks = core::parallel_blocks(cells.cells(), cells_per_block, [&](std::size_t begin, std::size_t end) {
        CellProofs block;
        for (std::size_t cell = begin; cell < end;) {
            const std::size_t first = cell, corners = cells.corners(cell);
            JacobianBatch batch;
            while (cell < end && batch.size < JacobianBatch::capacity && cells.corners(cell) == corners) {
                for_each_node(mesh, nodes, cell++, [&](std::size_t i, Point place) { batch.put(i, place); });
                batch.add_cell();
            }
            const auto bounds = bound_jacobians(static_cast<unsigned>(corners), nodes.order, batch, nodes.distribution);
            for (std::size_t i = 0; i < batch.size; ++i) add_proof(first + i, bounds[i], block);
        }
        return block;
    });
    CellProofs all;
    for (const CellProofs& block : blocks) append_proofs(block, all);
    return all;
}

CurvedCheck check_of(const MeshView& mesh, const CellProofs& proofs) {
    const CellEdges cells(mesh);
    const auto vertex_of = [&](std::size_t cell) { return mesh.points[cells.corner(cell, 0).index()]; };
    CurvedCheck check;
    DefectList defects;
    for (const DoubtfulCell& doubtful : proofs.doubtful) {
        ++(doubtful.is_invalid ? check.invalid : check.unproved);
        defects.add([&] {
            return MeshDefect{(doubtful.is_invalid ? "curved inside out: " : "curved and not proved valid: ") +
                                  cell_text(mesh, doubtful.cell),
                              vertex_of(doubtful.cell)};
        });
    }
    check.defects = std::move(defects.kept);
    check.defect_count = defects.count;
    if (!std::isfinite(proofs.min_scaled)) return check;
    check.min_scaled_jacobian = proofs.min_scaled;
    check.min_scaled_jacobian_at = vertex_of(proofs.worst);
    check.p01_scaled_jacobian = first_percentile(proofs, cells.cells());
    return check;
}

}  // namespace lamina::mesh
