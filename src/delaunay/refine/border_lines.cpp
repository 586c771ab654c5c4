// Lines and the vertices on them are found by number; where vertices lie on a line is sorted out once, at the end.
#include "delaunay/refine/border_lines.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include <lamina/predicates.hpp>

#include "core/segments.hpp"
#include "delaunay/constrain/straight_chains.hpp"
#include "delaunay/refine/triangle_shape.hpp"

namespace lamina::delaunay {

BorderLines::BorderLines(std::span<const Point> points, std::span<const Segment> segments,
                         std::span<const Index> parents, const Tris& tris)
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
    chain_of_line_ = straight_chains(points, lines_, parents, unresolved_distances_);
    find_chain_corners();
    list_chains_at_ends();
    find_coincident_chains(points, tris);
    if (!chain_corners_.empty() || !coincident_.empty()) return;
    first_chain_.clear();
    chains_of_ends_.clear();
}

bool BorderLines::meet(Index l, Index m) const {
    const Segment p = lines_[l], q = lines_[m];
    if (p.a == q.a || p.a == q.b || p.b == q.a || p.b == q.b) return true;
    const Index chain = chain_of_line_[l], other = chain_of_line_[m];
    return chain == other || !chain_corners(chain, other).empty() || are_coincident(chain, other);
}

Index BorderLines::line_of_edge(Index a, Index b) const {
    if (const Index line = line_of_vertex(a); line != no_index) return line;
    if (const Index line = line_of_vertex(b); line != no_index) return line;
    const std::uint64_t key = undirected_key(a, b);
    const auto found = std::lower_bound(by_ends_.begin(), by_ends_.end(), std::pair{key, Index{0}});
    return found != by_ends_.end() && found->first == key ? found->second : no_index;
}

void BorderLines::add_vertex(Index v, Index line) {
    assert(v >= line_of_vertex_.size() && line < lines_.size());
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
    return chain_apex(points, edge.a, edge.b);
}

std::span<const BorderLines::ChainCorner> BorderLines::chain_corners(Index chain, Index other) const {
    const auto [first, second] = std::minmax({chain, other});
    const auto begin = std::lower_bound(chain_corners_.begin(), chain_corners_.end(), ChainCorner{first, second, 0});
    auto end = begin;
    while (end != chain_corners_.end() && end->first == first && end->second == second) ++end;
    // The C++ library of browsers makes no span of two iterators.
    return {chain_corners_.data() + (begin - chain_corners_.begin()), static_cast<std::size_t>(end - begin)};
}

std::span<const Index> BorderLines::chains_at(Index v) const {
    if (first_chain_.empty()) return {};
    if (const Index line = line_of_vertex(v); line != no_index) return {&chain_of_line_[line], 1};
    if (v + 1 >= first_chain_.size()) return {};
    return std::span(chains_of_ends_).subspan(first_chain_[v], first_chain_[v + 1] - first_chain_[v]);
}

/// Returns a vertex at which chains of a and b meet, and from which both are seen at less than 60 degrees; no_index if
/// there is none.
Index BorderLines::chain_apex(std::span<const Point> points, Index a, Index b) const {
    for (const Index chain : chains_at(a)) {
        for (const Index other : chains_at(b)) {
            if (chain == other) continue;
            for (const ChainCorner& corner : chain_corners(chain, other)) {
                const Point at = points[corner.vertex], u = points[a] - at, v = points[b] - at;
                if (core::encloses_sharp_angle(u, v) || core::encloses_sharp_angle(v, u)) return corner.vertex;
            }
        }
    }
    return no_index;
}

bool BorderLines::join_sharp_lines(std::span<const Point> points, const SidedEdge& edge) const {
    return sharp_apex(points, edge) != no_index;
}

Index BorderLines::facing_corner(std::span<const Point> points, Index line, Index p) const {
    const Segment s = lines_[line];
    if (is_sharp_apex(points, s.a.value, s.b.value, p)) return s.a.value;
    if (is_sharp_apex(points, s.b.value, s.a.value, p)) return s.b.value;
    const Index from_a = chain_apex(points, s.a.value, p);
    return from_a != no_index ? from_a : chain_apex(points, s.b.value, p);
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

/// Finds the corners of chains among those of lines, which find_corners() has found.
void BorderLines::find_chain_corners() {
    std::vector<char> has_several(lines_.size(), 0);
    for (Index i = 0; i < lines_.size(); ++i)
        if (chain_of_line_[i] != i) has_several[chain_of_line_[i]] = 1;
    for (const SharpCorner& c : sharp_corners_) {
        const Index v = line_of_edge(c.u, c.v), w = line_of_edge(c.u, c.w);
        if (v == no_index || w == no_index) continue;
        const auto [first, second] = std::minmax({chain_of_line_[v], chain_of_line_[w]});
        if (has_several[first] || has_several[second]) chain_corners_.push_back({first, second, c.u});
    }
    std::sort(chain_corners_.begin(), chain_corners_.end());
    chain_corners_.erase(std::unique(chain_corners_.begin(), chain_corners_.end()), chain_corners_.end());
}

void BorderLines::list_chains_at_ends() {
    std::vector<std::pair<Index, Index>> chains;  // vertices and their chains
    chains.reserve(2 * lines_.size());
    for (Index i = 0; i < lines_.size(); ++i)
        for (const VertexId v : {lines_[i].a, lines_[i].b}) chains.emplace_back(v.value, chain_of_line_[i]);
    std::sort(chains.begin(), chains.end());
    chains.erase(std::unique(chains.begin(), chains.end()), chains.end());
    first_chain_.assign(acute_.size() + 1, chains.size());
    for (std::size_t i = chains.size(); i-- > 0;) first_chain_[chains[i].first] = i;
    for (std::size_t v = acute_.size(); v-- > 0;) first_chain_[v] = std::min(first_chain_[v], first_chain_[v + 1]);
    chains_of_ends_.reserve(chains.size());
    for (const auto& [vertex, chain] : chains) chains_of_ends_.push_back(chain);
}

/// Returns the two vertices of each chain that are furthest apart, at the place of its first line. All lines of a chain
/// lie on one line but for rounding, so that its ends are those that are furthest along the first one.
std::vector<Segment> BorderLines::chain_ends(std::span<const Point> points) const {
    std::vector<Segment> ends(lines_.begin(), lines_.end());
    for (Index i = 0; i < lines_.size(); ++i) {
        Segment& chain = ends[chain_of_line_[i]];
        const Segment first = lines_[chain_of_line_[i]];
        const Point along = points[first.b.index()] - points[first.a.index()];
        const auto before = [&](VertexId v, VertexId w) {
            return dot(points[w.index()] - points[v.index()], along) > 0;
        };
        for (const VertexId v : {lines_[i].a, lines_[i].b}) {
            if (before(v, chain.a)) chain.a = v;
            if (before(chain.b, v)) chain.b = v;
        }
    }
    return ends;
}

namespace {

/// Returns whether two straight lines run beside each other for at least 1 / coincidence_share times their distance,
/// which is the greater one of those at the ends of that part.
bool nearly_coincident(Point a, Point b, Point c, Point d) {
    const double length = distance(a, b);
    const Point along = (1 / length) * (b - a);
    double from = dot(along, c - a), to = dot(along, d - a);
    double left_from = cross(along, c - a), left_to = cross(along, d - a);
    if (from > to) {
        std::swap(from, to);
        std::swap(left_from, left_to);
    }
    const double begin = std::max(from, 0.0), end = std::min(to, length);
    if (!(end > begin)) return false;
    const double slope = (left_to - left_from) / (to - from);
    const double apart =
        std::max(std::abs(left_from + slope * (begin - from)), std::abs(left_from + slope * (end - from)));
    return apart <= coincidence_share * (end - begin);
}

}  // namespace

/// Returns the pairs of chains that share a flat triangle, each either way, sorted.
std::vector<BorderLines::ChainPair> BorderLines::chains_of_flat_triangles(std::span<const Point> points,
                                                                          const Tris& tris, double flat) const {
    std::vector<ChainPair> pairs;
    const auto add = [&](Index v, Index w) {
        for (const Index chain : chains_at(v))
            for (const Index other : chains_at(w))
                if (chain != other) pairs.insert(pairs.end(), {{chain, other}, {other, chain}});
    };
    for (const Tri& tri : tris) {
        const TriangleShape s = shape_of(points, tri);
        if (!(s.area2 * s.area2 <= flat * flat * s.squared[s.longest()])) continue;
        for (unsigned e = 0; e < 3; ++e) add(tri.v[next(e)], tri.v[previous(e)]);
    }
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    return pairs;
}

/// Finds chains that nearly coincide. Flat triangles join two of them where nothing lies between. Where they come to
/// face each other only once they are split, others that nearly coincide with both lie between.
void BorderLines::find_coincident_chains(std::span<const Point> points, const Tris& tris) {
    const std::vector<Segment> ends = chain_ends(points);
    double longest = 0;
    for (const Segment& s : ends) longest = std::max(longest, distance(points[s.a.index()], points[s.b.index()]));
    const auto coincide = [&](Index chain, Index other) {
        const auto [a, b] = ends[chain];
        const auto [c, d] = ends[other];
        return nearly_coincident(points[a.index()], points[b.index()], points[c.index()], points[d.index()]);
    };
    std::vector<ChainPair> joined = chains_of_flat_triangles(points, tris, coincidence_share * longest);
    std::erase_if(joined, [&](const ChainPair& pair) {
        return !coincide(std::min(pair.first, pair.second), std::max(pair.first, pair.second));
    });
    std::vector<Index> seen_from(lines_.size(), no_index), front;
    for (std::size_t i = 0; i < joined.size(); ++i) {
        const Index from = joined[i].first;
        if (i > 0 && joined[i - 1].first == from) continue;
        seen_from[from] = from;
        front.assign(1, from);
        while (!front.empty()) {
            auto at = std::lower_bound(joined.begin(), joined.end(), ChainPair{front.back(), 0});
            const Index through = front.back();
            front.pop_back();
            for (; at != joined.end() && at->first == through; ++at) {
                if (std::exchange(seen_from[at->second], from) == from || !coincide(from, at->second)) continue;
                coincident_.push_back(std::minmax({from, at->second}));
                front.push_back(at->second);
            }
        }
    }
    std::sort(coincident_.begin(), coincident_.end());
    coincident_.erase(std::unique(coincident_.begin(), coincident_.end()), coincident_.end());
}

bool BorderLines::are_coincident(Index chain, Index other) const {
    return std::binary_search(coincident_.begin(), coincident_.end(), ChainPair(std::minmax({chain, other})));
}

bool BorderLines::nearly_coincide(Index line, Index p) const {
    if (coincident_.empty() || line == no_index) return false;
    const std::span<const Index> chains = chains_at(p);
    return std::any_of(chains.begin(), chains.end(),
                       [&](Index chain) { return are_coincident(chain, chain_of_line_[line]); });
}

bool BorderLines::lies_between_coincident_chains(const Tri& tri) const {
    if (coincident_.empty()) return false;
    const auto is_beside = [&](Index chain, Index v) {
        const std::span<const Index> chains = chains_at(v);
        return std::any_of(chains.begin(), chains.end(),
                           [&](Index at_v) { return at_v == chain || are_coincident(at_v, chain); });
    };
    for (unsigned e = 0; e < 3; ++e)
        for (const Index chain : chains_at(tri.v[next(e)]))
            for (const Index other : chains_at(tri.v[previous(e)]))
                if ((is_beside(chain, tri.v[e]) || is_beside(other, tri.v[e])) && are_coincident(chain, other))
                    return true;
    return false;
}

}  // namespace lamina::delaunay
