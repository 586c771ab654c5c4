// Sizes from a solution: the edge lengths with which a mesh of a given number of vertices interpolates the fields of a
// solution best. The loop is: mesh, solve, solution_sizes(), mesh with SizingOptions::background, and so on.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include <lamina/export.hpp>
#include <lamina/mesh.hpp>
#include <lamina/sizing.hpp>
#include <lamina/solution.hpp>

namespace lamina {

/// The second derivatives of a function of two variables.
struct Hessian {
    double xx = 0;  ///< d2f/dx2
    double xy = 0;  ///< d2f/dxdy
    double yy = 0;  ///< d2f/dy2
};

/// Returns the larger absolute value of the two eigenvalues.
LAMINA_EXPORT double largest_curvature(const Hessian& hessian);

/// Returns the second derivatives of a field at the vertices of the isotropic cells of a mesh; elsewhere they are 0.
/// At each vertex a quadratic polynomial is fitted, by least squares, to the values at the vertices within two edges,
/// or in the cells at these vertices; for few values it is three edges or more. Only isotropic cells count, so that
/// the boundary layer has no influence. Quadratic fields are recovered exactly but for rounding. Regions are those of
/// the mesh or, where it has none, estimate_regions(). Throws OptionError where values and mesh do not fit.
/// Source: M.-G. Vallet, C.-M. Manole, J. Dompierre, S. Dufour, F. Guibault, Int. J. Numer. Meth. Engng 72 (2007),
/// "quadratic fitting"; O. C. Zienkiewicz, J. Z. Zhu, Int. J. Numer. Meth. Engng 33 (1992) for the patches.
LAMINA_EXPORT std::vector<Hessian> recover_hessians(const Mesh& mesh, const SolutionField& field);

/// Options of solution_sizes().
struct SolutionSizeOptions {
    double vertices = 50'000;  ///< number of vertices that the next mesh is to have
    double gradation = 0.2;    ///< SizedMesh::gradation of the result
    double max_change = 4;     ///< sizes are within this factor of the edges of the solution's mesh
    /// Whether sizes are raised near the layers, so that no edge of their borders is divided for their sake, and the
    /// layers stay as they are. Without that, the number of vertices can only be known by making the mesh.
    bool keep_borders = true;
};

/// Throws OptionError where an option is out of range.
LAMINA_EXPORT void validate(const SolutionSizeOptions& options);

/// A function that returns the number of vertices of the next mesh with these sizes.
using VertexCount = std::function<std::size_t(const SizedMesh&)>;

/// Sizes, and the mesh that they will make.
struct SolutionSizes {
    SizedMesh sizes;                  ///< on the isotropic cells of the solution's mesh, quads cut in two
    std::size_t vertices = 0;         ///< number of vertices that the next mesh has with them, by VertexCount
    std::size_t layer_vertices = 0;   ///< number of those in the layer, of the solution's mesh
    std::size_t vertices_before = 0;  ///< number of vertices of the solution's mesh
    int rounds = 0;                   ///< calls of VertexCount
    /// Per field: an estimate of the root of the integral of the squared error that linear interpolation has on the
    /// isotropic cells of the solution's mesh. The loop lowers it at equal numbers of vertices.
    std::vector<double> errors;
};

/// Returns the sizes h = c lambda^(-1/3) at the vertices of the isotropic cells. lambda is the larger eigenvalue of the
/// recovered Hessian of a field; this has the least mean square of interpolation errors for a given number of
/// triangles. Several fields are scaled so that each by itself asks for the same number of triangles, and the smallest
/// size is taken. c is found so that the next mesh has the number of vertices asked for, within 1 %. `count` makes that
/// mesh; empty: layers and their borders stay those of the solution's mesh, and only the region beyond is meshed, whose
/// outermost border must be convex then.
///
/// Throws OptionError where options are out of range, where no sizes within max_change give so many or so few vertices,
/// and where the outermost border is not convex; and the errors of decouple() and refine().
/// Source: F. Alauzet, A. Loseille, J. Comput. Phys. 229 (2010), section 2.3, with p = 2 and metrics h^(-2) I.
LAMINA_EXPORT SolutionSizes solution_sizes(const Solution& solution, const SolutionSizeOptions& options,
                                           const VertexCount& count = {});

}  // namespace lamina
