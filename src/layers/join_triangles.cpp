// A cell that is much higher than wide is cut badly into triangles where its top is divided: the line between the
// centroids of two triangles beside each other is far from orthogonal to the diagonal between them. For a rectangle that
// is 2.4 times as high as wide this is 56 degrees, however it is cut. With a quadrilateral on the lower edge it is 39:
//
//     c--q--b            c--q--b
//     | / \ |            | /   |
//     |/   \|            |/    |
//     d-----a            d-----a
//
#include "layers/join_triangles.hpp"

#include <algorithm>
#include <array>

#include "core/predicates.hpp"

namespace lamina::layers {

namespace {

/// Costs closer than this, relatively, count as equal.
constexpr double rounding = 1e-6;

bool has_corner(const Triangle& t, VertexId v) { return t.v[0] == v || t.v[1] == v || t.v[2] == v; }

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
        for (int k = 0; k < 4; ++k)
            if (!(core::inline_orient2d(at(quad.v[k]), at(quad.v[(k + 1) % 4]), at(quad.v[(k + 2) % 4])) > 0))
                return false;
        return true;
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

}  // namespace

std::optional<Quad> join_on_lower_edge(std::span<const Point> points, VertexId a, VertexId d, bool first_leads,
                                       std::size_t begin, std::vector<Triangle>& triangles) {
    const auto from = triangles.begin() + static_cast<std::ptrdiff_t>(begin);
    const auto on_edge =
        std::find_if(from, triangles.end(), [&](const Triangle& t) { return has_corner(t, a) && has_corner(t, d); });
    const auto k = static_cast<std::size_t>(on_edge - from);
    const CellCut cut(points, std::span(triangles).subspan(begin));
    const std::size_t n = triangles.size() - begin;
    std::optional<Quad> best;
    double best_cost = cut.worst_face(n) * (1 + rounding);
    std::size_t best_first = 0;
    for (const bool before : {first_leads, !first_leads}) {
        if (before ? k == 0 : k + 1 == n) continue;
        const std::size_t first = before ? k - 1 : k;
        const Quad quad = joined(triangles[begin + first], triangles[begin + first + 1], a);
        const double cost = cut.worst_face(first);
        if (!(cost < best_cost) || !cut.is_convex(quad)) continue;
        best = quad;
        best_first = first;
        best_cost = cost * (1 - rounding);
    }
    if (best)
        triangles.erase(from + static_cast<std::ptrdiff_t>(best_first),
                        from + static_cast<std::ptrdiff_t>(best_first) + 2);
    return best;
}

}  // namespace lamina::layers
