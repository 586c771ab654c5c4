#include "app/program.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <sstream>
#include <thread>

extern char** environ;

namespace lamina::test {

namespace {

std::string joined(const std::vector<std::string>& arguments) {
    std::string line = "lamina";
    for (const std::string& argument : arguments) line += " " + argument;
    return line;
}

/// Starts a program with files of `captured` as its standard input, output and error. Its output is `output` where that
/// is a descriptor.
pid_t start(const TemporaryFolder& folder, std::vector<std::string> words, const TemporaryFolder& captured,
            int output = -1) {
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);

    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    const int flags = O_WRONLY | O_CREAT;
    posix_spawn_file_actions_addopen(&actions, 0, (captured / "in").c_str(), O_RDONLY | O_CREAT, 0600);
    if (output >= 0)
        posix_spawn_file_actions_adddup2(&actions, output, 1);
    else
        posix_spawn_file_actions_addopen(&actions, 1, (captured / "out").c_str(), flags, 0600);
    posix_spawn_file_actions_addopen(&actions, 2, (captured / "err").c_str(), flags, 0600);
    posix_spawn_file_actions_addchdir_np(&actions, folder.path().c_str());
    // A shell starts its background jobs with SIGINT ignored, and programs inherit that.
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    sigset_t signals;
    sigemptyset(&signals);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) sigaddset(&signals, signal);
    posix_spawnattr_setsigdefault(&attributes, &signals);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGDEF);
    pid_t child = 0;
    const int failed = posix_spawn(&child, argv.front(), &actions, &attributes, argv.data(), environ);
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&actions);
    if (failed != 0) throw std::runtime_error("cannot start " + words.front());
    return child;
}

pid_t start_lamina(const TemporaryFolder& folder, const std::vector<std::string>& arguments,
                   const TemporaryFolder& captured, int output = -1) {
    std::vector<std::string> words{LAMINA_PROGRAM};
    words.insert(words.end(), arguments.begin(), arguments.end());
    return start(folder, words, captured, output);
}

/// Returns what lamina itself has printed. Where the thread sanitizer excuses something in TBB, it looks for names with
/// a program that complains on the same stream.
std::string without_symbolizer(std::string text) {
    const std::string complaint = "LLVMSymbolizer: ";
    for (std::size_t at = text.find(complaint); at != std::string::npos; at = text.find(complaint))
        text.erase(at, text.find('\n', at) - at + 1);
    return text;
}

/// Waits for a process to end.
ProgramRun ended(pid_t child, const TemporaryFolder& captured) {
    int status = 0;
    waitpid(child, &status, 0);
    return {.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1,
            .signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0,
            .out = std::filesystem::exists(captured / "out") ? captured.read("out") : "",
            .err = without_symbolizer(captured.read("err"))};
}

}  // namespace

std::vector<std::string> lines_of(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);) lines.push_back(line);
    return lines;
}

ProgramRun run_lamina(const TemporaryFolder& folder, const std::vector<std::string>& arguments,
                      const std::string& input) {
    const TemporaryFolder captured;
    if (!input.empty()) captured.write("in", input);
    return ended(start_lamina(folder, arguments, captured), captured);
}

ProgramRun run_lamina_in_memory(const TemporaryFolder& folder, const std::vector<std::string>& arguments,
                                std::size_t kilobytes) {
    const TemporaryFolder captured;
    std::vector<std::string> words{"/bin/sh", "-c", "ulimit -v \"$0\"; exec \"$@\"", std::to_string(kilobytes),
                                   LAMINA_PROGRAM};
    words.insert(words.end(), arguments.begin(), arguments.end());
    return ended(start(folder, words, captured), captured);
}

ProgramRun run_lamina_and_act(const TemporaryFolder& folder, const std::vector<std::string>& arguments,
                              const std::string& said, const std::function<void(int)>& act) {
    const TemporaryFolder captured;
    const pid_t child = start_lamina(folder, arguments, captured);
    const auto has_ended = [&] {
        siginfo_t info{};
        return waitid(P_PID, static_cast<id_t>(child), &info, WEXITED | WNOHANG | WNOWAIT) == 0 && info.si_pid != 0;
    };
    while (!has_ended()) {
        if (std::filesystem::exists(captured / "err") && captured.read("err").find(said) != std::string::npos) {
            act(child);
            break;
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return ended(child, captured);
}

ProgramRun run_lamina_unread(const TemporaryFolder& folder, const std::vector<std::string>& arguments) {
    const TemporaryFolder captured;
    int ends[2];
    if (pipe2(ends, O_CLOEXEC) != 0) throw std::runtime_error("no pipe");
    close(ends[0]);
    const pid_t child = start_lamina(folder, arguments, captured, ends[1]);
    close(ends[1]);
    return ended(child, captured);
}

int interrupt_lamina(const TemporaryFolder& folder, const std::vector<std::string>& arguments, int signal,
                     const std::function<bool()>& moment) {
    const TemporaryFolder captured;
    const pid_t child = start_lamina(folder, arguments, captured);
    int status = 0;
    while (!moment()) {
        if (waitpid(child, &status, WNOHANG) == child) return WIFSIGNALED(status) ? WTERMSIG(status) : 0;
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    kill(child, signal);
    waitpid(child, &status, 0);
    return WIFSIGNALED(status) ? WTERMSIG(status) : 0;
}

void expect_refused(const TemporaryFolder& folder, const std::vector<std::string>& arguments, int exit_code,
                    const std::string& said) {
    SCOPED_TRACE(joined(arguments));
    const std::vector<std::string> before = folder.names();
    const ProgramRun run = run_lamina(folder, arguments);
    EXPECT_EQ(run.exit_code, exit_code) << run.err;
    EXPECT_TRUE(run.err.starts_with("lamina: error: ")) << run.err;
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
    EXPECT_TRUE(run.err.ends_with('\n')) << run.err;
    EXPECT_NE(run.err.find(said), std::string::npos) << run.err;
    EXPECT_EQ(run.out, "");
    EXPECT_EQ(folder.names(), before);
}

}  // namespace lamina::test
