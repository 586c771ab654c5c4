// The search for separators, divided among processes: each searches some of the subdomains and tells all others where it
// has found a separator (docs/decisions/0051).
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include <lamina/ranks.hpp>

#include "decoupling/line_border.hpp"
#include "decoupling/lines.hpp"
#include "decoupling/separator_search.hpp"
#include "decoupling/separators.hpp"

namespace lamina::decoupling {

/// Stands for any process.
inline constexpr unsigned any_process = std::numeric_limits<unsigned>::max();

/// Says which process searches which subdomain. All processes come to the same answer. Work is counted in vertices of
/// borders that are searched; a border that is cut counts twice, since candidates for separators are tried.
class SearchDealer {
public:
    explicit SearchDealer(unsigned processes);

    /// Begins with what the processes do at the same time next.
    void begin_round();
    /// Deals a border that will be cut to this process, or else to the one to which deal() has given the least so far.
    /// Returns the process.
    unsigned deal(std::size_t vertices, unsigned process);
    /// Gives a process a region of its share, unless it would have more to do in this round than the busiest one has
    /// already. Returns whether it has got it.
    bool deal_if_room(unsigned process, std::size_t vertices);
    /// Returns all that a process has got.
    std::uint64_t work(unsigned process) const { return work_[process]; }

private:
    std::vector<std::uint64_t> work_, in_round_, of_deal_;  ///< per process: in all, in this round, and by deal()
    /// What deal() has given to processes, the least on top. Entries that are out of date differ from of_deal_.
    std::vector<std::pair<std::uint64_t, unsigned>> least_;
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
