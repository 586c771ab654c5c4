// Measurements in pairs: our work and the reference's alternate in one run, so that the load of the machine falls on
// both, and ratios of medians are given as counters.
#pragma once

#include <string>
#include <vector>

#include <benchmark/benchmark.h>

#include "references.hpp"

namespace lamina::bench {

struct Reference {
    std::string name;
    Work work;
};

/// Seconds of processor time, of all threads: unlike those of the wall clock they do not grow with other programs'
/// demands.
double cpu_seconds(const Work& work, std::size_t& made);

double median(std::vector<double> values);

/// Runs `ours` (on one thread) and the references in turn, once per iteration. Manual time is ours, in CPU seconds.
/// Counters: `made` = what ours returned, also a second; `ratio_to_X` = X's median time over ours; `made`_ratio = what
/// ours made over what the first reference made; `bytes_each` = peak memory of the first call over what it made.
void measure(benchmark::State& state, const std::string& made, const Work& ours,
             const std::vector<Reference>& references);

}  // namespace lamina::bench
