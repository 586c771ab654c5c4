// Lines and the vertices on them are found by number; where vertices lie on a line is sorted out once, at the end.
#include "delaunay/border_lines.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <lamina/predicates.hpp>

#include "core/segments.hpp"

namespace lamina::delaunay {

BorderLines::BorderLines(std::span<const Point> points, std::span<const Segment> segments, const Tris& tris)
    : lines_(segments.begin(), segments.end()) {
    for (Index i = 0; i < lines_.size(); ++i)
        by_ends_.emplace_back(undirected_key(lines_[i].a.value, lines_[i].b.value), i);
    std::sort(by_ends_.begin(), by_ends_.end());
    for (const Tri& t : tris) {
        for (unsigned e = 0; e < 3; ++e) {
            const Index a = t.v[next(e)], b = t.v[previous(e)];
            if (!t.n[e].is_border() || line_of_edge(a, b) != no_index) continue;
            lines_.push_back({VertexId{a}, VertexId{b}});
        }
    }
    for (auto i = static_cast<Index>(segments.size()); i < lines_.size(); ++i)
        by_ends_.emplace_back(undirected_key(lines_[i].a.value, lines_[i].b.value), i);
    std::sort(by_ends_.begin(), by_ends_.end());
    for (const Segment& line : lines_)
        unresolved_distances_.push_back(delaunay::unresolved_distance(points[line.a.index()], points[line.b.index()]));
    find_corners(points, tris);
}

Index BorderLines::line_of_edge(Index a, Index b) const {
    if (const Index line = line_of_vertex(a); line != no_index) return line;
    if (const Index line = line_of_vertex(b); line != no_index) return line;
    const std::uint64_t key = undirected_key(a, b);
    const auto found = std::lower_bound(by_ends_.begin(), by_ends_.end(), std::pair{key, Index{0}});
    return found != by_ends_.end() && found->first == key ? found->second : no_index;
}

void BorderLines::add_vertex(Index v, Index line) {
    line_of_vertex_.resize(v, no_index);
    line_of_vertex_.push_back(line);
    ++splits_;
}

Point BorderLines::division_point(std::span<const Point> points, Index a, Index b) const {
    const bool from_a = is_acute(a), from_b = is_acute(b);
    if (from_a == from_b) return midpoint(points[a], points[b]);
    const Point corner = points[from_a ? a : b], far = points[from_a ? b : a];
    const double whole = distance(corner, far);
    int exponent = 0;
    std::frexp(whole * (2.0 / 3.0), &exponent);
    return corner + (std::ldexp(0.5, exponent) / whole) * (far - corner);
}

Index BorderLines::line_from(Index corner, Index v) const {
    const Index line = line_of_edge(corner, v);
    if (line == no_index) return no_index;
    return lines_[line].a.value == corner || lines_[line].b.value == corner ? line : no_index;
}

bool BorderLines::is_sharp_apex(std::span<const Point> points, Index corner, Index a, Index b) const {
    if (corner == a || corner == b) return false;
    const Index line_a = line_from(corner, a);
    if (line_a == no_index) return false;
    const Index line_b = line_from(corner, b);
    if (line_b == no_index || line_b == line_a) return false;
    const Point u = points[a] - points[corner], v = points[b] - points[corner];
    return core::encloses_sharp_angle(u, v) || core::encloses_sharp_angle(v, u);
}

Index BorderLines::sharp_apex(std::span<const Point> points, const SidedEdge& edge) const {
    for (const Index v : {edge.opposite, edge.a, edge.b}) {
        const Index line = line_of_vertex(v);
        const Index first = line == no_index ? v : lines_[line].a.value;
        const Index second = line == no_index ? v : lines_[line].b.value;
        for (const Index corner : {first, second})
            if (is_sharp_apex(points, corner, edge.a, edge.b)) return corner;
    }
    return no_index;
}

bool BorderLines::join_sharp_lines(std::span<const Point> points, const SidedEdge& edge) const {
    return sharp_apex(points, edge) != no_index;
}

Index BorderLines::facing_corner(std::span<const Point> points, Index line, Index p) const {
    const Segment s = lines_[line];
    if (is_sharp_apex(points, s.a.value, s.b.value, p)) return s.a.value;
    return is_sharp_apex(points, s.b.value, s.a.value, p) ? s.b.value : no_index;
}

bool BorderLines::join_shells(std::span<const Point> points, const SidedEdge& edge) const {
    const Index apex = sharp_apex(points, edge);
    if (apex == no_index) return false;
    if (apex == edge.opposite) return true;
    const auto [a, b, opposite] = edge;
    // Radii of different shells differ by a factor of two, those of one shell by rounding.
    constexpr double tolerance = 0.001;
    const double to_a = distance(points[apex], points[a]), to_b = distance(points[apex], points[b]);
    return std::abs(to_a - to_b) <= tolerance * to_b;
}

bool BorderLines::in_sharp_corner(std::span<const Point> points, Index u, Point p) const {
    auto c = std::lower_bound(sharp_corners_.begin(), sharp_corners_.end(), u,
                              [](const SharpCorner& corner, Index value) { return corner.u < value; });
    for (; c != sharp_corners_.end() && c->u == u; ++c)
        if (orient2d(points[u], points[c->v], p) >= 0 && orient2d(points[u], p, points[c->w]) >= 0) return true;
    return false;
}

std::vector<std::vector<Index>> BorderLines::chains(std::span<const Point> points) const {
    std::vector<std::vector<Index>> chains(lines_.size());
    for (std::size_t i = 0; i < lines_.size(); ++i) chains[i].push_back(lines_[i].a.value);
    for (Index v = 0; v < line_of_vertex_.size(); ++v)
        if (line_of_vertex_[v] != no_index) chains[line_of_vertex_[v]].push_back(v);
    for (std::size_t i = 0; i < lines_.size(); ++i) {
        // Coordinates are compared as they are: differences from one end would be equal at the other, where vertices
        // may be 1e-30 times as far apart as the line is long.
        const Point along = points[lines_[i].b.index()] - points[lines_[i].a.index()];
        const bool by_x = std::abs(along.x) >= std::abs(along.y);
        const double sign_x = along.x < 0 ? -1 : 1, sign_y = along.y < 0 ? -1 : 1;
        const auto key = [&](Index v) {
            const double x = sign_x * points[v].x, y = sign_y * points[v].y;
            return by_x ? std::pair{x, y} : std::pair{y, x};
        };
        std::sort(chains[i].begin() + 1, chains[i].end(), [&](Index v, Index w) { return key(v) < key(w); });
        chains[i].push_back(lines_[i].b.value);
    }
    return chains;
}

/// Finds the corners where lines meet at less than 90 or 60 degrees. From each line u-v the search turns
/// counter-clockwise round u, through triangles, to the next line u-w.
void BorderLines::find_corners(std::span<const Point> points, const Tris& tris) {
    acute_.assign(points.size(), 0);
    for (Index start = 0; start < tris.size(); ++start) {
        for (unsigned e = 0; e < 3; ++e) {
            if (!tris[start].n[e].is_constrained()) continue;
            const Index u = tris[start].v[next(e)], v = tris[start].v[previous(e)];
            // In the triangle (apex, u, v) the edge from the apex to u is the one opposite v.
            Index t = start;
            unsigned leaving = previous(e);
            while (!tris[t].n[leaving].is_constrained()) {
                const Link across = tris[t].n[leaving];
                t = across.triangle();
                leaving = previous(across.edge());
            }
            const Index w = tris[t].v[next(leaving)];
            const Point a = points[v] - points[u], b = points[w] - points[u];
            if (!(orient2d(points[u], points[v], points[w]) > 0 && dot(a, b) > 0)) continue;
            acute_[u] = 1;
            if (core::encloses_sharp_angle(a, b)) sharp_corners_.push_back({u, v, w});
        }
    }
    std::sort(sharp_corners_.begin(), sharp_corners_.end(),
              [](const SharpCorner& l, const SharpCorner& r) { return l.u != r.u ? l.u < r.u : l.v < r.v; });
}

}  // namespace lamina::delaunay
