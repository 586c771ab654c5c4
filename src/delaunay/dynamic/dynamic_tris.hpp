// The triangles behind DynamicTriangulation, and the changes of one point or segment. Vertices are numbered from 1;
// vertex 0 is the one at infinity, whose ghosts close the hull.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include <lamina/ids.hpp>
#include <lamina/point.hpp>

#include "delaunay/cavity.hpp"
#include "delaunay/insert_segments.hpp"
#include "delaunay/triangles.hpp"

namespace lamina::delaunay::dynamic {

/// A constrained Delaunay triangulation that changes. Between changes
///   - the triangles are those of the vertices that are alive, closed by ghosts; or there are none, where all of these
///     lie on one line,
///   - every edge that is not constrained is locally Delaunay by the tie rule, and
///   - at_vertex() is a triangle there for each vertex alive, and for the one at infinity, if there are triangles.
class DynamicTris {
public:
    DynamicTris();

    std::span<const Point> vertices() const { return vertices_; }
    const Tris& tris() const { return tris_; }
    bool is_alive(Index v) const { return v < alive_.size() && alive_[v]; }
    std::size_t alive_count() const { return alive_count_; }
    Point at(Index v) const { return vertices_[v]; }

    /// Appends vertices that are not alive. Returns the number of the first.
    Index append(std::span<const Point> points);
    /// Forgets the last vertex. Precondition: it is not alive.
    void drop_last();
    /// Makes the vertex part of the triangulation, near a vertex that is alive. Returns the vertex, or the one that is
    /// there already. Precondition: there are triangles.
    Index insert(Index v, Index near);
    /// Makes vertices alive and, if they and those alive do not all lie on one line, the first triangles. Returns for
    /// each the vertex that is there. Precondition: there are no triangles.
    std::vector<Index> insert_without_triangles(std::span<const Index> vertices);
    /// Removes a vertex that is alive and an end of no constrained edge.
    void remove(Index v);
    /// Returns whether the vertex is an end of a constrained edge.
    bool has_constrained_edge(Index v) const;

    /// Inserts a segment as insert_segment() does. Where it crosses a constrained edge nothing changes.
    std::optional<CrossedEdge> insert_segment(Segment segment, std::vector<SegmentPiece>& pieces);
    /// Returns the constrained edges on the straight way from a to b, each by a triangle that has it; nothing if the way
    /// does not consist of them.
    std::optional<std::vector<Link>> find_constrained_way(Index a, Index b) const;
    /// Makes constrained edges others, and flips edges until the triangulation is constrained Delaunay again.
    void release(std::span<const Link> edges);

    /// Returns the vertex at p, if there is one. `near` is a vertex alive.
    std::optional<Index> find(Point p, Index near) const;
    /// Returns a vertex alive that is likely to be near p: the nearest of a sample and, if it is alive, of `hint`.
    /// Precondition: there is one.
    Index sample_near(Point p, Index hint) const;

private:
    /// A corner of the polygon that is left where a vertex is removed.
    struct StarCorner {
        Index vertex;
        Link outer;  ///< the triangle across the polygon's edge from this corner to the next
        Index before = 0, after = 0;
        bool is_cut = false;
    };
    struct Ear;

    Index triangle_at(Index v) const;
    Index walk_from(Index near, Point p) const;
    void make_first_triangle(Index a, Index b, Index c);
    std::vector<Index> collect_star(Index v, std::vector<StarCorner>& star) const;
    std::optional<Ear> make_ear(const std::vector<StarCorner>& star, Index corner, Point removed) const;
    Index cut_ears(std::vector<StarCorner>& star, Point removed, std::size_t least_corners, std::vector<Index>& places);
    void close_inner(const std::vector<StarCorner>& star, Index first, std::vector<Index>& places);
    void close_hull(const std::vector<StarCorner>& star, std::vector<Index>& places);
    void set_triangle(Index t, Index a, Index b, Index c);
    void flip_until_delaunay();
    void free_place(Index t);

    std::vector<Point> vertices_;
    std::vector<char> alive_;
    std::size_t alive_count_ = 0;
    Tris tris_;
    std::vector<Index> at_vertex_;
    Cavity cavity_;
    std::vector<Link> to_check_;  ///< edges that may not be locally Delaunay
};

}  // namespace lamina::delaunay::dynamic
