#include "pipeline/stage_clock.hpp"

#include <chrono>
#include <utility>

namespace lamina::pipeline {

namespace {

double seconds_now() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace

StageClock::StageClock(const Progress& progress) : progress_(progress), start_(seconds_now()), last_(start_) {}

void StageClock::begin(const std::string& stage, const std::optional<RunEstimate>& estimate) {
    const bool tells = estimate && !std::exchange(estimate_told_, estimate_told_ || estimate.has_value());
    if (progress_) progress_({stage, tells ? estimate : std::nullopt});
}

void StageClock::end(double StageSeconds::*stage) { seconds_.*stage += lap(); }

std::vector<ThreadSeconds> StageClock::end_shared(const core::BusyTimes& times) {
    const double elapsed = lap();
    std::vector<ThreadSeconds> threads;
    ThreadSeconds sum;
    for (std::size_t i = 0; i < times.threads(); ++i) {
        const ThreadSeconds thread{times.seconds(i, decomposition_work), times.seconds(i, layer_work),
                                   times.seconds(i, refinement_work), times.seconds(i, check_work),
                                   times.idle(i, elapsed)};
        sum.decomposition += thread.decomposition;
        sum.layer_triangulation += thread.layer_triangulation;
        sum.refinement += thread.refinement;
        sum.check += thread.check;
        threads.push_back(thread);
    }
    const double all = sum.decomposition + sum.layer_triangulation + sum.refinement + sum.check;
    const double share = all > 0 ? elapsed / all : 0;
    seconds_.decomposition += share * sum.decomposition;
    seconds_.layer_triangulation += share * sum.layer_triangulation;
    seconds_.refinement += share * sum.refinement;
    seconds_.check += share * sum.check;
    return threads;
}

StageSeconds StageClock::seconds() const {
    StageSeconds result = seconds_;
    result.total = seconds_now() - start_;
    return result;
}

double StageClock::lap() {
    const double now = seconds_now();
    return now - std::exchange(last_, now);
}

}  // namespace lamina::pipeline
