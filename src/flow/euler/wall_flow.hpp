// What the flow does along walls: sides, pressures, shocks.
#pragma once

#include <vector>

#include <lamina/compressible_flow.hpp>

#include "flow/euler/euler.hpp"

namespace lamina::flow::euler {

/// Returns the sides of all walls, with their shocks and without names. A side begins at the stagnation point: where the
/// flow along the outline parts, or where the pressure is largest if it parts nowhere.
std::vector<CompressibleElement> wall_flows(const EulerMesh& mesh, const EulerSolution& solution,
                                            const EulerOptions& options);

/// Returns the shocks along a side: where the Mach number of the wall falls through 1, in units of `extent` not at its
/// end, behind a region that is clearly supersonic, and by a jump. `from` and `extent` are those of the element in x.
std::vector<WallShock> find_shocks(const std::vector<CompressibleWallPoint>& side, double from, double extent);

}  // namespace lamina::flow::euler
