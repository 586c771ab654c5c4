// The flow solvers of `lamina adapt`: a solver that lamina writes cases for, or any program.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <lamina/pipeline.hpp>
#include <lamina/solution.hpp>
#include <lamina/solver_case.hpp>
#include <lamina/warning.hpp>

#include "app/case.hpp"
#include "app/run_files.hpp"

namespace lamina::app {

/// The forces that a solver has computed on one mesh, and whether and how it converged.
struct SolvedForces {
    double cl = 0, cd = 0;
    bool steady = true;
    std::optional<double> cm, y_plus;  ///< moment about the quarter chord, nose up; largest y+; where the solver says
    std::optional<std::size_t> iterations;  ///< empty: the solver does not say
    std::optional<double> residual;         ///< the logarithm to base 10 of the last residual of density (SU2) or
                                            ///< pressure (OpenFOAM)
};

/// A solver. A round has a folder with the mesh in mesh.vtu, the case and, once it was run, the solution.
class AdaptSolver {
public:
    virtual ~AdaptSolver() = default;

    /// Throws UsageError where a program is missing.
    virtual void require_programs() const = 0;
    /// Returns the fields whose errors ask for smaller triangles, where the user names none.
    virtual std::vector<std::string> usual_fields() const = 0;
    /// Returns the name of the vectors of velocity, or momentum, in a case that was run; empty where it has none.
    virtual std::string velocity(const std::filesystem::path& folder) const = 0;
    /// Returns the command in words for people.
    virtual std::string command() const = 0;
    /// Sets what the solver prefers in the options of meshes. Throws UsageError where they make no case.
    virtual void prepare(MeshCase& mesh_case) = 0;
    /// Returns what the solver makes of the mesh.
    virtual std::vector<Warning> warnings(const MeshResult& result) const = 0;
    /// Writes a case beside the mesh.
    virtual void write_case(const MeshResult& result, const MeshCase& mesh_case,
                            const std::filesystem::path& folder) const = 0;
    /// Gives a case the flow of a solved one as its start.
    virtual void start_from(const std::filesystem::path& solved, const SolvedForces& forces,
                            const std::filesystem::path& folder) const = 0;
    /// Runs the case. Throws IoError where the solver fails, leaves no files, or leaves numbers that are not finite.
    virtual SolvedForces run(const std::filesystem::path& folder, SignalGuard& guard) const = 0;
    /// Reads fields of a case that was run.
    virtual Solution read(const std::filesystem::path& folder, const std::vector<std::string>& fields) const = 0;
};

/// Returns the solver that --solver names: openfoam, su2, or a command.
std::unique_ptr<AdaptSolver> adapt_solver(const std::string& name, const SolverCaseOptions& options);

}  // namespace lamina::app
