// Measurements beside references: our work and that of the references alternate in one run, so that the load of the
// machine falls on all of them. Ratios of medians are given as counters.
#pragma once

#include <string>
#include <vector>

#include <benchmark/benchmark.h>

#include "references.hpp"

namespace lamina::bench {

/// Another program that does the same work.
struct Reference {
    std::string name;
    Work work;
};

/// Runs the work and returns the processor time of all threads, in seconds. Unlike wall-clock time it does not grow
/// with the demands of other programs. `made` receives the result of the work.
double cpu_seconds(const Work& work, std::size_t& made);

double median(std::vector<double> values);

/// Runs `ours`, on one thread, and the references in turn, once per iteration. Manual time is ours, in CPU seconds.
/// `made_name` names the things that the work makes, MADE below. The counters are
///
///     MADE, MADE/s    how many of them ours makes, and how many in a second
///     median_s        our median time in seconds
///     bytes_each      peak memory of our first call for each of them
///     ratio_to_X      median time of reference X over ours
///     MADE_ratio      how many ours makes for each one that the first reference makes
void measure(benchmark::State& state, const std::string& made_name, const Work& ours,
             const std::vector<Reference>& references);

}  // namespace lamina::bench
