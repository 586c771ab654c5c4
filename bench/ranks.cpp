// What the processes of lamina-mpi do by themselves and what they divide among themselves, for tools/scaling.py.
//
//     lamina_measure_ranks GRADATION RANKS... > ranks.json
//
// Threads stand in for processes, and each counts its own processor time. A thread that waits takes none, so the numbers
// hold for any number of ranks on any number of cores.
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <lamina/shared_mesh.hpp>

#include "support/thread_ranks.hpp"
#include "thesis_case.hpp"

namespace lamina::bench {
namespace {

/// Returns the processor time of the calling thread.
double processor_seconds() {
    std::timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// The processor time of one rank in each stage, in their order.
class StageTimes {
public:
    void begin(const std::string& stage) {
        end();
        times_.emplace_back(stage, 0.0);
        since_ = processor_seconds();
    }
    void end() {
        if (!times_.empty()) times_.back().second += processor_seconds() - since_;
    }
    std::string json() const {
        std::vector<std::string> entries;
        for (const auto& [stage, seconds] : times_) entries.push_back(fmt::format("[\"{}\", {:.6f}]", stage, seconds));
        return fmt::format("[{}]", fmt::join(entries, ", "));
    }

private:
    std::vector<std::pair<std::string, double>> times_;
    double since_ = 0;
};

/// Makes the mesh on so many ranks, and returns what they did.
std::string measured(unsigned n, const CaseOptions& options) {
    std::vector<StageTimes> times(n);
    std::vector<RankTraffic> traffic(n);
    std::size_t triangles = 0, pieces = 0;
    std::string hash;
    const std::string failure = test::run_ranks(n, [&](Ranks& ranks) {
        StageTimes& own = times[ranks.rank()];
        const SharedMesh mesh =
            share_mesh({"naca:0012"}, options, ranks, {}, [&](const ProgressEvent& event) { own.begin(event.stage); });
        own.end();
        traffic[ranks.rank()] = ranks.traffic();
        if (ranks.rank() != 0) return;
        triangles = mesh.counts.triangles;
        pieces = mesh.result.inviscid_pieces;
        hash = mesh.hash;
    });
    if (!failure.empty()) {
        std::fprintf(stderr, "%s\n", failure.c_str());
        std::exit(1);
    }
    std::size_t messages = 0, bytes = 0;
    std::vector<std::string> of_ranks;
    for (unsigned rank = 0; rank < n; ++rank) {
        messages += traffic[rank].messages;
        bytes += traffic[rank].bytes;
        of_ranks.push_back(times[rank].json());
    }
    return fmt::format(
        "{{\"ranks\": {}, \"triangles\": {}, \"pieces\": {}, \"hash\": \"{}\", \"messages\": {}, \"bytes\": {},\n"
        "  \"stages\": [{}]}}",
        n, triangles, pieces, hash, messages, bytes, fmt::join(of_ranks, ",\n             "));
}

}  // namespace
}  // namespace lamina::bench

int main(int argc, char** argv) {
    if (argc < 3) {
        std::fprintf(stderr, "usage: lamina_measure_ranks GRADATION RANKS...\n");
        return 2;
    }
    const lamina::CaseOptions options = lamina::bench::thesis_case(std::strtod(argv[1], nullptr));
    std::vector<std::string> runs;
    lamina::bench::measured(1, options);  // the first run asks the system for its memory
    for (int i = 2; i < argc; ++i)
        runs.push_back(lamina::bench::measured(static_cast<unsigned>(std::atoi(argv[i])), options));
    std::printf("[%s]\n", fmt::format("{}", fmt::join(runs, ",\n ")).c_str());
    return 0;
}
