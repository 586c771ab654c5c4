// Meshes that move as time goes on: the part of `lamina morph` that makes more than one.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <lamina/io.hpp>
#include <lamina/morph.hpp>

#include "app/report.hpp"
#include "app/run_files.hpp"

namespace lamina::app {

/// What the command line says about a sequence.
struct SequenceArguments {
    std::vector<std::string> turns;  ///< texts that parse_turn_in_time() reads
    std::optional<double> until;     ///< the last time; empty: the longest of duration_of()
    int steps = 40;                  ///< the number of times after 0
};

/// The times of a sequence, and where the meshes go.
struct MorphSequence {
    std::vector<TurnInTime> turns;
    std::vector<double> times;
    std::vector<std::string> meshes;  ///< a file per time; empty where a case of a solver has all times
    std::string folder;               ///< of that case
    WriteOptions options;             ///< the format is that of the solver's meshes where there is a case
    std::vector<RunFile> outputs;
};

/// Throws UsageError for texts that are no turns, and where the output neither holds "{step}" nor is a folder for
/// OpenFOAM or, with that format, for SU2.
MorphSequence plan_sequence(const SequenceArguments& arguments, const std::string& output, const WriteOptions& options);
/// Writes the meshes, and returns a report for each time. Throws what morph() throws, with the time.
Json write_sequence(const MorphMap& map, const MorphSequence& sequence, const MorphOptions& options);
/// Returns the summary of such reports.
std::string sequence_summary(const std::string& mesh, const Json& report, const std::string& output);

/// Returns the report of one morphed mesh.
Json morph_json(const MorphResult& result, const MorphReport& report);

}  // namespace lamina::app
