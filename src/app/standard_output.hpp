// Printing on standard output, which may also carry one of the files of a run.
#pragma once

#include <span>
#include <string>

#include "app/run_files.hpp"

namespace lamina::app {

/// Prints the result of a command on standard output. Throws IoError.
void print_result(const std::string& text);

/// Prints a summary for people: on standard output, or on standard error where standard output carries one of these
/// outputs. Throws IoError.
void print_summary(const std::string& text, std::span<const RunFile> outputs);

/// Opens /dev/null in place of standard streams that are closed, so that no file that is opened later takes the number
/// of such a stream and gets its text. Reading from it and writing to it fail as they do on a closed stream.
void guard_closed_streams();

}  // namespace lamina::app
