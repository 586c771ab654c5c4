// Point location by jump and walk, and the nearest vertex by descent through neighbours.
// Sources: E. P. Muecke, I. Saias, B. Zhu, Fast randomized point location without preprocessing in two- and
// three-dimensional Delaunay triangulations, Comput. Geom. 12 (1999); O. Devillers, S. Pion, M. Teillaud, Walking in a
// triangulation, Int. J. Found. Comput. Sci. 13 (2002).
#include <algorithm>
#include <array>

#include <lamina/predicates.hpp>

#include "core/parallel.hpp"
#include "core/predicates.hpp"
#include "delaunay/queries/query_index.hpp"
#include "delaunay/triangulate/walk.hpp"

namespace lamina::delaunay::queries {

namespace {

/// Queries of one block, which one thread answers.
constexpr std::size_t queries_per_block = 4096;

Point nearest_in_box(const Box& box, Point p) {
    return {std::clamp(p.x, box.lower.x, box.upper.x), std::clamp(p.y, box.lower.y, box.upper.y)};
}

}  // namespace

std::uint64_t VerticesAlongCurve::key(Point p) const { return curve(nearest_in_box(box, p)) >> key_shift; }

std::size_t VerticesAlongCurve::lower_bound(std::uint64_t key) const {
    const std::size_t bucket = key >> bucket_shift;
    const auto begin = keys.begin() + bucket_starts[bucket], end = keys.begin() + bucket_starts[bucket + 1];
    return static_cast<std::size_t>(std::lower_bound(begin, end, key) - keys.begin());
}

Index vertex_near(const QueryIndex& index, Point p) {
    const std::size_t after = index.along_curve.lower_bound(index.along_curve.key(p));
    // Key i is that of vertex i + 1.
    const auto last = static_cast<Index>(index.vertices.size() - 1);
    const Index v = std::min(static_cast<Index>(after + 1), last), before = std::max(static_cast<Index>(after), 1u);
    const bool before_is_nearer = squared_length(index.vertices[before] - p) < squared_length(index.vertices[v] - p);
    return before_is_nearer ? before : v;
}

Index walk_to(const QueryIndex& index, Index start, Point p) {
    return walk(index.vertices.data(), index.tris.data(), start, p);
}

PointLocation classify(const QueryIndex& index, Index found, Point p) {
    const Tri& t = index.tris[found];
    if (is_growing_ghost(t)) return {};
    unsigned touched[3], count = 0;
    for (unsigned e = 0; e < 3; ++e)
        if (core::inline_orient2d(index.vertices[t.v[next(e)]], index.vertices[t.v[previous(e)]], p) == 0)
            touched[count++] = e;
    if (count == 0) {
        if (!index.is_inside(found)) return {};
        return {TriangleId{index.triangle_ids[found]}, PointPlace::inside, 0};
    }
    if (count == 2) {
        // The two edges meet at the corner that is opposite neither.
        const Index v = t.v[3 - touched[0] - touched[1]];
        const Index at = index.at_vertex[v];
        return {TriangleId{index.triangle_ids[at]}, PointPlace::on_vertex,
                static_cast<std::uint8_t>(corner_of(index.tris[at], v))};
    }
    const Link other = t.n[touched[0]];
    const Index id = index.triangle_ids[found], other_id = index.triangle_ids[other.triangle()];
    if (id == no_index && other_id == no_index) return {};
    return id < other_id
               ? PointLocation{TriangleId{id}, PointPlace::on_edge, static_cast<std::uint8_t>(touched[0])}
               : PointLocation{TriangleId{other_id}, PointPlace::on_edge, static_cast<std::uint8_t>(other.edge())};
}

VertexId nearest_point(const QueryIndex& index, Index found, Point p) {
    const Tri& t = index.tris[found];
    const auto compare = [&](Index a, Index b) {
        return core::compare_distances(p, index.vertices[a], index.vertices[b]);
    };
    Index best = no_index;
    for (const Index v : t.v)
        if (v != growing_ghost_vertex && (best == no_index || compare(v, best) < 0)) best = v;
    // Calls visit for each neighbour of v until it returns true.
    const auto any_neighbour = [&](Index v, const auto& visit) {
        const Index first = index.at_vertex[v];
        Index turned = first;
        do {
            const Tri& tri = index.tris[turned];
            const unsigned i = corner_of(tri, v);
            if (const Index w = tri.v[next(i)]; w != growing_ghost_vertex && visit(w)) return;
            turned = tri.n[next(i)].triangle();
        } while (turned != first);
    };
    // A vertex that is not nearest has a neighbour that is nearer. Those that are equally near lie on an empty circle
    // round p and hang together.
    std::vector<Index> ties;
    for (bool nearer = true; nearer;) {
        nearer = false;
        ties.assign(1, best);
        any_neighbour(best, [&](Index w) {
            const double order = compare(w, best);
            if (order == 0) ties.push_back(w);
            if (order < 0) best = w;
            return nearer = order < 0;
        });
    }
    for (std::size_t i = 1; i < ties.size(); ++i)
        any_neighbour(ties[i], [&](Index w) {
            if (std::find(ties.begin(), ties.end(), w) == ties.end() && compare(w, best) == 0) ties.push_back(w);
            return false;
        });
    Index id = index.point_ids[best];
    for (const Index v : ties) id = std::min(id, index.point_ids[v]);
    return VertexId{id};
}

void for_each_found(const QueryIndex& index, std::span<const Point> queries,
                    const std::function<void(std::size_t, Index)>& answer) {
    if (index.tris.empty()) {
        for (std::size_t i = 0; i < queries.size(); ++i) answer(i, no_index);
        return;
    }
    const Box& box = index.along_curve.box;
    std::vector<Point> in_box(queries.begin(), queries.end());
    for (Point& p : in_box) p = in_exact_range(p) ? nearest_in_box(box, p) : box.lower;
    const CurveOrder order(in_box, index.along_curve.curve);
    // Where queries are few against triangles, a jump is shorter than the way from the last query.
    const bool dense = queries.size() >= index.vertices.size() / 4;
    core::parallel_for(queries.size(), queries_per_block, [&](std::size_t begin, std::size_t end) {
        Index recent = no_index;
        for (std::size_t k = begin; k < end; ++k) {
            const std::size_t i = order[k];
            const Point p = queries[i];
            if (!in_exact_range(p)) {
                answer(i, no_index);
                continue;
            }
            if (!dense || recent == no_index) recent = index.at_vertex[vertex_near(index, p)];
            const Index found = walk_to(index, recent, p);
            answer(i, found);
            recent = is_growing_ghost(index.tris[found]) ? no_index : found;
        }
    });
}

std::array<double, 3> linear_weights(const Point* vertices, const Tri& t, Point p) {
    std::array<Point, 3> to;
    for (unsigned e = 0; e < 3; ++e) to[e] = vertices[t.v[e]] - p;
    const auto edge = [&](unsigned e) { return to[previous(e)] - to[next(e)]; };
    std::array<double, 3> weights;
    double sum = 0;
    unsigned longest = 0;
    for (unsigned e = 0; e < 3; ++e) {
        weights[e] = cross(to[next(e)], to[previous(e)]);
        sum += weights[e];
        if (dot(edge(e), edge(e)) > dot(edge(longest), edge(longest))) longest = e;
    }
    const Point along = edge(longest);
    constexpr double flat = 1e-12;  // areas below are of the order of their rounding
    if (sum > flat * dot(along, along)) {
        for (double& w : weights) w /= sum;
        return weights;
    }
    // In such a needle the value on the longest edge is as good.
    const double share = std::clamp(-dot(to[next(longest)], along) / dot(along, along), 0.0, 1.0);
    weights[longest] = 0;
    weights[next(longest)] = 1 - share;
    weights[previous(longest)] = share;
    return weights;
}

}  // namespace lamina::delaunay::queries
