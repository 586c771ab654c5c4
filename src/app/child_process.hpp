// Programs that a run starts, without a shell.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/run_files.hpp"

namespace lamina::app {

/// Returns the words of a command, which blanks divide. What stands between quotes, ' or ", is one word or a part of
/// one. Throws UsageError, which begins with `origin`, for a quote that does not end, and where there are no words.
std::vector<std::string> split_command(const std::string& command, const std::string& origin);

/// Returns the file of a program: the word itself where it has a slash, as an absolute path, or the first of that name
/// in PATH. Empty where there is none that may be run.
std::filesystem::path find_program(const std::string& word);

/// Runs a program in a folder until it ends, and returns its exit code, or 128 and the number of the signal that ended
/// it. The first word is the file of the program; standard output and standard error go to `log`, and standard input is
/// empty. The program and all that it starts get the signals that end this one. Throws IoError where it cannot be
/// started.
int run_program_in(const std::filesystem::path& folder, const std::vector<std::string>& words,
                   const std::filesystem::path& log, SignalGuard& guard);

}  // namespace lamina::app
