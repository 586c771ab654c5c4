// A cell that is much higher than wide is cut badly into triangles where its top is divided: the line between the
// centroids of two triangles beside each other is far from orthogonal to the diagonal between them. For a rectangle that
// is 2.4 times as high as wide this is 56 degrees, however it is cut. With a quadrilateral on the lower edge it is 39:
//
//     c--q--b            c--q--b
//     | / \ |            | /   |
//     |/   \|            |/    |
//     d-----a            d-----a
//
// At a step of the front, a side of the cell has two edges. By its angles the best triangle on the lower one may have
// its middle far below that of the edge, as the long cell beyond the side has, which makes a skewed face. Then one
// diagonal is turned (docs/decisions/0060).
#include "layers/join_triangles.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/predicates.hpp"

namespace lamina::layers {

namespace {

/// Costs closer than this, relatively, count as equal.
constexpr double rounding = 1e-6;
/// A side may be skewed by this before a diagonal is turned. It costs as much as a face inside the cell that is off a
/// right angle by 45 degrees then.
constexpr double most_skewness = 0.7;
/// Turned diagonals make no angles above 135 degrees.
constexpr double least_cosine_of_turned = -0.7071;

bool has_corner(const Triangle& t, VertexId v) { return t.v[0] == v || t.v[1] == v || t.v[2] == v; }

/// Returns whether a triangle of a strip stands on an edge of the lower chain. Its second corner is on the upper one.
bool stands_on_lower(const Triangle& t, std::span<const VertexId> lower) {
    return std::find(lower.begin(), lower.end(), t.v[2]) != lower.end();
}

/// Returns the two triangles, successive ones of a strip that stand on edges of different chains, with the other
/// diagonal between them.
std::array<Triangle, 2> turned(const Triangle& t, const Triangle& next, bool first_stands_on_lower) {
    if (first_stands_on_lower) return {{{{t.v[0], t.v[1], next.v[2]}}, {{t.v[0], next.v[2], t.v[2]}}}};
    return {{{{t.v[0], t.v[1], next.v[2]}}, {{next.v[2], t.v[1], t.v[2]}}}};
}

/// Returns the quadrilateral of two triangles that share an edge, counter-clockwise from `a` on.
Quad joined(const Triangle& t, const Triangle& other, VertexId a) {
    int alone = 0;  // the corner of t that the other one has not
    while (has_corner(other, t.v[alone])) ++alone;
    int apex = 0;
    while (has_corner(t, other.v[apex])) ++apex;
    std::array<VertexId, 4> corners{t.v[alone], t.v[(alone + 1) % 3], other.v[apex], t.v[(alone + 2) % 3]};
    std::rotate(corners.begin(), std::find(corners.begin(), corners.end(), a), corners.end());
    return {{corners[0], corners[1], corners[2], corners[3]}};
}

/// The triangles of a cell from one side to the other, of which two are joined, or none.
class CellCut {
public:
    CellCut(std::span<const Point> points, std::span<const Triangle> triangles)
        : points_(points), triangles_(triangles) {}

    bool is_convex(const Quad& quad) const {
        return core::is_convex(at(quad.v[0]), at(quad.v[1]), at(quad.v[2]), at(quad.v[3]));
    }

    /// Returns whether a triangle is counter-clockwise (exact) and has no angle that is too large for a turned one.
    bool is_sound(const Triangle& t) const {
        const Point p[] = {at(t.v[0]), at(t.v[1]), at(t.v[2])};
        if (!(core::inline_orient2d(p[0], p[1], p[2]) > 0)) return false;
        for (int k = 0; k < 3; ++k) {
            const Point u = p[(k + 1) % 3] - p[k], v = p[(k + 2) % 3] - p[k];
            if (dot(u, v) < least_cosine_of_turned * length(u) * length(v)) return false;
        }
        return true;
    }

    /// Returns the squared skewness of a side of the cell: of the distance from its middle to the line between the
    /// centroids of both cells, along the side and over half of its length. `first` as in worst_face().
    double skewness(const CellSide& side, std::size_t first) const {
        std::size_t t = 0;
        while (!has_corner(triangles_[t], side.lower) || !has_corner(triangles_[t], side.upper)) ++t;
        const Point along = at(side.upper) - at(side.lower), middle = midpoint(at(side.lower), at(side.upper));
        const Point own = centroid(t, first) - middle, beyond = side.beyond - middle;
        const double across = std::abs(cross(along, own)), across_beyond = std::abs(cross(along, beyond));
        const double off = (across * dot(beyond, along) + across_beyond * dot(own, along)) / (across + across_beyond);
        return 4 * off * off / (squared_length(along) * squared_length(along));
    }

    /// Returns the largest squared cosine of the angle between a face inside the cell and the line between the
    /// centroids on both sides. Triangle `first` is joined with the next one; none is where there is no such triangle.
    double worst_face(std::size_t first) const {
        double worst = 0;
        for (std::size_t t = 0; t + 1 < triangles_.size(); ++t) {
            if (t == first) continue;  // there is no face between the two any more
            const Point along = common_edge(t);
            const Point across = centroid(t + 1, first) - centroid(t, first);
            const double product = dot(along, across);
            worst = std::max(worst, product * product / (squared_length(along) * squared_length(across)));
        }
        return worst;
    }

private:
    std::span<const Point> points_;
    std::span<const Triangle> triangles_;

    Point at(VertexId v) const { return points_[v.index()]; }

    /// Returns the edge between a triangle and the next one as a vector.
    Point common_edge(std::size_t t) const {
        int alone = 0;
        while (has_corner(triangles_[t + 1], triangles_[t].v[alone])) ++alone;
        return at(triangles_[t].v[(alone + 2) % 3]) - at(triangles_[t].v[(alone + 1) % 3]);
    }

    /// Returns the centroid of the cell that a triangle is part of.
    Point centroid(std::size_t t, std::size_t first) const {
        if (t != first && t != first + 1) return own_centroid(t);
        const double area = own_area(first), next_area = own_area(first + 1);
        return 1 / (area + next_area) * (area * own_centroid(first) + next_area * own_centroid(first + 1));
    }
    Point own_centroid(std::size_t t) const {
        const VertexId* v = triangles_[t].v;
        return 1.0 / 3 * (at(v[0]) + at(v[1]) + at(v[2]));
    }
    double own_area(std::size_t t) const {
        const VertexId* v = triangles_[t].v;
        return cross(at(v[1]) - at(v[0]), at(v[2]) - at(v[0]));
    }
};

/// Which triangle of a cell is joined with the next one, and the cost of the worst face inside the cell then.
struct Joint {
    std::size_t first;  ///< as many as there are triangles: none is
    double cost;
    Quad quad;  ///< if any
};

/// Returns the best way to join the triangle on the edge between `a` and `d` with one beside it, or not to.
Joint best_joint(std::span<const Point> points, std::span<const Triangle> triangles, VertexId a, VertexId d,
                 bool first_leads) {
    const auto on_edge = std::find_if(triangles.begin(), triangles.end(),
                                      [&](const Triangle& t) { return has_corner(t, a) && has_corner(t, d); });
    const auto k = static_cast<std::size_t>(on_edge - triangles.begin());
    const CellCut cut(points, triangles);
    const std::size_t n = triangles.size();
    Joint best{n, cut.worst_face(n) * (1 + rounding), {}};
    for (const bool before : {first_leads, !first_leads}) {
        if (before ? k == 0 : k + 1 == n) continue;
        const std::size_t first = before ? k - 1 : k;
        const Quad quad = joined(triangles[first], triangles[first + 1], a);
        const double cost = cut.worst_face(first);
        if (cost < best.cost && cut.is_convex(quad)) best = {first, cost * (1 - rounding), quad};
    }
    return best;
}

}  // namespace

void turn_from_side(std::span<const Point> points, std::span<const VertexId> lower, const std::array<VertexId, 2>& edge,
                    const CellSide& side, bool first_leads, std::size_t begin, std::vector<Triangle>& triangles) {
    const std::span<Triangle> strip = std::span(triangles).subspan(begin);
    const CellCut cut(points, strip);
    const Joint own = best_joint(points, strip, edge[0], edge[1], first_leads);
    const double skewness = cut.skewness(side, own.first);
    if (!(skewness > most_skewness * most_skewness)) return;
    double best_cost = std::max(skewness, own.cost) * (1 - rounding);
    std::size_t best = strip.size();
    std::array<Triangle, 2> best_pair;
    for (std::size_t i = 0; i + 1 < strip.size(); ++i) {
        const std::size_t t = first_leads ? i : strip.size() - 2 - i;
        const std::array<Triangle, 2> pair{strip[t], strip[t + 1]};
        const bool on_lower = stands_on_lower(pair[0], lower);
        if (on_lower == stands_on_lower(pair[1], lower)) continue;
        const std::array<Triangle, 2> other = turned(pair[0], pair[1], on_lower);
        if (!cut.is_sound(other[0]) || !cut.is_sound(other[1])) continue;
        std::copy(other.begin(), other.end(), strip.begin() + static_cast<std::ptrdiff_t>(t));
        const Joint joint = best_joint(points, strip, edge[0], edge[1], first_leads);
        const double cost = std::max(cut.skewness(side, joint.first), joint.cost);
        std::copy(pair.begin(), pair.end(), strip.begin() + static_cast<std::ptrdiff_t>(t));
        if (!(cost < best_cost)) continue;
        best = t;
        best_pair = other;
        best_cost = cost * (1 - rounding);
    }
    if (best < strip.size())
        std::copy(best_pair.begin(), best_pair.end(), strip.begin() + static_cast<std::ptrdiff_t>(best));
}

std::optional<Quad> join_on_lower_edge(std::span<const Point> points, VertexId a, VertexId d, bool first_leads,
                                       std::size_t begin, std::vector<Triangle>& triangles) {
    const Joint joint = best_joint(points, std::span(triangles).subspan(begin), a, d, first_leads);
    if (begin + joint.first == triangles.size()) return std::nullopt;
    const auto first = triangles.begin() + static_cast<std::ptrdiff_t>(begin + joint.first);
    triangles.erase(first, first + 2);
    return joint.quad;
}

}  // namespace lamina::layers
