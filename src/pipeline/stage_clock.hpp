// Announces the stages of a run and measures their times.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <lamina/pipeline.hpp>

#include "core/busy_times.hpp"
#include "delaunay/pieces/sorted_points.hpp"

namespace lamina::pipeline {

/// Kinds of work that share the threads: those of delaunay::pieces in the layer, the refinement of subdomains, and the
/// check of each.
enum SharedWork : std::size_t {
    decomposition_work = delaunay::pieces::cutting,
    layer_work = delaunay::pieces::triangulating,
    refinement_work,
    check_work
};

class StageClock {
public:
    /// The function of the progress must outlive this object.
    explicit StageClock(const Progress& progress);

    /// Announces a stage. The estimate is announced once, with the first stage that has it.
    void begin(const std::string& stage, const std::optional<RunEstimate>& estimate = {});
    /// Adds the time since the last end to that of a stage.
    void end(double StageSeconds::*stage);
    /// Ends stages that have shared the threads: their common time is divided among them in proportion to the time of
    /// the threads. Returns the seconds of each thread.
    std::vector<ThreadSeconds> end_shared(const core::BusyTimes& times);
    /// Returns the times so far.
    StageSeconds seconds() const;

private:
    const Progress& progress_;
    double start_, last_;
    bool estimate_told_ = false;
    StageSeconds seconds_;

    double lap();
};

}  // namespace lamina::pipeline
