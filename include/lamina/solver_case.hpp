// Cases of flow solvers: a mesh with everything that a solver needs beside it, ready to run. The files are templates
// under share/cases/ with placeholders; the library carries them with it.
//
// Guarantees:
//  1. The files do not depend on the machine. Each appears as a whole or not at all.
// Limits:
//  1. MeshError for a mesh without markers of the kinds wall and far field. OptionError where the Reynolds number is
//     missing, or the Mach number of a compressible flow is missing or out of range. UsageError for SU2 where most
//     cells of the layer are triangles, on which it diverges or finds a negative drag; for PyFR where it has no such flow.
// Example:
//     CaseOptions options{.far_field = {.size = 10}};
//     options.layer = {.first_height = 1e-3, .layers = 8, .topology = LayerTopology::quads};
//     const Mesh mesh = generate_mesh({"naca:0012"}, options).mesh;
//     write_solver_case(FlowSolver::su2, mesh, {.reference = {.reynolds = 6e6}}, "su2_case", {.overwrite = true});
//     assert(read_file("su2_case/case.cfg").find("REYNOLDS_NUMBER") != std::string::npos);
#pragma once

#include <filesystem>
#include <span>
#include <utility>

#include <lamina/curved_mesh.hpp>
#include <lamina/flow.hpp>
#include <lamina/mesh.hpp>
#include <lamina/morph.hpp>

namespace lamina {

/// The solvers that cases are written for.
enum class FlowSolver {
    openfoam,  ///< OpenFOAM: simpleFoam, rhoSimpleFoam (SolverCaseOptions::compressible), pimpleFoam (unsteady)
    su2,       ///< SU2_CFD: compressible
    pyfr,      ///< PyFR 3.1: compressible and laminar, in time, by polynomials of the order of the cells
};

/// Turbulence models of cases.
enum class TurbulenceModel {
    spalart_allmaras,  ///< Spalart-Allmaras
    k_omega_sst,       ///< Menter's k-omega SST of 2003
    laminar,           ///< none: the Navier-Stokes equations as they are
};

/// Forces whose adjoint solution a case can have.
enum class AdjointGoal { drag, lift };

/// Options of cases.
struct SolverCaseOptions {
    /// The model that closes the equations; empty: none below a Reynolds number of 1e4, Spalart-Allmaras above.
    std::optional<TurbulenceModel> turbulence{};
    bool overwrite = false;  ///< whether files of the folder that have the name of a file of the case are replaced
    /// Whether OpenFOAM's case is that of a gas, at ReferenceConditions::mach, above 0 and below 1. SU2's always is.
    bool compressible = false;
    /// Whether the case is solved in time, for flow that sheds vortices: by pimpleFoam, or in dual time steps of SU2.
    /// In one step the free stream crosses one edge of a triangle of the wake. OpenFOAM's is for incompressible flow.
    /// PyFR always solves in time, and begins with a gust then.
    bool unsteady = false;
    /// The force whose adjoint solution OpenFOAM's steady incompressible case finds by Alladjoint, after Allrun; empty:
    /// none. The adjoint of Spalart-Allmaras is a part of it; with k-omega SST the turbulent viscosity counts as given.
    std::optional<AdjointGoal> adjoint{};
};

/// Throws OptionError where no case of the solver is for a flow of this Mach number, which may be missing, for one in
/// time, for an adjoint solution, or with this model of turbulence.
LAMINA_EXPORT void validate(FlowSolver solver, const SolverCaseOptions& options, const std::optional<double>& mach);
/// Returns the solvers by their names on the command line: "openfoam", "su2", "pyfr".
LAMINA_EXPORT const std::vector<std::pair<std::string, FlowSolver>>& flow_solvers();
/// The Mach number of a case of SU2 where none is given.
inline constexpr double default_case_mach = 0.15;
/// Returns the half-width of the far field, in chords, that suits the conditions that the solver has for it at a Mach
/// number: OpenFOAM's far field carries the vortex of the lift; SU2's is a uniform stream, and what is behind shocks of
/// supersonic flow does not reach far; PyFR's explicit steps make cells expensive.
LAMINA_EXPORT double far_field_for(FlowSolver solver, double mach = default_case_mach);

/// The flow that a case computes, and what its coefficients count. Lengths are in units of the mesh.
struct SolverConditions {
    ReferenceConditions reference{};      ///< chord, angle of attack, Reynolds number (required) and Mach number
    std::optional<double> velocity{};     ///< of the free stream, in units of the mesh per second; empty: 1
    std::optional<Point> moment_point{};  ///< empty: a quarter of the chord behind the foremost vertex of the walls
    bool wall_functions = false;          ///< whether the first cells lie in the logarithmic layer
    /// Names of the markers of walls that are not bodies, as ground without slip: forces on them do not count.
    std::vector<std::string> outer_walls{};
    std::vector<std::string> moving_walls{};  ///< those of them that move with the free stream
    /// Whether the mesh is one half of an axisymmetric flow about y = 0, whose marker `axis` has the kind symmetry.
    /// Forces then are those of the whole body, over the area of its largest circle.
    bool axisymmetric = false;
};

/// Returns WarningCode::unsuited_to_solver where most cells of the layer are triangles, on which simpleFoam diverges,
/// and for PyFR where the flow would be turbulent.
LAMINA_EXPORT std::vector<Warning> find_solver_warnings(FlowSolver solver, const Mesh& mesh,
                                                        const ReferenceConditions& conditions = {});
/// Returns WarningCode::unsuited_speed where the mesh of a compressible case is not made for this Mach number: sizes
/// follow no shocks (FlowDecisions::knows_shocks), and the Mach number is above 0.5, or the flow is expected to be
/// supersonic along more than 0.05 chords of the walls, by the pressures of the incompressible flow before the mesh
/// (null where there is none) and Karman and Tsien's rule; and at supersonic free streams, whose bow shocks sizes leave
/// out.
LAMINA_EXPORT std::vector<Warning> find_speed_warnings(double mach, const Flow* flow, bool knows_shocks);
/// Returns the names of all files of a case in this folder. The first is the mesh, or the folder that it is in.
LAMINA_EXPORT std::vector<std::filesystem::path> solver_case_outputs(FlowSolver solver,
                                                                     const std::filesystem::path& folder,
                                                                     const SolverCaseOptions& options = {});
/// Throws what write_solver_case() would throw for the folder: UsageError where a file of the case exists and
/// SolverCaseOptions::overwrite is not set, IoError where the folder cannot be written to.
LAMINA_EXPORT void check_solver_case_writable(FlowSolver solver, const std::filesystem::path& folder,
                                              const SolverCaseOptions& options = {});
/// Writes mesh and case into a folder, which is created if it is missing. The cells may be curved for PyFR, whose
/// solution has their order.
LAMINA_EXPORT void write_solver_case(FlowSolver solver, const Mesh& mesh, const SolverConditions& conditions,
                                     const std::filesystem::path& folder, const SolverCaseOptions& options = {},
                                     const CurvedNodes& nodes = {});
/// Gives a steady case that was just written the flow of a solved one as its start, by transfer(): Allrun goes on from
/// there. OpenFOAM's fields in 0/ are replaced, and system/start holds the lift coefficient, for the vortex of the far
/// field; SU2's flow is in start_flow.dat. Throws IoError, and InputError or UsageError where the solution is
/// incomplete, is of another mesh or has numbers that are not finite.
LAMINA_EXPORT void start_case_from(FlowSolver solver, const std::filesystem::path& solved,
                                   const std::filesystem::path& folder, double lift);

/// Writes a case of OpenFOAM whose mesh moves, without its times: the mesh, and an Allrun that takes the flow from a
/// steady case of the same mesh and lets it go on by pimpleFoam. Throws UsageError for the mesh of an axisymmetric
/// flow, and where the folder has times of another motion.
LAMINA_EXPORT void write_moving_case(const Mesh& reference, std::span<const double> times,
                                     const std::filesystem::path& folder);
/// Gives the case the places of all vertices at a time, in the order of the mesh: as points, which checkMesh reads, and
/// as displacements, which pimpleFoam follows. Throws InputError for another number of points, and for a time that is
/// negative or not finite.
LAMINA_EXPORT void add_moved_points(const Mesh& reference, std::span<const Point> points, double time,
                                    const std::filesystem::path& folder);
/// Returns the names of all files of such a case with these times. The first is the folder of the mesh.
LAMINA_EXPORT std::vector<std::filesystem::path> moving_case_outputs(const std::filesystem::path& folder,
                                                                     std::span<const double> times);

/// Writes a case of SU2 whose whole mesh pitches, far field included: the mesh, and an Allrun that takes the flow from
/// a steady case of the same mesh and lets it go on up to a time > 0, in so many steps. In a unit of time the free
/// stream goes a unit of length. Throws UsageError unless all bodies pitch together and the far field is closed.
LAMINA_EXPORT void write_pitching_case(const Mesh& reference, const TurnInTime& turn, double end, int steps,
                                       const std::filesystem::path& folder);
/// Returns the names of all files of such a case. The first is the mesh.
LAMINA_EXPORT std::vector<std::filesystem::path> pitching_case_outputs(const std::filesystem::path& folder);

}  // namespace lamina
