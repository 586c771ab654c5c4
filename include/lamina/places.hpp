// Places of a mesh that people want to see, by name.
//
// Guarantees:
//  1. Names are unique, and windows are squares that hold what they are named after.
// Limits:
//  1. Indices of the mesh are in range, and coordinates finite. Markers that may_be_wall() count as walls.
// Example:
//     const Mesh mesh = generate_mesh({"naca:0012:60"}, {.layer = {.enabled = false}}).mesh;
//     const std::vector<Place> places = named_places(mesh);
//     assert(places[0].name == "all" && places[2].name == "nose:1" && places[2].window.contains({0, 0}));
#pragma once

#include <lamina/mesh.hpp>

namespace lamina {

/// A part of the plane with a name.
struct Place {
    std::string name;  ///< "nose:1"; unique among those of a mesh
    Box window;        ///< the part of the plane, which is square
};

/// Returns the places of a mesh, from the large ones to the small ones; none for a mesh without points:
///  - `all`; `walls`, round all bodies: walls that are closed, or where there are none, those with ends;
///  - for each body, counted from 1 in the order of wall_vertices(), `nose:N` and `tail:N`: the tail is its vertex with
///    the largest x, and the nose the vertex farthest from that;
///  - `slot:N`, counted in the direction of x, in gaps of two walls up to a tenth of the bodies' extent in x.
LAMINA_EXPORT std::vector<Place> named_places(const Mesh& mesh);

}  // namespace lamina
