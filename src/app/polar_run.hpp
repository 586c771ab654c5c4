// The work of `lamina polar`: forces at many angles of attack, by a solver on one mesh, or by the flow before the mesh.
#pragma once

#include <filesystem>
#include <string>

#include "app/adapt_solver.hpp"
#include "app/case.hpp"
#include "app/polar.hpp"

namespace lamina::app {

/// Options of a polar.
struct PolarSettings {
    std::filesystem::path folder;  ///< of the angles, and of polar.csv and polar.json, by the flow of polar.txt, too
    std::string identity;          ///< what else changes the outcome: the solver and its options
};

/// Returns the polar by lamina's own flow, without a mesh, and writes its files. Throws UsageError for the folder of a
/// polar by a solver.
FlowPolar run_polar_of_flow(const PolarSettings& settings, const MeshCase& mesh_case,
                            const TransitionOptions& transition);

/// Returns the polar by a solver, on one mesh that serves all angles. Each angle has a folder FOLDER/alpha_N with its
/// case, which appears once it is complete, with row.json; angles that are there are kept. Each begins with the flow of
/// the last one that was steady, or from rest where that cannot be read. An angle at which the solver fails is a row
/// that says so, and its folder alpha_N.failed stays until the angle is tried again. Throws as run_adapt().
FlowPolar run_polar_of_solver(const PolarSettings& settings, MeshCase mesh_case, AdaptSolver& solver);

}  // namespace lamina::app
