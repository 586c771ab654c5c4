// The borders of a constrained triangulation as straight lines that refinement may split: its segments, and the edges
// of its boundary that are no segments.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include <lamina/delaunay.hpp>
#include <lamina/point.hpp>

#include "core/predicates.hpp"
#include "delaunay/triangulate/triangles.hpp"

namespace lamina::delaunay {

/// Returns the larger coordinate of a point.
inline double magnitude(Point p) { return std::max(std::abs(p.x), std::abs(p.y)); }

/// Returns the length of the shortest edges into which refinement splits lines, given their coordinates and the extent
/// of the domain: rounding must not bend lines much, and sixth powers of lengths must not vanish.
inline double shortest_edge(double magnitude, double extent) {
    constexpr double share_of_magnitude = 0x1p-40, share_of_extent = 0x1p-120;
    return std::max(share_of_magnitude * magnitude, share_of_extent * extent);
}

/// Returns the distance from the line a-b below which vertices on both sides cannot be told apart: a triangle between
/// them that keeps an angle bound would have an edge on the line that is shorter than shortest_edge(), except near the
/// origin.
///
///       .------v----------.       where segments cross within rounding, or by mistake: v lies 1e-17 above a-b
///     a ------------------- b
inline double unresolved_distance(Point a, Point b) {
    constexpr double roundings = 1000;
    return roundings * core::epsilon * std::max(magnitude(a), magnitude(b));
}

/// Chains of lines nearly coincide where one runs beside another for at least 1 / this times their distance. What lies
/// between them would take some 2e4 triangles to keep an angle bound, which nobody wants of segments that are meant
/// to be one.
inline constexpr double coincidence_share = 1e-4;

/// Two lines, u-v and u-w, that meet at less than 60 degrees. The triangles between them lie counter-clockwise from v
/// to w.
struct SharpCorner {
    Index u, v, w;
};

/// An edge a-b of a triangle, and the vertex opposite.
struct SidedEdge {
    Index a, b, opposite;
};

/// The lines, and the vertices that split them. Vertices have the numbers of the triangulation that is refined.
class BorderLines {
public:
    /// Takes the segments of a triangulation first, in their order, then the edges of `tris` without a neighbour that
    /// are no segments. `points` are the vertices of `tris`, `parents` the segments of the user that the segments are
    /// pieces of.
    BorderLines(std::span<const Point> points, std::span<const Segment> segments, std::span<const Index> parents,
                const Tris& tris);

    /// Returns the line that the constrained edge a-b is a part of; no_index if it is a part of none.
    Index line_of_edge(Index a, Index b) const;
    /// Returns the line that vertex v splits; no_index for vertices that split none.
    Index line_of_vertex(Index v) const { return v < line_of_vertex_.size() ? line_of_vertex_[v] : no_index; }
    /// Returns whether two lines end at the same vertex, are the same, or lie on straight_chains() that are the same,
    /// meet at less than 60 degrees or nearly coincide.
    bool meet(Index l, Index m) const;
    /// Returns the unresolved_distance() from a line.
    double unresolved_distance(Index line) const { return unresolved_distances_[line]; }
    /// Notes that the new vertex v splits a line.
    void add_vertex(Index v, Index line);
    /// Returns the number of vertices that split lines.
    std::size_t splits() const { return splits_; }

    /// Returns the point that divides the edge a-b of a line: the middle or, if one end is a corner at which lines meet
    /// at less than 90 degrees, the point on a circle round that end whose radius is a power of two. Each side keeps at
    /// least a third. Source: J. Ruppert, J. Algorithms 18 (1995), "corner lopping".
    Point division_point(std::span<const Point> points, Index a, Index b) const;
    /// Returns whether lines meet at vertex v at less than 90 degrees.
    bool is_acute(Index v) const { return v < acute_.size() && acute_[v] != 0; }

    /// Returns whether the edge joins lines, which its vertices split or end, that meet at less than 60 degrees at a
    /// corner that is opposite, or where the line of one of the three vertices ends; or lines of straight chains that
    /// meet so at any vertex.
    bool join_sharp_lines(std::span<const Point> points, const SidedEdge& edge) const;
    /// Returns whether the edge joins such lines, and its vertices are at the same distance from the corner, or the
    /// corner is opposite. A narrow triangle whose shortest edge this is is then left as it is. Source: G. Miller, S.
    /// Pav, N. Walkington, Int. J. Comput. Geom. Appl. 15 (2005).
    bool join_shells(std::span<const Point> points, const SidedEdge& edge) const;
    /// Returns the vertex at which a line, or its straight chain, meets, at less than 60 degrees, a line or chain that
    /// vertex p splits or ends; no_index if there is none.
    Index facing_corner(std::span<const Point> points, Index line, Index p) const;
    /// Returns whether vertex p splits, ends or divides a chain that nearly coincides with that of a line
    /// (coincidence_share).
    bool nearly_coincide(Index line, Index p) const;
    /// Returns whether two vertices of a triangle split, end or divide chains that nearly coincide, and the third one
    /// such a chain or another that nearly coincides with one of them.
    bool lies_between_coincident_chains(const Tri& tri) const;
    /// Returns whether p lies between the lines of a sharp corner at vertex u. Exact.
    bool in_sharp_corner(std::span<const Point> points, Index u, Point p) const;

    /// Returns, for each line, its vertices from one end to the other.
    std::vector<std::vector<Index>> chains(std::span<const Point> points) const;

private:
    void find_corners(std::span<const Point> points, const Tris& tris);
    /// Returns the line that ends at this corner and that v splits or ends; no_index if there is none.
    Index line_from(Index corner, Index v) const;
    /// Returns whether lines of a and b meet at this corner at less than 60 degrees.
    bool is_sharp_apex(std::span<const Point> points, Index corner, Index a, Index b) const;
    /// Returns the corner that join_sharp_lines() speaks of; no_index if there is none.
    Index sharp_apex(std::span<const Point> points, const SidedEdge& edge) const;

    /// A vertex where two chains meet at less than 60 degrees.
    struct ChainCorner {
        Index first, second;  ///< the chains, the smaller number first
        Index vertex;
        friend bool operator==(const ChainCorner&, const ChainCorner&) = default;
        friend bool operator<(const ChainCorner& l, const ChainCorner& r) {
            return std::tie(l.first, l.second, l.vertex) < std::tie(r.first, r.second, r.vertex);
        }
    };
    void find_chain_corners();
    /// Returns the corners of two chains.
    std::span<const ChainCorner> chain_corners(Index chain, Index other) const;
    /// Returns the chains that a vertex splits, ends or divides; none where none meet or coincide.
    std::span<const Index> chains_at(Index v) const;
    Index chain_apex(std::span<const Point> points, Index a, Index b) const;

    /// Two chains that nearly coincide, the smaller number first.
    using ChainPair = std::pair<Index, Index>;
    void find_coincident_chains(std::span<const Point> points, const Tris& tris);
    std::vector<ChainPair> chains_of_flat_triangles(std::span<const Point> points, const Tris& tris, double flat) const;
    std::vector<Segment> chain_ends(std::span<const Point> points) const;
    void list_chains_at_ends();
    bool are_coincident(Index chain, Index other) const;

    std::vector<Segment> lines_;                            ///< the ends of each line
    std::vector<double> unresolved_distances_;              ///< from each line
    std::vector<std::pair<std::uint64_t, Index>> by_ends_;  ///< undirected_key() of the ends and the line, sorted
    std::vector<Index> line_of_vertex_;                     ///< for each vertex; vertices behind the end split none
    std::size_t splits_ = 0;
    std::vector<char> acute_;                 ///< for each vertex at first: whether lines meet at less than 90 degrees
    std::vector<SharpCorner> sharp_corners_;  ///< sorted by u
    std::vector<Index> chain_of_line_;        ///< straight_chains()
    /// Sorted; only those of which one chain at least has several lines.
    std::vector<ChainCorner> chain_corners_;
    std::vector<ChainPair> coincident_;     ///< sorted
    std::vector<Index> chains_of_ends_;     ///< of all vertices of the input, one vertex after another
    std::vector<std::size_t> first_chain_;  ///< for each of these vertices; and the end
};

}  // namespace lamina::delaunay
