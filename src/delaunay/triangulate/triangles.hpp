// The one data structure of the triangulation code: triangles that know their neighbours, in one flat array.
//
//              v[0]                 Edge e lies opposite vertex e and runs from v[e+1] to v[e+2] (indices modulo 3),
//              /  \.                so the triangle is on the left of its edges. n[e] is the link across edge e.
//      edge 2 /    \ edge 1
//            /      \.              A triangle takes 24 bytes.
//        v[1] ------ v[2]
//             edge 0
//
// A link packs the neighbour's index and edge into 32 bits: triangle << 3 | constrained << 2 | edge. No cavity reaches
// across a constrained edge. Link::border() stands where there is no neighbour.
// During plain triangulation ghost triangles (a, b, ghost_vertex) fill the outside of the hull, so every edge has two
// triangles. The hull edge a-b of a ghost has the outside on its left.
#pragma once

#include <array>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <lamina/point.hpp>

namespace lamina::delaunay {

using Index = std::uint32_t;

/// Stands where there is no index.
inline constexpr Index no_index = 0xffffffffu;
/// The vertex at infinity, the third one of every ghost triangle.
inline constexpr Index ghost_vertex = no_index;
/// The number of triangles that a Link can tell apart.
inline constexpr Index max_triangles = 1u << 29;

/// Return the edge after edge e = 0, 1, 2 of a triangle, and the one before it: 1, 2, 0 and 2, 0, 1, read from two bits
/// each. Branches would be predicted wrongly in every third case.
constexpr unsigned next(unsigned e) { return 0b00'10'01u >> 2 * e & 3u; }
constexpr unsigned previous(unsigned e) { return 0b01'00'10u >> 2 * e & 3u; }

/// Returns a number that orders pairs of indices by a, then by b.
constexpr std::uint64_t directed_key(Index a, Index b) { return std::uint64_t{a} << 32 | b; }

/// Returns a number that tells pairs of indices apart, whatever their order.
constexpr std::uint64_t undirected_key(Index a, Index b) { return a < b ? directed_key(a, b) : directed_key(b, a); }

/// A neighbour across an edge, or one edge of a triangle.
class Link {
public:
    constexpr Link() = default;
    constexpr Link(Index triangle, unsigned edge, bool constrained = false)
        : bits_(triangle << 3 | static_cast<Index>(constrained) << 2 | edge) {}
    /// Returns the link that stands where there is no neighbour.
    static constexpr Link border() { return {}; }

    constexpr bool is_border() const { return bits_ == no_index; }
    /// Returns true for constrained edges and for borders: cavities end at both.
    constexpr bool is_constrained() const { return (bits_ & 4u) != 0; }
    constexpr Index triangle() const { return bits_ >> 3; }
    constexpr unsigned edge() const { return bits_ & 3u; }
    /// Returns the same link across a constrained edge.
    constexpr Link constrained() const {
        Link link;
        link.bits_ = bits_ | 4u;
        return link;
    }
    /// Returns the same link across an edge that is not constrained. Precondition: it is not border().
    constexpr Link unconstrained() const {
        Link link;
        link.bits_ = bits_ & ~4u;
        return link;
    }
    friend constexpr bool operator==(Link, Link) = default;

private:
    Index bits_ = no_index;
};

/// A triangle with its neighbours. Results of public functions hold a plain Triangle (ids.hpp) instead.
struct Tri {
    Index v[3];
    Link n[3];

    bool is_ghost() const { return v[0] == ghost_vertex || v[1] == ghost_vertex || v[2] == ghost_vertex; }
};
static_assert(sizeof(Tri) == 24);

/// Returns whether a vertex is a corner of a triangle.
inline bool has_corner(const Tri& t, Index v) { return t.v[0] == v || t.v[1] == v || t.v[2] == v; }
/// Returns which corner of a triangle a vertex is. Precondition: has_corner(t, v).
inline unsigned corner_of(const Tri& t, Index v) { return t.v[0] == v ? 0 : t.v[1] == v ? 1 : 2; }

using Tris = std::vector<Tri>;

/// Returns whether a link is that of a border, or of an edge of one of the triangles. For assertions.
inline bool is_in_range(const Tris& tris, Link link) {
    return link.is_border() || (link.triangle() < tris.size() && link.edge() < 3);
}

/// Returns whether edge e of triangle t is a border, or the triangle behind it has the same edge, the other way round,
/// and knows t behind it, constrained or not as t does. For assertions.
inline bool is_linked(const Tris& tris, Index t, unsigned e) {
    const Link across = tris[t].n[e];
    if (across.is_border()) return true;
    if (!is_in_range(tris, across)) return false;
    const Tri& other = tris[across.triangle()];
    const unsigned k = across.edge();
    return other.n[k] == Link(t, e, across.is_constrained()) && other.v[next(k)] == tris[t].v[previous(e)] &&
           other.v[previous(k)] == tris[t].v[next(e)];
}

/// Returns the same for all edges of a triangle. For assertions.
inline bool is_linked(const Tris& tris, Index t) {
    return t < tris.size() && is_linked(tris, t, 0) && is_linked(tris, t, 1) && is_linked(tris, t, 2);
}

/// Returns the same for all triangles. For assertions where all of them were written.
inline bool are_linked(const Tris& tris) {
    for (Index t = 0; t < tris.size(); ++t)
        if (!is_linked(tris, t)) return false;
    return true;
}

/// Makes an edge of `triangle` and the edge behind `outer` neighbours. The edge becomes constrained if `outer` is.
inline void connect(Tris& tris, Index triangle, unsigned edge, Link outer) {
    assert(triangle < tris.size() && edge < 3);
    assert(is_in_range(tris, outer) && outer != Link(triangle, edge, outer.is_constrained()));
    tris[triangle].n[edge] = outer;
    if (!outer.is_border()) tris[outer.triangle()].n[outer.edge()] = Link(triangle, edge, outer.is_constrained());
}

/// Makes an edge constrained, as both of its triangles know it.
inline void constrain_edge(Tris& tris, Index triangle, unsigned edge) {
    assert(is_linked(tris, triangle, edge));
    connect(tris, triangle, edge, tris[triangle].n[edge].constrained());
}

/// Makes an edge with two triangles one that cavities may reach across.
inline void release_edge(Tris& tris, Index triangle, unsigned edge) {
    assert(!tris[triangle].n[edge].is_border() && is_linked(tris, triangle, edge));
    connect(tris, triangle, edge, tris[triangle].n[edge].unconstrained());
}

/// Replaces the two triangles at edge e of t by those on the other diagonal of their quadrilateral: triangle t becomes
/// (c, a, d) and its neighbour n (c, d, b). Flipping edge 1 of t undoes it, but for the order of vertices and for which
/// of the two is t. Precondition: the edge is not constrained.
///
///         c                 c
///        / \               /|\.
///       / t \             / | \.
///      a-----b           a t|n b
///       \ n /             \ | /
///        \ /               \|/
///         d                 d
void flip_edge(Tris& tris, Index t, unsigned e);

/// Returns the same triangles in an order, and with first vertices, that depend on where the vertices lie and not on
/// their numbers. Precondition: the vertices are distinct.
Tris in_order_of_place(std::span<const Point> points, const Tris& tris);

/// Returns one triangle, any one, at each vertex; no_index for vertices without triangles.
std::vector<Index> triangle_at_vertex(const Tris& tris, std::size_t point_count);

/// Returns the triangle on the left of the directed edge a -> b, and which of its edges that is; border() if a-b is no
/// edge. Turns round a and, if it has many triangles, round b at the same time. Precondition: both are surrounded by
/// triangles, ghosts among them.
Link find_edge(const Tris& tris, const std::vector<Index>& at_vertex, Index a, Index b);

}  // namespace lamina::delaunay
