// How much errors of interpolation change what an adjoint solution is of.
#pragma once

#include <vector>

#include <lamina/solution.hpp>
#include <lamina/solution_sizes.hpp>

#include "adaptation/hessian.hpp"
#include "adaptation/wall_flow.hpp"
#include "adaptation/wall_sizes.hpp"

namespace lamina::adaptation {

/// Returns second derivatives per vertex of the isotropic cells, 0 elsewhere, whose integral of the errors of
/// interpolation is that of the goal: the sum, over the equations of incompressible flow, of |dW*/dx| |H(F)| + |dW*/dy|
/// |H(G)|, where W* is the adjoint of the equation, F and G are its fluxes without friction, and |H| is the absolute
/// value of a Hessian. Throws OptionError where the fields are not in the solution, or not all at the same places.
/// Source: A. Loseille, A. Dervieux, F. Alauzet, J. Comput. Phys. 229 (2010), section 4, for Euler's equations.
std::vector<Hessian> goal_hessians(const Solution& solution, const GoalOptions& options);

/// Returns the same along walls, multiplied by a scale: second derivatives along the wall, from cell to cell of a row
/// of the layer, as means over the height of each column.
std::vector<EdgeValues> goal_curvatures_of_walls(const Solution& solution, const GoalOptions& options,
                                                 const std::vector<WallFlow>& walls, double scale);

}  // namespace lamina::adaptation
