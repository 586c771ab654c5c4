// The search for the best cut of a strip: dynamic programming over pairs of one corner of each chain. A first pass
// finds the smallest largest angle, a second one the least sum among the cuts with that angle.
#include "layers/cells/strip.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "core/predicates.hpp"

namespace lamina::layers {

namespace {

/// Cosines closer than this count as equal. In cells as thin as 1e-9 of their coordinates, rounding is no smaller.
constexpr double cosine_rounding = 1e-6;

/// Returns the cosine of the largest angle; -2, below all cosines, unless the triangle is counter-clockwise (exact).
double largest_angle_cosine(Point a, Point b, Point c) {
    if (!(core::inline_orient2d(a, b, c) > 0)) return -2;
    const Point ab = b - a, bc = c - b, ca = a - c;
    const double l = length(ab), m = length(bc), n = length(ca);
    return std::max(-1.0, -std::max({dot(ab, bc) / (l * m), dot(bc, ca) / (m * n), dot(ca, ab) / (n * l)}));
}

/// Returns what a triangle with this cosine of its largest angle adds to the sum that cuts are compared by: 1 for a
/// right angle, always finite.
double burden(double cosine) { return 1 / (1 + cosine + cosine_rounding); }

}  // namespace

bool StripCutter::cut(std::span<const VertexId> lower, std::span<const VertexId> upper, bool first_leads,
                      std::vector<Triangle>& triangles) {
    assert(!lower.empty() && !upper.empty() && lower.size() + upper.size() >= 3);
    lower_ = lower;
    upper_ = upper;
    const double min_cosine = find_min_cosine();
    if (min_cosine < -1) return false;
    min_cosine_ = min_cosine - cosine_rounding;
    find_burdens();
    for (std::size_t i = 0, j = 0; i + 1 < lower.size() || j + 1 < upper.size();) {
        const double via_upper = burden_via_upper(i, j), via_lower = burden_via_lower(i, j);
        const double slack = cosine_rounding * std::min(via_upper, via_lower);
        if (first_leads ? via_upper <= via_lower + slack : via_upper + slack < via_lower) {
            // Cosines of triangles that are not counter-clockwise are below all others.
            assert(j + 1 < upper.size() && state(i, j).upper_cosine >= -1);
            triangles.push_back({{lower[i], upper[j], upper[j + 1]}});
            ++j;
        } else {
            assert(i + 1 < lower.size() && state(i, j).lower_cosine >= -1);
            triangles.push_back({{lower[i], upper[j], lower[i + 1]}});
            ++i;
        }
    }
    return true;
}

/// Sets the cosines of all states. Returns the smallest cosine of the best cut; -2 where every cut has a triangle that
/// is not positive.
double StripCutter::find_min_cosine() {
    const std::size_t rows = lower_.size(), columns = upper_.size();
    const auto at = [&](VertexId v) { return points_[v.index()]; };
    states_.assign(rows * columns, {});
    state(0, 0).min_cosine = 1;
    for (std::size_t i = 0; i < rows; ++i) {
        for (std::size_t j = 0; j < columns; ++j) {
            CutState& here = state(i, j);
            if (j + 1 < columns) {
                here.upper_cosine = largest_angle_cosine(at(lower_[i]), at(upper_[j]), at(upper_[j + 1]));
                double& next = state(i, j + 1).min_cosine;
                next = std::max(next, std::min(here.min_cosine, here.upper_cosine));
            }
            if (i + 1 < rows) {
                here.lower_cosine = largest_angle_cosine(at(lower_[i]), at(upper_[j]), at(lower_[i + 1]));
                double& next = state(i + 1, j).min_cosine;
                next = std::max(next, std::min(here.min_cosine, here.lower_cosine));
            }
        }
    }
    return state(rows - 1, columns - 1).min_cosine;
}

/// Sets the burdens of all states, from the last side to the first.
void StripCutter::find_burdens() {
    const std::size_t columns = upper_.size();
    states_.back().burden = 0;
    for (std::size_t k = states_.size() - 1; k-- > 0;)
        states_[k].burden =
            std::min(burden_via_upper(k / columns, k % columns), burden_via_lower(k / columns, k % columns));
}

/// Returns the least burden from a state on if the next triangle stands on the upper chain; infinite where that is no
/// part of a best cut.
double StripCutter::burden_via_upper(std::size_t i, std::size_t j) const {
    if (j + 1 == upper_.size() || !(state(i, j).upper_cosine >= min_cosine_)) return HUGE_VAL;
    return burden(state(i, j).upper_cosine) + state(i, j + 1).burden;
}

/// Returns the least burden from a state on if the next triangle stands on the lower chain; infinite where that is no
/// part of a best cut.
double StripCutter::burden_via_lower(std::size_t i, std::size_t j) const {
    if (i + 1 == lower_.size() || !(state(i, j).lower_cosine >= min_cosine_)) return HUGE_VAL;
    return burden(state(i, j).lower_cosine) + state(i + 1, j).burden;
}

// A cell that is much higher than wide is cut badly into triangles where its top is divided: the line between the
// centroids of two triangles beside each other is far from orthogonal to the diagonal between them. For a rectangle that
// is 2.4 times as high as wide this is 56 degrees, however it is cut. With a quadrilateral on the lower edge it is 39:
//
//     c--q--b            c--q--b
//     | / \ |            | /   |
//     |/   \|            |/    |
//     d-----a            d-----a

namespace {

/// Costs closer than this, relatively, count as equal.
constexpr double cost_rounding = 1e-6;
bool has_corner(const Triangle& t, VertexId v) { return t.v[0] == v || t.v[1] == v || t.v[2] == v; }

/// Returns the quadrilateral of two triangles that share an edge, counter-clockwise from `a` on.
Quad joined(const Triangle& t, const Triangle& other, VertexId a) {
    int alone = 0;  // the corner of t that the other one has not
    while (has_corner(other, t.v[alone])) ++alone;
    int apex = 0;
    while (has_corner(t, other.v[apex])) ++apex;
    assert(alone < 3 && apex < 3 && t.v[(alone + 1) % 3] == other.v[(apex + 2) % 3] &&
           t.v[(alone + 2) % 3] == other.v[(apex + 1) % 3]);
    std::array<VertexId, 4> corners{t.v[alone], t.v[(alone + 1) % 3], other.v[apex], t.v[(alone + 2) % 3]};
    std::rotate(corners.begin(), std::find(corners.begin(), corners.end(), a), corners.end());
    assert(corners[0] == a);
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
    assert(on_edge != triangles.end());
    const auto k = static_cast<std::size_t>(on_edge - triangles.begin());
    const CellCut cut(points, triangles);
    const std::size_t n = triangles.size();
    Joint best{n, cut.worst_face(n) * (1 + cost_rounding), {}};
    for (const bool before : {first_leads, !first_leads}) {
        if (before ? k == 0 : k + 1 == n) continue;
        const std::size_t first = before ? k - 1 : k;
        const Quad quad = joined(triangles[first], triangles[first + 1], a);
        const double cost = cut.worst_face(first);
        if (cost < best.cost && cut.is_convex(quad)) best = {first, cost * (1 - cost_rounding), quad};
    }
    return best;
}

}  // namespace

std::optional<Quad> join_on_lower_edge(std::span<const Point> points, VertexId a, VertexId d, bool first_leads,
                                       std::size_t begin, std::vector<Triangle>& triangles) {
    const Joint joint = best_joint(points, std::span(triangles).subspan(begin), a, d, first_leads);
    if (begin + joint.first == triangles.size()) return std::nullopt;
    const auto first = triangles.begin() + static_cast<std::ptrdiff_t>(begin + joint.first);
    triangles.erase(first, first + 2);
    return joint.quad;
}

}  // namespace lamina::layers
