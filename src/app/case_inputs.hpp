// What a case reads when its work begins.
#pragma once

#include <lamina/pipeline.hpp>

#include "app/case.hpp"

namespace lamina::app {

/// Throws UsageError where standard input is asked for what it cannot give.
void require_inputs(const MeshCase& mesh_case);

/// Returns the options of the case with the background mesh read and the default limits set. Throws the errors of
/// read_sizes().
CaseOptions options_with_files(const MeshCase& mesh_case);

}  // namespace lamina::app
