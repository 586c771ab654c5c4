// The lines of a run on standard error: progress and warnings.
#pragma once

#include <condition_variable>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <thread>

#include <lamina/limits.hpp>
#include <lamina/pipeline.hpp>
#include <lamina/warning.hpp>

#include "app/case.hpp"
#include "app/stopwatch.hpp"

namespace lamina::app {

/// Prints the stages of a run on standard error: each when it begins, where that is wanted, and the one that goes on
/// every few seconds. Prints the estimate of runs that are expected to be long. It must be made after the SignalGuard
/// of the run, since it starts a thread.
class ProgressPrinter {
public:
    /// `shown`: as the user asks for it; `quiet`: nothing is printed.
    ProgressPrinter(ProgressShown shown, bool quiet);
    ~ProgressPrinter();
    ProgressPrinter(const ProgressPrinter&) = delete;
    ProgressPrinter& operator=(const ProgressPrinter&) = delete;

    /// Notes that a stage begins. Any thread may call it.
    void begin(const ProgressEvent& event);

private:
    const bool prints_stages_;
    std::mutex mutex_;  ///< guards all below
    std::condition_variable ended_changed_;
    bool ended_ = false;
    std::string stage_;
    std::optional<RunEstimate> estimate_;
    Stopwatch watch_;
    std::thread thread_;

    void repeat();
};

/// Prints each warning as one line on standard error.
void print_warnings(std::span<const Warning> warnings);

/// Prints what the reader warned of, for commands that make no mesh.
void print_warnings_of_reader(const Geometry& geometry);

/// Throws MeshError where isotropic triangles have an angle below the bound that no sharp corner excuses, unless the
/// case allows defects or has lines inside the domain, beside which no angle is promised.
void require_promised_angles(const MeshCheck& check, const MeshCase& mesh_case);

/// Throws MeshError where there are warnings and `strict` asks for none.
void require_no_warnings(std::span<const Warning> warnings, bool strict);

}  // namespace lamina::app
