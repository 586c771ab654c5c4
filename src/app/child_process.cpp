#include "app/child_process.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <string_view>

#include <fmt/format.h>

#include <lamina/error.hpp>

extern char** environ;

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

/// How a program is started: where its streams go, and which signals it knows of.
class SpawnSettings {
public:
    SpawnSettings(const fs::path& folder, const fs::path& log) {
        posix_spawn_file_actions_init(&actions);
        posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
        posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666);
        posix_spawn_file_actions_adddup2(&actions, STDOUT_FILENO, STDERR_FILENO);
        posix_spawn_file_actions_addchdir_np(&actions, folder.c_str());
        posix_spawnattr_init(&attributes);
        sigset_t none, ignored_here;
        sigemptyset(&none);
        sigemptyset(&ignored_here);
        sigaddset(&ignored_here, SIGPIPE);
        sigaddset(&ignored_here, SIGXFSZ);
        posix_spawnattr_setsigmask(&attributes, &none);
        posix_spawnattr_setsigdefault(&attributes, &ignored_here);
        posix_spawnattr_setpgroup(&attributes, 0);
        posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETPGROUP);
    }
    ~SpawnSettings() {
        posix_spawn_file_actions_destroy(&actions);
        posix_spawnattr_destroy(&attributes);
    }
    SpawnSettings(const SpawnSettings&) = delete;
    SpawnSettings& operator=(const SpawnSettings&) = delete;

    posix_spawn_file_actions_t actions{};
    posix_spawnattr_t attributes{};
};

}  // namespace

int run_program_in(const fs::path& folder, const std::vector<std::string>& words, const fs::path& log,
                   SignalGuard& guard) {
    std::vector<char*> arguments;
    std::vector<std::string> copies = words;
    arguments.reserve(copies.size() + 1);
    for (std::string& word : copies) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    const SpawnSettings settings(folder, fs::absolute(log));
    pid_t process = 0;
    const int error =
        posix_spawn(&process, arguments.front(), &settings.actions, &settings.attributes, arguments.data(), environ);
    if (error != 0) throw IoError(words.front(), std::string("cannot be run: ") + std::strerror(error));
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
