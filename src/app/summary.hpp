// The summaries of runs for people.
#pragma once

#include <string>

#include <lamina/forecast.hpp>
#include <lamina/mesh.hpp>
#include <lamina/mesh_sink.hpp>
#include <lamina/pipeline.hpp>
#include <lamina/ranks.hpp>

#include "app/case.hpp"

namespace lamina::app {

/// Returns one line of a summary: the label, indented and padded, the text, and a newline.
std::string summary_line(const std::string& label, const std::string& text);

/// Returns the lines about the quality of a mesh.
std::string quality_summary(const MeshCheck& check);

/// Returns the line on curved cells.
std::string curved_line(unsigned order, const CurvedCheck& check);

/// Returns the summary of `lamina mesh` for a mesh of this size.
std::string mesh_summary(const MeshCase& mesh_case, const MeshResult& result, const MeshCounts& counts,
                         double write_seconds);

/// Returns the summary of `lamina mesh --dry-run`.
std::string forecast_summary(const MeshCase& mesh_case, const MeshForecast& forecast);

/// Returns the line about what so many processes have sent each other for a mesh of so many pieces.
std::string traffic_line(unsigned processes, const RankTraffic& traffic, std::size_t pieces);

}  // namespace lamina::app
