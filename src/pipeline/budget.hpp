// Meshes of so many vertices or cells: CaseOptions::vertices and cells.
#pragma once

#include <functional>

#include <lamina/pipeline.hpp>

namespace lamina::pipeline {

/// Returns whether the options say how many vertices or cells there are to be.
bool has_budget(const CaseOptions& options);

/// Throws OptionError where they do, for runs that do not have the whole mesh.
void refuse_budget(const CaseOptions& options);

/// Makes meshes with_scale() until one has the number of vertices or cells. Throws OptionError where none within 3 % of
/// it is found. Precondition: has_budget().
MeshResult mesh_within_budget(const CaseOptions& options, const std::function<MeshResult(const CaseOptions&)>& make);

}  // namespace lamina::pipeline
