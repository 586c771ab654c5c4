// The search for separators, divided among processes: each searches some of the subdomains and tells all others where it
// has found a separator (docs/decisions/0051).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <lamina/ranks.hpp>

#include "decoupling/line_border.hpp"
#include "decoupling/lines.hpp"
#include "decoupling/separator_search.hpp"
#include "decoupling/separators.hpp"

namespace lamina::decoupling {

/// Says which process searches which subdomain: the one that has got the least so far, and the lowest of these. All
/// processes come to the same answer.
class SearchDealer {
public:
    explicit SearchDealer(unsigned processes);

    /// Returns the number of the process that searches a border of so many vertices.
    unsigned deal(std::size_t vertices);
    /// Begins with what the processes do at the same time next.
    void begin_round();
    /// Gives such a border to a process, of which deal() takes no account.
    void deal_to(unsigned process, std::size_t vertices);
    /// Returns whether a process that gets such a border has no more to do in this round than the busiest one has
    /// already.
    bool has_room(unsigned process, std::size_t vertices) const;

private:
    std::vector<std::uint64_t> work_;                        ///< what each process has to do in this round
    std::vector<std::pair<std::uint64_t, unsigned>> dealt_;  ///< what deal() has given to each, the least on top
    std::uint64_t most_ = 0;
};

/// A border and the process that searches it.
struct DealtBorder {
    const LineBorder* border;  ///< may be null on other processes
    unsigned process;
};

/// Collective: returns what search_separator() finds in each border, but for the estimates of those that are cut, which
/// count no more. Each process searches its own borders. What it tells of a border is about how much work it is, in one
/// byte, or the ends of its separator and how many vertices that has: who needs these divides it. Precondition: all
/// arguments are the same everywhere, but for borders of others and for the lines that are divided.
std::vector<SearchResult> search_together(Lines& lines, std::span<const DealtBorder> borders,
                                          const SeparatorSpacing& spacing, double pieces_target, Ranks& ranks);

/// Returns which regions without holes each process searches: those from the i-th of these numbers to the next one.
/// Successive regions often share a line.
std::vector<std::size_t> region_shares(std::size_t regions, unsigned processes);

/// Collective: divides all lines but loops, each by its process, and numbers their vertices.
void number_together(Lines& lines, std::span<const unsigned> process, const SeparatorSpacing& spacing, Ranks& ranks);

}  // namespace lamina::decoupling
