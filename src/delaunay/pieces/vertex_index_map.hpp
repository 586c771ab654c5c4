// A small hash map from vertices to their indices in a list.
#pragma once

#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include "delaunay/triangulate/triangles.hpp"

namespace lamina::delaunay::pieces {

/// VertexIndexMap::find() returns this for vertices that are not in the list.
inline constexpr std::size_t not_found = static_cast<std::size_t>(-1);

/// Finds the indices of vertices in a short list, where most vertices that are looked up are not in the list. One bit
/// of a filter shows this for nearly all of them; the others are looked up in a hash table with open addressing.
class VertexIndexMap {
public:
    /// Maps each vertex to its index in `vertices`; the last index counts where a vertex stands there several times.
    explicit VertexIndexMap(std::span<const Index> vertices)
        : bits_(static_cast<unsigned>(std::bit_width(2 * vertices.size() + 2))),
          entries_(std::size_t{1} << bits_, Entry{no_index, 0}),
          filter_(entries_.size() / 4, 0) {
        for (std::size_t i = 0; i < vertices.size(); ++i) {
            entries_[slot(vertices[i])] = {vertices[i], static_cast<Index>(i)};
            filter_[filter_word(vertices[i])] |= filter_bit(vertices[i]);
        }
    }

    /// Returns the index of the vertex in the list, or not_found.
    std::size_t find(Index vertex) const {
        if ((filter_[filter_word(vertex)] & filter_bit(vertex)) == 0) return not_found;
        const Entry& entry = entries_[slot(vertex)];
        return entry.vertex == vertex ? entry.index : not_found;
    }

private:
    struct Entry {
        Index vertex, index;
    };

    /// Returns the slot of the vertex, or the free slot where it would be put.
    std::size_t slot(Index vertex) const {
        std::size_t i = static_cast<std::uint32_t>(vertex * 0x9e3779b1u) >> (32 - bits_);
        while (entries_[i].vertex != vertex && entries_[i].vertex != no_index) i = i + 1 < entries_.size() ? i + 1 : 0;
        return i;
    }
    std::size_t filter_word(Index vertex) const { return vertex / 32 & (filter_.size() - 1); }
    static std::uint32_t filter_bit(Index vertex) { return 1u << vertex % 32; }

    unsigned bits_;  ///< binary logarithm of the number of slots
    std::vector<Entry> entries_;
    /// Eight bits per slot. A vertex of the list sets the bit whose number is its own modulo the number of bits.
    std::vector<std::uint32_t> filter_;
};

}  // namespace lamina::delaunay::pieces
