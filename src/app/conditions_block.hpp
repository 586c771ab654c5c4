// The block of the summary and of the report on the flow conditions: the numbers that lengths and the first height
// follow from, each with its source.
#pragma once

#include <string>
#include <vector>

#include <lamina/pipeline.hpp>

#include "app/case.hpp"
#include "app/report.hpp"

namespace lamina::app {

/// Returns the block of the summary: one line on the flow, and one on each length in force.
std::string conditions_summary(const MeshCase& mesh_case, const MeshResult& result);

/// Returns where the reference chord comes from: "given", or the extent in x of what.
std::string chord_source(const FlowConditions& conditions);

/// Returns the line of `lamina info` on the chord that lengths count.
std::string chord_line(const FlowConditions& conditions, const Geometry& geometry);

/// Returns a length in units of the input as reports tell it: in chords, too.
Json both_units(double length, double chord);

/// Returns the key "conditions" of the report.
Json conditions_report(const MeshCase& mesh_case, const MeshResult& result);

}  // namespace lamina::app
