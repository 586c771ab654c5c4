// Search for properties of a valid mesh that its user probably does not want.
#pragma once

#include <vector>

#include <lamina/pipeline.hpp>

namespace lamina::pipeline {

/// Returns the warnings about a result that is complete but for them. `size` is the size field of the isotropic region.
std::vector<Warning> find_warnings(const MeshResult& result, const CaseOptions& options, const SizeField& size);

}  // namespace lamina::pipeline
