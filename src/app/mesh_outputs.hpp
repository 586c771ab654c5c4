// What `lamina mesh` and `lamina family` write for each mesh.
#pragma once

#include <vector>

#include <lamina/pipeline.hpp>

#include "app/case.hpp"
#include "app/run_files.hpp"

namespace lamina::app {

/// Returns the files that the case writes, each with the option that names it.
std::vector<RunFile> files_written(const MeshCase& mesh_case);

/// Throws where an output is missing or certainly cannot be written, before the work begins.
void require_outputs(const MeshCase& mesh_case);

/// Writes the mesh, the table of its walls and the report of the run, as the case asks. Throws the errors of
/// write_mesh().
void write_outputs(const MeshCase& mesh_case, const MeshResult& result);

}  // namespace lamina::app
