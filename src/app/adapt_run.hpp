// The loop of `lamina adapt`: mesh, solve, find the sizes that the solution asks for, mesh again, and go on from the
// solution.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <lamina/solution_sizes.hpp>

#include "app/adapt_solver.hpp"
#include "app/case.hpp"

namespace lamina::app {

/// Options of run_adapt().
struct AdaptSettings {
    std::filesystem::path folder;  ///< of all rounds
    int rounds = 5;                ///< number of meshes at most
    std::vector<double> vertices;  ///< numbers of vertices of the rounds, the last one for all further; empty: those of
                                   ///< the first mesh as its options make it
    double tolerance = 1e-3;  ///< forces have settled where they change by less, as a share, in two rounds in a row
    std::vector<std::string> fields;  ///< whose errors ask for smaller triangles; empty: those usual for the solver
    SolutionSizeOptions sizes{};      ///< vertices are those of the rounds
    std::optional<double> max_ratio;  ///< of the lengths of triangles beyond the layer; empty: they are isotropic
    std::string identity;             ///< what else changes the outcome: the solver and its options
    bool dry_run = false;             ///< whether it is said what would be done, and nothing is
};

/// Runs the rounds that are not done yet. Each has a folder FOLDER/round_N, which appears once it is complete and holds
/// round.json; FOLDER/adapt.csv and FOLDER/adapt.html show them. Throws UsageError where a program is missing, where
/// options contradict each other, and where the folder has rounds of other options; what the stages throw ends the loop
/// and leaves the rounds that are complete.
void run_adapt(const AdaptSettings& settings, MeshCase mesh_case, AdaptSolver& solver);

}  // namespace lamina::app
