// Recursive bisection, level by level: the search for separators, which takes the time, runs on all subdomains of a
// level at once. Then they are cut in order, so that the numbers of new vertices do not depend on threads.
#include "decoupling/cut_to_size.hpp"

#include <algorithm>
#include <deque>
#include <iterator>
#include <span>
#include <utility>

#include "core/parallel.hpp"
#include "decoupling/separator_search.hpp"
#include "decoupling/shared_search.hpp"

namespace lamina::decoupling {

namespace {

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
    /// Returns the border of a region that stays whole.
    EstimatedBorder whole(std::size_t i) const {
        if (i < given_.size()) return {given_[i]};
        return {{}, static_cast<std::uint32_t>(i - given_.size())};
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
    Bisection(const SeparatorSpacing& spacing, double pieces_target)
        : spacing_(spacing), pieces_target_(pieces_target) {}

    /// Searches separators for all borders. May run at the same time as the other functions.
    std::vector<SearchResult> search(Lines& lines, std::span<const Part> parts) const {
        return core::parallel_blocks(parts.size(), 1, [&](std::size_t i, std::size_t) {
            return search_separator(localize(parts[i].border, lines, spacing_), spacing_, pieces_target_);
        });
    }
    std::vector<SearchResult> search(Lines& lines, const SimpleRegions& regions) const {
        return core::parallel_blocks(regions.size(), 1, [&](std::size_t i, std::size_t) {
            return search_separator(localize(regions.border(i, lines), lines, spacing_), spacing_, pieces_target_);
        });
    }

    /// Cuts the borders for which a separator was found, and returns their parts. The other borders are done.
    std::vector<Part> cut(Lines& lines, std::vector<Part> whole, std::span<SearchResult> results) {
        std::vector<Part> parts;
        for (std::size_t i = 0; i < whole.size(); ++i)
            if (results[i].separator)
                cut_in_two(lines, whole[i].border, results[i], parts);
            else
                add_done({std::move(whole[i].border)}, results[i]);
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

    std::vector<EstimatedBorder> take_done() { return std::move(done_); }

private:
    const SeparatorSpacing& spacing_;
    double pieces_target_;
    std::vector<EstimatedBorder> done_;

    void add_done(EstimatedBorder border, const SearchResult& result) {
        border.work = result.work;
        border.estimate = result.estimate;
        border.process = result.process;
        done_.push_back(std::move(border));
    }
    static void cut_in_two(Lines& lines, const LineBorder& border, SearchResult& result, std::vector<Part>& parts) {
        auto& [from, to, vertices, interior] = *result.separator;
        const std::uint32_t number = lines.add_line(vertex_of(border, from, lines), vertex_of(border, to, lines), 1);
        lines.number(number, vertices);
        if (!interior.empty()) lines.set_interior(number, std::move(interior));
        const Stretch line{number, 0, static_cast<std::uint32_t>(vertices + 1)};
        if (from.loop != to.loop) {
            parts.push_back({join(border, from, to, line), result.process});
        } else {
            auto [first, second] = split(border, from.index, to.index, line);
            // The larger part stays: it is the one that the next round waits for.
            const bool first_stays = first.vertices() >= second.vertices();
            parts.push_back({std::move(first), first_stays ? result.process : any_process});
            parts.push_back({std::move(second), first_stays ? any_process : result.process});
        }
    }
};

/// The searches that the processes still have to divide among themselves.
class SharedSearches {
public:
    /// The others are the regions without holes, in their order.
    SharedSearches(const SimpleRegions& others, const SeparatorSpacing& spacing, double pieces_target, Ranks& ranks)
        : others_(others),
          spacing_(spacing),
          pieces_target_(pieces_target),
          ranks_(ranks),
          of_others_(others.size()),
          dealer_(ranks.size()) {
        const std::vector<std::size_t> shares = region_shares(others.size(), ranks.size());
        next_.assign(shares.begin(), shares.end() - 1);
        end_.assign(shares.begin() + 1, shares.end());
    }

    /// Collective: returns the results for these borders. Processes that have nothing to do with them search some of
    /// their share of the other borders meanwhile.
    std::vector<SearchResult> search(Lines& lines, std::span<const Part> parts) {
        dealer_.begin_round();
        Round round;
        for (const Part& part : parts)
            round.dealt.push_back({&part.border, dealer_.deal(part.border.vertices(), part.process)});
        for (unsigned process = 0; process < ranks_.size(); ++process)
            for (std::size_t& next = next_[process];
                 next < end_[process] && dealer_.deal_if_room(process, others_.vertices(next, lines)); ++next)
                add_other(next, process, lines, round);
        return search_round(lines, round);
    }

    /// Collective: returns the results for the other borders. Processes that have had the more to do with the borders
    /// before leave regions at the end of their shares to those that have had less.
    std::vector<SearchResult> finish(Lines& lines) {
        std::vector<std::uint64_t> work;
        std::uint64_t all = 0;
        const auto vertices = [&](std::size_t region) { return others_.vertices(region, lines); };
        for (unsigned process = 0; process < ranks_.size(); ++process) {
            work.push_back(dealer_.work(process));
            for (std::size_t i = next_[process]; i < end_[process]; ++i) work.back() += vertices(i);
            all += work.back();
        }
        const std::uint64_t mean = all / ranks_.size();
        std::vector<std::size_t> left;
        for (unsigned process = 0; process < ranks_.size(); ++process)
            while (end_[process] > next_[process] && work[process] - vertices(end_[process] - 1) > mean) {
                work[process] -= vertices(--end_[process]);
                left.push_back(end_[process]);
            }
        Round round;
        for (unsigned process = 0; process < ranks_.size(); ++process) {
            for (; next_[process] < end_[process]; ++next_[process]) add_other(next_[process], process, lines, round);
            for (; !left.empty() && (work[process] < mean || process + 1 == ranks_.size()); left.pop_back()) {
                work[process] += vertices(left.back());
                add_other(left.back(), process, lines, round);
            }
        }
        search_round(lines, round);
        return std::move(of_others_);
    }

private:
    const SimpleRegions& others_;
    const SeparatorSpacing& spacing_;
    double pieces_target_;
    Ranks& ranks_;
    std::vector<std::size_t> next_, end_;  ///< per process: its share of the others that is not searched yet
    std::vector<SearchResult> of_others_;
    SearchDealer dealer_;

    /// What all processes search until they tell each other what they have found.
    struct Round {
        std::vector<DealtBorder> dealt;   ///< borders that are given, then others
        std::vector<std::size_t> others;  ///< the numbers of these
        std::deque<LineBorder> own;       ///< the borders of those that this process searches
    };

    void add_other(std::size_t region, unsigned process, const Lines& lines, Round& round) const {
        const bool is_own = process == ranks_.rank();
        round.dealt.push_back({is_own ? &round.own.emplace_back(others_.border(region, lines)) : nullptr, process});
        round.others.push_back(region);
    }
    /// Returns the results for the borders that are given.
    std::vector<SearchResult> search_round(Lines& lines, const Round& round) {
        std::vector<SearchResult> results = search_together(lines, round.dealt, spacing_, pieces_target_, ranks_);
        const std::size_t given = round.dealt.size() - round.others.size();
        for (std::size_t i = 0; i < round.others.size(); ++i)
            of_others_[round.others[i]] = std::move(results[given + i]);
        results.resize(given);
        return results;
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

std::vector<EstimatedBorder> cut_to_size(Lines& lines, UncutRegions regions, const SeparatorSpacing& spacing,
                                         double pieces_target) {
    // The subdomain round the bodies is cut many times over and would occupy one thread at first. The other threads
    // search the remaining subdomains meanwhile, whose borders hold none of the vertices that these cuts add.
    const SimpleRegions others(regions);
    Bisection bisection(spacing, pieces_target);
    std::vector<SearchResult> results;
    core::parallel_invoke([&] { bisection.cut_all(lines, parts_of(std::move(regions.borders))); },
                          [&] { results = bisection.search(lines, others); });
    bisection.cut_all(lines, bisection.cut(lines, others, results));
    return bisection.take_done();
}

std::vector<EstimatedBorder> cut_to_size_together(Lines& lines, UncutRegions regions, const SeparatorSpacing& spacing,
                                                  double pieces_target, Ranks& ranks) {
    // The order of all cuts is that of cut_to_size().
    const SimpleRegions others(regions), none;
    Bisection bisection(spacing, pieces_target);
    SharedSearches searches(others, spacing, pieces_target, ranks);
    const auto cut_all = [&](SharedSearches& shared, std::vector<Part> parts) {
        while (!parts.empty()) {
            std::vector<SearchResult> results = shared.search(lines, parts);
            parts = bisection.cut(lines, std::move(parts), results);
        }
    };
    cut_all(searches, parts_of(std::move(regions.borders)));
    std::vector<SearchResult> results = searches.finish(lines);
    SharedSearches of_parts(none, spacing, pieces_target, ranks);
    cut_all(of_parts, bisection.cut(lines, others, results));
    return bisection.take_done();
}

}  // namespace lamina::decoupling
