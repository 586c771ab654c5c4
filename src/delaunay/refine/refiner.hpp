// Frontal Delaunay refinement with a size field and a minimum angle: the steps that refinement with frozen borders and
// refinement with borders that may be split share. Triangles that are too large are mended first, row by row from the
// border inwards, then narrow ones, each by a new vertex; at the end vertices move to where triangles are better.
// docs/decisions/0002 explains the order of work.
//
// Refinement ends: a point placed for an angle is farther from every vertex than the shortest edge of the triangle it
// mends (for bounds up to 30 degrees); and points placed for size keep a distance of a share of h from every vertex.
//
// Sources: J. Ruppert, A Delaunay refinement algorithm for quality 2-dimensional mesh generation, J. Algorithms 18
// (1995); L. P. Chew, SoCG 1993; off-centres: A. Ungor, LATIN 2004; frontal refinement: S. Rebay, J. Comput. Phys. 106
// (1993); D. Engwirda, D. Ivers, Computer-Aided Design 72 (2016).
#pragma once

#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include <lamina/delaunay.hpp>

#include "core/interruption_point.hpp"
#include "core/predicates.hpp"
#include "core/reproducible_math.hpp"
#include "delaunay/refine/advancing_front.hpp"
#include "delaunay/refine/angle_queue.hpp"
#include "delaunay/refine/regularizer.hpp"
#include "delaunay/refine/smoothing.hpp"
#include "delaunay/refine/triangle_shape.hpp"
#include "delaunay/triangulate/cavity.hpp"
#include "delaunay/triangulate/conditions.hpp"
#include "delaunay/triangulate/triangles.hpp"

namespace lamina::delaunay {

/// Throws the MeshError for a refinement that needs more Steiner points than it may make.
[[noreturn]] void fail_too_many_points(std::size_t max_points);

/// Returns the power of two that brings an extent of this length near 1; 1 for the lengths that need no scaling. The
/// refiner multiplies coordinates by it, which is exact, so that squares and cubes of areas neither overflow nor vanish
/// wherever the coordinates lie in their range (docs/decisions/0001).
double unit_scale(double extent);

/// Refines a triangulation whose borders are constrained edges or edges without a neighbour. The derived class knows
/// the borders and the sizes; its members, all found at compile time, are
///     double size_at(Point p, Index t)        h at p, which lies in triangle t, in the scale of the refiner
///     double gradation()                      bound of the growth of h per unit of distance
///     bool is_blocked(const CavityEdge& a, const CavityEdge& b)
///                                             whether a new point may not stand so near to the constrained edge a-b
///     Index first_movable()                   the first vertex that smoothing may move, unless it is on a border
///     bool may_renumber                       whether vertices and triangles may get other numbers once all are made
///     bool always_counts                      whether triangles beyond the bounds are counted even where no point was
///                                             refused
///     bool must_mend(Index t)                 whether a triangle that is narrow has to be mended
///     bool is_in_sight(Index t, Point p)      false if a border is known to lie between t and p, which would block p
///     Point settled(Point p, Index t)         where a point for the size of triangle t is placed that should be at p
///     bool is_unresolved(Point a, Point b)    whether coordinates do not resolve vertices at the distance of these
///     void vertex_inserted(Index t, std::size_t old_count)
///                                             is called after a new vertex was inserted into the cavity round t
///     void give_up(Index t, Point p)          is called where the circumcentre p of t cannot be inserted
///     bool split_next()                       splits a border that has to be split; returns false if there is none
template <class Derived>
class Refiner {
protected:
    /// A new vertex of the front keeps this share of h, or of the new edges where they are shorter, from the vertices
    /// of other fronts.
    static constexpr double min_front_distance = 0.999;
    /// A triangle on the front is at least this high, in lengths of its base.
    static constexpr double min_front_height = 0.3;
    /// Its apex stands at most this far from the bisector, in lengths of its base.
    static constexpr double max_front_shift = 0.3;

    /// Keeps a reference to the options. `points` and `tris` are those that are refined.
    Refiner(const RefineOptions& options, std::vector<Point> points, Tris tris)
        : options_(options), input_count_(points.size()), points_(std::move(points)), tris_(std::move(tris)) {
        cavity_.max_triangles = tris_.size();
        const double bound = core::radians(options.min_angle_deg);
        const double s = core::sin_reproducible(bound);
        squared_sine_ = s * s;
        area2_per_squared_sum_ = options.max_area_ratio * 2 * equilateral_area / 9;
        // Over the shortest edge the off-centre makes an angle of the bound. It stands 5 % nearer to the edge, so that
        // rounding leaves the angle above the bound.
        off_centre_ = 0.475 * std::sqrt((1 + core::cos_reproducible(bound)) / (1 - core::cos_reproducible(bound)));
    }

    /// Refines until nothing is left to be mended: first large triangles, then narrow ones. Smoothing comes in between,
    /// since it mends most narrow triangles without new vertices, and at the end. Regularization comes last.
    void run() {
        front_.reset(tris_.size());
        for (Index t = 0; t < tris_.size(); ++t) classify(t);
        for (Index t = 0; t < tris_.size(); ++t)
            if (is_on_front(t)) front_.ready.push({t, tris_[t].v[0]});
        do {
            mend_all_large();
        } while (!is_full() && queue_enclosed());
        mend_narrow();
        if constexpr (Derived::may_renumber)
            if (regularizes()) regularize();
    }

    TriangleShape shape_of(const Tri& t) const { return delaunay::shape_of(points_, t); }

    double size_sum(const Tri& t) const {
        return static_cast<double>(sizes_[t.v[0]]) + sizes_[t.v[1]] + sizes_[t.v[2]];
    }

    /// Returns whether a triangle is too large for the sum of sizes_ at its vertices, given the product of its squared
    /// edges and twice its area: whether its circumcircle is larger than that of an equilateral triangle with edges of
    /// max_circle_ratio h, h being the mean, or its area is more than max_area_ratio times that of one with edges of h.
    /// The squared circumradius is product / (2 area2)^2.
    bool is_large(double product, double area2, double sum) const {
        const double squared_sum = squared_unit_ * (sum * sum);
        return product > squared_radius_per_squared_sum * squared_sum * (area2 * area2) ||
               area2 > area2_per_squared_sum_ * squared_sum;
    }

    /// Returns whether a triangle is larger than its bounds and rounding allow.
    bool is_oversized(const Tri& t, const TriangleShape& s) const {
        constexpr double allowance = 1 + 1e-6;
        return is_large(s.squared[0] * s.squared[1] * s.squared[2], s.area2, allowance * size_sum(t));
    }

    /// Sets the number of refused points: those whose refusal left a triangle beyond the bounds. Smoothing may have
    /// mended what the others left.
    void count_refused(RefineStats& stats) const {
        stats.refused = stats.below_bound == stats.exempt && stats.oversized == 0 ? 0 : refused_;
    }

    bool is_narrow(double ab, double bc, double ca, double shortest, double area2) const {
        return is_angle_below(squared_sine_, ab, bc, ca, shortest, area2);
    }

    /// Notes whether the triangle is too large, and queues it if it is narrow.
    void classify(Index t) {
        const TriangleShape s = shape_of(tris_[t]);
        if (is_large(s.squared[0] * s.squared[1] * s.squared[2], s.area2, size_sum(tris_[t]))) {
            front_.set_large(t, s.base());
        } else {
            front_.set_done(t);
            queue_if_narrow(t, s);
        }
    }

    void queue_if_narrow(Index t, const TriangleShape& s) {
        const double shortest = s.squared[s.shortest()];
        if (is_narrow(s.squared[0], s.squared[1], s.squared[2], shortest, s.area2) && derived().must_mend(t))
            queue_narrow({t, tris_[t].v[0]}, shortest);
    }

    /// Queues a narrow triangle by its shortest edge in multiples of the unit.
    void queue_narrow(QueuedTriangle entry, double squared_shortest) {
        narrow_.push(entry, squared_shortest / squared_unit_);
    }

    /// Returns whether a triangle is large and its base on the front.
    bool is_on_front(Index t) const { return front_.is_large(t) && front_.is_done_across(tris_[t].n[front_.base(t)]); }

    /// Queues the triangle if it is large and on the front, and those across its edges that it brings to the front.
    void queue_front(Index t) {
        if (is_on_front(t)) front_.ready.push({t, tris_[t].v[0]});
        if (front_.is_large(t)) return;
        for (const Link across : tris_[t].n) queue_if_based_on(across);
    }

    bool is_current(QueuedTriangle entry) const { return tris_[entry.triangle].v[0] == entry.newest; }

    /// Returns whether the cavity was found, and p lies strictly on the inner side of every edge of its boundary and is
    /// not blocked by any that is constrained.
    bool cavity_admits(Point p) const {
        if (cavity_.is_open_star) return true;
        const std::size_t k = cavity_.boundary.size();
        if (k == 0) return false;
        for (std::size_t i = 0; i < k; ++i) {
            const CavityEdge& a = cavity_.boundary[i];
            const CavityEdge& b = cavity_.boundary[i + 1];
            if (a.outer.is_constrained() && derived().is_blocked(a, b)) return false;
            if (!is_inside(a, b, p)) return false;
        }
        return true;
    }

    /// Returns whether p lies strictly on the inner side of an edge of the cavity's boundary.
    bool is_inside(const CavityEdge& a, const CavityEdge& b, Point p) const {
        return !(a.area2 <= side_error * (a.aa + b.aa) && core::inline_orient2d(points_[a.a], points_[b.a], p) <= 0);
    }

    /// Returns whether p lies in the circle of t.
    bool in_circle(const Tri& t, const RelativeTriangle& relative, Point p) const {
        double det = 0, sum = 0;
        for (unsigned i = 0; i < 3; ++i) {
            det += relative.rr[i] * relative.area2[i];
            sum += relative.rr[i];
        }
        // The circumcentre of a triangle that is flat but for rounding may be infinitely far away.
        return det > incircle_error * (sum * sum) ||
               (sum < HUGE_VAL && in_circle_after_filter<false>(points_.data(), t, p));
    }

    /// Returns whether the refinement stopped because it may make no more Steiner points.
    bool stopped() const { return stopped_; }

    /// Refinement looks whether it is still wanted whenever it has added so many vertices: every few milliseconds.
    static constexpr std::size_t vertices_between_looks = 4096;

    /// Adds a vertex and its size. Throws MeshError where there are too many, and Interrupted.
    Index add_vertex(Point p, float size) {
        const std::size_t count = points_.size();
        if (count % vertices_between_looks == 0) core::check_interruption();
        if (count - input_count_ >= options_.max_points) fail_too_many_points(options_.max_points);
        points_.push_back(p);
        sizes_.push_back(size);
        cavity_.max_triangles = 2 * count + 2;  // n vertices have at most 2 n triangles
        return static_cast<Index>(count);
    }

    /// Sets the length that sizes_ are multiples of.
    void set_unit(double unit) {
        unit_ = unit;
        squared_unit_ = unit * unit;
    }
    double unit() const { return unit_; }
    /// Returns a size as sizes_ holds it.
    float stored(double size) const { return static_cast<float>(size / unit_); }
    /// Returns h at a point of the triangulation.
    double size_of(Index v) const { return unit_ * sizes_[v]; }

    void reserve(std::size_t triangles) {
        tris_.reserve(triangles + triangles / 8 + 16);
        points_.reserve(input_count_ + triangles / 2 + triangles / 16);
        sizes_.reserve(points_.capacity());
    }

    const RefineOptions& options_;
    std::size_t input_count_;    ///< number of points that do not count as Steiner points
    std::vector<Point> points_;  ///< the points of the input first
    std::vector<float> sizes_;   ///< h at each point, in multiples of the unit
    Tris tris_;
    double squared_sine_ = 0;  ///< of the angle bound
    double off_centre_ = 0;    ///< height of the off-centre over the shortest edge, in lengths of that edge
    Cavity cavity_;
    AdvancingFront front_;
    std::size_t refused_ = 0;
    std::optional<std::vector<Index>> suspects_;  ///< if known, all others are known to be within the bounds
    bool stopped_ = false;

private:
    /// Returns whether to stop because there are as many Steiner points as there may be. Each step makes one at most.
    bool is_full() {
        if (options_.stop_at_max_points && points_.size() - input_count_ >= options_.max_points) stopped_ = true;
        return stopped_;
    }

    Derived& derived() { return static_cast<Derived&>(*this); }
    const Derived& derived() const { return static_cast<const Derived&>(*this); }

    /// The squared sine of 39 degrees. Triangles that are not ill-shaped have no angle below 39.8 degrees.
    static constexpr double squared_sine_of_fat = 0.396;

    /// The sizes and bounds that smoothing has to respect.
    struct SmoothingRules {
        Refiner& refiner;
        bool may_be_narrow;  ///< whether narrow triangles will be mended later
        double size_at(Point p, Index t) const { return refiner.derived().size_at(p, t) / refiner.unit_; }
        bool is_allowed(double aa, double bb, double cc, double area2, double size_sum) const {
            return !refiner.is_large(aa * bb * cc, area2, size_sum) &&
                   (may_be_narrow || !refiner.is_narrow(aa, bb, cc, std::min({aa, bb, cc}), area2));
        }
        bool is_surely_allowed(double squared_sum, double area2, double size_sum) const {
            // The product of three numbers is at most the cube of their mean.
            const double mean = squared_sum * (1.0 / 3);
            return !refiner.is_large(mean * mean * mean, area2, size_sum) &&
                   (may_be_narrow || refiner.squared_sine_ <= squared_sine_of_fat);
        }
        double unit() const { return refiner.unit_; }
        double gradation() const { return refiner.derived().gradation(); }
        /// Returns twice the error of the field, and some more for rounding.
        static constexpr double size_error() { return 2.1 * SizeField::relative_error; }
        bool is_blocked(const CavityEdge& a, const CavityEdge& b) const { return refiner.derived().is_blocked(a, b); }
    };

    Smoother<SmoothingRules> smoother(bool may_be_narrow) {
        return {{points_, sizes_, tris_, derived().first_movable()}, {*this, may_be_narrow}};
    }

    bool regularizes() const { return Derived::may_renumber && options_.regularize && !stopped_; }

    /// Gives vertices and triangles other numbers, so nothing may be queued any more.
    void regularize() {
        Regularizer<SmoothingRules>({points_, sizes_, tris_, derived().first_movable()}, {*this, false},
                                    input_count_ + options_.max_points)
            .run();
    }

    /// Smooths, mends the triangles that are narrow nevertheless, and smooths what that has made.
    void mend_narrow() {
        const bool smooths = options_.smoothing > 0;
        if (smooths) {
            auto first = smoother(!narrow_.empty());
            first.smooth(options_.smoothing);
            if (!narrow_.empty() || refused_ > 0) suspects_ = first.suspects();
            if (!narrow_.empty()) {
                narrow_.clear();  // flips have changed triangles
                for (const Index t : *suspects_) queue_if_narrow(t, shape_of(tris_[t]));
            }
            if (!narrow_.empty() || Derived::always_counts || stopped_ || regularizes()) {
                first.update_sizes();
                suspects_.reset();
            }
        }
        if (narrow_.empty()) return;
        const std::size_t before = points_.size();
        do {
            mend_all_large();
        } while (!is_full() && (mend_narrow_next() || queue_enclosed()));
        if (smooths && points_.size() > before) smoother(false).mend();
    }

    void queue_if_based_on(Link link) {
        if (link.is_constrained() || !front_.has_base(link.triangle(), link.edge())) return;
        front_.ready.push({link.triangle(), tris_[link.triangle()].v[0]});
    }

    /// Mends large triangles until none is queued, and splits borders that have to be split before.
    void mend_all_large() {
        while (!is_full() && (derived().split_next() || mend_large_next())) {
        }
    }

    /// Mends the next large triangle. Returns false if none is queued.
    bool mend_large_next() {
        QueuedTriangle entry;
        if (front_.ready.pop(entry)) {
            if (is_current(entry) && front_.is_large(entry.triangle)) advance(entry);
        } else if (front_.met.pop(entry)) {
            if (is_current(entry) && front_.is_large(entry.triangle)) mend_large(entry.triangle);
        } else {
            return false;
        }
        return true;
    }

    /// Mends the next narrow triangle. Returns false if there is none.
    bool mend_narrow_next() {
        QueuedTriangle entry;
        if (!narrow_.pop(entry)) return false;
        if (is_current(entry)) mend_angle(entry.triangle);
        return true;
    }

    /// Queues large triangles that no front reaches, since two of them lie on both sides of their base. Returns false
    /// if there is none. Looks at all triangles, so it comes last.
    bool queue_enclosed() {
        for (Index t = 0; t < tris_.size(); ++t)
            if (front_.is_large(t)) front_.met.push({t, tris_[t].v[0]});
        return !front_.met.empty();
    }

    /// A place for a new vertex over the base of a large triangle.
    struct FrontPoint {
        Point at;
        double squared_distance;  ///< that it should keep from the vertices of other fronts, squared
    };

    /// Returns h over a base from the sizes at its ends and behind it, continued linearly: the new point is about the
    /// mirror image of the apex behind. That costs less than the field.
    static double continued_size(double size_at_ends, double size_at_apex) {
        constexpr double min_change = 0.7, max_change = 1.4;
        return std::clamp(2 * size_at_ends - size_at_apex, min_change * size_at_ends, max_change * size_at_ends);
    }

    /// Returns the point p over the base u-v of a large triangle from which both ends of the base are as far as the
    /// mean of h at p and there, or the circumcentre, if that is nearer to the base.
    ///
    ///               w
    ///             .'  '.           The point lies beside the bisector if h differs at u and v. The
    ///           .'  x   '.         circumcentre x lies dot / (2 cross) lengths of the base above its
    ///         .'    p     '.       middle m; dot and cross are those of w -> u and w -> v.
    ///        u ----- m ---- v
    [[gnu::always_inline]] FrontPoint front_point(Index t) const {
        const Tri& tri = tris_[t];
        const unsigned e = front_.base(t);
        const Index u_vertex = tri.v[next(e)], v_vertex = tri.v[previous(e)];
        const Point u = points_[u_vertex], v = points_[v_vertex], w = points_[tri.v[e]];
        const Point base = v - u, wu = u - w, wv = v - w, up = perpendicular(base), middle = midpoint(u, v);
        const double to_centre = 0.5 * dot(wu, wv) / cross(wu, wv);
        const double squared_base = squared_length(base), inverse = 1 / squared_base;
        const double hu = size_of(u_vertex), hv = size_of(v_vertex), at_ends = 0.5 * (hu + hv);
        // Edges to both ends have the length l at a height of the square root of this, in lengths of the base.
        const auto squared_height = [inverse](double l) { return l * l * inverse - 0.25; };
        constexpr double least = min_front_height * min_front_height, share = min_front_distance * min_front_distance;
        const auto bounded = [this](double squared) {
            return std::min(squared > least ? std::sqrt(squared) : min_front_height, off_centre_);
        };
        const double squared_at_ends = squared_height(at_ends);
        if (to_centre <= off_centre_ && (to_centre <= min_front_height || to_centre * to_centre <= squared_at_ends)) {
            const double edge = std::min(at_ends * at_ends, (0.25 + off_centre_ * off_centre_) * squared_base);
            return {middle + to_centre * up, share * edge};
        }
        const Link behind = tri.n[e];
        const double h = behind.is_constrained()
                             ? derived().size_at(middle + bounded(squared_at_ends) * up, t)
                             : continued_size(at_ends, size_of(tris_[behind.triangle()].v[behind.edge()]));
        const double to_u = 0.5 * (hu + h), to_v = 0.5 * (hv + h);
        const double height = bounded(squared_height(0.5 * (to_u + to_v)));
        const double edge = std::min(h * h, (0.25 + height * height) * squared_base);
        if (height >= to_centre) return {middle + to_centre * up, share * edge};
        const double shift = std::clamp(0.5 * (to_u * to_u - to_v * to_v) * inverse, -max_front_shift, max_front_shift);
        return {middle + shift * base + height * up, share * edge};
    }

    FrontPoint settled_front_point(Index t) const {
        FrontPoint p = front_point(t);
        p.at = derived().settled(p.at, t);
        return p;
    }

    /// Returns whether the apex of the triangle or of a neighbour across another edge than the base is nearer to p than
    /// this. Other vertices need no look: they stand behind the front, or have not been nearer in any trial.
    bool is_near_other_front(Index t, const FrontPoint& p) const {
        const Tri& tri = tris_[t];
        const unsigned e = front_.base(t);
        if (squared_length(points_[tri.v[e]] - p.at) < p.squared_distance) return true;
        for (const Link side : {tri.n[next(e)], tri.n[previous(e)]}) {
            if (side.is_constrained()) continue;
            const Index apex = tris_[side.triangle()].v[side.edge()];
            if (squared_length(points_[apex] - p.at) < p.squared_distance) return true;
        }
        return false;
    }

    /// Places a vertex over the base of a large triangle on the front, unless two fronts meet there.
    void advance(QueuedTriangle entry) {
        const Index t = entry.triangle;
        if (!is_on_front(t)) return;
        const FrontPoint p = settled_front_point(t);
        if (is_near_other_front(t, p) || !insert_in_sight(t, p.at)) front_.met.push(entry);
    }

    /// Places the circumcentre of a large triangle where fronts meet or, if that is blocked, a point over the base. If
    /// that is blocked, too, the triangle counts as done.
    void mend_large(Index t) {
        const Point centre = derived().settled(on_bisector(tris_[t], front_.base(t), HUGE_VAL), t);
        if (insert_in_sight(t, centre)) return;
        if (const Point p = settled_front_point(t).at; p != centre && insert_in_sight(t, p)) return;
        front_.set_done(t);
        queue_front(t);
        derived().give_up(t, centre);
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

    /// Places the off-centre of the shortest edge.
    void mend_angle(Index t) {
        const unsigned e = shape_of(tris_[t]).base();
        // A new vertex would be about as far from its neighbours as the shortest edge is long.
        if (derived().is_unresolved(points_[tris_[t].v[next(e)]], points_[tris_[t].v[previous(e)]]))
            ++refused_;
        else
            insert_near(t, e, off_centre_);
    }

    /// Inserts the point of on_bisector(). If a border blocks it, inserts the circumcentre instead, on whose distance
    /// from the border the guarantee for frozen borders rests (docs/decisions/0003).
    void insert_near(Index t, unsigned e, double height) {
        const Point p = on_bisector(tris_[t], e, height);
        if (insert_in_sight(t, p)) return;
        const Point centre = on_bisector(tris_[t], e, HUGE_VAL);
        if (centre == p || !insert_in_sight(t, centre)) derived().give_up(t, centre);
    }

    /// Inserts p as insert() does, but looks first whether a border is known to hide it from t.
    bool insert_in_sight(Index t, Point p) { return derived().is_in_sight(t, p) && insert(t, p); }

    /// Inserts p, which lies in the circle of triangle t but for rounding. Returns false, and changes nothing, if the
    /// border blocks p.
    bool insert(Index t, Point p) {
        const RelativeTriangle relative = relative_to(points_.data(), tris_[t], p);
        if (!in_circle(tris_[t], relative, p)) return false;
        find_cavity<false>(points_.data(), tris_.data(), t, relative, p, cavity_);
        if (!cavity_admits(p)) return false;
        const float stored_size = stored(derived().size_at(p, t));
        const double size = stored_size;
        const Index vertex = add_vertex(p, stored_size);
        const std::size_t old_count = tris_.size();
        assert(t < old_count && sizes_.size() == points_.size() && is_star(points_, cavity_, p));
        front_.resize(old_count + 2);
        const float* const sizes = sizes_.data();
        double size_a = sizes[cavity_.boundary[0].a];
        fill_cavity(tris_, cavity_, vertex, [&](Index created, const CavityEdge& a, const CavityEdge& b) {
            const double size_b = sizes[b.a];
            classify_new(created, a, b, size + size_a + size_b);
            size_a = size_b;
        });
        derived().vertex_inserted(t, old_count);
        queue_fan(vertex);
        return true;
    }

    /// Notes whether a new triangle on the edge a-b of the cavity's boundary is large, and which edge is its base, with
    /// the lengths that find_cavity() left behind. Edge 0 lies on the boundary.
    void classify_new(Index t, const CavityEdge& a, const CavityEdge& b, double size_sum) {
        const double ex = b.ax - a.ax, ey = b.ay - a.ay;
        const double ab = ex * ex + ey * ey;
        const double shorter = std::min(a.aa, b.aa);
        if (is_large(a.aa * b.aa * ab, a.area2, size_sum)) {
            // Without branches, since none could be predicted.
            const unsigned is_a_shorter = a.aa < b.aa, is_ab_longer = shorter < ab;
            front_.set_large(t, is_ab_longer * (1 + is_a_shorter));
            return;
        }
        front_.set_done(t);
        if (const double shortest = std::min(shorter, ab); is_narrow(a.aa, b.aa, ab, shortest, a.area2))
            new_narrow_.push_back({t, shortest});
    }

    /// Queues the new triangles round a vertex, and those that they bring to the front.
    void queue_fan(Index vertex) {
        const std::size_t k = cavity_.boundary.size();
        const CavityEdge* const boundary = cavity_.boundary.data();
        const Index* const created = cavity_.triangles.data();
        for (std::size_t i = 0; i < k; ++i) {
            const Index t = created[i];
            if (!front_.is_large(t)) {
                queue_if_based_on(boundary[i].outer);
                continue;
            }
            if (front_.is_done_across(tris_[t].n[front_.base(t)])) front_.ready.push({t, vertex});
        }
        for (const auto& [t, shortest] : new_narrow_)
            if (derived().must_mend(t)) queue_narrow({t, vertex}, shortest);
        new_narrow_.clear();
    }

    static constexpr double squared_radius_per_squared_sum = 4 * max_circle_ratio * max_circle_ratio / 27;
    double unit_ = 1;                   ///< the length that sizes_ are multiples of
    double squared_unit_ = 1;           ///< its square
    double area2_per_squared_sum_ = 0;  ///< twice the area bound of a triangle, over the squared sum of h
    AngleQueue narrow_;
    /// A triangle of the newest vertex that is narrow, and its squared shortest edge.
    struct NarrowTriangle {
        Index t;
        double shortest;
    };
    std::vector<NarrowTriangle> new_narrow_;
};

}  // namespace lamina::delaunay
