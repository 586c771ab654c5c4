// This text stands beside the mesh on its page; share/page/page.js shows it.
#pragma once

#include <string>

#include <lamina/mesh.hpp>
#include <lamina/page.hpp>
#include <lamina/pipeline.hpp>

#include "app/case.hpp"
#include "app/report.hpp"

namespace lamina::app {

/// Returns the text of the page of a run, whose report is mesh_report().
PageText page_of_run(const MeshCase& mesh_case, const MeshResult& result, const Json& report);

/// Returns the text of the page of a mesh from a file of this name, whose report is check_report().
PageText page_of_mesh(const std::string& title, const Mesh& mesh, const Json& report);

}  // namespace lamina::app
