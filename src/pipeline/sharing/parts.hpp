// The parts that a mesh is handed on in: their order and their numbers, whoever makes them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <lamina/mesh_sink.hpp>

#include "decoupling/subdomain.hpp"
#include "layers/layer.hpp"
#include "mesh/hash.hpp"

namespace lamina::pipeline {

/// Return the parts before those of the subdomains: the vertices of the decoupling, which are `points`, then the
/// triangles of the layer. They refer to the arguments.
std::vector<MeshPart> parts_of_points(std::span<const Point> points);
std::vector<MeshPart> parts_of_layer(std::span<const Point> points, const layers::LayerCells& cells);
/// Returns the parts behind them, of a mesh with this many triangles: the quadrilaterals of the layer.
std::vector<MeshPart> parts_behind_pieces(std::span<const Point> points, const layers::LayerCells& cells,
                                          std::size_t triangles);

/// Gives the vertices of a subdomain's triangles their numbers in the mesh, where its Steiner points begin with
/// `first_vertex`.
void number_in_mesh(const decoupling::Subdomain& subdomain, std::size_t first_vertex, Refinement& refinement);
/// Returns the part that number_in_mesh() has numbered. It refers to the arguments.
MeshPart part_of_piece(std::span<const Point> points, std::size_t layer_pieces, std::size_t piece,
                       std::size_t first_vertex, std::size_t first_triangle, const Refinement& refinement);

/// Returns the hash of the triangles of a subdomain, before they are numbered.
mesh::HashOfParts hash_of_piece(const decoupling::Subdomain& subdomain, const Refinement& refinement);

/// Throws MeshError where there are more vertices than can be numbered.
void require_numbered(std::size_t vertices);

}  // namespace lamina::pipeline
