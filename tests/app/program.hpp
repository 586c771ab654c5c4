// Runs the program in a folder, with arguments.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "support/temporary_folder.hpp"

namespace lamina::test {

/// The exit codes of refusals (docs/reference/command-line.md, "Exit codes").
inline constexpr int usage = 2, bad_input = 3, mesh_failed = 4, io_failed = 5;

struct ProgramRun {
    int exit_code = -1;  ///< -1 where a signal ended it
    int signal = 0;      ///< the signal that ended it; 0: none
    std::string out;
    std::string err;
};

/// Returns the lines of a text.
std::vector<std::string> lines_of(const std::string& text);

/// Runs `lamina ARGUMENTS...` with `folder` as its working directory and `input` as its standard input.
ProgramRun run_lamina(const TemporaryFolder& folder, const std::vector<std::string>& arguments,
                      const std::string& input = "");

/// Runs it, too, with a pipe as its standard output that nobody reads. `out` stays empty.
ProgramRun run_lamina_unread(const TemporaryFolder& folder, const std::vector<std::string>& arguments);

/// Runs it, too, and sends it a signal as soon as `moment()` holds. Returns the signal that ended it, or 0.
int interrupt_lamina(const TemporaryFolder& folder, const std::vector<std::string>& arguments, int signal,
                     const std::function<bool()>& moment);

/// Runs it, too, and calls act(its process id) once its standard error contains `said`, unless it ends before.
ProgramRun run_lamina_and_act(const TemporaryFolder& folder, const std::vector<std::string>& arguments,
                              const std::string& said, const std::function<void(int)>& act);

/// Runs it, too, with this much address space.
ProgramRun run_lamina_in_memory(const TemporaryFolder& folder, const std::vector<std::string>& arguments,
                                std::size_t kilobytes);

/// Expects the program to refuse the arguments: with this exit code, one line "lamina: error: ..." that contains
/// `said`, nothing on standard output, and a folder that did not change.
void expect_refused(const TemporaryFolder& folder, const std::vector<std::string>& arguments, int exit_code,
                    const std::string& said);

}  // namespace lamina::test
