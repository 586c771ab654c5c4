// What the processes of lamina-mpi do by themselves and what they divide among themselves, for tools/scaling.py.
//
//     lamina_measure_ranks GRADATION RANKS... > ranks.json
//     lamina_measure_ranks --until-pieces GRADATION RANKS...
//
// Threads stand in for processes, and each counts its own processor time. A thread that waits takes none, so the numbers
// hold for any number of ranks on any number of cores. Between two collective functions all wait for the busiest: the sum
// of its times is what a stage takes with the waiting, too. --until-pieces ends before pieces are made, so that many ranks
// can be measured with large meshes.
#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <string>
#include <string_view>
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

/// A part of the work of a rank: from the begin of a stage, or from a collective function, to the next one.
struct Phase {
    std::size_t stage = 0;
    double seconds = 0;  ///< of processor time
};

/// A rank that counts its processor time.
class TimedRanks : public test::ThreadRanks {
public:
    using ThreadRanks::ThreadRanks;

    void begin(const std::string& stage) {
        stages.push_back(stage);
        begin_phase();
    }
    void end() {
        if (!phases.empty()) phases.back().seconds += processor_seconds() - since_;
    }
    std::vector<std::string> stages;
    std::vector<Phase> phases;

protected:
    /// Every collective function begins with this question.
    unsigned lowest_failed(bool failed) override {
        if (!stages.empty()) begin_phase();
        return ThreadRanks::lowest_failed(failed);
    }

private:
    double since_ = 0;

    void begin_phase() {
        end();
        phases.push_back({stages.size() - 1});
        since_ = processor_seconds();
    }
};

/// What the ranks of a run have done.
struct MeasuredRun {
    std::vector<std::string> stages;
    std::vector<std::vector<Phase>> of_ranks;
    std::size_t messages = 0, bytes = 0, triangles = 0, pieces = 0;
    std::string hash;
};

/// Returns the processor time of each stage: of each rank, then of the busiest rank between each two collective
/// functions.
std::string stages_json(const MeasuredRun& run) {
    std::vector<std::string> rows;
    std::vector<Phase> busiest = run.of_ranks.front();
    const auto row_of = [&](const std::vector<Phase>& phases) {
        std::vector<double> seconds(run.stages.size(), 0);
        for (const Phase& phase : phases) seconds[phase.stage] += phase.seconds;
        std::vector<std::string> entries;
        for (std::size_t i = 0; i < seconds.size(); ++i)
            entries.push_back(fmt::format("[\"{}\", {:.6f}]", run.stages[i], seconds[i]));
        return fmt::format("[{}]", fmt::join(entries, ", "));
    };
    for (const std::vector<Phase>& phases : run.of_ranks) {
        rows.push_back(row_of(phases));
        for (std::size_t i = 0; i < busiest.size(); ++i)
            busiest[i].seconds = std::max(busiest[i].seconds, phases.at(i).seconds);
    }
    return fmt::format("\"stages\": [{}],\n  \"with_waiting\": {}", fmt::join(rows, ",\n             "),
                       row_of(busiest));
}

/// Thrown where a run is not to be finished.
struct Enough {};

/// Makes the mesh on so many ranks, and returns what they did.
std::string measured(unsigned n, const CaseOptions& options, bool until_pieces) {
    MeasuredRun run;
    run.of_ranks.resize(n);
    std::vector<RankTraffic> traffic(n);
    const std::string failure = test::run_ranks<TimedRanks>(n, [&](TimedRanks& ranks) {
        const auto note = [&](const ProgressEvent& event) {
            if (until_pieces && event.stage.find("refinement") != std::string::npos) throw Enough();
            ranks.begin(event.stage);
            if (event.estimate && ranks.rank() == 0)
                run.triangles = static_cast<std::size_t>(event.estimate->triangles);
        };
        const auto finish = [&] {
            ranks.end();
            traffic[ranks.rank()] = ranks.traffic();
            run.of_ranks[ranks.rank()] = ranks.phases;
            if (ranks.rank() == 0) run.stages = ranks.stages;
        };
        try {
            const SharedMesh mesh = share_mesh({"naca:0012"}, options, ranks, {}, note);
            finish();
            if (ranks.rank() != 0) return;
            run.triangles = mesh.counts.triangles;
            run.pieces = mesh.result.inviscid_pieces;
            run.hash = mesh.hash;
        } catch (const Enough&) {
            finish();
        }
    });
    if (!failure.empty()) {
        std::fprintf(stderr, "%s\n", failure.c_str());
        std::exit(1);
    }
    for (const RankTraffic& of_rank : traffic) {
        run.messages += of_rank.messages;
        run.bytes += of_rank.bytes;
    }
    return fmt::format(
        "{{\"ranks\": {}, \"triangles\": {}, \"pieces\": {}, \"hash\": \"{}\", \"messages\": {}, \"bytes\": {},\n  "
        "{}}}",
        n, run.triangles, run.pieces, run.hash, run.messages, run.bytes, stages_json(run));
}

}  // namespace
}  // namespace lamina::bench

int main(int argc, char** argv) {
    const bool until_pieces = argc > 1 && std::string_view(argv[1]) == "--until-pieces";
    const int first = until_pieces ? 2 : 1;
    if (argc < first + 2) {
        std::fprintf(stderr, "usage: lamina_measure_ranks [--until-pieces] GRADATION RANKS...\n");
        return 2;
    }
    const lamina::CaseOptions options = lamina::bench::thesis_case(std::strtod(argv[first], nullptr));
    std::vector<std::string> runs;
    // The first run asks the system for its memory, which counts where one rank is to be compared with.
    if (!until_pieces && std::atoi(argv[first + 1]) == 1) lamina::bench::measured(1, options, false);
    for (int i = first + 1; i < argc; ++i)
        runs.push_back(lamina::bench::measured(static_cast<unsigned>(std::atoi(argv[i])), options, until_pieces));
    std::printf("[%s]\n", fmt::format("{}", fmt::join(runs, ",\n ")).c_str());
    return 0;
}
