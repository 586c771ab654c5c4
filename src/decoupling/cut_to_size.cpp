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

/// Cuts borders in two, and their parts again.
class Bisection {
public:
    Bisection(const SeparatorSpacing& spacing, double pieces_target)
        : spacing_(spacing), pieces_target_(pieces_target) {}

    /// Searches separators for all borders. May run at the same time as the other functions.
    std::vector<SearchResult> search(Lines& lines, std::span<const LineBorder> borders) const {
        return core::parallel_blocks(borders.size(), 1, [&](std::size_t i, std::size_t) {
            return search_separator(localize(borders[i], lines, spacing_), spacing_, pieces_target_);
        });
    }
    std::vector<SearchResult> search(Lines& lines, const SimpleRegions& regions) const {
        return core::parallel_blocks(regions.size(), 1, [&](std::size_t i, std::size_t) {
            return search_separator(localize(regions.border(i, lines), lines, spacing_), spacing_, pieces_target_);
        });
    }

    /// Cuts the borders for which a separator was found, and returns their parts. The other borders are done.
    std::vector<LineBorder> cut(Lines& lines, std::vector<LineBorder> borders, std::span<SearchResult> results) {
        std::vector<LineBorder> parts;
        for (std::size_t i = 0; i < borders.size(); ++i)
            if (results[i].separator)
                cut_in_two(lines, borders[i], *results[i].separator, parts);
            else
                add_done({std::move(borders[i])}, results[i]);
        return parts;
    }
    std::vector<LineBorder> cut(Lines& lines, const SimpleRegions& regions, std::span<SearchResult> results) {
        std::vector<LineBorder> parts;
        for (std::size_t i = 0; i < regions.size(); ++i)
            if (results[i].separator)
                cut_in_two(lines, regions.border(i, lines), *results[i].separator, parts);
            else
                add_done(regions.whole(i), results[i]);
        return parts;
    }

    /// Cuts the borders and their parts until all are done.
    void cut_all(Lines& lines, std::vector<LineBorder> borders) {
        while (!borders.empty()) {
            std::vector<SearchResult> results = search(lines, borders);
            borders = cut(lines, std::move(borders), results);
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
    static void cut_in_two(Lines& lines, const LineBorder& border, Separator& separator,
                           std::vector<LineBorder>& parts) {
        auto& [from, to, vertices, interior] = separator;
        const std::uint32_t number = lines.add_line(vertex_of(border, from, lines), vertex_of(border, to, lines), 1);
        lines.number(number, vertices);
        if (!interior.empty()) lines.set_interior(number, std::move(interior));
        const Stretch line{number, 0, static_cast<std::uint32_t>(vertices + 1)};
        if (from.loop != to.loop) {
            parts.push_back(join(border, from, to, line));
        } else {
            auto [first, second] = split(border, from.index, to.index, line);
            parts.push_back(std::move(first));
            parts.push_back(std::move(second));
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
    std::vector<SearchResult> search(Lines& lines, std::span<const LineBorder> borders) {
        dealer_.begin_round();
        std::vector<DealtBorder> dealt;
        for (const LineBorder& border : borders) dealt.push_back({&border, dealer_.deal(border.vertices())});
        const auto has_room = [&](unsigned process, std::size_t region) {
            const std::size_t vertices = others_.vertices(region, lines);
            if (!dealer_.has_room(process, vertices)) return false;
            dealer_.deal_to(process, vertices);
            return true;
        };
        return search_with_others(lines, std::move(dealt), has_room);
    }

    /// Collective: returns the results for the other borders.
    std::vector<SearchResult> finish(Lines& lines) {
        search_with_others(lines, {}, [](unsigned, std::size_t) { return true; });
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

    /// Searches those borders, and of its own others each process the next ones that it has room for. Returns the results
    /// for the former.
    template <class HasRoom>
    std::vector<SearchResult> search_with_others(Lines& lines, std::vector<DealtBorder> dealt, HasRoom&& has_room) {
        const std::size_t given = dealt.size();
        std::deque<LineBorder> own;
        std::vector<std::size_t> meanwhile;
        for (unsigned process = 0; process < ranks_.size(); ++process)
            for (std::size_t& next = next_[process]; next < end_[process] && has_room(process, next); ++next) {
                const bool is_own = process == ranks_.rank();
                dealt.push_back({is_own ? &own.emplace_back(others_.border(next, lines)) : nullptr, process});
                meanwhile.push_back(next);
            }
        std::vector<SearchResult> results = search_together(lines, dealt, spacing_, pieces_target_, ranks_);
        for (std::size_t i = 0; i < meanwhile.size(); ++i) of_others_[meanwhile[i]] = std::move(results[given + i]);
        results.resize(given);
        return results;
    }
};

}  // namespace

std::vector<EstimatedBorder> cut_to_size(Lines& lines, UncutRegions regions, const SeparatorSpacing& spacing,
                                         double pieces_target) {
    // The subdomain round the bodies is cut many times over and would occupy one thread at first. The other threads
    // search the remaining subdomains meanwhile, whose borders hold none of the vertices that these cuts add.
    const SimpleRegions others(regions);
    Bisection bisection(spacing, pieces_target);
    std::vector<SearchResult> results;
    core::parallel_invoke([&] { bisection.cut_all(lines, std::move(regions.borders)); },
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
    const auto cut_all = [&](SharedSearches& shared, std::vector<LineBorder> parts) {
        while (!parts.empty()) {
            std::vector<SearchResult> results = shared.search(lines, parts);
            parts = bisection.cut(lines, std::move(parts), results);
        }
    };
    cut_all(searches, std::move(regions.borders));
    std::vector<SearchResult> results = searches.finish(lines);
    SharedSearches of_parts(none, spacing, pieces_target, ranks);
    cut_all(of_parts, bisection.cut(lines, others, results));
    return bisection.take_done();
}

}  // namespace lamina::decoupling
