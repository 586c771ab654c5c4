// Each polygon is filled with triangles from its base on.
// Source: M. V. Anglada, An improved incremental algorithm for constructing restricted Delaunay triangulations,
// Computers & Graphics 21 (1997). The opposite vertex of each base is chosen with the perturbed incircle test, so the
// result obeys the one tie rule.
#include "delaunay/constrain/crossed_polygons.hpp"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cstdint>
#include <utility>

#include <lamina/ids.hpp>

#include "core/predicates.hpp"
#include "delaunay/constrain/insert_segments.hpp"
#include "delaunay/constrain/regions.hpp"
#include "delaunay/triangulate/conditions.hpp"
#include "delaunay/triangulate/triangulate_points.hpp"

namespace lamina::delaunay {

namespace {

/// Returns whether the direction from u to x lies in the closed sector that opens counter-clockwise from the direction
/// to `from` to the direction to `to`.
bool in_sector(Point u, Point from, Point to, Point x) {
    if (from == to) return true;
    const double opening = core::inline_orient2d(u, from, to);
    if (opening >= 0) return core::inline_orient2d(u, from, x) >= 0 && core::inline_orient2d(u, x, to) >= 0;
    return !(core::inline_orient2d(u, to, x) > 0 && core::inline_orient2d(u, x, from) > 0);
}

/// Returns the constrained Delaunay triangulation of the inside of a polygon. Its border has the inside on its left.
Tris triangulate_polygon(std::span<const Point> vertices, std::span<const Segment> border) {
    Tris tris = triangulate_points(vertices);
    insert_segments(vertices, border, tris);
    return keep_left_of_segments({&border.back(), 1}, tris, vertices.size());
}

}  // namespace

void CrossedPolygons::clear() {
    crossed_.clear();
    edges_.clear();
    left_.clear();
    right_.clear();
}

void CrossedPolygons::add(std::vector<Index>& chain, Index triangle, unsigned edge) {
    const Tri& t = tris_[triangle];
    chain.push_back(static_cast<Index>(edges_.size()));
    edges_.push_back({t.v[next(edge)], t.v[previous(edge)], Link(triangle, edge), t.n[edge], no_index, {}});
}

void CrossedPolygons::fill() {
    // By Euler's formula so many edges surround the crossed triangles. Both chains run from a to b.
    assert(!crossed_.empty() && left_.size() + right_.size() == crossed_.size() + 2);
    assert(edges_[left_.front()].b == edges_[right_.front()].a && edges_[left_.back()].a == edges_[right_.back()].b);
    pair_dangling_edges();
    chain_ = left_;
    const Link left = fill_chain();
    // The right chain, walked from b to a, has its polygon on the same side as the left one.
    chain_.assign(right_.rbegin(), right_.rend());
    const Link right = fill_chain();
    connect(tris_, left.triangle(), left.edge(), right.constrained());
    // Both polygons have taken all places, and the segment is an edge that both sides know.
    assert(crossed_.empty() && tris_[left.triangle()].n[left.edge()].is_constrained());
    assert(is_linked(tris_, left.triangle(), left.edge()));
    assert(tris_[left.triangle()].v[next(left.edge())] == edges_[left_.front()].b);
    assert(tris_[left.triangle()].v[previous(left.edge())] == edges_[left_.back()].a);
}

/// Sets the partners of the chain edges whose other side is removed, too. The removed triangles serve as a table: their
/// links are overwritten by indices into the list of chain edges.
void CrossedPolygons::pair_dangling_edges() {
    // Two vertices of this number mark a removed triangle; a ghost has only one.
    for (Index t : crossed_) tris_[t].v[0] = tris_[t].v[1] = no_index;
    for (Index i = 0; i < edges_.size(); ++i) {
        const ChainEdge& edge = edges_[i];
        tris_[edge.inside.triangle()].n[edge.inside.edge()] = Link(i, 0);
    }
    for (ChainEdge& edge : edges_) {
        if (edge.outer.is_border()) continue;
        const Tri& t = tris_[edge.outer.triangle()];
        if (t.v[0] == no_index && t.v[1] == no_index) edge.partner = t.n[edge.outer.edge()].triangle();
    }
}

/// Triangulates the polygon between chain_ and its base, the line from the chain's first vertex to its last, which has
/// the polygon on its left. The new triangles take the places at the end of crossed_. Returns the new triangle at the
/// base, and its edge there.
Link CrossedPolygons::fill_chain() {
    // Seen from the crossed triangles the edges run against the chain, which has its polygon on the right.
    vertices_.assign(1, edges_[chain_.front()].b);
    for (Index e : chain_) {
        assert(edges_[e].b == vertices_.back());
        vertices_.push_back(edges_[e].a);
    }
    return fill_ranges();
}

/// Fills the polygon recursively. The vertex k whose circle with the base holds no other vertex of the chain makes the
/// triangle at the base; the parts on both sides of it are problems of the same kind. As in quicksort n edges usually
/// take O(n log n) steps. Where they take more because most parts are unequal, long parts are filled in another way.
///
///             k
///           /   \.
///       ../       \..
///      low ------- high
Link CrossedPolygons::fill_ranges() {
    constexpr std::size_t long_range = 100;
    std::size_t steps = 0;
    const std::size_t usual_steps = 4 * chain_.size() * static_cast<std::size_t>(std::bit_width(chain_.size()));
    Link at_base = Link::border();
    ranges_.assign(1, {0, chain_.size(), Link::border()});
    while (!ranges_.empty()) {
        const ChainRange r = ranges_.back();
        ranges_.pop_back();
        if (r.high - r.low >= long_range && (steps += r.high - r.low) > usual_steps) {
            const Link base = fill_long_range(r.low, r.high);
            if (r.base.is_border())
                at_base = base;
            else
                connect(tris_, base.triangle(), base.edge(), r.base);
            continue;
        }
        const std::size_t k = opposite_vertex(r.low, r.high);
        assert(!crossed_.empty());
        const Index t = crossed_.back();
        crossed_.pop_back();
        const Index v[3] = {vertices_[r.low], vertices_[r.high], vertices_[k]};
        for (unsigned i = 0; i < 3; ++i) {
            tris_[t].v[i] = v[i];
            tris_[t].n[i] = Link::border();
            set_triangle_at(v[i], t);
        }
        assert(is_counter_clockwise(points_, tris_[t]));
        if (r.base.is_border())
            at_base = Link(t, 2);
        else
            connect(tris_, t, 2, r.base);
        if (r.high == k + 1)
            attach(chain_[k], t, 0);
        else
            ranges_.push_back({k, r.high, Link(t, 0)});
        if (k == r.low + 1)
            attach(chain_[r.low], t, 1);
        else
            ranges_.push_back({r.low, k, Link(t, 1)});
    }
    assert(!at_base.is_border());
    return at_base;
}

/// Returns the index in vertices_, strictly between low and high, of the vertex that forms a triangle with low -> high:
/// it lies on the left, and no other such vertex lies in its circle. A vertex from which edges dangle stands in the
/// chain several times: then the entry counts whose interior angle faces the base.
std::size_t CrossedPolygons::opposite_vertex(std::size_t low, std::size_t high) const {
    const Index a = vertices_[low], b = vertices_[high];
    std::size_t k = low;
    for (std::size_t i = low + 1; i < high; ++i) {
        const Index v = vertices_[i];
        if (core::inline_orient2d(points_[a], points_[b], points_[v]) <= 0) continue;
        if (k == low ||
            (v == vertices_[k]
                 ? in_sector(points_[v], points_[vertices_[i - 1]], points_[vertices_[i + 1]], points_[a])
                 : core::inline_incircle_perturbed(points_[a], points_[b], points_[vertices_[k]], points_[v]) > 0))
            k = i;
    }
    assert(k != low);
    return k;
}

/// Connects a new triangle to the neighbour across a chain edge. Across an edge that dangles the neighbour is a new
/// triangle as well: the later one of the two connects both.
void CrossedPolygons::attach(Index chain_edge, Index triangle, unsigned edge) {
    ChainEdge& c = edges_[chain_edge];
    assert(c.filled.is_border() && tris_[triangle].v[next(edge)] == c.a && tris_[triangle].v[previous(edge)] == c.b);
    c.filled = Link(triangle, edge);
    if (c.partner == no_index)
        connect(tris_, triangle, edge, c.outer);
    else if (const Link other = edges_[c.partner].filled; !other.is_border())
        connect(tris_, triangle, edge, Link(other.triangle(), other.edge(), c.outer.is_constrained()));
    assert(is_linked(tris_, triangle, edge));
}

/// Fills the polygon between a part of the chain and its base by the constrained triangulation of its vertices, of
/// which the polygon's is a part. Chain edges were Delaunay edges of more points, or segments: nearly all of them are
/// edges of the plain triangulation, and inserting the others is a smaller problem of this kind. So no chain costs
/// O(k^2). Returns the new triangle at the base, and its edge there.
Link CrossedPolygons::fill_long_range(std::size_t low, std::size_t high) {
    const std::span<const Index> vertices = std::span(vertices_).subspan(low, high - low + 1);
    std::vector<Index> global(vertices.begin(), vertices.end());  // local number -> number
    std::sort(global.begin(), global.end());
    global.erase(std::unique(global.begin(), global.end()),
                 global.end());  // a vertex may stand in the chain repeatedly
    const auto local = [&](Index v) {
        return VertexId(static_cast<std::size_t>(std::lower_bound(global.begin(), global.end(), v) - global.begin()));
    };
    std::vector<Point> points;
    points.reserve(global.size());
    for (Index v : global) points.push_back(points_[v]);
    // The border is directed with the polygon on its left; edge i is chain edge low + i, and the base is the last.
    std::vector<Segment> border;
    border.reserve(vertices.size());
    for (std::size_t i = 0; i + 1 < vertices.size(); ++i)
        border.push_back({local(vertices[i + 1]), local(vertices[i])});
    border.push_back({local(vertices.front()), local(vertices.back())});
    const Tris inside = triangulate_polygon(points, border);
    assert(inside.size() + 1 == high - low);

    std::vector<std::pair<std::uint64_t, Index>> border_index;
    border_index.reserve(border.size());
    for (std::size_t i = 0; i < border.size(); ++i)
        border_index.push_back({directed_key(border[i].a.value, border[i].b.value), static_cast<Index>(i)});
    std::sort(border_index.begin(), border_index.end());
    const std::vector<Index> places = replace_crossed(inside, global);
    Link at_base = Link::border();
    for (std::size_t i = 0; i < inside.size(); ++i)
        for (unsigned e = 0; e < 3; ++e) {
            if (!inside[i].n[e].is_constrained()) continue;
            const std::uint64_t edge = directed_key(inside[i].v[next(e)], inside[i].v[previous(e)]);
            const auto found = std::lower_bound(border_index.begin(), border_index.end(), std::pair{edge, Index{0}});
            assert(found != border_index.end() && found->first == edge);
            const Index index = found->second;
            if (index + 1 == border.size())
                at_base = Link(places[i], e);
            else
                attach(chain_[low + index], places[i], e);
        }
    assert(!at_base.is_border());
    return at_base;
}

/// Copies the triangles inside a polygon to the places at the end of crossed_, in global numbers, with links between
/// each other alone. Returns the place of each triangle.
std::vector<Index> CrossedPolygons::replace_crossed(const Tris& inside, std::span<const Index> global) {
    assert(inside.size() <= crossed_.size());
    std::vector<Index> places(crossed_.end() - static_cast<std::ptrdiff_t>(inside.size()), crossed_.end());
    crossed_.resize(crossed_.size() - inside.size());
    for (std::size_t i = 0; i < inside.size(); ++i)
        for (unsigned e = 0; e < 3; ++e) {
            const Link n = inside[i].n[e];
            const Index v = global[inside[i].v[e]];
            tris_[places[i]].v[e] = v;
            tris_[places[i]].n[e] = n.is_constrained() ? Link::border() : Link(places[n.triangle()], n.edge());
            set_triangle_at(v, places[i]);
        }
    return places;
}

}  // namespace lamina::delaunay
