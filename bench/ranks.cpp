// A run of lamina-mpi on many ranks, with real work and simulated time, for tools/scaling.py.
//
//     lamina_measure_ranks GRADATION RANKS... > ranks.json
//     lamina_measure_ranks --until-pieces GRADATION RANKS...
//     lamina_measure_ranks --forget GRADATION RANKS...
//
// Threads stand in for processes. Each has a clock of its own, which runs while the thread has a processor, and jumps
// to that of another rank where it has waited for this one. One thread works at a time, until it waits, and then the
// one whose clock is the furthest behind: so pieces are taken in the order in which ranks would ask for them, and no
// rank finds its caches emptied and its memory locked by others in the midst of its work. What a machine with a
// processor for each rank would take is what the clocks say, however busy this one is. Messages take no time.
// --until-pieces ends before pieces are made. --forget keeps no pieces, so that the memory limits no mesh: they go to a
// file, as with --stream, to which nothing is written.
#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <deque>
#include <mutex>
#include <semaphore>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <unistd.h>

#ifdef __GLIBC__
#include <malloc.h>
#endif

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <lamina/stream.hpp>

#include "app/kept_memory.hpp"
#include "core/packing.hpp"
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

/// What the ranks of a simulation share: whose turn it is, and the clocks that they tell each other.
class Turns {
public:
    explicit Turns(unsigned ranks) : told_{std::vector<double>(ranks), std::vector<double>(ranks)} {
        for (unsigned rank = 0; rank < ranks; ++rank) may_go_.emplace_back(0);
    }

    /// Returns once no other rank works, and none with an earlier clock waits for its turn.
    void take(unsigned rank, double clock) {
        {
            const std::lock_guard lock(mutex_);
            waiting_.emplace(clock, rank);
            let_go();
        }
        may_go_[rank].acquire();
    }
    void give() {
        const std::lock_guard lock(mutex_);
        busy_ = false;
        let_go();
    }

    /// The clocks at one of two successive meetings of all ranks.
    std::vector<double>& clocks(std::size_t meeting) { return told_[meeting % 2]; }

private:
    std::mutex mutex_;
    bool busy_ = false;
    std::set<std::pair<double, unsigned>> waiting_;
    std::deque<std::binary_semaphore> may_go_;
    std::vector<double> told_[2];

    void let_go() {
        if (busy_ || waiting_.empty()) return;
        busy_ = true;
        may_go_[waiting_.begin()->second].release();
        waiting_.erase(waiting_.begin());
    }
};

/// A part of the work of a rank: from the begin of a stage, or from a meeting of all ranks, to the next one.
struct Phase {
    std::size_t stage = 0;
    double begin = 0;    ///< the clock then
    double seconds = 0;  ///< of work
    double pieces = 0;   ///< of this, from when the rank may make its first piece until it is told of all cuts
    double end = 0;      ///< the clock then
    double sent = 0;     ///< the clock when it has last told one rank something
};

/// A rank of a simulation.
class TimedRanks : public test::ThreadRanks {
public:
    TimedRanks(unsigned rank, test::RankHub& hub) : ThreadRanks(rank, hub) { begin_turn(); }
    ~TimedRanks() override { end_turn(); }

    static inline Turns* turns = nullptr;  ///< those of all ranks

    void begin(const std::string& stage) {
        stages.push_back(stage);
        begin_phase();
    }
    /// Ends the last phase.
    void end() {
        advance();
        if (phases.empty()) return;
        phases.back().seconds = worked_ - worked_before_phase_;
        phases.back().end = clock_;
    }
    std::vector<std::string> stages;
    std::vector<Phase> phases;

protected:
    /// Every collective function begins with this question.
    unsigned lowest_failed(bool failed) override {
        end();
        std::vector<double>& clocks = turns->clocks(meetings_++);
        clocks[rank()] = clock_;
        const unsigned lowest = ThreadRanks::lowest_failed(failed);
        clock_ = *std::max_element(clocks.begin(), clocks.end());
        if (!stages.empty()) begin_phase();
        return lowest;
    }
    void wait() override {
        end_turn();
        ThreadRanks::wait();
        begin_turn();
    }
    void do_send(unsigned to, std::string_view bytes) override {
        advance();
        if (!phases.empty()) phases.back().sent = clock_;
        core::Packer packer;
        packer.put(clock_);
        packer.put_text(bytes);
        ThreadRanks::do_send(to, packer.take());
    }
    /// Who makes pieces asks this between them.
    bool do_has_bytes(unsigned from) override {
        end_turn();
        if (!std::exchange(makes_pieces_, true)) worked_before_pieces_ = worked_;
        begin_turn();
        return was_sent(from);
    }
    std::string do_receive(unsigned from) override {
        advance();
        if (std::exchange(makes_pieces_, false)) phases.back().pieces += worked_ - worked_before_pieces_;
        const bool waits = !was_sent(from);
        if (waits) end_turn();
        const std::string packed = ThreadRanks::do_receive(from);
        core::Unpacker unpacker(packed);
        clock_ = std::max(clock_, unpacker.get<double>());
        if (waits) begin_turn();
        return unpacker.get_text();
    }
    std::uint64_t do_add_to_counter(std::uint64_t number) override {
        // Whoever makes pieces of its own asks only whether another rank has failed. It goes on with warm caches, as a
        // process that has a processor for itself.
        if (number == 0) return ThreadRanks::do_add_to_counter(0);
        end_turn();
        begin_turn();
        return ThreadRanks::do_add_to_counter(number);
    }

private:
    double clock_ = 0, worked_ = 0, worked_before_phase_ = 0, worked_before_pieces_ = 0;
    bool makes_pieces_ = false;
    double since_ = 0;  ///< processor time when worked_ was counted
    std::size_t meetings_ = 0;

    /// Returns whether bytes of a rank are there that it has sent by now.
    bool was_sent(unsigned from) {
        return has_bytes(from, [&](std::string_view packed) { return core::Unpacker(packed).get<double>() <= clock_; });
    }
    /// Counts the work since the last call.
    void advance() {
        const double now = processor_seconds();
        const double seconds = now - std::exchange(since_, now);
        clock_ += seconds;
        worked_ += seconds;
    }
    void begin_turn() {
        turns->take(rank(), clock_);
        since_ = processor_seconds();
    }
    void end_turn() {
        advance();
        turns->give();
    }
    void begin_phase() {
        end();
        phases.push_back({stages.size() - 1, clock_});
        worked_before_phase_ = worked_;
    }
};

/// What the ranks of a run have done.
struct MeasuredRun {
    std::vector<std::string> stages;
    std::vector<std::vector<Phase>> of_ranks;
    std::size_t messages = 0, bytes = 0, triangles = 0, pieces = 0;
    std::string hash;
};

/// Returns the seconds of each stage, by name.
std::string by_stage(const MeasuredRun& run, const std::vector<double>& seconds) {
    std::vector<std::string> entries;
    for (std::size_t i = 0; i < seconds.size(); ++i)
        entries.push_back(fmt::format("[\"{}\", {:.6f}]", run.stages[i], seconds[i]));
    return fmt::format("[{}]", fmt::join(entries, ", "));
}

/// Returns the phase in which the regions round the bodies are cut, as it is on rank 0, with the pieces that all ranks
/// make meanwhile.
Phase cuts_of(const MeasuredRun& run) {
    for (std::size_t i = 0; i < run.of_ranks.front().size(); ++i) {
        Phase cuts = run.of_ranks.front()[i];
        if (run.stages[cuts.stage] != "decoupling" || cuts.sent == 0) continue;
        for (const std::vector<Phase>& of_rank : run.of_ranks) cuts.pieces += of_rank.at(i).pieces;
        return cuts;
    }
    return {};
}

/// Returns the work of each stage: of each rank; then the time of the stages with the waiting, from when the last rank
/// has begun with it to when the last one has ended; then of each phase its stage, the mean work, the most work, whose
/// that is, and this time; then the pieces that all ranks make during the cuts round the bodies, and for how long these
/// last.
std::string stages_json(const MeasuredRun& run) {
    std::vector<std::string> rows, phases;
    for (const std::vector<Phase>& of_rank : run.of_ranks) {
        std::vector<double> seconds(run.stages.size(), 0);
        for (const Phase& phase : of_rank) seconds[phase.stage] += phase.seconds;
        rows.push_back(by_stage(run, seconds));
    }
    std::vector<double> with_waiting(run.stages.size(), 0);
    double last_end = 0;
    for (std::size_t i = 0; i < run.of_ranks.front().size(); ++i) {
        double sum = 0, most = 0, end = 0;
        std::size_t busiest = 0;
        for (std::size_t rank = 0; rank < run.of_ranks.size(); ++rank) {
            const Phase& phase = run.of_ranks[rank].at(i);
            sum += phase.seconds;
            end = std::max(end, phase.end);
            if (phase.seconds <= most) continue;
            most = phase.seconds;
            busiest = rank;
        }
        const std::size_t stage = run.of_ranks.front()[i].stage;
        with_waiting[stage] += end - last_end;
        phases.push_back(fmt::format("[{}, {:.6f}, {:.6f}, {}, {:.6f}]", stage,
                                     sum / static_cast<double>(run.of_ranks.size()), most, busiest, end - last_end));
        last_end = end;
    }
    const Phase cuts = cuts_of(run);
    return fmt::format(
        "\"stages\": [{}],\n  \"with_waiting\": {},\n  \"phases\": [{}],\n  "
        "\"pieces_during_cuts\": {:.6f}, \"cuts\": {:.6f}",
        fmt::join(rows, ",\n             "), by_stage(run, with_waiting), fmt::join(phases, ", "), cuts.pieces,
        cuts.sent - cuts.begin);
}

/// Thrown where a run is not to be finished.
struct Enough {};

/// Makes the mesh on so many ranks, and returns what they did.
std::string measured(unsigned n, const CaseOptions& options, bool until_pieces, bool forget) {
    MeasuredRun run;
    run.of_ranks.resize(n);
    std::vector<RankTraffic> traffic(n);
    Turns turns(n);
    TimedRanks::turns = &turns;
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
            const auto beside = forget ? std::optional<std::filesystem::path>("forgotten") : std::nullopt;
            const SharedMesh mesh = share_mesh({"naca:0012"}, options, ranks, beside, note);
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

/// Gives each rank freed memory of its own, as the processes of lamina-mpi have. By default 16 and more threads share
/// what they have freed.
void keep_memory_as_processes() {
    app::keep_freed_memory();
#ifdef __GLIBC__
    mallopt(M_ARENA_MAX, 4096);
#endif
}

}  // namespace
}  // namespace lamina::bench

/// Writes nothing, in place of the function of the system: see --forget.
extern "C" ssize_t pwrite(int, const void*, std::size_t bytes, off_t) { return static_cast<ssize_t>(bytes); }
extern "C" ssize_t pwrite64(int, const void*, std::size_t bytes, off64_t) { return static_cast<ssize_t>(bytes); }

int main(int argc, char** argv) {
    const std::string_view option = argc > 1 ? argv[1] : "";
    const bool until_pieces = option == "--until-pieces", forget = option == "--forget";
    const int first = until_pieces || forget ? 2 : 1;
    if (argc < first + 2) {
        std::fprintf(stderr, "usage: lamina_measure_ranks [--until-pieces|--forget] GRADATION RANKS...\n");
        return 2;
    }
    lamina::bench::keep_memory_as_processes();
    lamina::CaseOptions options = lamina::bench::thesis_case(std::strtod(argv[first], nullptr));
    options.limits.max_triangles = 4'000'000'000;
    std::vector<std::string> runs;
    // The first run asks the system for its memory, which counts where one rank is to be compared with, unless little
    // is kept of the mesh.
    if (!until_pieces && !forget && std::atoi(argv[first + 1]) == 1) lamina::bench::measured(1, options, false, forget);
    for (int i = first + 1; i < argc; ++i)
        runs.push_back(
            lamina::bench::measured(static_cast<unsigned>(std::atoi(argv[i])), options, until_pieces, forget));
    std::printf("[%s]\n", fmt::format("{}", fmt::join(runs, ",\n ")).c_str());
    return 0;
}
