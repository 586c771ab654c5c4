// Where vertices stand in a list of them.
#pragma once

#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include "delaunay/triangles.hpp"

namespace lamina::delaunay::pieces {

using delaunay::Index;
using delaunay::no_index;

inline constexpr std::size_t nowhere = static_cast<std::size_t>(-1);

/// Finds a few vertices by their numbers: a hash table with open addressing. Of equal ones the last counts. Nearly all
/// others are told apart by one bit.
class Places {
public:
    explicit Places(std::span<const Index> vertices)
        : bits_(static_cast<unsigned>(std::bit_width(2 * vertices.size() + 2))),
          entries_(std::size_t{1} << bits_, Entry{no_index, 0}),
          may_be_here_(entries_.size() / 4, 0) {
        for (std::size_t i = 0; i < vertices.size(); ++i) {
            entries_[slot(vertices[i])] = {vertices[i], static_cast<Index>(i)};
            may_be_here_[word(vertices[i])] |= bit(vertices[i]);
        }
    }
    std::size_t of(Index vertex) const {
        if ((may_be_here_[word(vertex)] & bit(vertex)) == 0) return nowhere;
        const Entry& entry = entries_[slot(vertex)];
        return entry.vertex == vertex ? entry.place : nowhere;
    }

private:
    struct Entry {
        Index vertex, place;
    };
    /// Where the vertex is, or the free entry where it would be.
    std::size_t slot(Index vertex) const {
        std::size_t at = static_cast<std::uint32_t>(vertex * 0x9e3779b1u) >> (32 - bits_);
        while (entries_[at].vertex != vertex && entries_[at].vertex != no_index)
            at = at + 1 < entries_.size() ? at + 1 : 0;
        return at;
    }
    std::size_t word(Index vertex) const { return vertex / 32 & (may_be_here_.size() - 1); }
    static std::uint32_t bit(Index vertex) { return 1u << vertex % 32; }

    unsigned bits_;
    std::vector<Entry> entries_;
    std::vector<std::uint32_t> may_be_here_;  ///< eight bits an entry
};

}  // namespace lamina::delaunay::pieces
