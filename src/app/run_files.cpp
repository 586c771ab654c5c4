#include "app/run_files.hpp"

#include <pthread.h>
#include <unistd.h>
#ifdef __linux__
#include <sys/syscall.h>
#endif

#include <algorithm>
#include <chrono>
#include <system_error>

#include <fmt/format.h>

#include <lamina/error.hpp>
#include <lamina/files.hpp>
#include <lamina/io.hpp>

namespace lamina::app {

namespace fs = std::filesystem;

namespace {

/// The signal that ends the thread of a guard. macOS has none that are free for programs but two.
int signal_of_the_end() {
#ifdef SIGRTMIN
    return SIGRTMIN;
#else
    return SIGUSR2;
#endif
}

bool is_file_or_folder(const fs::path& path) {
    std::error_code ignored;
    const fs::file_type type = fs::status(path, ignored).type();
    return type == fs::file_type::regular || type == fs::file_type::directory || type == fs::file_type::not_found;
}

bool is_folder(const fs::path& path) {
    std::error_code ignored;
    return fs::is_directory(path, ignored);
}

bool is_inside(const fs::path& path, const fs::path& folder) {
    return std::mismatch(folder.begin(), folder.end(), path.begin(), path.end()).first == folder.end();
}

/// Returns whether writing `output` changes `other`. Standard streams are given by their devices.
bool replaces(const fs::path& output, const fs::path& other) {
    if (!is_file_or_folder(output) || !is_file_or_folder(other)) return false;
    std::error_code ignored;
    if (fs::equivalent(output, other, ignored)) return true;
    const fs::path a = path_behind_links(output), b = path_behind_links(other);
    if (a == b) return true;
    // A folder that is written takes its files with it; a folder that is read may hold a folder that is written.
    return is_folder(a) && (is_inside(b, a) || is_inside(a, b));
}

/// Returns the path to compare a file of a run by. A shell may have opened a file as standard input or output.
fs::path comparable(const fs::path& path, const char* device) { return is_standard_stream(path) ? device : path; }
fs::path comparable_input(const RunFile& input) { return comparable(input.path, "/dev/stdin"); }
fs::path comparable_output(const RunFile& output) { return comparable(output.path, "/dev/stdout"); }

bool are_one_file(const RunFile& output, const RunFile& other) {
    if (is_standard_stream(output.path) && is_standard_stream(other.path)) return true;
    const fs::path a = comparable_output(output), b = comparable_output(other);
    return replaces(a, b) || replaces(b, a);
}

}  // namespace

fs::path path_behind_links(const fs::path& path) {
    const fs::path absolute = fs::absolute(path);
    std::error_code failed;
    fs::path result = fs::weakly_canonical(absolute, failed);
    if (failed) result = absolute.lexically_normal();
    return result.has_filename() ? result : result.parent_path();
}

void require_distinct(std::span<const RunFile> inputs, std::span<const RunFile> outputs) {
    for (std::size_t i = 0; i < outputs.size(); ++i) {
        const RunFile& output = outputs[i];
        for (const RunFile& input : inputs)
            if (replaces(comparable_output(output), comparable_input(input)))
                throw UsageError(fmt::format("{}: '{}' would replace the input '{}'", output.role, output.path.string(),
                                             input.path.string()));
        for (const RunFile& earlier : outputs.first(i))
            if (are_one_file(output, earlier))
                throw UsageError(
                    fmt::format("{}: '{}' is written by {} already", output.role, output.path.string(), earlier.role));
    }
}

void require_format(const std::string& file, const std::string& format, const std::string& option) {
    if (is_standard_stream(file) && format.empty())
        throw UsageError(fmt::format("'-' has no extension that tells the format: give {} NAME", option));
}

void require_parts_taken(std::span<const std::string> files, const WriteOptions& options) {
    const auto takes = [&](const std::string& file) { return takes_parts(file, options); };
    if (options.parts > 1 && std::none_of(files.begin(), files.end(), takes))
        throw UsageError("option --parts: only PVTU files and OpenFOAM's folders have parts");
}

std::vector<RunFile> files_in(const fs::path& folder, const std::string& role) {
    std::vector<RunFile> files;
    std::error_code ignored;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, ignored))
        files.push_back({entry.path(), role});
    return files;
}

std::vector<RunFile> files_of_output(const std::string& output, const WriteOptions& options) {
    std::vector<RunFile> files;
    for (const fs::path& file : output_files(output, options)) files.push_back({file, "option --output"});
    return files;
}

std::vector<RunFile> files_of_mesh(const std::string& mesh, const std::string& format) {
    std::vector<RunFile> files{{mesh, "MESH"}};
    const std::string known = format.empty() && is_folder(mesh) ? "openfoam" : format;  // no other format is a folder
    try {
        for (const fs::path& part : output_files(mesh, {.format = known})) {
            if (part != fs::path(mesh)) files.push_back({part, "MESH"});
            const std::vector<RunFile> inside = files_in(part, "MESH");
            files.insert(files.end(), inside.begin(), inside.end());
        }
    } catch (const UsageError&) {
        // The name tells no format, so reading it fails.
    }
    return files;
}

std::vector<RunFile> files_of_case(const MeshCase& mesh_case) {
    std::vector<RunFile> files;
    for (const std::string& input : mesh_case.inputs) files.push_back({input, "INPUT"});
    if (!mesh_case.case_file.empty()) files.push_back({mesh_case.case_file, "INPUT"});
    if (!mesh_case.background.empty()) {
        const std::vector<RunFile> background = files_of_mesh(mesh_case.background, "");
        files.insert(files.end(), background.begin(), background.end());
    }
    return files;
}

SignalGuard::SignalGuard(std::span<const RunFile> outputs) {
    std::vector<fs::path> paths;
    for (const RunFile& output : outputs) {
        paths.push_back(output.path);
        const std::vector<fs::path> missing = missing_folders(output.path);
        missing_folders_.insert(missing_folders_.end(), missing.rbegin(), missing.rend());
    }
    folders_ = folders_of_temporaries(paths);
    sigemptyset(&signals_);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
        struct sigaction action {};
        sigaction(signal, nullptr, &action);
        if (action.sa_handler != SIG_IGN) sigaddset(&signals_, signal);
    }
    sigaddset(&signals_, signal_of_the_end());
    pthread_sigmask(SIG_BLOCK, &signals_, &mask_before_);
    try {
        thread_ = std::thread([this] { wait_for_signals(); });
    } catch (...) {
        pthread_sigmask(SIG_SETMASK, &mask_before_, nullptr);
        throw;
    }
}

SignalGuard::~SignalGuard() {
    ended_ = true;
    pthread_kill(thread_.native_handle(), signal_of_the_end());
    thread_.join();
    pthread_sigmask(SIG_SETMASK, &mask_before_, nullptr);
}

#ifdef __linux__
namespace {

/// Number of threads that stop_other_threads() has stopped. A handler of signals can reach nothing but globals.
std::atomic<int> stopped_threads = 0;

void stop_this_thread(int) {
    ++stopped_threads;
    for (;;) ::pause();
}

/// Makes all other threads stand still for good. They may hold locks then, so the caller must neither allocate memory
/// afterwards nor do much else.
void stop_other_threads() {
    std::vector<long> others;
    const long own = ::syscall(SYS_gettid);
    std::error_code ignored;
    for (const fs::directory_entry& entry : fs::directory_iterator("/proc/self/task", ignored))
        if (const long thread = std::stol(entry.path().filename().string()); thread != own) others.push_back(thread);
    struct sigaction action {};
    action.sa_handler = stop_this_thread;
    sigaction(SIGRTMIN + 1, &action, nullptr);
    int signalled = 0;
    for (const long thread : others)
        if (::syscall(SYS_tgkill, ::getpid(), thread, SIGRTMIN + 1) == 0) ++signalled;
    // A thread that waits for a disk takes notice later; it creates no file before.
    for (int wait = 0; wait < 100 && stopped_threads < signalled; ++wait)
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
}

}  // namespace
#else
// Elsewhere a file that is created in the last microseconds may stay.
static void stop_other_threads() {}
#endif

bool SignalGuard::remove_temporaries() const {
    bool found = false;
    for (const fs::path& folder : folders_) found = remove_temporaries_in(folder.c_str()) || found;
    return found;
}

void SignalGuard::wait_for_signals() {
    constexpr int max_passes = 1000;
    int signal = 0;
    do {
        if (sigwait(&signals_, &signal) != 0) return;
        if (ended_) return;
    } while (signal == signal_of_the_end());
    // The run goes on meanwhile, and may make one file after another; so the last pass finds nothing.
    for (int more = max_passes; more > 0 && remove_temporaries(); --more) continue;
    std::error_code ignored;
    for (const fs::path& folder : missing_folders_) fs::remove(folder, ignored);  // fails unless it is empty
    // A file that the run has created since the last pass would stay.
    try {
        stop_other_threads();
        remove_temporaries();
    } catch (...) {
        // Where memory is lacking, the passes before have to do.
    }
    if (const pid_t group = group_; group > 0) ::kill(-group, signal);
    // The process ends as if the signal had not been caught, so that shells and scripts see it.
    std::signal(signal, SIG_DFL);
    sigset_t this_signal;  // and no other, such as the one that ends the thread
    sigemptyset(&this_signal);
    sigaddset(&this_signal, signal);
    pthread_sigmask(SIG_UNBLOCK, &this_signal, nullptr);
    std::raise(signal);
}

}  // namespace lamina::app
