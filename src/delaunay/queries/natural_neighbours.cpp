// Sibson's weights: the share of each Voronoi cell that a new vertex would take.
//
// The triangles whose circles hold the point p form its cavity; the neighbours are the corners of that polygon. What p
// takes from the cell of neighbour v is a polygon. Its corners are the centre N of the circle through p, v and the next
// neighbour, the centres C of the cavity's triangles at v, and the centre N' of the circle through p, the neighbour
// before and v:
//
//            C1 --- C2
//           /        \          Each edge a -> b of a cavity triangle, with centre C on its left and X on its right
//          N ------- N'         (X = N on the cavity's boundary), is crossed by the polygon of a from X to C and by
//               p               that of b from C to X. The polygon of v is closed from N' to N.
//
// Source: R. Sibson, A vector identity for the Dirichlet tessellation, Math. Proc. Camb. Phil. Soc. 87 (1980); D. F.
// Watson, Contouring (1992).
#include <algorithm>
#include <array>

#include <lamina/predicates.hpp>

#include "core/predicates.hpp"
#include "delaunay/queries/query_index.hpp"
#include "delaunay/refine/triangle_shape.hpp"
#include "delaunay/triangulate/walk.hpp"

namespace lamina::delaunay::queries {

namespace {

/// An edge of the cavity's boundary, which starts at vertex a.
struct StolenShare {
    Index a;
    Point centre;      ///< of the circle through p, a and the next vertex
    double area2 = 0;  ///< twice the area that p takes from the cell of a
};

/// A triangle that the search has found beyond an edge of the cavity.
struct PendingTriangle {
    Link outer;
    Index b;       ///< the edge ends here, seen from the cavity
    Point centre;  ///< of the cavity triangle
};

/// A crossing of an edge by the polygons of its ends a and b.
struct CentreStep {
    Index a, b;
    Point from, to;  ///< for the polygon of a; the other way for that of b
};

/// Finds the cavity of p, depth first and counter-clockwise. Coordinates are relative to p.
class SibsonCavity {
public:
    SibsonCavity(const QueryIndex& index, Index start, Point p) : index_(index), p_(p) {
        const Tri& t = index.tris[start];
        const Point centre = centre_of(t);
        std::vector<PendingTriangle> stack;
        Index a = t.v[1];
        for (unsigned e = 3; e-- > 0;) stack.push_back({t.n[e], t.v[previous(e)], centre});
        while (!stack.empty()) {
            const PendingTriangle edge = stack.back();
            stack.pop_back();
            const Tri& outer = index.tris[edge.outer.triangle()];
            const unsigned k = edge.outer.edge();
            if (!holds_p(outer)) {
                const Point centre_outside = circumcentre({}, relative(a), relative(edge.b));
                shares.push_back({a, centre_outside});
                steps_.push_back({a, edge.b, centre_outside, edge.centre});
                a = edge.b;
                continue;
            }
            const Point beyond = centre_of(outer);
            steps_.push_back({a, edge.b, beyond, edge.centre});
            stack.push_back({outer.n[previous(k)], edge.b, beyond});
            stack.push_back({outer.n[next(k)], outer.v[k], beyond});
        }
        measure();
    }

    std::vector<StolenShare> shares;  ///< counter-clockwise round p

private:
    Point relative(Index v) const { return index_.vertices[v] - p_; }
    Point centre_of(const Tri& t) const { return circumcentre(relative(t.v[0]), relative(t.v[1]), relative(t.v[2])); }
    bool holds_p(const Tri& t) const {
        const Point* const v = index_.vertices.data();
        return !is_growing_ghost(t) && incircle(v[t.v[0]], v[t.v[1]], v[t.v[2]], p_) > 0;
    }

    /// Adds up the areas.
    void measure() {
        std::vector<std::pair<Index, std::size_t>> places;
        for (std::size_t i = 0; i < shares.size(); ++i) places.emplace_back(shares[i].a, i);
        std::sort(places.begin(), places.end());
        const auto share = [&](Index v) -> double& {
            return shares[std::lower_bound(places.begin(), places.end(), std::pair{v, std::size_t{0}})->second].area2;
        };
        for (const CentreStep& step : steps_) {
            const double twice = cross(step.from, step.to);
            share(step.a) += twice;
            share(step.b) -= twice;
        }
        for (std::size_t i = 0; i < shares.size(); ++i) {
            const Point before = shares[i > 0 ? i - 1 : shares.size() - 1].centre;
            shares[i].area2 += cross(before, shares[i].centre);
        }
    }

    const QueryIndex& index_;
    Point p_;
    std::vector<CentreStep> steps_;
};

NaturalNeighbours on_edge_between(const QueryIndex& index, Index a, Index b, Point p) {
    const double to_a = distance(index.vertices[a], p), to_b = distance(index.vertices[b], p);
    return {{VertexId{index.point_ids[a]}, VertexId{index.point_ids[b]}}, {to_b / (to_a + to_b), to_a / (to_a + to_b)}};
}

/// Returns whether the weighted mean of the neighbours is p, as Sibson's identity says. Where neighbours lie on a line
/// up to rounding, centres are so far away that the areas are lost.
bool reproduces(const QueryIndex& index, const SibsonCavity& cavity, const NaturalNeighbours& neighbours, Point p) {
    constexpr double tolerance = 1e-9;
    Point mean;
    double reach2 = 0;
    for (std::size_t i = 0; i < cavity.shares.size(); ++i) {
        const Point to = index.vertices[cavity.shares[i].a] - p;
        mean = mean + neighbours.weights[i] * to;
        reach2 = std::max(reach2, dot(to, to));
    }
    return dot(mean, mean) <= tolerance * tolerance * reach2;
}

NaturalNeighbours corners_of(const QueryIndex& index, const Tri& t, Point p) {
    NaturalNeighbours result;
    const std::array<double, 3> weights = linear_weights(index.vertices.data(), t, p);
    for (unsigned i = 0; i < 3; ++i) {
        result.vertices.emplace_back(index.point_ids[t.v[i]]);
        result.weights.push_back(std::max(weights[i], 0.0));
    }
    return result;
}

}  // namespace

NaturalNeighbours natural_neighbours_at(const QueryIndex& index, Index found, Point p) {
    const Tri& t = index.tris[found];
    if (is_growing_ghost(t)) return {};
    unsigned touched = 0, edge = 0, sum = 0;
    for (unsigned e = 0; e < 3; ++e) {
        if (core::inline_orient2d(index.vertices[t.v[next(e)]], index.vertices[t.v[previous(e)]], p) != 0) continue;
        ++touched;
        edge = e;
        sum += e;
    }
    if (touched == 2) return {{VertexId{index.point_ids[t.v[3 - sum]]}}, {1.0}};
    if (touched == 1 && is_growing_ghost(index.tris[t.n[edge].triangle()]))
        return on_edge_between(index, t.v[next(edge)], t.v[previous(edge)], p);
    const SibsonCavity cavity(index, found, p);
    NaturalNeighbours result;
    double sum_of_areas = 0;
    for (const StolenShare& s : cavity.shares) sum_of_areas += std::max(s.area2, 0.0);
    for (const StolenShare& s : cavity.shares) {
        result.vertices.emplace_back(index.point_ids[s.a]);
        result.weights.push_back(std::max(s.area2, 0.0) / sum_of_areas);
    }
    if (!reproduces(index, cavity, result, p)) return corners_of(index, t, p);
    return result;
}

}  // namespace lamina::delaunay::queries
