#include "app/case_inputs.hpp"

#include <algorithm>
#include <memory>

#include <lamina/error.hpp>
#include <lamina/files.hpp>
#include <lamina/io.hpp>
#include <lamina/limits.hpp>

namespace lamina::app {

void require_inputs(const MeshCase& mesh_case) {
    if (std::count_if(mesh_case.inputs.begin(), mesh_case.inputs.end(), is_standard_stream) > 1)
        throw UsageError("INPUT: '-' is given twice, but standard input can be read only once");
    if (is_standard_stream(mesh_case.background))
        throw UsageError("option --background: must be a file: standard input holds sections alone");
}

CaseOptions options_with_files(const MeshCase& mesh_case) {
    CaseOptions options = mesh_case.options;
    if (!mesh_case.background.empty())
        options.sizing.background = std::make_shared<const SizedMesh>(read_sizes(mesh_case.background));
    options.limits = with_default_limits(options.limits);
    return options;
}

}  // namespace lamina::app
