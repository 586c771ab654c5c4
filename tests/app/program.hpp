// Runs the built program as a user would: in a folder, with arguments.
#pragma once

#include <string>
#include <vector>

#include "support/temporary_folder.hpp"

namespace lamina::test {

struct ProgramRun {
    int exit_code = -1;  ///< -1 where a signal ended it
    std::string out;
    std::string err;
};

/// Runs `lamina ARGUMENTS...` with `folder` as its working directory.
ProgramRun run_lamina(const TemporaryFolder& folder, const std::vector<std::string>& arguments);

/// What every refusal promises: the exit code, one line "lamina: error: ..." that holds `said`, nothing on standard
/// output, and the folder as it was before.
void expect_refused(const TemporaryFolder& folder, const std::vector<std::string>& arguments, int exit_code,
                    const std::string& said);

}  // namespace lamina::test
