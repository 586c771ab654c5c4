// Trimming of dividing paths: J. K. Pardue, thesis (2015), 6.7.
//
//             path
//               :               The edges of the path inside the region (+) become border of both parts. Its edges
//               :   outside     outside of the region (:), beyond the outer border or through a body, become border of
//      ---------o---------      neither. The path changes between inside and outside at vertices of the border only. An
//         low   +   high        edge of the border (-) belongs to the part on whose side of the path it lies; none may
//      ---------o---------      cross the path.
//               :   body
//      ---------o---------
//         low   +   high
#include "delaunay/pieces/divide_border.hpp"

#include <algorithm>
#include <memory>
#include <span>

#include "core/predicates.hpp"
#include "delaunay/pieces/vertex_index_map.hpp"

namespace lamina::delaunay::pieces {

namespace {

/// The side of the path on which an edge lies.
enum class Side { low, high, crossing };

/// A path in the frame of its cut.
class FramedPath {
public:
    FramedPath(const SortedPoints& sorted, std::span<const Index> vertices, CutLine cut)
        : sorted_(sorted), cut_(cut), frame_{cut.axis}, indices_(vertices) {
        for (const Index v : vertices) {
            points_.push_back(point(v));
            extent_.include(points_.back());
        }
    }

    Point point(Index i) const { return frame_(sorted_.points[i]); }
    /// Returns the index of a point on the path, or not_found.
    std::size_t index_of(Index i) const { return indices_.find(i); }

    /// Returns the side of an edge that lies clear of the path's box in the direction across, as most edges do.
    std::optional<Side> clear_side(BorderEdge e) const {
        const double a = point(e.a).x, b = point(e.b).x;
        if (std::max(a, b) < extent_.lower.x) return Side::low;
        if (std::min(a, b) > extent_.upper.x) return Side::high;
        return {};
    }

    /// Returns the side of an edge that is no edge of the path. `index_a` and `index_b` are the indices of its ends on
    /// the path.
    Side side_of(BorderEdge e, std::size_t index_a, std::size_t index_b) const {
        std::optional<Side> side;
        const auto agree = [&](Side s) {
            if (!side) side = s;
            return *side == s;
        };
        // A point that is not on the path lies on the same side of the path as of the cut line.
        if (index_a == not_found) side = before_cut(e.a) ? Side::low : Side::high;
        if (index_b == not_found && !agree(before_cut(e.b) ? Side::low : Side::high)) return Side::crossing;
        // The vertices of the path between the ends of the edge must all lie on its other side.
        Point a = point(e.a), b = point(e.b);
        if (a.y > b.y) std::swap(a, b);
        const auto first = std::partition_point(points_.begin(), points_.end(), [&](Point p) { return p.y <= a.y; });
        for (auto p = first; p != points_.end() && p->y < b.y; ++p) {
            const double turn = core::inline_orient2d(a, b, *p);
            if (turn == 0 || !agree(turn < 0 ? Side::low : Side::high)) return Side::crossing;
        }
        return side.value_or(Side::crossing);
    }

private:
    bool before_cut(Index i) const {
        return cut_.axis == Axis::x ? i < cut_.at : sorted_.y_rank[i] < sorted_.y_rank[cut_.at];
    }

    const SortedPoints& sorted_;
    CutLine cut_;
    CutFrame frame_;
    Box extent_;
    std::vector<Point> points_;
    VertexIndexMap indices_;
};

/// An edge of the border at a vertex of the path, seen from that vertex.
struct IncidentEdge {
    std::size_t path_index;  ///< of the vertex
    Index other;             ///< the other end of the edge
    bool leaves;  ///< the border runs from the vertex to `other`: the region begins counter-clockwise of the edge
};

/// Sorts the edges by their vertex of the path, stably.
std::vector<IncidentEdge> sorted_by_path_vertex(const std::vector<IncidentEdge>& edges, std::size_t path_vertices) {
    std::vector<std::size_t> starts(path_vertices + 1, 0);
    for (const IncidentEdge& e : edges) ++starts[e.path_index + 1];
    for (std::size_t p = 1; p < starts.size(); ++p) starts[p] += starts[p - 1];
    std::vector<IncidentEdge> sorted(edges.size());
    for (const IncidentEdge& e : edges) sorted[starts[e.path_index]++] = e;
    return sorted;
}

/// Returns whether a clockwise turn round `center` that starts at `from` meets x before y. It meets points in the
/// direction of `from` itself last.
bool met_before(Point center, Point from, Point x, Point y) {
    const auto half = [&](Point p) {
        const double turn = core::inline_orient2d(center, from, p);
        if (turn != 0) return turn < 0 ? 0 : 2;
        return dot(from - center, p - center) < 0 ? 1 : 3;
    };
    const int half_x = half(x), half_y = half(y);
    return half_x != half_y ? half_x < half_y : core::inline_orient2d(center, x, y) < 0;
}

/// Returns whether the region lies in the direction of `to`, seen from a vertex of its border: whether the first border
/// edge clockwise from there leaves the vertex. `edges` are all border edges at the vertex.
bool leads_inside(const FramedPath& path, Index vertex, Index to, std::span<const IncidentEdge> edges) {
    const Point center = path.point(vertex), from = path.point(to);
    const auto first = std::min_element(edges.begin(), edges.end(), [&](const IncidentEdge& l, const IncidentEdge& r) {
        return met_before(center, from, path.point(l.other), path.point(r.other));
    });
    return first->leaves;
}

/// Builds the borders of both parts: from all edges of the border first, then from the path.
class BorderDivider {
public:
    BorderDivider(const SortedPoints& sorted, std::span<const Index> vertices, CutLine cut)
        : vertices_(vertices), path_(sorted, vertices, cut), along_border_(vertices.size(), 0) {
        borders_.low.has_path_vertex.assign(vertices.size(), 0);
        borders_.high.has_path_vertex.assign(vertices.size(), 0);
    }

    /// Adds an edge of the border to the part on its side of the path. Returns false where it crosses the path.
    bool add_border_edge(BorderEdge e) {
        if (const std::optional<Side> side = path_.clear_side(e)) {
            part(*side).edges.push_back(e);
            return true;
        }
        const std::size_t a = path_.index_of(e.a), b = path_.index_of(e.b);
        if (a != not_found) incident_.push_back({a, e.b, true});
        if (b != not_found) incident_.push_back({b, e.a, false});
        const Side side = is_path_edge(a, b) ? (a < b ? Side::low : Side::high) : path_.side_of(e, a, b);
        if (side == Side::crossing) return false;
        if (is_path_edge(a, b)) along_border_[std::min(a, b)] = 1;
        HalfBorder& own = part(side);
        own.edges.push_back(e);
        if (a != not_found) own.has_path_vertex[a] = 1;
        if (b != not_found) own.has_path_vertex[b] = 1;
        return true;
    }

    /// Adds the edges of the path that run inside the region to both parts.
    void add_path_edges() {
        const std::vector<IncidentEdge> incident = sorted_by_path_vertex(incident_, vertices_.size());
        auto next = incident.begin();
        for (std::size_t i = 0; i + 1 < vertices_.size(); ++i) {
            const auto first = next;
            while (next != incident.end() && next->path_index == i) ++next;
            const bool ends_on_border = first != next && next != incident.end() && next->path_index == i + 1;
            if (along_border_[i]) continue;
            // All points off the border lie inside the region, and so does a path edge with one of them at its end.
            const std::span at_vertex(std::to_address(first), static_cast<std::size_t>(next - first));
            if (ends_on_border && !leads_inside(path_, vertices_[i], vertices_[i + 1], at_vertex)) continue;
            borders_.low.edges.push_back({vertices_[i], vertices_[i + 1]});
            borders_.high.edges.push_back({vertices_[i + 1], vertices_[i]});
            for (const std::size_t end : {i, i + 1})
                borders_.low.has_path_vertex[end] = borders_.high.has_path_vertex[end] = 1;
        }
    }

    DividedBorder take() { return std::move(borders_); }

private:
    HalfBorder& part(Side side) { return side == Side::low ? borders_.low : borders_.high; }

    /// Returns whether vertices with these indices on the path, which may be not_found, are neighbours on it.
    static bool is_path_edge(std::size_t a, std::size_t b) {
        return a != not_found && b != not_found && (a + 1 == b || b + 1 == a);
    }

    std::span<const Index> vertices_;
    FramedPath path_;
    DividedBorder borders_;
    std::vector<IncidentEdge> incident_;
    std::vector<char> along_border_;  ///< for each vertex: whether the path edge from it to the next is a border edge
};

}  // namespace

std::optional<DividedBorder> divide_border(const SortedPoints& sorted, std::span<const BorderEdge> border,
                                           std::span<const Index> path, CutLine cut) {
    BorderDivider divider(sorted, path, cut);
    for (const BorderEdge e : border)
        if (!divider.add_border_edge(e)) return {};
    divider.add_path_edges();
    return divider.take();
}

}  // namespace lamina::delaunay::pieces
