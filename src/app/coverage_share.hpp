// Sums over the layers of all elements, for the report and the summary.
#pragma once

#include <lamina/layers.hpp>
#include <lamina/pipeline.hpp>

namespace lamina::app {

/// Returns the share of the requested layer cells that were made; 1 where none was requested.
inline double made_share(const LayerCoverage& coverage) {
    if (coverage.requested_cells == 0) return 1;
    return static_cast<double>(coverage.made_cells) / static_cast<double>(coverage.requested_cells);
}

/// Returns the coverage summed over all elements.
inline ElementCoverage total_coverage(const MeshResult& result) {
    ElementCoverage total;
    for (const ElementCoverage& element : result.layer_coverage) total += element;
    return total;
}

}  // namespace lamina::app
