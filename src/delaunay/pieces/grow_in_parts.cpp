// A sample of the points is triangulated, and its triangles are dealt to parts. All parts grow at the same time:
// a point is inserted where its cavity and all triangles round that belong to one part. Points whose cavities come near
// another part are inserted once the parts are joined.
//
//      o-----o-----o-----o-----o
//     / \  1/ \  1/ \\ 2/ \  2/       Across the border (\\) between parts 1 and 2 no triangle is changed while parts
//    /   \ / 1 \ / 1 \\/ 2 \ /        grow: its two triangles stay, so each part needs no look at the other one.
//   o-----o-----o-----o-----o
//
// Each intermediate triangulation is the Delaunay triangulation of the vertices it has, since no cavity is cut short.
// So the result is the one of any other order (docs/decisions/0001).
//
// The triangles between two lines of points follow one another like the steps of a ladder, so that short borders part
// them. find_parts() says which.
//
// Source: J. Kohout, I. Kolingerova, J. Zara, Parallel Delaunay triangulation in E2 and E3 for computers with shared
// memory, Parallel Computing 31 (2005), where threads lock the triangles of a cavity.
#include "delaunay/pieces/grow_in_parts.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <iterator>
#include <numeric>
#include <optional>
#include <utility>

#include "core/interruption_point.hpp"
#include "core/parallel.hpp"
#include "core/uninitialized.hpp"
#include "delaunay/pieces/triangle_parts.hpp"
#include "delaunay/triangulate/arguments.hpp"
#include "delaunay/triangulate/brio.hpp"
#include "delaunay/triangulate/conditions.hpp"
#include "delaunay/triangulate/growing.hpp"
#include "delaunay/triangulate/triangulate_points.hpp"
#include "delaunay/triangulate/walk.hpp"

namespace lamina::delaunay::pieces {

namespace {

constexpr std::size_t growth_grain = 1 << 14;

/// One point of so many is in the sample. In a smaller sample triangles at borders hold more points, which wait.
constexpr std::size_t points_per_sampled_one = 64;

/// Points of a part, more or less.
constexpr std::size_t points_per_part = 1 << 16;

/// Swaps the outermost points in eight directions with the last ones of the sample. The ends of a line are among them:
/// where points are not quite on it, an end that came late would have thousands of triangles in its cavity, and so
/// would all points near it as long as it waits.
void bring_outermost_forward(std::size_t sample, std::vector<Index>& order, GrowingTriangulation& grown) {
    constexpr std::array<Point, 8> directions{{{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}}};
    using Outermost = std::array<Index, directions.size()>;
    const auto further = [&](unsigned d, Index a, Index b) {
        return dot(grown.vertices[a] - grown.vertices[b], directions[d]) > 0;
    };
    const auto blocks = core::parallel_blocks(order.size(), growth_grain, [&](std::size_t begin, std::size_t end) {
        Outermost found;
        found.fill(static_cast<Index>(begin + 1));
        for (std::size_t i = begin + 1; i < end; ++i)
            for (unsigned d = 0; d < found.size(); ++d)
                if (further(d, static_cast<Index>(i + 1), found[d])) found[d] = static_cast<Index>(i + 1);
        return found;
    });
    Outermost found = blocks.front();
    for (const Outermost& block : blocks)
        for (unsigned d = 0; d < found.size(); ++d)
            if (further(d, block[d], found[d])) found[d] = block[d];
    std::sort(found.begin(), found.end());
    auto to = static_cast<Index>(sample);
    for (const Index v : std::span(found.begin(), std::unique(found.begin(), found.end()))) {
        if (v <= sample) continue;
        std::swap(grown.vertices[v], grown.vertices[to]);
        std::swap(order[v - 1], order[to - 1]);
        --to;
    }
}

/// The triangles of a part or of all parts, and one of them at each vertex of the sample.
struct GrowingPart {
    Tris tris;
    std::vector<Index> at_sample;  ///< no_index for vertices of the sample in other parts
    std::vector<Index> waiting;    ///< vertices that were not inserted
};

/// Inserts all vertices behind those of a sample.
class PartwiseGrowth {
public:
    /// Precondition: `room` is as large as there will be triangles.
    PartwiseGrowth(GrowingTriangulation& grown, TriangleParts division, std::size_t sample, Tris room)
        : vertices_(grown.vertices),
          division_(std::move(division)),
          first_(static_cast<Index>(sample + 1)),
          sample_(std::move(grown.tris)),
          all_{std::move(room), {}, {}},
          parts_(division_.size()) {}

    /// Returns all triangles. Throws InputError for duplicates.
    Tris run(std::span<const Point> points, std::span<const Index> order) && {
        deal();
        core::parallel_for(parts_.size(), 1, [&](std::size_t k, std::size_t) { grow(k); });
        join();
        insert_waiting(points, order);
        assert(is_sphere(all_.tris, vertices_.size() - 1));
        return std::move(all_.tris);
    }

private:
    /// Inserts the vertices that wait, in their order. Those near the same vertex of the sample follow one another.
    void insert_waiting(std::span<const Point> points, std::span<const Index> order) {
        Cavity cavity;
        Index recent = no_index, last_near = no_index;
        for (const Index v : all_.waiting) {
            const Index near = near_in_sample(v);
            const Index place = find_place<false>(all_, near == last_near ? recent : start_at(all_, near), v);
            if (const Index equal = equal_vertex(all_, place, v); equal != no_index)
                fail_duplicate(points, order[equal - 1], order[v - 1]);
            insert(all_, place, v, cavity);
            recent = start_of_next_walk(all_.tris, cavity);
            last_near = near;
        }
    }

    /// Deals vertices to the parts that they lie in, or almost so where triangles are sorted along a direction.
    void deal() {
        const bool by_place = !division_.along.empty();
        if (!by_place) near_ = core::UninitializedArray<Index>(vertices_.size() - first_);
        dealt_ =
            core::parallel_blocks(vertices_.size() - first_, growth_grain, [&](std::size_t begin, std::size_t end) {
                std::vector<std::vector<Index>> dealt(parts_.size());
                Index recent = beside_ghost(sample_, 0);
                for (std::size_t i = begin; i < end; ++i) {
                    const Point p = vertices_[first_ + i];
                    const auto v = static_cast<Index>(first_ + i);
                    if (by_place) {
                        dealt[division_.part_near(p)].push_back(v);
                        continue;
                    }
                    const Point from = vertices_[sample_[recent].v[0]];
                    near_[i] = delaunay::find_place<false>(vertices_.data(), sample_.data(), recent, from, p);
                    dealt[division_.part[near_[i]]].push_back(v);
                    recent = beside_ghost(sample_, near_[i]);
                }
                return dealt;
            });
    }
    /// Returns a vertex of the sample near a vertex behind it.
    Index near_in_sample(Index v) const {
        const Point p = vertices_[v];
        return nearest_corner(sample_[division_.along.empty() ? near_[v - first_] : division_.near(p)], p);
    }
    Index nearest_corner(const Tri& t, Point p) const {
        Index nearest = no_index;
        double least = HUGE_VAL;
        for (const Index v : t.v) {
            const double distance2 = squared_length(vertices_[v] - p);  // NaN for the vertex at infinity
            if (!(distance2 < least)) continue;
            least = distance2;
            nearest = v;
        }
        return nearest;
    }

    /// Cuts a part out of the sample, with borders round it.
    void cut_out(std::size_t k, GrowingPart& part) const {
        for (std::size_t i = division_.first[k]; i < division_.first[k + 1]; ++i) {
            Tri t = sample_[division_.order[i]];
            for (Link& n : t.n)
                n = division_.part[n.triangle()] == k ? Link(division_.within(n.triangle()), n.edge()) : Link::border();
            for (const Index v : t.v) part.at_sample[v] = static_cast<Index>(part.tris.size());
            part.tris.push_back(t);
        }
        assert(are_linked(part.tris));
    }

    void grow(std::size_t k) {
        GrowingPart& part = parts_[k];
        std::size_t count = division_.first[k + 1] - division_.first[k];
        for (const auto& block : dealt_) count += 2 * block[k].size();
        part.tris.reserve(count);
        part.at_sample.assign(first_, no_index);
        cut_out(k, part);
        Cavity cavity;
        Index recent = no_index;
        for (auto& block : dealt_) {
            core::check_interruption();
            for (const Index v : std::exchange(block[k], {})) {
                Index place = find_place<true>(part, recent, v);
                if (place == no_index) place = find_place<true>(part, start_at(part, near_in_sample(v)), v);
                if (place != no_index && equal_vertex(part, place, v) == no_index && insert(part, place, v, cavity)) {
                    recent = start_of_next_walk(part.tris, cavity);
                } else {
                    recent = place == no_index ? no_index : beside_ghost(part.tris, place);
                    part.waiting.push_back(v);
                }
            }
        }
    }

    /// Returns a triangle whose circle holds vertex v, or which has an equal vertex; no_index where a border bars the
    /// way from `start`, or where that is no_index. Precondition: `start` is no ghost.
    template <bool Borders>
    Index find_place(const GrowingPart& part, Index start, Index v) const {
        if (start == no_index) return no_index;
        const Point from = vertices_[part.tris[start].v[0]];
        return delaunay::find_place<Borders>(vertices_.data(), part.tris.data(), start, from, vertices_[v]);
    }
    /// Returns a triangle at a vertex of the sample, for find_place().
    Index start_at(const GrowingPart& part, Index v) const {
        const Index t = part.at_sample[v];
        return t == no_index ? no_index : beside_ghost(part.tris, t);
    }

    Index equal_vertex(const GrowingPart& part, Index place, Index v) const {
        for (const Index w : part.tris[place].v)
            if (vertices_[w] == vertices_[v]) return w;
        return no_index;
    }

    /// Inserts a vertex, unless its cavity ends at a border.
    bool insert(GrowingPart& part, Index place, Index v, Cavity& cavity) const {
        const Point p = vertices_[v];
        find_cavity<true>(vertices_.data(), part.tris.data(), place, relative_to(vertices_.data(), part.tris[place], p),
                          p, cavity);
        if (!cavity.is_open_star) {
            const CavityEdge* const edges = cavity.boundary.data();
            if (std::any_of(edges, edges + cavity.boundary.size(),
                            [](const CavityEdge& e) { return e.outer.is_border(); }))
                return false;
        }
        assert(is_star(vertices_, cavity, p, growing_ghost_vertex));
        fill_cavity(part.tris, cavity, v, [&](Index t, const CavityEdge& a, const CavityEdge&) {
            if (a.a < first_) part.at_sample[a.a] = t;
        });
        return true;
    }

    /// Puts the parts one behind the other, in the place of the sample.
    void join() {
        std::vector<Index> first{0};  // the first triangle of each part
        for (GrowingPart& part : parts_) {
            first.push_back(first.back() + static_cast<Index>(part.tris.size()));
            all_.waiting.insert(all_.waiting.end(), part.waiting.begin(), part.waiting.end());
        }
        std::sort(all_.waiting.begin(), all_.waiting.end());
        all_.tris.resize(first.back());
        all_.at_sample.assign(first_, no_index);
        core::parallel_for(parts_.size(), 1, [&](std::size_t k, std::size_t) {
            Index at = first[k];
            for (Tri t : std::exchange(parts_[k].tris, {})) {
                for (Link& n : t.n)
                    if (!n.is_border()) n = Link(first[k] + n.triangle(), n.edge());
                all_.tris[at++] = t;
            }
        });
        for (std::size_t k = 0; k < parts_.size(); ++k)
            for (Index v = 0; v < first_; ++v)
                if (parts_[k].at_sample[v] != no_index) all_.at_sample[v] = first[k] + parts_[k].at_sample[v];
        // Triangles on both sides of a border still stand where they stood.
        const auto now = [&](Index t) { return first[division_.part[t]] + division_.within(t); };
        for (Index t = 0; t < sample_.size(); ++t)
            for (unsigned e = 0; e < 3; ++e)
                if (const Link n = sample_[t].n[e]; division_.is_border(t, n)) {
                    assert(all_.tris[now(t)].n[e].is_border());
                    all_.tris[now(t)].n[e] = Link(now(n.triangle()), n.edge());
                    // The later one of both has the other one's link, too.
                    assert(n.triangle() > t || is_linked(all_.tris, now(t), e));
                }
    }

    std::span<const Point> vertices_;
    TriangleParts division_;
    Index first_;  ///< the first vertex behind the sample
    Tris sample_;
    GrowingPart all_;  ///< all triangles, once the parts are joined
    std::vector<GrowingPart> parts_;
    core::UninitializedArray<Index> near_;                ///< for each vertex from first_ on its triangle in the sample
    std::vector<std::vector<std::vector<Index>>> dealt_;  ///< vertices from first_ on in blocks, and there by parts
};

/// Writes all triangles but the ghosts, with the indices of points. Precondition: `triangles` has room for all.
void put_triangles_of_points(const Tris& tris, std::span<const Index> order, std::vector<Triangle>& triangles) {
    const auto count = core::parallel_blocks(tris.size(), growth_grain, [&](std::size_t begin, std::size_t end) {
        std::size_t inner = 0;
        for (std::size_t t = begin; t < end; ++t) inner += !is_growing_ghost(tris[t]);
        return inner;
    });
    std::vector<std::size_t> first(count.size() + 1, 0);
    std::partial_sum(count.begin(), count.end(), first.begin() + 1);
    triangles.resize(first.back());
    core::parallel_for(tris.size(), growth_grain, [&](std::size_t begin, std::size_t end) {
        Triangle* to = triangles.data() + first[begin / growth_grain];
        for (std::size_t t = begin; t < end; ++t) {
            if (is_growing_ghost(tris[t])) continue;
            const Index* v = tris[t].v;
            *to++ = {{VertexId{order[v[0] - 1]}, VertexId{order[v[1] - 1]}, VertexId{order[v[2] - 1]}}};
        }
    });
}

}  // namespace

std::vector<Triangle> triangulate_in_parts(std::span<const Point> points) {
    const std::size_t parts = points.size() / points_per_part, sample = points.size() / points_per_sampled_one;
    if (parts < 2) return without_ghosts(triangulate_points(points)).triangles;
    check_points(points);
    std::vector<Index> order;
    GrowingTriangulation grown;
    std::optional<TriangleParts> division;
    Tris room;
    std::vector<Triangle> triangles;
    core::parallel_invoke(
        [&] {
            Box box;
            for (const Point p : points) box.include(p);
            order = brio_order(points, box);
            grown = begin_to_grow(points, order);
            if (grown.tris.empty()) return;
            bring_outermost_forward(sample, order, grown);
            insert_vertices(points, order, 4, sample, grown);
            division = find_parts(grown, parts);
        },
        [&] {
            // Room for all triangles is made while much of the above keeps one thread busy.
            room.resize(2 * points.size());
            triangles.resize(2 * points.size());
        });
    if (division)
        grown.tris = PartwiseGrowth(grown, std::move(*division), sample, std::move(room)).run(points, order);
    else if (!grown.tris.empty())
        insert_vertices(points, order, sample + 1, points.size(), grown);
    put_triangles_of_points(grown.tris, order, triangles);
    return triangles;
}

}  // namespace lamina::delaunay::pieces
