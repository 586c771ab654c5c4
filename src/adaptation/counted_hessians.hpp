// The second derivatives whose errors of interpolation count, and the vertices at which they do.
#pragma once

#include <cstddef>
#include <vector>

#include <lamina/solution.hpp>
#include <lamina/solution_sizes.hpp>

#include "adaptation/hessian.hpp"
#include "adaptation/vertex_patches.hpp"

namespace lamina::adaptation {

/// Second derivatives that count: those of a field, or of what a goal makes of all fields.
struct CountedHessians {
    std::vector<Hessian> at;  ///< per vertex of the mesh
    double rounding = 0;      ///< smaller second differences are 0 but for rounding
};

/// What is known about the vertices of the isotropic cells. Lists have one entry per vertex of the mesh.
struct OuterVertices {
    std::vector<double> area;  ///< a third, or a quarter, of the cells at the vertex; 0 inside the layer
    std::vector<double> edge;  ///< mean length of the cells' edges there

    /// Returns whether the second differences at a vertex are not 0 beyond the layer.
    bool counts(const CountedHessians& hessians, std::size_t v) const {
        return area[v] > 0 && largest_curvature(hessians.at[v]) * edge[v] * edge[v] > hessians.rounding;
    }
};

/// Measures the vertices of the chosen cells.
OuterVertices measure_vertices(const Mesh& mesh, const VertexCells& cells);

/// Returns the second derivatives of each field, or those of the goal. Throws OptionError where neither is there.
std::vector<CountedHessians> counted_hessians(const Solution& solution, const SolutionSizeOptions& options);

/// Returns the p of the norm of the errors that is least.
inline double norm_of(const SolutionSizeOptions& options) { return options.goal ? 1 : options.norm; }

}  // namespace lamina::adaptation
