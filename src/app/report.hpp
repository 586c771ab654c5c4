// The JSON reports of runs (docs/reference/report.md, "Report").
#pragma once

#include <span>
#include <string>

#include <nlohmann/json_fwd.hpp>

#include <lamina/forecast.hpp>
#include <lamina/limits.hpp>
#include <lamina/mesh.hpp>
#include <lamina/mesh_sink.hpp>
#include <lamina/pipeline.hpp>
#include <lamina/warning.hpp>

#include "app/case.hpp"

namespace lamina::app {

using Json = nlohmann::ordered_json;

/// Returns the key "quality" of the reports, without the numbers that only the pipeline knows.
Json quality_report(const MeshCheck& check);

/// Returns the key "decomposition" of the reports.
Json decomposition_report(const DecompositionStats& stats);

/// Returns the keys "warnings" and "estimate" of the reports.
Json warnings_report(std::span<const Warning> warnings);
Json estimate_report(const RunEstimate& estimate);

/// The facts about a mesh that its report needs, and which a streamed mesh leaves behind.
struct MeshFacts {
    MeshCounts counts;
    std::string hash;
};
MeshFacts facts_of(const Mesh& mesh);

/// Returns the report of a run of `lamina mesh`. `write_seconds` is the time for writing the mesh files; "total"
/// includes it.
Json mesh_report(const MeshCase& mesh_case, const MeshResult& result, const MeshFacts& facts, double write_seconds);

/// Returns the report of `lamina mesh --dry-run`.
Json forecast_report(const MeshCase& mesh_case, const MeshForecast& forecast);

/// Returns JSON as text that ends with a newline. Bytes that are not UTF-8 are replaced.
std::string to_text(const Json& json);

}  // namespace lamina::app
