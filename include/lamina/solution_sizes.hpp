// Sizes from a solution: the edge lengths with which a mesh of a given number of vertices interpolates the fields of a
// solution best. The loop is: mesh, solve, solution_sizes(), mesh with SizingOptions::background, and so on.
//
// Guarantees:
//  1. The next mesh has the number of vertices asked for, within 1 %. At equal numbers the loop lowers the errors.
//  2. Only isotropic cells count, so that the boundary layer has no influence on the sizes.
// Limits:
//  1. OptionError where options are out of range, where no sizes within max_change give so many or so few vertices, and
//     where the outermost border is not convex; and the errors of meshes and refinement.
// Example:
//     Solution solution{generate_mesh({"naca:0012:60"}, {.layer = {.enabled = false}}).mesh, {{"bump", false, {}}}};
//     for (const Point p : solution.mesh.points) solution.fields[0].values.push_back(std::exp(-squared_length(p)));
//     const auto n = static_cast<double>(solution.mesh.points.size());
//     const SolutionSizes next = solution_sizes(solution, {.vertices = 2 * n});
//     assert(std::abs(static_cast<double>(next.vertices) - 2 * n) <= 0.02 * n);
//
// Source: F. Alauzet, A. Loseille, J. Comput. Phys. 229 (2010), section 2.3, with metrics h^(-2) I; goals: A. Loseille,
// A. Dervieux, F. Alauzet, J. Comput. Phys. 229 (2010); Hessians: M.-G. Vallet, C.-M. Manole, J. Dompierre, S. Dufour,
// F. Guibault, Int. J. Numer. Meth. Engng 72 (2007).
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <lamina/solution.hpp>

namespace lamina {

/// The part of a solution that says how the flow passes the walls, and the viscosity that turns it into friction.
struct WallFlowOptions {
    std::string
        velocity;  ///< name of the vectors of velocity, or of momentum, whose components "NAME:x" and "NAME:y" are
                   ///< the last two fields of the solution
    double viscosity = 0;  ///< kinematic, over the speed of the free stream: the chord over the Reynolds number

    /// Returns the names of the two components.
    std::vector<std::string> components() const { return {velocity + ":x", velocity + ":y"}; }
};

/// The fields of an incompressible flow and of the adjoint solution of a goal, as the drag. They are at the same
/// places.
struct GoalOptions {
    std::string velocity = "U";           ///< name of the vectors of velocity
    std::string pressure = "p";           ///< name of the pressure over the density
    std::string adjoint_velocity = "Ua";  ///< name of the vectors that are the adjoint of momentum
    std::string adjoint_pressure = "pa";  ///< name of the adjoint of mass

    /// Returns the names of the six fields: those of the flow, then those of the adjoint.
    std::vector<std::string> fields() const {
        return {velocity + ":x",         velocity + ":y",         pressure,
                adjoint_velocity + ":x", adjoint_velocity + ":y", adjoint_pressure};
    }
};

/// Options of solution_sizes().
struct SolutionSizeOptions {
    double vertices = 50'000;  ///< number of vertices that the next mesh is to have
    double norm = 2;           ///< p: the L^p norm of the errors is least; larger ones see large errors above all
    double gradation = 0.2;    ///< SizedMesh::gradation of the result
    double max_change = 4;     ///< sizes are within this factor of the edges of the solution's mesh
    /// Whether sizes are raised near the layers, so that no edge of their borders is divided for their sake, and the
    /// layers stay as they are. Without that, the number of vertices can only be known by making the mesh.
    bool keep_borders = true;
    std::optional<WallFlowOptions> walls{};  ///< empty: nothing is asked of the walls
    /// Where it is set, sizes lower the error of the goal of an adjoint solution in place of those of the fields: each
    /// error of interpolation counts as much as it changes the goal, and `norm` is 1.
    std::optional<GoalOptions> goal{};
};

LAMINA_EXPORT void validate(const SolutionSizeOptions& options);  ///< throws OptionError: an option out of range

/// A function that returns the number of vertices of the next mesh with these sizes.
using VertexCount = std::function<std::size_t(const SizedMesh&)>;

/// Sizes, and the mesh that they will make.
struct SolutionSizes {
    SizedMesh sizes;                  ///< on the isotropic cells of the solution's mesh, quads cut in two
    std::size_t vertices = 0;         ///< number of vertices that the next mesh has with them, by VertexCount
    std::size_t layer_vertices = 0;   ///< number of those in the layer, of the solution's mesh
    std::size_t vertices_before = 0;  ///< number of vertices of the solution's mesh
    int rounds = 0;                   ///< calls of VertexCount
    /// Per field: an estimate of the norm of the error of linear interpolation before. One number with a goal: the
    /// error of the goal, if no errors cancelled.
    std::vector<double> errors;
};

/// Returns the sizes h = c lambda^(-p / (2 p + 2)) at the vertices of the isotropic cells. lambda is the larger
/// eigenvalue of the recovered Hessian of a field; this has the least L^p norm of interpolation errors for a given
/// number of triangles. Several fields are scaled so that each by itself asks for the same number of triangles, and the
/// smallest size is taken. `count` makes the next mesh; empty: layers and their borders stay those of the solution's
/// mesh, and only the region beyond is meshed, whose outermost border must be convex then.
LAMINA_EXPORT SolutionSizes solution_sizes(const Solution& solution, const SolutionSizeOptions& options,
                                           const VertexCount& count = {});

}  // namespace lamina
