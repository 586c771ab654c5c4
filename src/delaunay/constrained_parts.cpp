// Parts are floods of triangles that stop at borders. Neighbours and borders of edges are found in sorted lists of
// keys.
#include "delaunay/constrained_parts.hpp"

#include <algorithm>
#include <utility>

#include <lamina/predicates.hpp>

#include "core/segments.hpp"

namespace lamina::delaunay {

namespace {

/// The neighbours and borders of the edges of a triangulation. Edge 3 t + e is edge e of triangle t.
struct EdgeTable {
    std::vector<Index> opposite;  ///< the same edge as the neighbouring triangle has it; no_index on the boundary
    std::vector<Index> border;    ///< the border that the edge is; no_index for edges inside parts
};

/// A value that is found by a key.
struct KeyedIndex {
    std::uint64_t key;
    Index value;
};

void sort_by_key(std::vector<KeyedIndex>& entries) {
    std::sort(entries.begin(), entries.end(), [](const KeyedIndex& l, const KeyedIndex& r) { return l.key < r.key; });
}

/// Returns the value of the first sorted entry with this key; no_index if there is none.
Index find_key(const std::vector<KeyedIndex>& entries, std::uint64_t key) {
    const auto found = std::lower_bound(entries.begin(), entries.end(), key,
                                        [](const KeyedIndex& entry, std::uint64_t k) { return entry.key < k; });
    return found != entries.end() && found->key == key ? found->value : no_index;
}

/// Returns the vertices that an edge joins, the triangle on its left.
std::pair<Index, Index> ends_of(const ConstrainedTriangulation& t, Index edge) {
    const Triangle& triangle = t.triangles[edge / 3];
    return {triangle.v[next(edge % 3)].value, triangle.v[previous(edge % 3)].value};
}

/// Returns EdgeTable::opposite.
std::vector<Index> find_opposite_edges(const ConstrainedTriangulation& t) {
    const auto directed_key = [](Index a, Index b) { return std::uint64_t{a} << 32 | b; };
    const auto edge_count = static_cast<Index>(3 * t.triangles.size());
    std::vector<KeyedIndex> edges;
    edges.reserve(edge_count);
    for (Index edge = 0; edge < edge_count; ++edge) {
        const auto [a, b] = ends_of(t, edge);
        edges.push_back({directed_key(a, b), edge});
    }
    sort_by_key(edges);
    std::vector<Index> opposite(edge_count);
    for (Index edge = 0; edge < edge_count; ++edge) {
        const auto [a, b] = ends_of(t, edge);
        opposite[edge] = find_key(edges, directed_key(b, a));
    }
    return opposite;
}

/// Appends the borders of the triangulation. Returns EdgeTable::border.
std::vector<Index> find_borders(const ConstrainedTriangulation& t, const std::vector<Index>& opposite,
                                std::vector<PartBorder>& borders) {
    std::vector<KeyedIndex> segments;
    segments.reserve(t.segments.size());
    for (const Segment& s : t.segments) {
        segments.push_back({undirected_key(s.a.value, s.b.value), static_cast<Index>(borders.size())});
        borders.push_back({{s.a.value, s.b.value}, {}});
    }
    sort_by_key(segments);

    std::vector<Index> border_of_edge(opposite.size());
    for (Index edge = 0; edge < opposite.size(); ++edge) {
        const auto [a, b] = ends_of(t, edge);
        border_of_edge[edge] = find_key(segments, undirected_key(a, b));
        if (border_of_edge[edge] == no_index && opposite[edge] == no_index) {
            border_of_edge[edge] = static_cast<Index>(borders.size());
            borders.push_back({{a, b}, {}});
        }
    }
    return border_of_edge;
}

/// Appends the part of the triangles that can be reached from one of them, and notes its number for each of them.
void add_part(const ConstrainedTriangulation& t, const EdgeTable& edges, Index first,
              std::vector<Index>& part_of_triangle, ConstrainedParts& result) {
    const auto number = static_cast<Index>(result.parts.size());
    ConstrainedPart& part = result.parts.emplace_back();
    std::vector<Index> front{first};
    part_of_triangle[first] = number;
    while (!front.empty()) {
        const Index i = front.back();
        front.pop_back();
        for (unsigned e = 0; e < 3; ++e) {
            const Index edge = 3 * i + e;
            part.vertices.push_back(t.triangles[i].v[e].value);
            if (const Index border = edges.border[edge]; border != no_index) {
                part.sides.push_back({border, result.borders[border].chain.front() == ends_of(t, edge).first});
            } else if (const Index other = edges.opposite[edge] / 3; part_of_triangle[other] == no_index) {
                part_of_triangle[other] = number;
                front.push_back(other);
            }
        }
    }
    std::sort(part.vertices.begin(), part.vertices.end());
    part.vertices.erase(std::unique(part.vertices.begin(), part.vertices.end()), part.vertices.end());
}

/// Makes the parts, and tells the borders which parts lie beside them. Returns the part of each triangle.
std::vector<Index> make_parts(const ConstrainedTriangulation& t, const EdgeTable& edges, ConstrainedParts& result) {
    std::vector<Index> part_of_triangle(t.triangles.size(), no_index);
    for (Index first = 0; first < t.triangles.size(); ++first)
        if (part_of_triangle[first] == no_index) add_part(t, edges, first, part_of_triangle, result);
    for (Index p = 0; p < result.parts.size(); ++p)
        for (const PartSide& side : result.parts[p].sides) result.borders[side.border].parts.push_back(p);
    return part_of_triangle;
}

/// Finds the pairs of borders that meet at a vertex u with an angle of a part below 90 or 60 degrees between them. From
/// each border u -> v the search turns counter-clockwise round u, through triangles, to the next border u -> w.
void find_corners(const ConstrainedTriangulation& t, const EdgeTable& edges, ConstrainedParts& result) {
    const std::vector<Point>& points = result.points;
    result.acute.assign(points.size(), 0);
    for (Index start = 0; start < edges.border.size(); ++start) {
        if (edges.border[start] == no_index) continue;
        const auto [u, v] = ends_of(t, start);
        // In the triangle (apex, u, v) the edge from the apex to u is the one opposite v.
        Index edge = start;
        Index leaving = 3 * (edge / 3) + previous(edge % 3);
        while (edges.border[leaving] == no_index) {
            edge = edges.opposite[leaving];  // from u to the apex, in the next triangle
            leaving = 3 * (edge / 3) + previous(edge % 3);
        }
        const Index w = ends_of(t, leaving).first;
        const Point a = points[v] - points[u], b = points[w] - points[u];
        if (!(orient2d(points[u], points[v], points[w]) > 0 && dot(a, b) > 0)) continue;
        result.acute[u] = 1;
        if (!core::encloses_sharp_angle(a, b)) continue;
        result.sharp_corners.push_back({u, v, w});
        result.sharp_pairs.push_back(undirected_key(edges.border[start], edges.border[leaving]));
    }
    std::sort(result.sharp_pairs.begin(), result.sharp_pairs.end());
    std::sort(result.sharp_corners.begin(), result.sharp_corners.end(),
              [](const SharpCorner& l, const SharpCorner& r) { return l.u != r.u ? l.u < r.u : l.v < r.v; });
}

/// Gives each part its size field. Later regions come first, so that the first region of a part has the last word.
void assign_sizes(const ConstrainedTriangulation& t, const SizeField& size, std::span<const RegionSize> regions,
                  const std::vector<Index>& part_of_triangle, ConstrainedParts& result) {
    for (ConstrainedPart& part : result.parts) part.size = &size;
    for (std::size_t r = regions.size(); r-- > 0;) {
        const Point seed = regions[r].seed;
        for (Index i = 0; i < t.triangles.size(); ++i) {
            const VertexId* v = t.triangles[i].v;
            const Point a = result.points[v[0].index()], b = result.points[v[1].index()],
                        c = result.points[v[2].index()];
            if (orient2d(a, b, seed) < 0 || orient2d(b, c, seed) < 0 || orient2d(c, a, seed) < 0) continue;
            ConstrainedPart& part = result.parts[part_of_triangle[i]];
            part.size = &regions[r].size;
            part.region = static_cast<std::uint32_t>(r);
            break;
        }
    }
}

}  // namespace

bool ConstrainedParts::in_sharp_corner(Index u, Point p) const {
    auto c = std::lower_bound(sharp_corners.begin(), sharp_corners.end(), u,
                              [](const SharpCorner& corner, Index value) { return corner.u < value; });
    for (; c != sharp_corners.end() && c->u == u; ++c)
        if (orient2d(points[u], points[c->v], p) >= 0 && orient2d(points[u], p, points[c->w]) >= 0) return true;
    return false;
}

bool ConstrainedParts::meet_sharply(Index border_a, Index border_b) const {
    return std::binary_search(sharp_pairs.begin(), sharp_pairs.end(), undirected_key(border_a, border_b));
}

LocalPart ConstrainedParts::localize(const ConstrainedPart& part) const {
    LocalPart local;
    local.global = part.vertices;
    for (const PartSide& side : part.sides) {
        const auto& chain = borders[side.border].chain;
        local.global.insert(local.global.end(), chain.begin() + 1, chain.end() - 1);
    }
    std::sort(local.global.begin(), local.global.end());
    local.global.erase(std::unique(local.global.begin(), local.global.end()), local.global.end());
    local.points.reserve(local.global.size());
    for (Index v : local.global) local.points.push_back(points[v]);
    const auto local_id = [&](Index v) {
        return VertexId(static_cast<std::size_t>(std::lower_bound(local.global.begin(), local.global.end(), v) -
                                                 local.global.begin()));
    };
    for (const PartSide& side : part.sides) {
        const auto& chain = borders[side.border].chain;
        for (std::size_t i = 0; i + 1 < chain.size(); ++i) {
            const VertexId a = local_id(chain[i]), b = local_id(chain[i + 1]);
            local.segments.push_back(side.forward ? Segment{a, b} : Segment{b, a});
            local.subsegments.push_back({side.border, i});
        }
    }
    return local;
}

ConstrainedParts find_parts(std::span<const Point> points, const ConstrainedTriangulation& triangulation,
                            const SizeField& size, std::span<const RegionSize> regions) {
    ConstrainedParts result;
    result.points.assign(points.begin(), points.end());
    result.points.insert(result.points.end(), triangulation.steiner_points.begin(), triangulation.steiner_points.end());
    result.border_of_vertex.assign(result.points.size(), no_index);
    EdgeTable edges;
    edges.opposite = find_opposite_edges(triangulation);
    edges.border = find_borders(triangulation, edges.opposite, result.borders);
    const std::vector<Index> part_of_triangle = make_parts(triangulation, edges, result);
    find_corners(triangulation, edges, result);
    assign_sizes(triangulation, size, regions, part_of_triangle, result);
    return result;
}

}  // namespace lamina::delaunay
