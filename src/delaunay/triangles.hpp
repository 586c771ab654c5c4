// The kernel's only data structure: triangles that know their neighbours, in one flat array.
//
//              v[0]                 Edge e lies opposite vertex e and runs from v[e+1] to v[e+2]
//              /  \.                (indices modulo 3), so that the triangle is on its left.
//      edge 2 /    \ edge 1         n[e] is the link across edge e.
//            /      \.
//        v[1] ------ v[2]           24 bytes a triangle.
//             edge 0
//
// A link is the neighbour's index and its edge in 32 bits: triangle << 3 | fixed << 2 | edge. Fixed edges are
// constraints: no cavity reaches across them. `Link::border()` stands where there is no neighbour.
// During plain triangulation the outside of the hull is filled with ghost triangles (a, b, ghost_vertex), so that every
// edge has two triangles; the real edge a-b of a ghost has the outside on its left.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <lamina/point.hpp>

namespace lamina::delaunay {

using Index = std::uint32_t;

inline constexpr Index no_index = 0xffffffffu;
inline constexpr Index ghost_vertex = no_index;
inline constexpr Index max_triangles = 1u << 29;

constexpr unsigned next(unsigned e) { return e == 2 ? 0 : e + 1; }
constexpr unsigned previous(unsigned e) { return e == 0 ? 2 : e - 1; }

class Link {
public:
    constexpr Link() = default;
    constexpr Link(Index triangle, unsigned edge, bool fixed = false)
        : bits_(triangle << 3 | static_cast<Index>(fixed) << 2 | edge) {}
    static constexpr Link border() { return {}; }

    constexpr bool is_border() const { return bits_ == no_index; }
    /// True for constraints and borders: where a cavity ends.
    constexpr bool is_constrained() const { return (bits_ & 4u) != 0; }
    constexpr Index triangle() const { return bits_ >> 3; }
    constexpr unsigned edge() const { return bits_ & 3u; }
    constexpr Link fixed() const {
        Link l;
        l.bits_ = bits_ | 4u;
        return l;
    }
    friend constexpr bool operator==(Link, Link) = default;

private:
    Index bits_ = no_index;
};

struct Tri {
    Index v[3];
    Link n[3];

    bool is_ghost() const { return v[0] == ghost_vertex || v[1] == ghost_vertex || v[2] == ghost_vertex; }
};
static_assert(sizeof(Tri) == 24);

using Tris = std::vector<Tri>;

/// Makes `inside` and what lies at `outer` neighbours; `inside` inherits the fixedness of `outer`.
inline void connect(Tris& tris, Index triangle, unsigned edge, Link outer) {
    tris[triangle].n[edge] = outer;
    if (!outer.is_border()) tris[outer.triangle()].n[outer.edge()] = Link(triangle, edge, outer.is_constrained());
}

}  // namespace lamina::delaunay
