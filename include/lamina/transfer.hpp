// Fields of a solution carried over to another mesh of the same domain.
//
// Guarantees:
//  1. Fields that are linear over the whole mesh are reproduced up to rounding where both meshes have the same boundary.
//  2. A field that is nowhere negative has no negative values afterwards, and one that is positive everywhere has
//     positive ones.
// Limits:
//  1. It does not conserve integrals.
// Example:
//     Mesh from, to;
//     from.points = {{0, 0}, {2, 0}, {0, 2}};
//     from.triangles = {{{VertexId{0u}, VertexId{1u}, VertexId{2u}}}};
//     to.points = {{0, 0}, {1, 0}, {0, 1}};
//     to.triangles = from.triangles;
//     const auto fields = transfer({from, {{"p", false, {1, 3, 5}}}}, to);
//     assert((fields[0].values == std::vector<double>{1, 2, 3}));
#pragma once

#include <vector>

#include <lamina/solution.hpp>

namespace lamina {

/// Returns the fields of a solution at the vertices of another mesh or, those at cells, at the middles of its cells.
/// Places are located exactly. Values at vertices are linear in each triangle, and in the two halves of each quad;
/// those at cells are linear in each cell, with a gradient by least squares over the cells that share a vertex with it.
/// A place beyond the boundary takes the nearest place on it. Where walls are divided otherwise, the places near them
/// move with the wall, so that they keep their distance from it. Throws InputError where the solution's mesh is not
/// valid, and OptionError("field") where a field has another number of values than the mesh has vertices or cells.
LAMINA_EXPORT std::vector<SolutionField> transfer(const Solution& solution, const Mesh& mesh);

}  // namespace lamina
