// The JSON reports of runs (docs/guide.md, "Report").
#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include <lamina/mesh.hpp>
#include <lamina/pipeline.hpp>

namespace lamina::app {

using Json = nlohmann::ordered_json;

/// Returns the key "quality" of the reports, without the numbers that only the pipeline knows.
Json quality_report(const MeshCheck& check);

/// Returns the key "decomposition" of the reports.
Json decomposition_report(const DecompositionStats& stats);

/// Returns the report of `lamina mesh`. `write_seconds` is the time for writing the mesh files; "total" includes it.
Json mesh_report(const MeshResult& result, double write_seconds);

/// Returns JSON as text that ends with a newline. Bytes that are not UTF-8 are replaced.
std::string to_text(const Json& json);

}  // namespace lamina::app
