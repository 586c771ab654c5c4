// The files of one run of the program: no output replaces an input or another output, and nothing temporary stays
// behind when a signal ends the run.
#pragma once

#include <atomic>
#include <csignal>
#include <filesystem>
#include <span>
#include <string>
#include <thread>
#include <vector>

#include <lamina/io.hpp>

#include "app/case.hpp"

namespace lamina::app {

/// A file that a run reads or writes.
struct RunFile {
    std::filesystem::path path;
    std::string role;  ///< the words of the command line that name it: "option --report"
};

/// Returns the absolute path of a file without links and dots, as far as it exists.
std::filesystem::path path_behind_links(const std::filesystem::path& path);

/// Throws UsageError where an output would replace an input or another output, under whatever name: links are followed.
/// Folders are replaced with all that is in them. Devices and pipes may be named several times; "-", which stands for
/// standard input and standard output, may stand for one output.
void require_distinct(std::span<const RunFile> inputs, std::span<const RunFile> outputs);

/// Throws UsageError where the file is standard input or output and no format is given; `option` would give it.
void require_format(const std::string& file, const std::string& format, const std::string& option);

/// Throws UsageError where parts are asked for that none of these mesh files has.
void require_parts_taken(std::span<const std::string> files, const WriteOptions& options);

/// Returns the files that write_mesh() makes of the option --output.
std::vector<RunFile> files_of_output(const std::string& output, const WriteOptions& options);

/// Returns the files in a folder; none where it is no folder.
std::vector<RunFile> files_in(const std::filesystem::path& folder, const std::string& role);

/// Returns the files of a mesh that is read: those that its format consists of. The format is the one of this name or,
/// if that is empty, the one that the name of the mesh tells.
std::vector<RunFile> files_of_mesh(const std::string& mesh, const std::string& format);

/// Returns the files that a run reads: its inputs, the case file that names them, and the background mesh.
std::vector<RunFile> files_of_case(const MeshCase& mesh_case);

/// While it lives, the signals INT, TERM and HUP remove the temporary files of the outputs, and the folders that were
/// created for them and are still empty, before they end the process.
/// Threads must be started after it, so that they leave the signals to it. A signal that is ignored stays ignored.
class SignalGuard {
public:
    explicit SignalGuard(std::span<const RunFile> outputs);
    ~SignalGuard();
    SignalGuard(const SignalGuard&) = delete;
    SignalGuard& operator=(const SignalGuard&) = delete;

    /// From now on the signals go to this group of processes as well, before they end this one; 0: to none.
    void take_along(pid_t group) { group_ = group; }

private:
    std::vector<std::filesystem::path> folders_;          ///< those of temporary files
    std::vector<std::filesystem::path> missing_folders_;  ///< folders above the outputs, inner ones before outer ones
    sigset_t signals_;                                    ///< those that the thread waits for
    sigset_t mask_before_;                                ///< those that were blocked before
    std::atomic<bool> ended_ = false;
    std::atomic<pid_t> group_ = 0;  ///< of the processes that get the signals, too
    std::thread thread_;

    void wait_for_signals();
    bool remove_temporaries() const;
};

}  // namespace lamina::app
