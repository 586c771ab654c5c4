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

    /// Returns the number of the process that searches a border.
    unsigned deal(const LineBorder& border);
    /// Begins with what the processes do at the same time next.
    void begin_round();
    /// Gives a border to a process, of which deal() takes no account.
    void deal_to(unsigned process, const LineBorder& border);
    /// Returns whether a process that gets this border has no more to do in this round than the busiest one has
    /// already.
    bool has_room(unsigned process, const LineBorder& border) const;

private:
    std::vector<std::uint64_t> work_;                        ///< what each process has to do in this round
    std::vector<std::pair<std::uint64_t, unsigned>> dealt_;  ///< what deal() has given to each, the least on top
    std::uint64_t most_ = 0;
};

/// A border and the process that searches it.
struct DealtBorder {
    const LineBorder* border;
    unsigned process;
};

/// Collective: returns what search_separator() finds in each border, but for the estimates of those that are cut, which
/// count no more. Each process searches its own borders. What it tells of a border is its estimate, or the ends of its
/// separator and how many vertices that has: who needs these divides it. Precondition: all arguments are the same
/// everywhere, but for the lines that are divided.
std::vector<SearchResult> search_together(Lines& lines, std::span<const DealtBorder> borders,
                                          const SeparatorSpacing& spacing, double pieces_target, Ranks& ranks);

/// Returns the process that searches the i-th of n regions without holes. Successive regions, which often share a line,
/// go to one process.
inline unsigned simple_region_process(std::size_t i, std::size_t n, unsigned processes) {
    return static_cast<unsigned>(i * processes / n);
}

/// Collective: divides all lines but loops, each by its process, and numbers their vertices.
void number_together(Lines& lines, std::span<const unsigned> process, const SeparatorSpacing& spacing, Ranks& ranks);

}  // namespace lamina::decoupling
