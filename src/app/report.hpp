// What a run tells: the JSON report and the summary for people (docs/guide.md, "Report").
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include <lamina/mesh.hpp>
#include <lamina/pipeline.hpp>

namespace lamina::app {

using Json = nlohmann::ordered_json;

/// "quality" of the report without what only the pipeline knows; also that of `lamina check --json`.
Json quality_report(const MeshCheck& check);

/// "decomposition" of the reports of `lamina mesh` and `lamina delaunay`.
Json decomposition_report(const DecompositionStats& stats);

/// The report of `lamina mesh`. write_seconds: spent in writing the mesh files; "total" includes them.
Json mesh_report(const MeshResult& result, double write_seconds);

/// JSON as text with a final newline; text that is not UTF-8 is mended.
std::string to_text(const Json& json);

/// "isotropic: smallest angle 20.9 deg, ..." lines of a summary, indented.
std::string quality_summary(const MeshCheck& check);

std::string mesh_summary(const MeshResult& result, const std::vector<std::string>& outputs, double write_seconds);

}  // namespace lamina::app
