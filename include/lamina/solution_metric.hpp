// Stretched triangles from a solution: beyond the layer a mesh gets the triangles with which so many vertices
// interpolate the fields of a solution best, short where a field bends and long where it does not. It is the step of
// the loop that follows solution_sizes().
//
// Guarantees:
//  1. Those of remesh(): layers and the boundary stay, and the result is valid.
//  2. The result has SolutionSizeOptions::vertices vertices, within 2 %.
// Limits:
//  1. Walls and layers are those of the mesh: SolutionSizeOptions::walls asks nothing of them here.
// Example:
//     Solution solution{generate_mesh({"naca:0012:60"}, {.layer = {.enabled = false}}).mesh, {{"shock", false, {}}}};
//     for (const Point p : solution.mesh.points) solution.fields[0].values.push_back(std::tanh(5 * (p.x - 2)));
//     const auto n = static_cast<double>(solution.mesh.points.size());
//     const RemeshedMesh next = remesh_to_solution(solution.mesh, solution, {.vertices = n}, 8);
//     assert(check_mesh(next.mesh).valid() && std::abs(static_cast<double>(next.mesh.points.size()) - n) <= 0.02 * n);
//
// Source: A. Loseille, F. Alauzet, Continuous mesh framework, SIAM J. Numer. Anal. 49 (2011).
#pragma once

#include <lamina/mesh.hpp>
#include <lamina/remesh.hpp>
#include <lamina/solution_sizes.hpp>

namespace lamina {

/// Returns the mesh with the triangles beyond its layer replaced by those that a solution on another mesh of the same
/// domain asks for: those of the metric c det(|H|)^(-1/(2p+2)) |H|, where |H| is the absolute value of the recovered
/// Hessian of a field. It has the least L^p norm of interpolation errors for a given number of vertices. Several fields
/// are scaled so that each by itself asks for the same number, and their metrics are intersected. Sizes are within
/// SolutionSizeOptions::max_change of the edges of the solution's mesh in each direction, and grow by
/// SolutionSizeOptions::gradation, beginning with the edges that stay. The two lengths at a place differ by a factor of
/// `max_ratio` at most.
///
/// Throws OptionError where an option is out of range, where fields are missing or linear, and where no sizes within
/// max_change give so many or so few vertices; and the errors of remesh() and transfer().
LAMINA_EXPORT RemeshedMesh remesh_to_solution(const Mesh& mesh, const Solution& solution,
                                              const SolutionSizeOptions& options, double max_ratio);

}  // namespace lamina
