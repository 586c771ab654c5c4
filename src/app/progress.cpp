#include "app/progress.hpp"

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>

#include <fmt/core.h>

#include <lamina/error.hpp>

namespace lamina::app {

namespace {

/// The time between two lines about the same stage, and the shortest run, by estimate, whose estimate is printed.
constexpr std::chrono::seconds repeat_after{5};
constexpr double long_run_seconds = 2;

void print_line(const std::string& text) { std::fputs(("lamina: " + text + "\n").c_str(), stderr); }

}  // namespace

ProgressPrinter::ProgressPrinter(ProgressShown shown, bool quiet)
    : prints_stages_(shown == ProgressShown::always ||
                     (shown == ProgressShown::automatic && !quiet && isatty(STDERR_FILENO) != 0)) {
    if (shown == ProgressShown::always || (shown == ProgressShown::automatic && !quiet))
        thread_ = std::thread([this] {
            try {
                repeat();
            } catch (...) {
                // Without memory for a line there are no more lines. The run itself may still succeed.
            }
        });
}

ProgressPrinter::~ProgressPrinter() {
    if (!thread_.joinable()) return;
    {
        const std::lock_guard lock(mutex_);
        ended_ = true;
    }
    ended_changed_.notify_one();
    thread_.join();
}

void ProgressPrinter::begin(const ProgressEvent& event) {
    if (!thread_.joinable()) return;
    const std::lock_guard lock(mutex_);
    stage_ = event.stage;
    if (event.estimate) {
        estimate_ = event.estimate;
        if (estimate_->seconds > long_run_seconds) print_line(estimate_text(*estimate_) + ", by estimate");
    }
    if (prints_stages_) print_line(stage_);
}

void ProgressPrinter::repeat() {
    double seconds = 0;
    std::unique_lock lock(mutex_);
    while (!ended_changed_.wait_for(lock, repeat_after, [this] { return ended_; })) {
        seconds += watch_.lap();
        std::string line = fmt::format("{} ({:.0f} s", stage_, seconds);
        if (estimate_ && estimate_->seconds > seconds) line += fmt::format(" of about {:.0f} s", estimate_->seconds);
        print_line(line + ")");
    }
}

void print_warnings(std::span<const Warning> warnings) {
    for (const Warning& warning : warnings) {
        std::string line = warning.message;
        std::replace(line.begin(), line.end(), '\n', ' ');
        print_line("warning: " + line);
    }
}

void print_warnings_of_reader(const Geometry& geometry) {
    for (const Element& element : geometry.elements)
        for (Warning warning : element.warnings) {
            warning.message = element.name + ": " + warning.message;
            print_warnings({&warning, 1});
        }
}

void require_promised_angles(const MeshCheck& check, const MeshCase& mesh_case) {
    const std::size_t narrow = check.isotropic.unexcused();
    if (mesh_case.allow_defects || !mesh_case.options.lines.empty() || narrow == 0) return;
    throw MeshError(
        fmt::format("{} triangle{} beyond the layer {} an angle below the bound; nothing is written "
                    "(--allow-defects writes the mesh all the same)",
                    narrow, narrow == 1 ? "" : "s", narrow == 1 ? "has" : "have"));
}

void require_no_warnings(std::span<const Warning> warnings, bool strict) {
    if (!strict || warnings.empty()) return;
    throw MeshError(fmt::format("{} warning{} (--strict); the outputs are written", warnings.size(),
                                warnings.size() == 1 ? "" : "s"));
}

}  // namespace lamina::app
