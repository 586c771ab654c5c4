// The search for separators, divided among processes: each searches some of the subdomains and tells all others where
// it has found a separator (docs/decisions/0045).
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <lamina/sizing.hpp>

#include "core/connected_ranks.hpp"
#include "core/difference_packing.hpp"
#include "core/packing.hpp"
#include "decoupling/line_border.hpp"
#include "decoupling/lines.hpp"
#include "decoupling/ring_regions.hpp"
#include "decoupling/separator_search.hpp"

namespace lamina::decoupling {

/// Stands for any process.
inline constexpr unsigned any_process = std::numeric_limits<unsigned>::max();

/// Says which process searches which subdomain. All processes come to the same answer. Work is counted in vertices of
/// borders that are searched.
class SearchDealer {
public:
    explicit SearchDealer(unsigned processes);

    /// Deals a border to this process, or else to the one that has got the least so far. Returns the process.
    unsigned deal(std::size_t vertices, unsigned process);

private:
    std::vector<std::uint64_t> work_;  ///< per process
    /// A heap of the work that processes have got, the least on top. Entries that are out of date differ from work_.
    std::vector<std::pair<std::uint64_t, unsigned>> least_;
};

/// A border and the process that searches it.
struct DealtBorder {
    const LineBorder* border;  ///< may be null on other processes
    unsigned process;
};

/// Adds what processes tell of a border: about how much work it is, in one byte, or the ends of its separator and how
/// many vertices that has. Who needs these divides it.
void pack_result(const SearchResult& result, core::Packer& packer);
/// Returns what pack_result() has added.
SearchResult unpack_result(core::Unpacker& unpacker);
/// Makes what this process has found what the others know of it.
void make_as_told(SearchResult& result);

/// Processes tell each other this number of a region that is cut, and a smaller one, which stands for the work, of a
/// region that stays whole.
inline constexpr std::uint8_t has_separator = 255;

/// Puts the results of successive regions, most of which stay whole and are about as much work as the ones before.
class ResultsPacker {
public:
    void put(const SearchResult& result);
    /// Puts what was put, for a ResultsUnpacker.
    void finish(core::Packer& packer);

private:
    core::DifferencePacker codes_;
    core::Packer separators_;
};

/// Takes the results in their order.
class ResultsUnpacker {
public:
    /// Precondition: the bytes outlive this object.
    explicit ResultsUnpacker(core::Unpacker& unpacker)
        : codes_text_(unpacker.get_text()), codes_(codes_text_), separators_(unpacker) {}
    ResultsUnpacker(const ResultsUnpacker&) = delete;

    /// Looks at the next region. Returns whether it is cut; then separator() is to be called.
    bool next_is_cut();
    /// Returns the work of a region that stays whole.
    float work() const { return work_; }
    Separator separator();

private:
    std::string codes_text_;
    core::DifferenceUnpacker codes_;
    core::Unpacker& separators_;
    std::uint8_t code_ = has_separator;
    float work_ = 0;
};

/// Collective: returns what search_separator() finds in each border, but for the estimates of those that are cut, which
/// count no more. Each process searches its own borders. Precondition: all arguments are the same everywhere, but for
/// borders of others and for the lines that are divided.
std::vector<SearchResult> search_together(Lines& lines, std::span<const DealtBorder> borders, const SizeField& size,
                                          double pieces_target, core::ConnectedRanks& ranks);

/// Returns how many processes, the first ones, cut the regions round the bodies where there are so many others.
unsigned cutting_processes(std::size_t others, unsigned processes);

/// Returns which regions without holes each process searches: those from the i-th of these numbers to the next one.
/// Successive regions often share a line. Processes that cut regions round the bodies while others do not have none.
std::vector<std::size_t> region_shares(std::size_t regions, unsigned processes);

/// Collective: divides the lines of these runs, which are all but loops in ascending order, each by its process, and
/// numbers their vertices. Throws MeshError where another process has other lines.
void number_together(Lines& lines, std::span<const LineRun> runs, const SizeField& size, core::ConnectedRanks& ranks);

}  // namespace lamina::decoupling
