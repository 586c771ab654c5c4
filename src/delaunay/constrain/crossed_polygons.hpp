// The polygons on the two sides of a segment, which are triangulated anew once the triangles that the segment crosses
// are removed.
//
//        w0 ---- w1 ------- w2
//       /  \    /  \      /    \        left chain   a w0 w1 w2 b
//      a ---\--/----\----/----- b       right chain  a u0 u1 b
//       \    \/      \  /      /
//        u0 ---------- u1 ----         Each polygon lies between its chain and its base, the segment a-b.
//
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <lamina/point.hpp>

#include "delaunay/triangulate/reach.hpp"
#include "delaunay/triangulate/triangles.hpp"

namespace lamina::delaunay {

/// Collects the crossed triangles and the chains of one segment after another, and fills their polygons.
class CrossedPolygons {
public:
    /// Keeps references to its arguments. `at_vertex` holds a triangle at each vertex and is kept up to date for those
    /// within reach. Precondition: crossed triangles are within reach.
    CrossedPolygons(std::span<const Point> points, const Reach& reach, Tris& tris, std::vector<Index>& at_vertex)
        : points_(points), reach_(reach), tris_(tris), at_vertex_(at_vertex) {}

    /// Forgets the last segment.
    void clear();
    void add_crossed(Index triangle) { crossed_.push_back(triangle); }
    /// Appends an edge of a crossed triangle to a chain. Both chains run from a to b.
    void add_left(Index triangle, unsigned edge) { add(left_, triangle, edge); }
    void add_right(Index triangle, unsigned edge) { add(right_, triangle, edge); }

    /// Replaces the crossed triangles by triangulations of both polygons, which a constrained edge a-b separates.
    void fill();

private:
    /// An edge of a chain. Both of its sides may belong to the polygon: such an edge dangles, and stands in the list of
    /// chain edges twice.
    struct ChainEdge {
        Index a, b;
        Link inside;               ///< the crossed triangle, and its edge, that the edge was seen from
        Link outer;                ///< the triangle on the other side
        Index partner = no_index;  ///< index of the other side's entry, if the edge dangles
        Link filled;               ///< the new triangle on the inside, once it is made
    };

    /// A part of a polygon: between the chain's vertices from `low` to `high` and the line that joins them.
    struct ChainRange {
        std::size_t low, high;  ///< indices into vertices_; the polygon lies on the left of low -> high
        Link base;              ///< the new triangle on the other side of that line; border() at the segment
    };

    void add(std::vector<Index>& chain, Index triangle, unsigned edge);
    void pair_dangling_edges();
    Link fill_chain();
    Link fill_ranges();
    Link fill_long_range(std::size_t low, std::size_t high);
    std::vector<Index> replace_crossed(const Tris& inside, std::span<const Index> global);
    std::size_t opposite_vertex(std::size_t low, std::size_t high) const;
    void attach(Index chain_edge, Index triangle, unsigned edge);
    void set_triangle_at(Index vertex, Index triangle) {
        if (reach_.has_vertex_of_triangle(vertex)) at_vertex_[vertex] = triangle;
    }

    std::span<const Point> points_;
    const Reach& reach_;
    Tris& tris_;
    std::vector<Index>& at_vertex_;

    std::vector<Index> crossed_;       ///< triangles to be removed, whose places in the array new ones take
    std::vector<ChainEdge> edges_;     ///< edges of both chains
    std::vector<Index> left_, right_;  ///< indices into edges_, in the order from a to b
    std::vector<Index> chain_;         ///< the chain that is being filled, as indices into edges_
    std::vector<Index> vertices_;      ///< its vertices, one more than edges
    std::vector<ChainRange> ranges_;   ///< the parts of its polygon that are yet to be filled
};

}  // namespace lamina::delaunay
