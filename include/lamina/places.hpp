// Places of a mesh that people want to see, by name.
#pragma once

#include <string>
#include <vector>

#include <lamina/export.hpp>
#include <lamina/mesh.hpp>

namespace lamina {

/// A part of the plane with a name.
struct Place {
    std::string name;  ///< "nose:1"; unique among those of a mesh
    Box window;        ///< the part of the plane, which is square
};

/// Returns the places of a mesh, from the large ones to the small ones: `all`; `walls`, round all walls; for each body,
/// counted from 1 in the order of wall_vertices(), `nose:N` and `tail:N`; and for each pair of bodies that are close
/// to each other, `slot:N`, counted in the direction of x. The tail of a body is its vertex with the largest x, and its
/// nose the vertex farthest from that. A slot lies where two bodies are nearest to each other; bodies are close where
/// that gap is at most a tenth of the extent of all walls in x. All markers that may be walls count (may_be_wall()).
/// Empty for a mesh without points. Precondition: all indices are in range, and coordinates are finite.
LAMINA_EXPORT std::vector<Place> named_places(const Mesh& mesh);

}  // namespace lamina
