// A run that makes a case of a flow solver: what `lamina case` and `lamina adapt` have in common.
#pragma once

#include <string>
#include <vector>

#include <lamina/pipeline.hpp>
#include <lamina/solver_case.hpp>
#include <lamina/warning.hpp>

#include "app/case.hpp"
#include "app/mesh_run.hpp"

namespace lamina::app {

/// Returns the solver of this name. Throws UsageError where there is none.
FlowSolver solver_of_name(const std::string& name);
/// Sets what the solver prefers where neither a case file nor the command line says otherwise, and
/// SolverCaseOptions::compressible. Throws UsageError where the options do not make a case.
void prepare_case(FlowSolver solver, SolverCaseOptions& options, MeshCase& mesh_case);
/// Returns what the solver makes of the mesh and of the speed.
std::vector<Warning> warnings_of_case(FlowSolver solver, const MeshResult& result, const SolverCaseOptions& options);
/// Returns the flow that the case of a mesh computes.
SolverConditions solver_conditions(const MeshResult& result, const CaseOptions& options);
/// Returns the destination of a case in the folder that is the only output. It refers to the case.
MeshDestination destination_of_case(FlowSolver solver, const MeshCase& mesh_case, const SolverCaseOptions& options);

}  // namespace lamina::app
