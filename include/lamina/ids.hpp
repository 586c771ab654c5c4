// Indices with a type of their own, so that a vertex cannot be taken for a triangle, and the cells made of them.
//
// Limits:
//  1. Ids have 32 bits, which suffice for 4.29e9 vertices in half the memory of 64. Counts and offsets are std::size_t.
// Example:
//     const std::vector<Point> points{{0, 0}, {1, 0}, {0, 1}};
//     const Triangle triangle{{VertexId{0u}, VertexId{1u}, VertexId{2u}}};
//     assert(points[triangle.v[1].index()] == (Point{1, 0}) && !TriangleId{}.valid());
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>

namespace lamina {

/// An index into an array of the things that Tag names. An id that is made without an index is not valid.
template <class Tag>
struct Id {
    std::uint32_t value = std::numeric_limits<std::uint32_t>::max();  ///< the index; the largest number where not valid

    constexpr Id() = default;
    /// Makes a valid id. Precondition: the index is less than 2^32 - 1.
    constexpr explicit Id(std::size_t index) : value(static_cast<std::uint32_t>(index)) {}
    /// Returns whether the id has an index.
    constexpr bool valid() const { return value != std::numeric_limits<std::uint32_t>::max(); }
    /// Returns the index. Precondition: valid().
    constexpr std::size_t index() const { return value; }
    /// Orders ids by their indices.
    // NOLINTNEXTLINE(modernize-use-nullptr): clang-tidy 14 takes the 0 of the defaulted comparison for a null pointer
    friend constexpr auto operator<=>(Id, Id) = default;
};

using VertexId = Id<struct VertexTag>;      ///< index into an array of points
using TriangleId = Id<struct TriangleTag>;  ///< index into an array of triangles

/// A triangle; the vertices run counter-clockwise unless a comment says otherwise.
struct Triangle {
    VertexId v[3];  ///< its corners
    /// Returns whether two triangles list the same corners in the same order.
    friend constexpr bool operator==(const Triangle&, const Triangle&) = default;
};

/// A quadrilateral; the vertices run counter-clockwise.
struct Quad {
    VertexId v[4];  ///< its corners
};

/// A segment that is directed from a to b.
struct Segment {
    VertexId a;  ///< where it begins
    VertexId b;  ///< where it ends
    /// Orders segments by a, then by b.
    // NOLINTNEXTLINE(modernize-use-nullptr): clang-tidy 14 takes the 0 of the defaulted comparison for a null pointer
    friend constexpr auto operator<=>(const Segment&, const Segment&) = default;
};

}  // namespace lamina
