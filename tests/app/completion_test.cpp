// The scripts that complete the command line, and the manual page, hold every option and suit the programs that read
// them.
#include <cstdlib>

#include <gtest/gtest.h>

#include "app/program.hpp"

namespace lamina::test {
namespace {

const char* const commands[] = {"mesh", "family",  "sizes", "batch", "case",     "check",     "plot",
                                "view", "convert", "info",  "flow",  "delaunay", "completion"};

/// Returns the long options that the help of a command shows.
std::vector<std::string> options_in_help(const TemporaryFolder& folder, const std::string& command) {
    const std::string help = run_lamina(folder, {command, "--help-all"}).out;
    std::vector<std::string> options;
    for (std::size_t at = help.find("\n  -"); at != std::string::npos; at = help.find("\n  -", at + 1)) {
        const std::size_t begin = help.find("--", at);
        options.push_back(help.substr(begin, help.find_first_of(" ,\n", begin) - begin));
    }
    return options;
}

bool succeeds(const std::string& line) { return std::system(line.c_str()) == 0; }

bool is_installed(const std::string& program) { return succeeds("command -v " + program + " > /dev/null 2>&1"); }

TEST(Completion, ScriptsAndManualHoldEveryOption) {
    const TemporaryFolder folder;
    std::size_t options = 0;
    for (const char* target : {"bash", "zsh", "fish", "man"}) {
        const ProgramRun run = run_lamina(folder, {"completion", target});
        ASSERT_EQ(run.exit_code, 0) << run.err;
        for (const char* command : commands) {
            EXPECT_NE(run.out.find(command), std::string::npos) << target << ' ' << command;
            for (std::string option : options_in_help(folder, command)) {
                ++options;
                if (target == std::string("fish")) option = " -l " + option.substr(2) + " ";
                if (target == std::string("man"))
                    for (std::size_t at = 0; (at = option.find('-', at)) != std::string::npos; at += 2)
                        option.insert(at, "\\");
                EXPECT_NE(run.out.find(option), std::string::npos) << target << ' ' << command << ' ' << option;
            }
        }
    }
    EXPECT_GT(options, 4 * 60u);
}

TEST(Completion, ShellsAndGroffFindNothingWrong) {
    const TemporaryFolder folder;
    for (const char* target : {"bash", "zsh", "fish", "man"})
        folder.write(target, run_lamina(folder, {"completion", target}).out);
    const std::string at = folder.path().string() + "/";
    EXPECT_TRUE(succeeds("bash -n " + at + "bash"));
    if (is_installed("zsh")) {
        EXPECT_TRUE(succeeds("zsh -n " + at + "zsh"));
    }
    if (is_installed("fish")) {
        EXPECT_TRUE(succeeds("fish --no-execute " + at + "fish"));
    }
    if (is_installed("groff")) {
        EXPECT_TRUE(succeeds("groff -man -ww -z " + at + "man 2> " + at + "warnings"));
        EXPECT_EQ(folder.read("warnings"), "");
    }
}

TEST(Completion, BashOffersOptionsAndValues) {
    const TemporaryFolder folder;
    const std::string script = run_lamina(folder, {"completion", "bash"}).out;
    folder.write("try.sh",
                 script +
                     "try() { COMP_WORDS=(\"$@\"); COMP_CWORD=$(($# - 1)); _lamina; echo \"${COMPREPLY[*]}\"; }\n"
                     "try lamina me\ntry lamina mesh --first\ntry lamina mesh --surface re\n"
                     "try lamina help che\ntry lamina completion z\ntry lamina convert --span-ends p\n"
                     "try lamina mesh --growth-law ''\n");
    const std::string at = folder.path().string() + "/";
    ASSERT_TRUE(succeeds("bash " + at + "try.sh > " + at + "out"));
    EXPECT_TRUE(
        folder.read("out").starts_with("mesh\n--first-height\nresample\ncheck\nzsh\nperiodic\ngeometric polynomial "))
        << folder.read("out");
}

}  // namespace
}  // namespace lamina::test
