// What `lamina delaunay` tells of a run: a report, and a summary.
#pragma once

#include <filesystem>
#include <string>

#include "app/delaunay_run.hpp"

namespace lamina::app {

/// The facts about a run that only the command knows.
struct DelaunayRunFacts {
    std::filesystem::path stem;
    bool with_poly = false;
    unsigned threads = 0;
    double smallest_angle_deg = 0;
    double read_seconds = 0, write_seconds = 0, total_seconds = 0;
};

/// Returns the text of the report, an object of JSON.
std::string delaunay_report(const DelaunayResult& result, const DelaunayRunFacts& facts);
/// Returns the lines that a run prints at its end.
std::string delaunay_summary(const DelaunayResult& result, const DelaunayRunFacts& facts);

}  // namespace lamina::app
