// The sum of the fluxes out of each control volume.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "flow/euler/dual_mesh.hpp"
#include "flow/euler/gas.hpp"

namespace lamina::flow::euler {

/// The flow that comes in from far away.
struct FarFlow {
    Four free_stream{};  ///< its state
    double lift = 0;     ///< lift coefficient, based on the unit of length
    Point vortex{};      ///< where the vortex of the lift sits
};

/// Returns the state at a point of the far field: the free stream and, below Mach 1, the vortex of the lift in it,
/// after Prandtl and Glauert, with the free stream's entropy and total enthalpy.
/// Source: J. L. Thomas, M. D. Salas, AIAA J. 24 (1986).
Four far_state(const FarFlow& far, Point at);

/// Memory of residual().
struct ResidualMemory {
    std::vector<std::array<Four, 2>> gradients;  ///< of the states: d/dx, d/dy
};

/// Computes the sum of the fluxes out of each control volume. The first order has constant states in them. The second
/// has linear ones, by least-squares gradients and the limiter of van Albada along each edge; where they would have
/// hardly any density or pressure left, they stay constant. No gas crosses walls. Out of the bases of blunt trailing
/// edges gas of the pressure there flows, with a share of the free stream's speed and its total enthalpy, in place of a
/// wake that inviscid flow cannot keep steady. The far field is characteristic, by a Riemann solver.
/// Source: T. J. Barth, D. C. Jespersen, AIAA-89-0366; G. D. van Albada, B. van Leer, W. W. Roberts, Astron. Astrophys.
/// 108 (1982); V. Venkatakrishnan, J. Comput. Phys. 118 (1995), for the threshold below which nothing is limited.
void residual(const DualMesh& mesh, std::span<const Four> states, const FarFlow& far, int order, ResidualMemory& memory,
              std::vector<Four>& sums);

/// Computes the sums of the largest wave speeds through the faces of each control volume.
void wave_sums(const DualMesh& mesh, std::span<const Four> states, std::vector<double>& sums);

}  // namespace lamina::flow::euler
