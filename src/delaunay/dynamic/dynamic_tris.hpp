// The triangles behind DynamicTriangulation, and the changes of one point or segment. Vertices are numbered from 1;
// vertex 0 is the one at infinity, whose ghosts close the hull.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include <lamina/ids.hpp>
#include <lamina/point.hpp>

#include "delaunay/constrain/insert_segments.hpp"
#include "delaunay/triangulate/cavity.hpp"
#include "delaunay/triangulate/triangles.hpp"

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
    /// Makes the vertices from `first` on alive and, if they and those alive do not all lie on one line, triangles.
    /// Returns for each of them the vertex that is there. Precondition: there are no triangles.
    std::vector<Index> insert_without_triangles(Index first);
    /// Removes a vertex that is alive and an end of no constrained edge.
    void remove(Index v);
    /// Returns whether the vertex is an end of a constrained edge.
    bool has_constrained_edge(Index v) const;

    /// Inserts a segment as insert_segment() does. Where it crosses a constrained edge nothing changes.
    std::optional<CrossedEdge> insert_segment(Segment segment, std::vector<SegmentPiece>& pieces);
    /// Returns the constrained edges on the straight way from a to b, each by a triangle that has it; nothing if the
    /// way does not consist of them.
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
    /// An ear that may be cut off. Those with the smallest height come first.
    struct Ear {
        double height;
        Index corner, before, after;
        friend bool operator<(const Ear& l, const Ear& r) {
            return l.height != r.height ? l.height > r.height : l.corner > r.corner;
        }
    };

    Index triangle_at(Index v) const;
    Index walk_from(Index near, Point p) const;
    void insert_all(std::span<const Index> sequence);
    void make_first_triangle(Index a, Index b, Index c);
    void collect_star(Index v);
    void add_ear(Index corner, Point removed);
    Index cut_ears(Point removed, std::size_t least_corners);
    void close_inner(Index first);
    void close_hull();
    void set_triangle(Index t, Index a, Index b, Index c);
    void flip_until_delaunay();
    void free_place(Index t);

    std::vector<Point> vertices_;
    std::vector<char> alive_;
    std::size_t alive_count_ = 0;
    bool had_segments_ = false;  ///< whether an edge may be constrained
    Tris tris_;
    std::vector<Index> at_vertex_;
    Cavity cavity_;
    std::vector<Link> to_check_;  ///< edges that may not be locally Delaunay
    // Scratch space of remove().
    std::vector<StarCorner> star_;  ///< the polygon round the vertex, counter-clockwise
    std::vector<Index> places_;     ///< the triangles round it, whose places new ones take
    std::vector<Ear> ears_;         ///< a heap; some have been cut off or changed
};

}  // namespace lamina::delaunay::dynamic
