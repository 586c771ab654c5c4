// Neighbours in a list of triangles, as the code that makes the triangles hands them over.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace lamina::core {

/// Edge i of triangle t of a list: 4 t + i. Where nothing else is said, edge i leads from vertex i to the next one. A
/// list has less than 2^30 triangles.
using EdgeLink = std::uint32_t;
/// Stands where there is no neighbour.
inline constexpr EdgeLink no_link = std::numeric_limits<EdgeLink>::max();

constexpr EdgeLink edge_link(std::size_t triangle, unsigned edge) {
    return static_cast<EdgeLink>(triangle << 2) | edge;
}
constexpr std::uint32_t triangle_of(EdgeLink link) { return link >> 2; }
constexpr unsigned edge_of(EdgeLink link) { return link & 3u; }

/// The neighbours of all triangles of a list: entry 3 t + i is the edge of the neighbour across edge i of triangle t.
using EdgeLinks = std::vector<EdgeLink>;

}  // namespace lamina::core
