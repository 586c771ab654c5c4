// Delaunay refinement with a size field and a minimum angle: the steps that refinement with frozen borders and
// refinement with borders that may be split share. Triangles that are too large are mended first, then narrow ones,
// each by a new vertex. docs/decisions/0002 explains the order of work and gives figures.
//
// Refinement ends: a point placed for an angle is farther from every vertex than the shortest edge of the triangle it
// mends (for bounds up to 30 degrees); and points placed for size keep a distance of a share of h from every vertex.
//
// Sources: J. Ruppert, A Delaunay refinement algorithm for quality 2-dimensional mesh generation, J. Algorithms 18
// (1995); L. P. Chew, SoCG 1993; off-centres: A. Ungor, LATIN 2004; points at a prescribed size on the perpendicular
// bisector: S. Rebay, J. Comput. Phys. 106 (1993).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include <lamina/delaunay.hpp>

#include "core/predicates.hpp"
#include "core/reproducible_math.hpp"
#include "delaunay/angle_queue.hpp"
#include "delaunay/cavity.hpp"
#include "delaunay/triangles.hpp"

namespace lamina::delaunay {

/// Throws the MeshError for a refinement that needs more Steiner points than it may make.
[[noreturn]] void fail_too_many_points(std::size_t max_points);

/// Returns the power of two that brings an extent of this length near 1; 1 for the lengths that need no scaling. The
/// refiner multiplies coordinates by it, which is exact, so that squares and cubes of areas neither overflow nor vanish
/// wherever the coordinates lie in their range (docs/decisions/0005).
double unit_scale(double extent);

/// Returns whether a triangle's smallest angle is below a bound, given the squared sine of the bound, the squared edges
/// and twice the area: sin^2 of the smallest angle is (2 area)^2 / (product of the two longer squared edges).
inline bool is_angle_below(double squared_sine, double ab, double bc, double ca, double shortest, double area2) {
    return area2 * area2 * shortest < squared_sine * (ab * bc * ca);
}

/// The measures of a triangle that the decisions hang on.
struct TriangleShape {
    std::array<double, 3> squared;  ///< squared length of edge e
    double area2;                   ///< twice the area
    /// Returns the shortest edge.
    unsigned shortest() const {
        const unsigned m = squared[1] < squared[0] ? 1 : 0;
        return squared[2] < squared[m] ? 2 : m;
    }
};

/// Refines a triangulation whose borders are constrained edges or edges without a neighbour. The derived class knows
/// the borders and the sizes; its members, all found at compile time, are
///     double size_at(Point p, Index t)        h at p, which lies in triangle t, in the scale of the refiner
///     bool is_blocked(const CavityEdge& a, const CavityEdge& b)
///                                             whether a new point may not stand so near to the constrained edge a-b
///     bool must_mend(Index t)                 whether a triangle that is narrow has to be mended
///     void vertex_inserted(Index t, std::size_t old_count)
///                                             is called after a new vertex was inserted into the cavity round t
///     void give_up(Index t, Point p)          is called where the circumcentre p of t cannot be inserted
///     bool split_next()                       splits a border that has to be split; returns false if there is none
template <class Derived>
class Refiner {
protected:
    /// A point placed for size aims at a triangle with this share of the area bound.
    static constexpr double target_area_share = 0.9;
    /// The height of that triangle over its base, in lengths of the base, is at least this. Over a base that is too
    /// long for it, the point is placed at the circumcentre.
    static constexpr double min_front_height = 0.3;
    /// Twice the area bound of a triangle, over the squared sum of h at its vertices.
    static constexpr double area2_per_squared_sum = 2 * equilateral_area / 9;

    /// Keeps a reference to the options. `points` and `tris` are those that are refined.
    Refiner(const RefineOptions& options, std::vector<Point> points, Tris tris)
        : options_(options), input_count_(points.size()), points_(std::move(points)), tris_(std::move(tris)) {
        cavity_.max_triangles = tris_.size();
        const double bound = core::radians(options.min_angle_deg);
        const double s = core::sin_reproducible(bound);
        squared_sine_ = s * s;
        // Over the shortest edge the off-centre makes an angle of the bound. It stands 5 % nearer to the edge, so that
        // rounding leaves the angle above the bound.
        off_centre_ = 0.475 * std::sqrt((1 + core::cos_reproducible(bound)) / (1 - core::cos_reproducible(bound)));
    }

    /// Refines until nothing is left to be mended. Triangles that are too large come first, from a stack, so that work
    /// stays in cache; then narrow ones, the shortest edge first.
    void run() {
        for (Index t = 0; t < tris_.size(); ++t) classify(t);
        while (derived().split_next() || mend_next()) {
        }
    }

    TriangleShape shape_of(const Tri& t) const {
        const Point a = points_[t.v[0]], b = points_[t.v[1]], c = points_[t.v[2]];
        return {{squared_length(c - b), squared_length(a - c), squared_length(b - a)}, cross(b - a, c - a)};
    }

    /// Returns twice the largest area that the sizes at its vertices allow.
    double area2_bound(const Tri& t) const {
        const double sum = static_cast<double>(sizes_[t.v[0]]) + sizes_[t.v[1]] + sizes_[t.v[2]];
        return area2_per_squared_sum * (sum * sum);
    }

    bool is_narrow(double ab, double bc, double ca, double shortest, double area2) const {
        return is_angle_below(squared_sine_, ab, bc, ca, shortest, area2);
    }

    /// Queues the triangle if it is too large or narrow.
    void classify(Index t) {
        const TriangleShape s = shape_of(tris_[t]);
        const double shortest = s.squared[s.shortest()];
        const QueuedTriangle entry{t, tris_[t].v[0]};
        if (s.area2 > area2_bound(tris_[t]))
            oversized_.push_back(entry);
        else if (is_narrow(s.squared[0], s.squared[1], s.squared[2], shortest, s.area2) && derived().must_mend(t))
            narrow_.push(entry, shortest);
    }

    bool is_current(QueuedTriangle entry) const { return tris_[entry.triangle].v[0] == entry.newest; }

    /// Returns whether the cavity was found, and p lies strictly on the inner side of every edge of its boundary and is
    /// not blocked by any that is constrained.
    bool cavity_admits(Point p) const {
        const std::size_t k = cavity_.boundary.size();
        if (k == 0) return false;
        for (std::size_t i = 0; i < k; ++i) {
            const CavityEdge& a = cavity_.boundary[i];
            const CavityEdge& b = cavity_.boundary[i + 1 < k ? i + 1 : 0];
            if (a.outer.is_constrained() && derived().is_blocked(a, b)) return false;
            if (!is_inside(a, b, p)) return false;
        }
        return true;
    }

    /// Returns whether p lies strictly on the inner side of an edge of the cavity's boundary. The filter is twice the
    /// rounding error of a cross product of these lengths.
    bool is_inside(const CavityEdge& a, const CavityEdge& b, Point p) const {
        return !(a.area2 <= 1e-15 * (a.aa + b.aa) && core::inline_orient2d(points_[a.a], points_[b.a], p) <= 0);
    }

    /// Adds a vertex and its size. Throws MeshError where there are too many.
    Index add_vertex(Point p, double size) {
        if (points_.size() - input_count_ >= options_.max_points) fail_too_many_points(options_.max_points);
        points_.push_back(p);
        sizes_.push_back(static_cast<float>(size));
        cavity_.max_triangles = tris_.size() + 2;
        return static_cast<Index>(points_.size() - 1);
    }

    void reserve(std::size_t triangles) {
        tris_.reserve(triangles + triangles / 8 + 16);
        points_.reserve(input_count_ + triangles / 2 + triangles / 16);
        sizes_.reserve(points_.capacity());
    }

    const RefineOptions& options_;
    std::size_t input_count_;    ///< number of points that do not count as Steiner points
    std::vector<Point> points_;  ///< the points of the input first
    std::vector<float> sizes_;   ///< h at each point
    Tris tris_;
    double squared_sine_ = 0;  ///< of the angle bound
    Cavity cavity_;
    std::size_t refused_ = 0;

private:
    Derived& derived() { return static_cast<Derived&>(*this); }
    const Derived& derived() const { return static_cast<const Derived&>(*this); }

    /// Mends the next triangle. Returns false if there is none.
    bool mend_next() {
        QueuedTriangle entry;
        if (!oversized_.empty()) {
            if (oversized_.size() > purge_at_) purge();
            entry = oversized_.back();
            oversized_.pop_back();
            if (is_current(entry)) mend_size(entry.triangle);
            return true;
        }
        if (!narrow_.pop(entry)) return false;
        if (is_current(entry)) mend_angle(entry.triangle);
        return true;
    }

    /// Removes the stale entries of the stack, which would lie there until the end; the others keep their order.
    void purge() {
        std::erase_if(oversized_, [&](QueuedTriangle entry) { return !is_current(entry); });
        purge_at_ = std::max(min_purge_size, 2 * oversized_.size());
    }

    /// Returns the point on the perpendicular bisector of edge e that lies `height` edge lengths above its middle, but
    /// never beyond the circumcentre. All points from the middle to the circumcentre lie in the circumscribed circle.
    ///
    ///            w
    ///          / : \           The tangent of the angle at w is
    ///         /  x  \          cross / dot. The circumcentre x lies
    ///        /   :   \         dot / (2 cross) edge lengths above
    ///       u ---m--- v        the middle m.
    Point on_bisector(const Tri& t, unsigned e, double height) const {
        const Point u = points_[t.v[next(e)]], v = points_[t.v[previous(e)]], w = points_[t.v[e]];
        const Point edge = v - u, wu = u - w, wv = v - w;
        const double to_centre = 0.5 * dot(wu, wv) / cross(wu, wv);
        return midpoint(u, v) + std::min(height, to_centre) * perpendicular(edge);
    }

    /// Places a point that makes a triangle of the target area over the shortest edge.
    void mend_size(Index t) {
        const Tri& tri = tris_[t];
        const TriangleShape s = shape_of(tri);
        const unsigned e = s.shortest();
        const double height = target_area_share * area2_bound(tri) / s.squared[e];
        insert_near(t, e, height > min_front_height ? height : HUGE_VAL);
    }

    /// Places the off-centre of the shortest edge.
    void mend_angle(Index t) { insert_near(t, shape_of(tris_[t]).shortest(), off_centre_); }

    /// Inserts the point of on_bisector(). If a border blocks it, inserts the circumcentre instead, on whose distance
    /// from the border the guarantee for frozen borders rests (docs/decisions/0003).
    void insert_near(Index t, unsigned e, double height) {
        const Point p = on_bisector(tris_[t], e, height);
        if (insert(t, p)) return;
        const Point centre = on_bisector(tris_[t], e, HUGE_VAL);
        if (centre == p || !insert(t, centre)) derived().give_up(t, centre);
    }

    /// Inserts p, which lies in the circle of triangle t but for rounding. Returns false, and changes nothing, if the
    /// border blocks p.
    bool insert(Index t, Point p) {
        const RelativeTriangle relative = relative_to(points_.data(), tris_[t], p);
        if (!in_circle(tris_[t], relative, p)) return false;
        find_cavity<false>(points_.data(), tris_.data(), t, relative, p, cavity_);
        if (!cavity_admits(p)) return false;
        const Index vertex = add_vertex(p, derived().size_at(p, t));
        const std::size_t old_count = tris_.size();
        fill_cavity(tris_, cavity_, vertex);
        derived().vertex_inserted(t, old_count);
        classify_fan(vertex, old_count);
        return true;
    }

    /// Returns whether p lies in the circle of t.
    bool in_circle(const Tri& t, const RelativeTriangle& relative, Point p) const {
        double det = 0, sum = 0;
        for (unsigned i = 0; i < 3; ++i) {
            const double rr = squared_length(relative.r[i]);
            det += rr * relative.area2[i];
            sum += rr;
        }
        // The circumcentre of a triangle that is flat but for rounding may be infinitely far away.
        return det > incircle_error * (sum * sum) ||
               (sum < HUGE_VAL && in_circle_after_filter<false>(points_.data(), t, p));
    }

    /// Does what classify() does for the new triangles round `vertex`, with the lengths that find_cavity() left behind.
    void classify_fan(Index vertex, std::size_t old_count) {
        const std::size_t k = cavity_.boundary.size();
        const double h = sizes_[vertex];
        for (std::size_t i = 0; i < k; ++i) {
            const CavityEdge& a = cavity_.boundary[i];
            const CavityEdge& b = cavity_.boundary[i + 1 < k ? i + 1 : 0];
            const double sum = h + sizes_[a.a] + sizes_[b.a];
            const double ex = b.ax - a.ax, ey = b.ay - a.ay;
            const double ab = ex * ex + ey * ey;
            const QueuedTriangle entry{cavity_.created(i, old_count), vertex};
            if (a.area2 > area2_per_squared_sum * (sum * sum)) {
                oversized_.push_back(entry);
            } else {
                const double shortest = std::min(std::min(a.aa, b.aa), ab);
                if (is_narrow(a.aa, b.aa, ab, shortest, a.area2) && derived().must_mend(entry.triangle))
                    narrow_.push(entry, shortest);
            }
        }
    }

    double off_centre_ = 0;  ///< height of the off-centre over the shortest edge, in lengths of that edge
    static constexpr std::size_t min_purge_size = std::size_t{1} << 16;
    std::vector<QueuedTriangle> oversized_;  ///< a stack
    std::size_t purge_at_ = min_purge_size;  ///< size of the stack beyond which purge() is called
    AngleQueue narrow_;
};

}  // namespace lamina::delaunay
