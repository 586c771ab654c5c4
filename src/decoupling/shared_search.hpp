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

/// Says which process searches which subdomain: the one that has the least to do so far, and the lowest of these. All
/// processes come to the same answer.
class SearchDealer {
public:
    explicit SearchDealer(unsigned processes);

    /// Returns the number of the process that searches a border.
    unsigned deal(const LineBorder& border);
    /// Returns whether the process that would get this border would have no more to do than the busiest one has already.
    bool has_room(const LineBorder& border) const;

private:
    std::vector<std::pair<std::uint64_t, unsigned>> heap_;  ///< what each process has to do, the least on top
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

/// Collective: divides all lines of `lines`, each by one process, and numbers their vertices.
void number_together(Lines& lines, const SeparatorSpacing& spacing, Ranks& ranks);

}  // namespace lamina::decoupling
