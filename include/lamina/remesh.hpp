// A mesh of triangles adapted to a metric: small and stretched where and as the metric asks for it, the layer
// untouched.
//
// Guarantees:
//  1. Every triangle is counter-clockwise at every moment, by the exact predicate: the result is valid where the mesh is.
//  2. Quadrilaterals and cells of Region::layer stay, and so do the edges of the border of all that changes, unless
//     RemeshOptions::divide_borders lets those on straight lines of the boundary be divided or merged.
//  3. The result depends on the arguments alone: one thread makes it.
// Limits:
//  1. Edges of unit length everywhere need not exist: near borders that stay, and where the metric jumps, some are
//     longer or shorter. RemeshedMesh::unit_edges says how many are not.
// Example:
//     Mesh mesh{.points = {{0, 0}, {1, 0}, {0, 1}}, .triangles = {{{VertexId{0u}, VertexId{1u}, VertexId{2u}}}}};
//     mesh.markers = {{"box", MarkerKind::far_field, {}}};
//     for (const std::size_t i : {0, 1, 2}) mesh.markers[0].edges.push_back({VertexId{i}, VertexId{(i + 1) % 3}});
//     const std::vector<MetricTensor> flat(3, {100, 0, 2500});  // lengths of 1/10 along x, of 1/50 along y
//     const RemeshedMesh made = remesh(mesh, flat, {.divide_borders = true});
//     assert(check_mesh(made.mesh).valid() && made.mesh.triangles.size() > 200 && made.unit_edges > 0.8);
//
// Source: H. Borouchaki, P. L. George, F. Hecht, P. Laug, E. Saltel, Delaunay mesh generation governed by metric
// specifications, Finite Elem. Anal. Des. 25 (1997); F. Alauzet, Finite Elem. Anal. Des. 46 (2010).
#pragma once

#include <optional>
#include <span>
#include <vector>

#include <lamina/mesh.hpp>
#include <lamina/metric.hpp>
#include <lamina/option.hpp>

namespace lamina {

/// Options of remesh().
struct RemeshOptions {
    /// Whether edges on straight lines of the boundary may be divided, and vertices between two of them removed. Walls
    /// without thickness and periodic borders stay as they are.
    bool divide_borders = false;
    std::optional<double> vertices{};   ///< the metric is scaled to ask for about so many; empty: it counts as it is
    std::optional<double> gradation{};  ///< growth of sizes per unit of distance: 0.3; empty: as in the metric
    double max_ratio = 1e6;             ///< largest ratio of the two lengths that the metric asks for at a place
};

LAMINA_EXPORT void validate(const RemeshOptions& options);  ///< throws OptionError: an option out of range

/// The result of remesh().
struct RemeshedMesh {
    Mesh mesh;                         ///< vertices that stay come first, in the order that they had
    std::vector<MetricTensor> metric;  ///< at the vertices of the mesh: as it was asked for, scaled, graded and limited
    std::size_t triangles = 0;         ///< number of those that are not of the layer
    double unit_edges = 0;             ///< share of their edges whose length in the metric is from 0.7 to 1.4
    double mean_quality = 0;           ///< mean of 4 sqrt(3) area / (sum of squared edges), measured in the metric
};

/// Returns the mesh with its triangles beyond the layer replaced by those that a metric asks for.
///
/// `metric` has one tensor per vertex. Between vertices the tensor of sizes, M^(-1/2), is linear, so that an isotropic
/// metric has linear sizes (Borouchaki et al. 1997). Edges longer than sqrt(2) are divided and shorter than 1 / sqrt(2)
/// contracted, diagonals are swapped and vertices moved for the sake of shape. The length of an edge is the integral
/// along it of the metric between its ends, with a linear size (Alauzet 2010, section 2). Edges that stay are no longer
/// than sqrt(2) in the metric that counts: it is lowered along them.
///
/// Preconditions: check_mesh() finds no defect. Throws OptionError for options out of range, InputError where the
/// number of tensors is not that of vertices or a tensor is not finite or not positive definite, and MeshError where
/// the mesh has no triangle beyond the layer or the metric asks for more than 2^29.
LAMINA_EXPORT RemeshedMesh remesh(const MeshView& mesh, std::span<const MetricTensor> metric,
                                  const RemeshOptions& options = {});

/// Returns the mesh with diagonals of its triangles beyond the layer swapped, and vertices between them moved, where
/// this lowers the sum of distortions: inverse mean ratios, with edges as long as they are round each vertex. No vertex
/// comes, goes or gets another number. Triangles of the layer come first, in their order. A mesh without regions gets
/// those of estimate_regions(), and Mesh::piece is empty. A mesh without triangles beyond its layer keeps its cells.
/// Precondition: check_mesh() finds no defect. Source: L. A. Freitag, C. Ollivier-Gooch, Tetrahedral mesh improvement
/// using swapping and smoothing, Int. J. Numer. Methods Eng. 40 (1997), in two dimensions.
LAMINA_EXPORT Mesh reconnect(const MeshView& mesh);

/// Returns the number of vertices that a metric asks for beyond the layer: 2 / sqrt(3) times its complexity, which is
/// the integral of the square root of its determinant. Source: A. Loseille, F. Alauzet, SIAM J. Numer. Anal. 49 (2011).
LAMINA_EXPORT double vertices_of_metric(const MeshView& mesh, std::span<const MetricTensor> metric);

}  // namespace lamina
