#include "paired.hpp"

#include <algorithm>
#include <ctime>
#include <fstream>

#include <malloc.h>

#include "core/parallel.hpp"

namespace lamina::bench {

double cpu_seconds(const Work& work, std::size_t& made) {
    timespec begin, end;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &begin);
    made = work();
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &end);
    return static_cast<double>(end.tv_sec - begin.tv_sec) + 1e-9 * static_cast<double>(end.tv_nsec - begin.tv_nsec);
}

double median(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

namespace {

/// Returns a field of /proc/self/status in bytes: VmRSS is the memory that is resident now, VmHWM its peak since
/// reset_peak_memory().
double memory(const std::string& field) {
    std::ifstream status("/proc/self/status");
    for (std::string word; status >> word;) {
        if (word != field + ":") continue;
        double kilobytes = 0;
        status >> kilobytes;
        return 1024 * kilobytes;
    }
    return 0;
}

void reset_peak_memory() { std::ofstream("/proc/self/clear_refs") << "5"; }

}  // namespace

void measure(benchmark::State& state, const std::string& made_name, const Work& ours,
             const std::vector<Reference>& references) {
    std::vector<double> our_seconds;
    std::vector<std::vector<double>> seconds(references.size());
    std::vector<std::size_t> made(references.size());
    std::size_t our_made = 0;
    double bytes = 0;
    for (auto _ : state) {
        const bool first = our_seconds.empty();
        if (first) malloc_trim(0);  // or the call would get memory that earlier ones have freed, which does not count
        const double resident = memory("VmRSS");
        if (first) reset_peak_memory();
        with_threads(1, [&] { our_seconds.push_back(cpu_seconds(ours, our_made)); });
        if (first) bytes = memory("VmHWM") - resident;
        state.SetIterationTime(our_seconds.back());
        for (std::size_t r = 0; r < references.size(); ++r)
            seconds[r].push_back(cpu_seconds(references[r].work, made[r]));
    }
    const double our_median = median(our_seconds), count = static_cast<double>(our_made);
    state.counters[made_name] = count;
    state.counters[made_name + "/s"] = count / our_median;
    state.counters["median_s"] = our_median;
    state.counters["bytes_each"] = bytes / count;
    for (std::size_t r = 0; r < references.size(); ++r) {
        state.counters["ratio_to_" + references[r].name] = median(seconds[r]) / our_median;
    }
    if (!references.empty()) state.counters[made_name + "_ratio"] = count / static_cast<double>(made[0]);
}

}  // namespace lamina::bench
