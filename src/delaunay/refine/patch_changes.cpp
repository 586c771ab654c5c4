// Changes of the connectivity of patches.
#include <algorithm>
#include <cassert>
#include <utility>

#include "delaunay/refine/patch.hpp"
#include "delaunay/refine/triangle_shape.hpp"

namespace lamina::delaunay {

namespace {

constexpr int regular_degree = 6;
/// Free vertices keep at least so many neighbours when an edge flips or two vertices merge.
constexpr unsigned min_degree = 4;

/// Returns how (degree - 6)^2 changes where a free vertex gets so many more neighbours; 0 for one that is fixed.
int defect_change(const Patch& patch, Index v, int more) {
    if (patch.is_fixed[v]) return 0;
    const int now = static_cast<int>(patch.degrees[v]) - regular_degree;
    return (now + more) * (now + more) - now * now;
}

bool may_lose_neighbour(const Patch& patch, Index v) { return patch.is_fixed[v] || patch.degrees[v] > min_degree; }

/// Adds the flip of edge e of t, and the merge of its ends.
void add_changes_of_edge(const Patch& patch, Index t, unsigned e, std::vector<Change>& changes) {
    const Tri& tri = patch.tris[t];
    const Link across = tri.n[e];
    const Index a = tri.v[next(e)], b = tri.v[previous(e)], c = tri.v[e],
                d = patch.tris[across.triangle()].v[across.edge()];
    if (may_lose_neighbour(patch, a) && may_lose_neighbour(patch, b))
        changes.push_back({Change::Kind::flip, t, e, 0,
                           defect_change(patch, a, -1) + defect_change(patch, b, -1) + defect_change(patch, c, 1) +
                               defect_change(patch, d, 1)});
    if ((patch.is_fixed[a] && patch.is_fixed[b]) || !may_lose_neighbour(patch, c) || !may_lose_neighbour(patch, d))
        return;
    // The vertex that remains has all neighbours of both but for the other one, and c and d only once. It counts as
    // fixed if either is.
    const Index kept = patch.is_fixed[b] ? b : a, removed = patch.is_fixed[b] ? a : b;
    const int defect = static_cast<int>(patch.degrees[removed]) - regular_degree;
    changes.push_back({Change::Kind::merge, t, e, 0,
                       defect_change(patch, kept, static_cast<int>(patch.degrees[removed]) - 4) - defect * defect +
                           defect_change(patch, c, -1) + defect_change(patch, d, -1)});
}

/// Adds the splits of a free vertex.
void add_splits(const Patch& patch, Index t, unsigned corner, std::vector<Change>& changes) {
    const std::vector<Link> star = star_of(patch.tris, t, corner);
    const auto degree = static_cast<unsigned>(star.size());
    const auto neighbour = [&](unsigned i) {
        const Link at = star[i % degree];
        return patch.tris[at.triangle()].v[next(at.edge())];
    };
    const auto squared_defect = [](unsigned degree_then) {
        const int defect = static_cast<int>(degree_then) - regular_degree;
        return defect * defect;
    };
    for (unsigned count = min_degree - 2; 2 * count <= degree; ++count) {
        const int at_vertex = squared_defect(count + 2) + squared_defect(degree - count + 2) - squared_defect(degree);
        const unsigned places = 2 * count == degree ? count : degree;
        for (unsigned i = 0; i < places; ++i)
            changes.push_back(
                {Change::Kind::split, star[i].triangle(), star[i].edge(), count,
                 at_vertex + defect_change(patch, neighbour(i), 1) + defect_change(patch, neighbour(i + count), 1)});
    }
}

bool is_positive(const Patch& patch, Index t) {
    constexpr double least_positive_share = 1e-9;  // far beyond rounding
    const TriangleShape s = shape_of(patch.points, patch.tris[t]);
    return s.area2 > least_positive_share * s.squared_sum();
}

bool are_positive(const Patch& patch, const std::vector<Link>& star) {
    return std::all_of(star.begin(), star.end(),
                       [&](Link l) { return patch.is_removed(l.triangle()) || is_positive(patch, l.triangle()); });
}

bool flip(Patch& patch, Index t, unsigned e) {
    const Tri& tri = patch.tris[t];
    const Link across = tri.n[e];
    --patch.degrees[tri.v[next(e)]];
    --patch.degrees[tri.v[previous(e)]];
    ++patch.degrees[tri.v[e]];
    ++patch.degrees[patch.tris[across.triangle()].v[across.edge()]];
    flip_edge(patch.tris, t, e);
    return is_positive(patch, t) && is_positive(patch, across.triangle());
}

/// Returns whether u has a neighbour in common with the vertex of this star, besides c and d.
bool have_other_common_neighbour(const Patch& patch, const std::vector<Link>& star, Index u, Index c, Index d) {
    for (const Tri& tri : patch.tris) {
        if (tri.v[0] == no_index || !has_corner(tri, u)) continue;
        for (const Link l : star) {
            const Index w = patch.tris[l.triangle()].v[next(l.edge())];
            if (w != u && w != c && w != d && has_corner(tri, w)) return true;
        }
    }
    return false;
}

/// Removes a triangle of which two corners have become one, and makes the two edges that remain of it one.
void remove_flat(Patch& patch, Index t, unsigned between) {
    Link one = patch.tris[t].n[next(between)], other = patch.tris[t].n[previous(between)];
    if (one.is_constrained()) other = other.constrained();
    if (other.is_constrained()) one = one.constrained();
    if (!one.is_border()) patch.tris[one.triangle()].n[one.edge()] = other;
    if (!other.is_border()) patch.tris[other.triangle()].n[other.edge()] = one;
    assert(one.is_border() || is_linked(patch.tris, one.triangle(), one.edge()));
    assert(other.is_border() || is_linked(patch.tris, other.triangle(), other.edge()));
    patch.tris[t] = {{no_index, no_index, no_index}, {}};
}

/// Merges the ends of edge e of t: one that is fixed stays, two that are free meet in the middle.
bool merge(Patch& patch, Index t, unsigned e) {
    const Link across = patch.tris[t].n[e];
    assert(!across.is_constrained() && is_linked(patch.tris, t, e));
    const Index n = across.triangle();
    Index kept = patch.tris[t].v[next(e)], removed = patch.tris[t].v[previous(e)];
    if (patch.is_fixed[removed]) std::swap(kept, removed);
    const Index c = patch.tris[t].v[e], d = patch.tris[n].v[across.edge()];
    const std::vector<Link> star = star_of(patch.tris, t, corner_of(patch.tris[t], removed));
    assert(!patch.is_fixed[removed] && c != d && star.size() == patch.degrees[removed]);
    if (have_other_common_neighbour(patch, star, kept, c, d)) return false;
    if (!patch.is_fixed[kept]) patch.points[kept] = midpoint(patch.points[kept], patch.points[removed]);
    std::vector<Link> old_star;
    if (!patch.is_fixed[kept]) old_star = star_of(patch.tris, t, corner_of(patch.tris[t], kept));
    for (const Link l : star) patch.tris[l.triangle()].v[l.edge()] = kept;
    remove_flat(patch, t, e);
    remove_flat(patch, n, across.edge());
    patch.degrees[kept] += patch.degrees[removed] - 4;
    patch.degrees[removed] = 0;
    patch.is_fixed[removed] = 1;
    --patch.degrees[c];
    --patch.degrees[d];
    // Two triangles fewer, and one vertex: the others round both vertices are neighbours of each other.
    assert(patch.is_removed(t) && patch.is_removed(n));
    assert(std::all_of(star.begin(), star.end(), [&](Link l) { return is_linked(patch.tris, l.triangle()); }));
    return are_positive(patch, star) && are_positive(patch, old_star);
}

/// Splits the vertex w at a corner of t.
///
///        o-----o               o-----o
///       / \   / \             / \   / \.     Triangles (w, from, new) and (w, new, to)
///      /   \ /   \           /   new   \.    fill the gap. Both vertices move apart,
///     to----w----from       to----|----from  towards the means of their neighbours.
///      \   / \   /           \    w    /
///       \ /   \ /             \ /   \ /
///        o-----o               o-----o
bool split(Patch& patch, Index t, unsigned corner, unsigned count) {
    constexpr double share_of_way = 0.3;
    const std::vector<Link> star = star_of(patch.tris, t, corner);
    const auto degree = static_cast<unsigned>(star.size());
    assert(2 <= count && count < degree && degree == patch.degrees[patch.tris[t].v[corner]]);
    const Index w = patch.tris[t].v[corner], created = static_cast<Index>(patch.points.size());
    const auto neighbour = [&](unsigned i) {
        const Link at = star[i % degree];
        return patch.tris[at.triangle()].v[next(at.edge())];
    };
    const Index from = neighbour(0), to = neighbour(count);
    const Point old_place = patch.points[w];
    const auto place_towards = [&](unsigned begin, unsigned end) {
        Point sum{0, 0};
        for (unsigned i = begin; i <= end; ++i) sum = sum + (patch.points[neighbour(i)] - old_place);
        return old_place + (share_of_way / (end - begin + 1)) * sum;
    };
    const Point taken = place_towards(0, count), left = place_towards(count, degree);
    patch.points[w] = left;
    patch.points.push_back(taken);
    patch.is_fixed.push_back(0);
    patch.degrees[w] = degree - count + 2;
    patch.degrees.push_back(count + 2);
    ++patch.degrees[from];
    ++patch.degrees[to];
    const auto a = static_cast<Index>(patch.tris.size()), b = a + 1;
    const Link first = star[0], last = star[count - 1], after = star[count], before = star[degree - 1];
    patch.tris.push_back({{w, from, created}, {}});
    patch.tris.push_back({{w, created, to}, {}});
    for (unsigned i = 0; i < count; ++i) patch.tris[star[i].triangle()].v[star[i].edge()] = created;
    connect(patch.tris, a, 0, Link(first.triangle(), previous(first.edge())));
    connect(patch.tris, a, 1, Link(b, 2));
    connect(patch.tris, a, 2, Link(before.triangle(), next(before.edge())));
    connect(patch.tris, b, 0, Link(last.triangle(), next(last.edge())));
    connect(patch.tris, b, 1, Link(after.triangle(), previous(after.edge())));
    // Two triangles more, and one vertex.
    assert(patch.tris.size() == b + std::size_t{1} && is_linked(patch.tris, a) && is_linked(patch.tris, b));
    assert(std::all_of(star.begin(), star.end(), [&](Link l) { return is_linked(patch.tris, l.triangle()); }));
    return is_positive(patch, a) && is_positive(patch, b) && are_positive(patch, star);
}

}  // namespace

std::vector<Link> star_of(const Tris& tris, Index t, unsigned corner) {
    std::vector<Link> star;
    const Index first = t;
    do {
        star.emplace_back(t, corner);
        const Link across = tris[t].n[next(corner)];
        if (across.is_constrained()) return {};
        t = across.triangle();
        corner = next(across.edge());
    } while (t != first);
    return star;
}

std::vector<Change> find_changes(const Patch& patch) {
    std::vector<Change> changes;
    std::vector<Index> seen;
    for (Index t = 0; t < patch.core; ++t) {
        if (patch.is_removed(t)) continue;
        for (unsigned e = 0; e < 3; ++e) {
            const Link across = patch.tris[t].n[e];
            const bool is_first = t < across.triangle() || across.triangle() >= patch.core;
            if (!across.is_constrained() && is_first) add_changes_of_edge(patch, t, e, changes);
            const Index v = patch.tris[t].v[e];
            if (patch.is_fixed[v] || std::find(seen.begin(), seen.end(), v) != seen.end()) continue;
            seen.push_back(v);
            add_splits(patch, t, e, changes);
        }
    }
    std::erase_if(changes, [](const Change& c) { return c.defect_change > 0; });
    std::stable_sort(changes.begin(), changes.end(),
                     [](const Change& a, const Change& b) { return a.defect_change < b.defect_change; });
    return changes;
}

bool apply(Patch& patch, const Change& change) {
    switch (change.kind) {
        case Change::Kind::flip:
            return flip(patch, change.t, change.e);
        case Change::Kind::merge:
            return merge(patch, change.t, change.e);
        case Change::Kind::split:
            return split(patch, change.t, change.e, change.count);
    }
    return false;
}

}  // namespace lamina::delaunay
