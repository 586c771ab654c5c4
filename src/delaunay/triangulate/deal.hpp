// Entries sorted by ranges of a key, on all threads: they are dealt in blocks whose places are counted before, so every
// entry has a place that no thread decides.
#pragma once

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "core/parallel.hpp"
#include "core/uninitialized.hpp"

namespace lamina::delaunay {

/// Entries that are sorted by their ranges.
template <class Entry>
struct DealtEntries {
    core::UninitializedArray<Entry> entries;
    std::vector<std::size_t> starts;  ///< range r is entries[starts[r]] .. entries[starts[r + 1]]

    std::size_t ranges() const { return starts.size() - 1; }
    std::span<const Entry> range(std::size_t r) const {
        return entries.all().subspan(starts[r], starts[r + 1] - starts[r]);
    }
    std::span<Entry> range(std::size_t r) { return {entries.data() + starts[r], starts[r + 1] - starts[r]}; }
};

/// Returns the entries entry_of(0) .. entry_of(count - 1), sorted by range_of(entry), which is less than `ranges`;
/// within a range they keep their order. Both functions are called twice for each entry, on any thread.
template <class Entry, class EntryOf, class RangeOf>
DealtEntries<Entry> deal(std::size_t count, std::size_t ranges, const EntryOf& entry_of, const RangeOf& range_of) {
    constexpr std::size_t entries_per_block = 100'000;
    auto places = core::parallel_blocks(count, entries_per_block, [&](std::size_t begin, std::size_t end) {
        std::vector<std::size_t> counts(ranges, 0);
        for (std::size_t i = begin; i < end; ++i) ++counts[range_of(entry_of(i))];
        return counts;
    });
    DealtEntries<Entry> dealt{core::UninitializedArray<Entry>(count), {0}};
    std::size_t place = 0;
    for (std::size_t r = 0; r < ranges; ++r) {
        for (auto& counts : places) place += std::exchange(counts[r], place);
        dealt.starts.push_back(place);
    }
    core::parallel_for(count, entries_per_block, [&](std::size_t begin, std::size_t end) {
        std::vector<std::size_t>& next_place = places[begin / entries_per_block];
        for (std::size_t i = begin; i < end; ++i) {
            const Entry entry = entry_of(i);
            dealt.entries[next_place[range_of(entry)]++] = entry;
        }
    });
    return dealt;
}

}  // namespace lamina::delaunay
