// The files of a case beside the mesh.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <lamina/mesh.hpp>
#include <lamina/solver_case.hpp>

namespace lamina::cases {

/// A file of a case beside the mesh.
struct SolverCaseFile {
    std::filesystem::path name;  ///< within the folder of the case: "system/controlDict"
    std::string text;            ///< its contents
    bool executable = false;     ///< whether it is a script to run
};

/// Writes a file of a case into its folder.
void write_case_file(const SolverCaseFile& file, const std::filesystem::path& folder);

/// Returns the files of a case without the mesh. They do not depend on the machine. Walls of the mesh are its markers
/// of the kind wall, and its far field is all markers of that kind. `order`: that of its cells. Throws OptionError
/// where the Reynolds number is missing, or the Mach number of a compressible flow is missing or out of range,
/// MeshError where the mesh has no wall or no far field, and UsageError for SU2 where most cells of the layer are
/// triangles: with the scheme of its case SU2 diverges on them or finds a negative drag. UsageError for PyFR where the
/// flow or a marker's name is none that it knows.
std::vector<SolverCaseFile> solver_case_files(FlowSolver solver, const Mesh& mesh, const SolverConditions& conditions,
                                              const SolverCaseOptions& options = {}, unsigned order = 1);

}  // namespace lamina::cases
