// The queue of triangles whose angles refinement has to mend.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "delaunay/triangulate/triangles.hpp"

namespace lamina::delaunay {

/// A triangle that waits to be mended. Triangles are made with the new vertex first, so the entry is stale, and is
/// dropped, if the triangle at this index has another first vertex by now.
struct QueuedTriangle {
    Index triangle;
    Index newest;  ///< its first vertex when it was queued
};

/// A priority queue of triangles by shortest edge, in buckets that span a factor of 2^(1/4) in squared length.
class AngleQueue {
public:
    void push(QueuedTriangle entry, double squared_shortest) {
        const std::size_t b = bucket(static_cast<float>(squared_shortest));
        buckets_[b].push_back(entry);
        occupied_[b / 64] |= std::uint64_t{1} << (b % 64);
    }

    bool empty() const {
        return std::all_of(occupied_.begin(), occupied_.end(), [](std::uint64_t word) { return word == 0; });
    }

    void clear() {
        for (auto& bucket : buckets_) bucket.clear();
        occupied_.fill(0);
    }

    /// Takes the most recent entry of the lowest bucket out. Returns false if the queue is empty.
    bool pop(QueuedTriangle& entry) {
        for (std::size_t word = 0; word < occupied_.size(); ++word) {
            if (occupied_[word] == 0) continue;
            const std::size_t b = word * 64 + static_cast<std::size_t>(std::countr_zero(occupied_[word]));
            entry = buckets_[b].back();
            buckets_[b].pop_back();
            if (buckets_[b].empty()) occupied_[word] &= occupied_[word] - 1;
            return true;
        }
        return false;
    }

private:
    static constexpr std::size_t bucket_count = 1024;  // 8 bits of exponent and 2 bits of mantissa
    static std::size_t bucket(float key) { return std::bit_cast<std::uint32_t>(key) >> 21; }

    std::array<std::vector<QueuedTriangle>, bucket_count> buckets_;
    std::array<std::uint64_t, bucket_count / 64> occupied_{};  ///< one bit per bucket
};

}  // namespace lamina::delaunay
