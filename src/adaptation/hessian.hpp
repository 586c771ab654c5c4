// First and second derivatives of fields on meshes.
#pragma once

#include <vector>

#include <lamina/mesh.hpp>
#include <lamina/solution.hpp>

namespace lamina::adaptation {

/// The second derivatives of a function of two variables.
struct Hessian {
    double xx = 0;  ///< d2f/dx2
    double xy = 0;  ///< d2f/dxdy
    double yy = 0;  ///< d2f/dy2
};

inline Hessian operator+(const Hessian& a, const Hessian& b) { return {a.xx + b.xx, a.xy + b.xy, a.yy + b.yy}; }
inline Hessian operator*(double s, const Hessian& a) { return {s * a.xx, s * a.xy, s * a.yy}; }

/// Returns the larger absolute value of the two eigenvalues.
double largest_curvature(const Hessian& hessian);
/// Returns the matrix with the same eigenvectors and the absolute values of the eigenvalues.
Hessian absolute(const Hessian& hessian);

/// The derivatives of a field at a vertex.
struct Derivatives {
    Point gradient{};
    Hessian hessian{};
};

/// Returns the derivatives of a field at the vertices of the isotropic cells of a mesh; elsewhere they are 0.
/// At each vertex a quadratic polynomial is fitted, by least squares, to the values at the vertices within two edges,
/// or in the cells at these vertices; for few values it is three edges or more. Only isotropic cells count, so that
/// the boundary layer has no influence. Quadratic fields are recovered exactly but for rounding. Regions are those of
/// the mesh or, where it has none, estimate_regions(). Throws OptionError where values and mesh do not fit.
/// Source: M.-G. Vallet, C.-M. Manole, J. Dompierre, S. Dufour, F. Guibault, Int. J. Numer. Meth. Engng 72 (2007),
/// "quadratic fitting"; O. C. Zienkiewicz, J. Z. Zhu, Int. J. Numer. Meth. Engng 33 (1992) for the patches.
std::vector<Derivatives> recover_derivatives(const Mesh& mesh, const SolutionField& field);

}  // namespace lamina::adaptation
