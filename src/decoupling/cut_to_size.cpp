// Recursive bisection, level by level: the search for separators, which takes the time, runs on all subdomains of a
// level at once. Then they are cut in order, so that the numbers of new vertices do not depend on threads.
#include "decoupling/cut_to_size.hpp"

#include <algorithm>
#include <atomic>
#include <cassert>
#include <deque>
#include <exception>
#include <iterator>
#include <span>
#include <string>
#include <utility>

#include <lamina/threads.hpp>

#include "core/packing.hpp"
#include "core/parallel.hpp"
#include "decoupling/separator_search.hpp"
#include "decoupling/shared_search.hpp"

namespace lamina::decoupling {

namespace {

using core::Packer;
using core::Unpacker;

/// The regions without holes, in their order. Most are trapezoids, whose borders are made where they are needed.
class SimpleRegions {
public:
    /// Takes them away from the regions.
    explicit SimpleRegions(UncutRegions& regions) : rings_(std::move(regions.rings)) {
        const auto rest = std::stable_partition(regions.borders.begin(), regions.borders.end(),
                                                [](const LineBorder& border) { return border.loops.size() > 1; });
        given_.assign(std::make_move_iterator(rest), std::make_move_iterator(regions.borders.end()));
        regions.borders.erase(rest, regions.borders.end());
    }
    SimpleRegions() = default;

    std::size_t size() const { return given_.size() + rings_.size(); }
    LineBorder border(std::size_t i, const Lines& lines) const {
        return i < given_.size() ? given_[i] : rings_.border(i - given_.size(), lines);
    }
    std::size_t vertices(std::size_t i, const Lines& lines) const {
        return i < given_.size() ? given_[i].vertices() : rings_.vertices(i - given_.size(), lines);
    }
    /// Returns the number of the trapezoid that a region is.
    std::uint32_t trapezoid(std::size_t i) const {
        return i < given_.size() ? EstimatedBorder::no_trapezoid : static_cast<std::uint32_t>(i - given_.size());
    }
    /// Returns the border of a region that stays whole.
    EstimatedBorder whole(std::size_t i) const {
        EstimatedBorder whole;
        if (i < given_.size())
            whole.border = std::make_unique<LineBorder>(given_[i]);
        else
            whole.trapezoid = trapezoid(i);
        return whole;
    }

private:
    std::vector<LineBorder> given_;
    RingRegions rings_;
};

/// A border that is still to be searched.
struct Part {
    LineBorder border;
    unsigned process = any_process;  ///< that should search it, since it has divided the most of its lines
};

/// Cuts borders in two, and their parts again.
class Bisection {
public:
    Bisection(const SizeField& size, double pieces_target) : size_(size), pieces_target_(pieces_target) {}

    /// Searches separators for all borders. May run at the same time as the other functions.
    std::vector<SearchResult> search(Lines& lines, std::span<const Part> parts) const {
        return core::parallel_blocks(parts.size(), 1, [&](std::size_t i, std::size_t) {
            return search_separator(localize(parts[i].border, lines, size_), size_, pieces_target_);
        });
    }
    std::vector<SearchResult> search(Lines& lines, const SimpleRegions& regions) const {
        return core::parallel_blocks(regions.size(), 1, [&](std::size_t i, std::size_t) {
            return search_separator(localize(regions.border(i, lines), lines, size_), size_, pieces_target_);
        });
    }

    /// Cuts the borders for which a separator was found, and returns their parts. The other borders are done.
    std::vector<Part> cut(Lines& lines, std::vector<Part> whole, std::span<SearchResult> results) {
        std::vector<Part> parts;
        for (std::size_t i = 0; i < whole.size(); ++i)
            if (results[i].separator)
                cut_in_two(lines, whole[i].border, results[i], parts);
            else
                add_done({.border = std::make_unique<LineBorder>(std::move(whole[i].border))}, results[i]);
        return parts;
    }
    std::vector<Part> cut(Lines& lines, const SimpleRegions& regions, std::span<SearchResult> results) {
        std::vector<Part> parts;
        for (std::size_t i = 0; i < regions.size(); ++i)
            if (results[i].separator)
                cut_in_two(lines, regions.border(i, lines), results[i], parts);
            else
                add_done(regions.whole(i), results[i]);
        return parts;
    }

    /// Cuts the borders and their parts until all are done.
    void cut_all(Lines& lines, std::vector<Part> parts) {
        while (!parts.empty()) {
            std::vector<SearchResult> results = search(lines, parts);
            parts = cut(lines, std::move(parts), results);
        }
    }

    /// Adds a border that stays whole, and returns it.
    EstimatedBorder& add_done(EstimatedBorder&& border) { return done_.emplace_back(std::move(border)); }
    void add_done(EstimatedBorder&& border, const SearchResult& result) {
        EstimatedBorder& done = add_done(std::move(border));
        done.work = static_cast<float>(result.work);
        if (result.estimate) done.estimate = std::make_unique<WorkEstimate>(*result.estimate);
        done.process = result.process;
    }
    void expect_done(std::size_t more) { done_.reserve(done_.size() + more); }
    std::vector<EstimatedBorder> take_done() { return std::move(done_); }

    static void cut_in_two(Lines& lines, const LineBorder& border, SearchResult& result, std::vector<Part>& parts) {
        auto& [from, to, vertices, interior] = *result.separator;
        assert(interior.empty() || interior.size() == vertices);
        const std::uint32_t number = lines.add_line(vertex_of(border, from, lines), vertex_of(border, to, lines), 1);
        lines.number(number, vertices);
        if (!interior.empty()) lines.set_interior(number, std::move(interior));
        const Stretch line{number, 0, static_cast<std::uint32_t>(vertices + 1)};
        if (from.loop != to.loop) {
            parts.push_back({join(border, from, to, line), result.process});
            assert(is_closed(parts.back().border.loops[std::min(from.loop, to.loop)], lines));
        } else {
            auto [first, second] = split(border, from.index, to.index, line);
            // The larger part stays: it is the one that the next round waits for.
            const bool first_stays = first.vertices() >= second.vertices();
            assert(is_closed(first.loops.front(), lines) && is_closed(second.loops.front(), lines));
            parts.push_back({std::move(first), first_stays ? result.process : any_process});
            parts.push_back({std::move(second), first_stays ? any_process : result.process});
        }
    }

private:
    const SizeField& size_;
    double pieces_target_;
    std::vector<EstimatedBorder> done_;
};

/// Calls search(parts, processes) for parts and their parts until none is left, with the processes that are to search
/// them, and cuts them. All processes deal in the same way.
template <class Search>
void cut_dealt(Lines& lines, std::vector<Part> parts, unsigned processes, Bisection& bisection, Search&& search) {
    for (SearchDealer dealer(processes); !parts.empty();) {
        std::vector<unsigned> dealt;
        dealt.reserve(parts.size());
        for (const Part& part : parts) dealt.push_back(dealer.deal(part.border.vertices(), part.process));
        std::vector<SearchResult> results = search(parts, dealt);
        parts = bisection.cut(lines, std::move(parts), results);
    }
}

/// The cuts round the bodies follow one another, and few processes can search at the same time. So the first processes
/// make them without a word to the others, which search the other regions meanwhile and make pieces of those that stay
/// whole. Nobody waits for a piece that another process is making.
class CutsAtOnce {
public:
    /// The others are the regions without holes, in their order.
    CutsAtOnce(const SimpleRegions& others, const SizeField& size, double pieces_target, core::ConnectedRanks& ranks,
               const MakeTrapezoid& make)
        : others_(others),
          size_(size),
          pieces_target_(pieces_target),
          ranks_(ranks),
          make_(make),
          cutters_(cutting_processes(others.size(), ranks.size())),
          shares_(region_shares(others.size(), ranks.size())) {}

    /// Called by all processes: cuts these parts and then the other regions. Returns the parts of the latter.
    std::vector<Part> cut(Lines& lines, std::vector<Part> parts, Bisection& bisection) {
        const bool is_cutter = ranks_.rank() < cutters_;
        Packer packer;
        const std::exception_ptr failure = failure_of([&] {
            if (is_cutter)
                cut_among_cutters(lines, parts, bisection, packer);
            else
                search_share(lines, packer);
        });
        const std::vector<std::string> told = tell_all(lines, packer.take(), failure);
        if (!is_cutter) cut_as_told(lines, std::move(parts), bisection, told.front());
        if (cutters_ == ranks_.size()) {
            std::vector<SearchResult> results = search_shares(lines);
            return bisection.cut(lines, others_, results);
        }
        std::vector<Part> of_others;
        bisection.expect_done(others_.size());
        for (unsigned process = cutters_; process < ranks_.size(); ++process)
            take_results(lines, process, told[process], bisection, of_others);
        return of_others;
    }

private:
    /// The share of its own work that a process keeps, whatever the others have. It is enough to do during the cuts,
    /// which last for half as long as all pieces, and the rest is enough to make up for the time that those who cut
    /// need.
    static constexpr double kept_share = 0.7;

    const SimpleRegions& others_;
    const SizeField& size_;
    double pieces_target_;
    core::ConnectedRanks& ranks_;
    const MakeTrapezoid& make_;
    unsigned cutters_;
    std::vector<std::size_t> shares_;  ///< the regions that each process searches, from one of these to the next
    std::vector<SearchResult> own_;    ///< of the share of this process
    std::vector<std::size_t> kept_;    ///< those of the share that this process makes pieces of in any case

    /// Thrown by cutters where another one has failed.
    struct OtherCutterFailed {};

    std::size_t begin(unsigned process) const { return shares_[process]; }
    std::size_t end(unsigned process) const { return shares_[process + 1]; }

    /// Returns what a function throws, or null.
    template <class F>
    static std::exception_ptr failure_of(F&& f) {
        try {
            f();
        } catch (...) {
            return std::current_exception();
        }
        return nullptr;
    }

    /// Tells all processes these bytes, or that this one has failed, and makes pieces until all have told theirs.
    /// Throws where one has failed.
    std::vector<std::string> tell_all(Lines& lines, const std::string& bytes, std::exception_ptr failure) {
        const std::unique_ptr<core::PendingGather> pending = ranks_.start_all_gather(failure ? std::string() : bytes);
        if (!failure) failure = failure_of([&] { make_pieces(lines, *pending); });
        std::vector<std::string> told = pending->take();
        if (failure) std::rethrow_exception(failure);
        const bool one_failed =
            std::any_of(told.begin(), told.end(), [](const std::string& one) { return one.empty(); });
        if (one_failed) ranks_.agree();  // throws what it fails with
        return told;
    }

    SearchResult search(const LineBorder& border, Lines& lines) const {
        SearchResult result = search_separator(localize(border, lines, size_), size_, pieces_target_);
        make_as_told(result);
        result.process = ranks_.rank();
        return result;
    }

    /// Cuts the parts on one of the cutters. Rank 0 puts all results, the others that they are done. Nobody puts
    /// anything where another cutter has failed.
    void cut_among_cutters(Lines& lines, std::vector<Part> parts, Bisection& bisection, Packer& packer) {
        packer.put(true);
        try {
            cut_dealt(lines, std::move(parts), cutters_, bisection,
                      [&](std::span<const Part> round, std::span<const unsigned> dealt) {
                          std::vector<SearchResult> results = search_round(lines, round, dealt);
                          if (ranks_.rank() == 0)
                              for (const SearchResult& result : results) pack_result(result, packer);
                          return results;
                      });
        } catch (const OtherCutterFailed&) {
            packer = Packer();
        }
    }
    std::vector<SearchResult> search_round(Lines& lines, std::span<const Part> parts, std::span<const unsigned> dealt) {
        std::vector<std::size_t> own;
        for (std::size_t i = 0; i < parts.size(); ++i)
            if (dealt[i] == ranks_.rank()) own.push_back(i);
        std::vector<SearchResult> results(parts.size());
        const std::exception_ptr failure = failure_of([&] {
            core::parallel_for(own.size(), 1, [&](std::size_t i, std::size_t) {
                results[own[i]] = search(parts[own[i]].border, lines);
            });
        });
        // The other cutters wait for this one, whatever has happened.
        Packer packer;
        packer.put(failure != nullptr);
        if (!failure)
            for (const std::size_t i : own) pack_result(results[i], packer);
        const std::vector<std::string> told = ranks_.all_gather_among(cutters_, packer.take());
        if (failure) std::rethrow_exception(failure);
        std::vector<Unpacker> unpackers(told.begin(), told.end());
        for (Unpacker& unpacker : unpackers)
            if (unpacker.get<bool>()) throw OtherCutterFailed();
        for (std::size_t i = 0; i < parts.size(); ++i) {
            SearchResult result = unpack_result(unpackers[dealt[i]]);
            if (dealt[i] == ranks_.rank()) continue;
            results[i] = std::move(result);
            results[i].process = dealt[i];
        }
        return results;
    }
    /// Makes the cuts that rank 0 has told, as the cutters have made them.
    void cut_as_told(Lines& lines, std::vector<Part> parts, Bisection& bisection, const std::string& told) const {
        Unpacker unpacker(told);
        unpacker.get<bool>();
        cut_dealt(lines, std::move(parts), cutters_, bisection,
                  [&](std::span<const Part> round, std::span<const unsigned> dealt) {
                      std::vector<SearchResult> results;
                      for (std::size_t i = 0; i < round.size(); ++i) {
                          results.push_back(unpack_result(unpacker));
                          results.back().process = dealt[i];
                      }
                      return results;
                  });
    }

    /// Searches the share of this process. Puts how many pieces of it the process keeps, and the results.
    void search_share(Lines& lines, Packer& packer) {
        const std::size_t first = begin(ranks_.rank());
        own_.resize(end(ranks_.rank()) - first);
        core::parallel_for(own_.size(), 1, [&](std::size_t i, std::size_t) {
            own_[i] = search(others_.border(first + i, lines), lines);
        });
        if (make_) keep_pieces();
        packer.put_short(kept_.size());
        ResultsPacker results;
        for (const SearchResult& result : own_) results.put(result);
        results.finish(packer);
    }
    /// Decides which regions of the share, the first ones that become pieces as they are, this process keeps. They need
    /// not wait for the ids of vertices of other cuts.
    void keep_pieces() {
        const auto becomes_piece = [&](std::size_t i) {
            return !own_[i].separator && is_trapezoid(begin(ranks_.rank()) + i);
        };
        double work = 0, kept_work = 0;
        for (std::size_t i = 0; i < own_.size(); ++i)
            if (becomes_piece(i)) work += own_[i].work;
        for (std::size_t i = 0; i < own_.size(); ++i) {
            if (!becomes_piece(i)) continue;
            kept_work += own_[i].work;
            if (kept_work > kept_share * work) return;
            kept_.push_back(i);
        }
    }
    /// Makes kept pieces, in their order, until all processes have told what they have found.
    void make_pieces(Lines& lines, core::PendingGather& pending) const {
        const std::size_t first = begin(ranks_.rank());
        std::atomic<std::size_t> next = 0;
        core::parallel_for(thread_count(), 1, [&](std::size_t, std::size_t) {
            for (std::size_t i; !pending.is_there() && (i = next++) < kept_.size();) {
                const std::size_t region = first + kept_[i];
                make_(others_.trapezoid(region), others_.border(region, lines), *own_[kept_[i]].estimate, lines);
            }
        });
    }
    bool is_trapezoid(std::size_t region) const { return others_.trapezoid(region) != EstimatedBorder::no_trapezoid; }

    /// Cuts the share of a process as it has told.
    void take_results(Lines& lines, unsigned process, const std::string& told, Bisection& bisection,
                      std::vector<Part>& parts) {
        Unpacker unpacker(told);
        std::size_t kept = unpacker.get_short();
        ResultsUnpacker results(unpacker);
        const bool is_own = process == ranks_.rank();
        for (std::size_t i = begin(process); i < end(process); ++i) {
            SearchResult* own = is_own ? &own_[i - begin(process)] : nullptr;
            if (results.next_is_cut()) {
                SearchResult result;
                result.separator = results.separator();
                result.process = process;
                Bisection::cut_in_two(lines, others_.border(i, lines), own != nullptr ? *own : result, parts);
                continue;
            }
            EstimatedBorder& whole = bisection.add_done(others_.whole(i));
            whole.work = results.work();
            whole.process = process;
            if (own != nullptr) whole.estimate = std::make_unique<WorkEstimate>(*own->estimate);
            if (kept > 0 && is_trapezoid(i)) {
                whole.kept = true;
                --kept;
            }
        }
    }
    /// Collective: searches the other regions once those round the bodies are cut, each process its share.
    std::vector<SearchResult> search_shares(Lines& lines) {
        std::deque<LineBorder> own;
        std::vector<DealtBorder> dealt;
        for (unsigned process = 0; process < ranks_.size(); ++process)
            for (std::size_t i = begin(process); i < end(process); ++i) {
                const bool is_own = process == ranks_.rank();
                dealt.push_back({is_own ? &own.emplace_back(others_.border(i, lines)) : nullptr, process});
            }
        if (dealt.empty()) return {};
        return search_together(lines, dealt, size_, pieces_target_, ranks_);
    }
};

/// Returns borders that any process may search.
std::vector<Part> parts_of(std::vector<LineBorder> borders) {
    std::vector<Part> parts;
    parts.reserve(borders.size());
    for (LineBorder& border : borders) parts.push_back({std::move(border)});
    return parts;
}

}  // namespace

std::vector<EstimatedBorder> cut_to_size(Lines& lines, UncutRegions regions, const SizeField& size,
                                         double pieces_target) {
    // The subdomain round the bodies is cut many times over and would occupy one thread at first. The other threads
    // search the remaining subdomains meanwhile, whose borders hold none of the vertices that these cuts add.
    const SimpleRegions others(regions);
    Bisection bisection(size, pieces_target);
    std::vector<SearchResult> results;
    core::parallel_invoke([&] { bisection.cut_all(lines, parts_of(std::move(regions.borders))); },
                          [&] { results = bisection.search(lines, others); });
    bisection.cut_all(lines, bisection.cut(lines, others, results));
    return bisection.take_done();
}

std::vector<EstimatedBorder> cut_to_size_together(Lines& lines, UncutRegions regions, const SizeField& size,
                                                  double pieces_target, core::ConnectedRanks& ranks,
                                                  const MakeTrapezoid& make) {
    // The order of all cuts is that of cut_to_size().
    const SimpleRegions others(regions);
    Bisection bisection(size, pieces_target);
    CutsAtOnce cuts(others, size, pieces_target, ranks, make);
    std::vector<Part> of_others = cuts.cut(lines, parts_of(std::move(regions.borders)), bisection);
    cut_dealt(lines, std::move(of_others), ranks.size(), bisection,
              [&](std::span<const Part> parts, std::span<const unsigned> processes) {
                  std::vector<DealtBorder> dealt;
                  for (std::size_t i = 0; i < parts.size(); ++i) dealt.push_back({&parts[i].border, processes[i]});
                  return search_together(lines, dealt, size, pieces_target, ranks);
              });
    return bisection.take_done();
}

}  // namespace lamina::decoupling
