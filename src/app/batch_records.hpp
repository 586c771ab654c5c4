// The records of the jobs of `lamina batch`, objects of JSON: lines of its journal, and rows of its table.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "app/batch_run.hpp"
#include "app/mesh_run.hpp"
#include "app/report.hpp"

namespace lamina::app {

/// Returns the text that names a job among those of a batch.
std::string id_of(const BatchJob& job);

/// Returns the files that a job has written, with their contents. Throws IoError where one cannot be read back.
Json files_report(const MeshCase& mesh_case, const MeshDestination& destination);

/// Returns a record as one line.
std::string line_of(const Json& record);

/// Returns the records of a journal by the names of their jobs. A line that an interruption cut off does not count.
std::map<std::string, Json> read_journal(const std::filesystem::path& journal);

/// Returns whether a record is of a job with this fingerprint, and the files of the job are still as they were written.
bool still_holds(const Json& record, const std::string& digits);

/// Returns the records of all jobs, in their order, as a table in CSV.
std::string table_of(const std::vector<BatchJob>& jobs, const std::vector<Json>& records);

}  // namespace lamina::app
