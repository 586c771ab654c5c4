// A set of vertices of a mesh, one bit each, which many threads may fill at once.
#pragma once

#include <atomic>
#include <cstdint>
#include <vector>

#include <lamina/ids.hpp>

namespace lamina::mesh {

class VertexMarks {
public:
    explicit VertexMarks(std::size_t vertices = 0) : words_((vertices + 63) / 64, 0) {}

    /// May be called by several threads at once, but not while another one asks.
    void add(VertexId v) { std::atomic_ref(words_[v.index() / 64]).fetch_or(bit(v), std::memory_order_relaxed); }
    bool has(VertexId v) const { return (words_[v.index() / 64] & bit(v)) != 0; }

private:
    std::vector<std::uint64_t> words_;

    static std::uint64_t bit(VertexId v) { return std::uint64_t{1} << (v.index() % 64); }
};

}  // namespace lamina::mesh
