// Which triangles and vertices an insertion may change, so that several threads can change parts of one triangulation.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "delaunay/triangulate/triangles.hpp"

namespace lamina::delaunay {

/// Tells for most vertices that they are not in a set.
class VertexFilter {
public:
    void add(Index v) { words_[v / 64 % words] |= std::uint64_t{1} << v % 64; }
    bool may_have(Index v) const { return (words_[v / 64 % words] >> v % 64 & 1) != 0; }

private:
    static constexpr std::size_t words = 128;
    std::array<std::uint64_t, words> words_{};
};

/// A range of the parts that triangles and vertices are divided into, or the whole triangulation. Where several threads
/// insert segments at the same time, each in the reach of its own,
///
/// - no triangle within one reach has an edge in common with one within another;
/// - the triangles round a vertex within one reach are within that reach, or within none.
///
/// Triangles within no reach keep their vertices. A thread that stays within its reach changes at most their links to
/// its own triangles, and no other thread looks at these links.
class Reach {
public:
    /// Makes the reach that holds everything.
    Reach() = default;
    /// Makes the reach of the parts first .. first + count - 1. Both arrays hold parts, of triangles and of vertices;
    /// vertices that triangles of several parts have in common are in `shared`.
    Reach(const std::uint8_t* of_triangle, const std::uint8_t* of_vertex, const VertexFilter& shared,
          std::uint8_t first, std::uint8_t count)
        : of_triangle_(of_triangle), of_vertex_(of_vertex), shared_(&shared), first_(first), count_(count) {}

    bool has_triangle(Index t) const { return of_triangle_ == nullptr || is_within(of_triangle_[t]); }
    bool has_vertex(Index v) const { return of_vertex_ == nullptr || is_within(of_vertex_[v]); }
    /// Returns the same for a vertex of a triangle within reach. To look up the parts of all of these would take time.
    bool has_vertex_of_triangle(Index v) const { return !shared_->may_have(v) || has_vertex(v); }

private:
    bool is_within(std::uint8_t part) const { return static_cast<std::uint8_t>(part - first_) < count_; }

    const std::uint8_t* of_triangle_ = nullptr;
    const std::uint8_t* of_vertex_ = nullptr;
    static constexpr VertexFilter none{};
    const VertexFilter* shared_ = &none;
    std::uint8_t first_ = 0, count_ = 0;
};

}  // namespace lamina::delaunay
