#include "app/child_process.hpp"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <string_view>

#include <fmt/format.h>

#include <lamina/error.hpp>

namespace lamina::app {

namespace fs = std::filesystem;

std::vector<std::string> split_command(const std::string& command, const std::string& origin) {
    std::vector<std::string> words;
    bool in_word = false;
    char quote = '\0';
    for (const char c : command) {
        const bool is_blank = c == ' ' || c == '\t' || c == '\n';
        if (quote == '\0' && is_blank) {
            in_word = false;
            continue;
        }
        if (!in_word) words.emplace_back();
        in_word = true;
        if (c == quote)
            quote = '\0';
        else if (quote == '\0' && (c == '\'' || c == '"'))
            quote = c;
        else
            words.back() += c;
    }
    if (quote != '\0') throw UsageError(fmt::format("{}: the quote {} does not end", origin, quote));
    if (words.empty()) throw UsageError(origin + ": is empty");
    return words;
}

fs::path find_program(const std::string& word) {
    const auto can_run = [](const fs::path& file) {
        std::error_code ignored;
        return fs::is_regular_file(file, ignored) && ::access(file.c_str(), X_OK) == 0;
    };
    if (word.find('/') != std::string::npos) return can_run(word) ? fs::absolute(word) : fs::path();
    const char* const given = std::getenv("PATH");
    for (std::string_view rest = given != nullptr ? given : ""; !rest.empty();) {
        const std::size_t colon = rest.find(':');
        fs::path file = fs::absolute(fs::path(rest.substr(0, colon)) / word);
        if (can_run(file)) return file;
        rest.remove_prefix(colon == std::string_view::npos ? rest.size() : colon + 1);
    }
    return {};
}

namespace {

/// Lets the signals that are handled here do what they do by themselves, and no signal wait. Two are ignored here.
void forget_signals() {
    for (int number = 1; number < NSIG; ++number) {
        struct sigaction now {};
        const bool is_known = ::sigaction(number, nullptr, &now) == 0;
        if (is_known && (now.sa_handler != SIG_IGN || number == SIGPIPE || number == SIGXFSZ))
            std::signal(number, SIG_DFL);
    }
    sigset_t none;
    sigemptyset(&none);
    ::sigprocmask(SIG_SETMASK, &none, nullptr);
}

/// Becomes the program, in this folder and in a group of its own, with its streams in the log. Returns only where that
/// fails, with errno. Calls nothing that another thread of the program before could have locked.
void become(char* const* arguments, const char* folder, const char* log) {
    const int input = ::open("/dev/null", O_RDONLY | O_CLOEXEC);
    const int output = ::open(log, O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    if (input < 0 || output < 0 || ::dup2(input, STDIN_FILENO) < 0 || ::dup2(output, STDOUT_FILENO) < 0 ||
        ::dup2(output, STDERR_FILENO) < 0 || ::chdir(folder) != 0)
        return;
    ::setpgid(0, 0);
    forget_signals();
    ::execv(arguments[0], arguments);
}

/// Starts a program and returns its process. Throws IoError where that fails. fork() stands here in place of
/// posix_spawn(), which can change folders since version 2.29 of the C library alone.
pid_t start(const std::vector<char*>& arguments, const fs::path& folder, const fs::path& log) {
    const auto refuse = [&](int error) {
        throw IoError(arguments.front(), std::string("cannot be run: ") + std::strerror(error));
    };
    int report[2];  // closed by execv(), or given the number of an error
    if (::pipe(report) != 0) refuse(errno);
    for (const int end : report) ::fcntl(end, F_SETFD, FD_CLOEXEC);
    // A signal between both would run what this program does with it, in the other process.
    sigset_t all, before;
    sigfillset(&all);
    ::pthread_sigmask(SIG_SETMASK, &all, &before);
    const pid_t process = ::fork();
    if (process == 0) {
        become(arguments.data(), folder.c_str(), log.c_str());
        const int error = errno;
        const ssize_t written = ::write(report[1], &error, sizeof error);
        ::_exit(written == sizeof error ? 127 : 126);
    }
    int error = process < 0 ? errno : 0;
    ::pthread_sigmask(SIG_SETMASK, &before, nullptr);
    ::close(report[1]);
    while (process > 0 && ::read(report[0], &error, sizeof error) < 0 && errno == EINTR) continue;
    ::close(report[0]);
    if (process > 0 && error != 0) ::waitpid(process, nullptr, 0);
    if (error != 0) refuse(error);
    return process;
}

}  // namespace

int run_program_in(const fs::path& folder, const std::vector<std::string>& words, const fs::path& log,
                   SignalGuard& guard) {
    std::vector<char*> arguments;
    std::vector<std::string> copies = words;
    arguments.reserve(copies.size() + 1);
    for (std::string& word : copies) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    const pid_t process = start(arguments, folder, fs::absolute(log));
    guard.take_along(process);
    int status = 0;
    pid_t ended = 0;
    while ((ended = ::waitpid(process, &status, 0)) < 0 && errno == EINTR) continue;
    const int lost = ended < 0 ? errno : 0;
    guard.take_along(0);
    // Where SIGCHLD is ignored, no exit code is kept.
    if (lost != 0) throw IoError(words.front(), std::string("its exit code cannot be read: ") + std::strerror(lost));
    return WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
}

}  // namespace lamina::app
