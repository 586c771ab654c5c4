// Strong ids: an index that says what it is an index of. 32 bits address 4.29e9 vertices and 8.6e9 triangles, far
// beyond memory; counts and offsets are std::size_t.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>

namespace lamina {

template <class Tag>
struct Id {
    std::uint32_t value = std::numeric_limits<std::uint32_t>::max();

    constexpr Id() = default;
    constexpr explicit Id(std::size_t index) : value(static_cast<std::uint32_t>(index)) {}
    constexpr bool valid() const { return value != std::numeric_limits<std::uint32_t>::max(); }
    constexpr std::size_t index() const { return value; }
    friend constexpr auto operator<=>(Id, Id) = default;
};

using VertexId = Id<struct VertexTag>;      ///< a point of the array at hand
using TriangleId = Id<struct TriangleTag>;  ///< a triangle of the array at hand

/// The vertices run counter-clockwise unless a comment says otherwise.
struct Triangle {
    VertexId v[3];
    friend constexpr bool operator==(const Triangle&, const Triangle&) = default;
};

/// A quadrilateral; the vertices run counter-clockwise.
struct Quad {
    VertexId v[4];
};

/// A segment that is directed from a to b.
struct Segment {
    VertexId a, b;
    friend constexpr auto operator<=>(const Segment&, const Segment&) = default;
};

}  // namespace lamina
