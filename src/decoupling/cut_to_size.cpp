// Recursive bisection, level by level: the search for separators, which takes the time, runs on all subdomains of a
// level at once. Then they are cut in order, so that the numbers of new vertices do not depend on threads.
#include "decoupling/cut_to_size.hpp"

#include <algorithm>
#include <iterator>
#include <span>
#include <utility>

#include "core/parallel.hpp"
#include "decoupling/separator_search.hpp"
#include "decoupling/shared_search.hpp"

namespace lamina::decoupling {

namespace {

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

    /// Cuts the borders for which a separator was found, and returns their parts. The other borders are done.
    std::vector<LineBorder> cut(Lines& lines, std::vector<LineBorder> borders, std::span<SearchResult> results) {
        std::vector<LineBorder> parts;
        for (std::size_t i = 0; i < borders.size(); ++i) {
            auto& separator = results[i].separator;
            if (!separator) {
                done_.push_back({std::move(borders[i]), results[i].estimate, results[i].process});
                continue;
            }
            auto& [from, to, vertices, interior] = *separator;
            const std::uint32_t number =
                lines.add_line(vertex_of(borders[i], from, lines), vertex_of(borders[i], to, lines), 1);
            lines.number(number, vertices);
            if (!interior.empty()) lines.set_interior(number, std::move(interior));
            const Stretch line{number, 0, static_cast<std::uint32_t>(vertices + 1)};
            if (from.loop != to.loop) {
                parts.push_back(join(borders[i], from, to, line));
            } else {
                auto [first, second] = split(borders[i], from.index, to.index, line);
                parts.push_back(std::move(first));
                parts.push_back(std::move(second));
            }
        }
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
};

/// Takes the borders of one loop away from the others, and returns them. Their order stays.
std::vector<LineBorder> take_simple(std::vector<LineBorder>& borders) {
    const auto rest = std::stable_partition(borders.begin(), borders.end(),
                                            [](const LineBorder& border) { return border.loops.size() > 1; });
    std::vector<LineBorder> simple(std::make_move_iterator(rest), std::make_move_iterator(borders.end()));
    borders.erase(rest, borders.end());
    return simple;
}

/// The searches that the processes still have to divide among themselves.
class SharedSearches {
public:
    /// The others are the regions without holes, in their order.
    SharedSearches(std::span<const LineBorder> others, const SeparatorSpacing& spacing, double pieces_target,
                   Ranks& ranks)
        : others_(others),
          spacing_(spacing),
          pieces_target_(pieces_target),
          ranks_(ranks),
          of_others_(others.size()),
          dealer_(ranks.size()) {
        std::size_t begin = 0;
        for (unsigned process = 0; process < ranks.size(); ++process) {
            next_.push_back(begin);
            while (begin < others.size() && process_of(begin) == process) ++begin;
            end_.push_back(begin);
        }
    }

    /// Collective: returns the results for these borders. Processes that have nothing to do with them search some of
    /// their share of the other borders meanwhile.
    std::vector<SearchResult> search(Lines& lines, std::span<const LineBorder> borders) {
        dealer_.begin_round();
        std::vector<DealtBorder> dealt;
        for (const LineBorder& border : borders) dealt.push_back({&border, dealer_.deal(border)});
        std::vector<std::size_t> meanwhile;
        for (unsigned process = 0; process < ranks_.size(); ++process)
            for (std::size_t& next = next_[process]; next < end_[process] && dealer_.has_room(process, others_[next]);
                 ++next) {
                dealer_.deal_to(process, others_[next]);
                dealt.push_back({&others_[next], process});
                meanwhile.push_back(next);
            }
        std::vector<SearchResult> results = search_together(lines, dealt, spacing_, pieces_target_, ranks_);
        for (std::size_t i = 0; i < meanwhile.size(); ++i)
            of_others_[meanwhile[i]] = std::move(results[borders.size() + i]);
        results.resize(borders.size());
        return results;
    }

    /// Collective: returns the results for the other borders.
    std::vector<SearchResult> finish(Lines& lines) {
        std::vector<DealtBorder> dealt;
        std::vector<std::size_t> rest;
        for (unsigned process = 0; process < ranks_.size(); ++process)
            for (; next_[process] < end_[process]; ++next_[process]) {
                dealt.push_back({&others_[next_[process]], process});
                rest.push_back(next_[process]);
            }
        std::vector<SearchResult> results = search_together(lines, dealt, spacing_, pieces_target_, ranks_);
        for (std::size_t i = 0; i < rest.size(); ++i) of_others_[rest[i]] = std::move(results[i]);
        return std::move(of_others_);
    }

private:
    std::span<const LineBorder> others_;
    const SeparatorSpacing& spacing_;
    double pieces_target_;
    Ranks& ranks_;
    std::vector<std::size_t> next_, end_;  ///< per process: its share of the others that is not searched yet
    std::vector<SearchResult> of_others_;
    SearchDealer dealer_;

    unsigned process_of(std::size_t i) const { return simple_region_process(i, others_.size(), ranks_.size()); }
};

}  // namespace

std::vector<EstimatedBorder> cut_to_size(Lines& lines, std::vector<LineBorder> borders, const SeparatorSpacing& spacing,
                                         double pieces_target) {
    // The subdomain round the bodies is cut many times over and would occupy one thread at first. The other threads
    // search the remaining subdomains meanwhile, whose borders hold none of the vertices that these cuts add.
    std::vector<LineBorder> others = take_simple(borders);
    Bisection bisection(spacing, pieces_target);
    std::vector<SearchResult> results;
    core::parallel_invoke([&] { bisection.cut_all(lines, std::move(borders)); },
                          [&] { results = bisection.search(lines, others); });
    bisection.cut_all(lines, bisection.cut(lines, std::move(others), results));
    return bisection.take_done();
}

std::vector<EstimatedBorder> cut_to_size_together(Lines& lines, std::vector<LineBorder> borders,
                                                  const SeparatorSpacing& spacing, double pieces_target, Ranks& ranks) {
    // The order of all cuts is that of cut_to_size().
    std::vector<LineBorder> others = take_simple(borders);
    Bisection bisection(spacing, pieces_target);
    SharedSearches searches(others, spacing, pieces_target, ranks);
    const auto cut_all = [&](SharedSearches& shared, std::vector<LineBorder> parts) {
        while (!parts.empty()) {
            std::vector<SearchResult> results = shared.search(lines, parts);
            parts = bisection.cut(lines, std::move(parts), results);
        }
    };
    cut_all(searches, std::move(borders));
    std::vector<SearchResult> results = searches.finish(lines);
    SharedSearches of_parts({}, spacing, pieces_target, ranks);
    cut_all(of_parts, bisection.cut(lines, std::move(others), results));
    return bisection.take_done();
}

}  // namespace lamina::decoupling
