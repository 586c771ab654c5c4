// Delaunay refinement with a size field, a minimum angle and a frozen border. Triangles that are too large are mended
// first, then narrow ones, each by a new vertex. docs/decisions/0002 explains the order of work and gives figures.
//
// Refinement ends: no segment is ever split; a point placed for an angle is farther from every vertex than the shortest
// edge of the triangle it mends (for bounds up to 30 degrees); and points placed for size keep a distance of a share of
// h from every vertex.
//
// Sources: J. Ruppert, A Delaunay refinement algorithm for quality 2-dimensional mesh generation, J. Algorithms 18
// (1995); L. P. Chew, SoCG 1993; off-centres: A. Ungor, LATIN 2004; points at a prescribed size on the perpendicular
// bisector: S. Rebay, J. Comput. Phys. 106 (1993).
#include "delaunay/refine_region.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include <lamina/error.hpp>

#include "core/pages.hpp"
#include "core/reproducible_math.hpp"
#include "core/segments.hpp"
#include "core/text.hpp"
#include "delaunay/angle_queue.hpp"
#include "delaunay/cavity.hpp"
#include "delaunay/estimate.hpp"
#include "delaunay/insert_segments.hpp"
#include "delaunay/regions.hpp"
#include "delaunay/triangulate_points.hpp"

namespace lamina::delaunay {

namespace {

/// A point placed for size aims at a triangle with this share of the area bound.
constexpr double target_area_share = 0.9;
/// The height of that triangle over its base, in lengths of the base, is at least this. Over a base that is too long
/// for it, the point is placed at the circumcentre.
constexpr double min_front_height = 0.3;

/// Twice the area bound of a triangle, over the squared sum of h at its vertices.
constexpr double area2_per_squared_sum = 2 * equilateral_area / 9;

/// Refines one region.
class Refiner {
public:
    Refiner(std::span<const Point> border, std::span<const Segment> segments, const SizeField& size,
            const RefineOptions& options)
        : size_(size), options_(options), border_count_(border.size()), points_(border.begin(), border.end()) {
        const double bound = core::radians(options.min_angle_deg);
        const double s = core::sin_reproducible(bound);
        squared_sine_ = s * s;
        // Over the shortest edge the off-centre makes an angle of the bound. It stands 5 % nearer to the edge, so that
        // rounding leaves the angle above the bound.
        off_centre_ = 0.475 * std::sqrt((1 + core::cos_reproducible(bound)) / (1 - core::cos_reproducible(bound)));

        tris_ = triangulate_points(border);
        insert_segments(border, segments, tris_);
        tris_ = keep_left_of_segments(segments, tris_, border.size());
        sizes_.reserve(border.size());
        for (Point p : border) sizes_.push_back(static_cast<float>(size(p)));
        reserve(options.expected_triangles > 0
                    ? options.expected_triangles
                    : static_cast<std::size_t>(std::min(estimate_loads(points_, tris_, size).total, 1e9)));
    }

    /// Refines. Triangles that are too large come first, from a stack, so that work stays in cache; then narrow ones,
    /// the shortest edge first.
    void run() {
        for (Index t = 0; t < tris_.size(); ++t) classify(t);
        for (;;) {
            QueuedTriangle entry;
            if (!oversized_.empty()) {
                if (oversized_.size() > purge_at_) purge();
                entry = oversized_.back();
                oversized_.pop_back();
                if (is_current(entry)) mend_size(entry.triangle);
            } else if (narrow_.pop(entry)) {
                if (is_current(entry)) mend_angle(entry.triangle);
            } else {
                return;
            }
        }
    }

    /// Returns the refinement. It may be called once only, after run(), since it frees the refiner's memory as it goes.
    Refinement result() {
        Refinement r;
        r.stats = count_leftovers();
        sizes_ = {};
        oversized_ = {};
        narrow_ = {};
        points_.erase(points_.begin(), points_.begin() + static_cast<std::ptrdiff_t>(border_count_));
        r.steiner_points = std::move(points_);
        r.triangles.reserve(tris_.size());
        // Each block gives its pages back once it is copied, so that memory does not peak here.
        constexpr std::size_t block = std::size_t{1} << 16;
        for (std::size_t from = 0; from < tris_.size(); from += block) {
            const std::size_t to = std::min(from + block, tris_.size());
            for (std::size_t i = from; i < to; ++i) {
                const auto& v = tris_[i].v;
                r.triangles.push_back({VertexId{v[0]}, VertexId{v[1]}, VertexId{v[2]}});
            }
            core::give_back_pages(&tris_[from], (to - from) * sizeof(Tri));
        }
        return r;
    }

private:
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

    TriangleShape shape_of(const Tri& t) const {
        const Point a = points_[t.v[0]], b = points_[t.v[1]], c = points_[t.v[2]];
        return {{squared_length(c - b), squared_length(a - c), squared_length(b - a)}, cross(b - a, c - a)};
    }

    /// Returns twice the largest area that the sizes at its vertices allow.
    double area2_bound(const Tri& t) const {
        const double sum = static_cast<double>(sizes_[t.v[0]]) + sizes_[t.v[1]] + sizes_[t.v[2]];
        return area2_per_squared_sum * (sum * sum);
    }

    /// Returns whether the smallest angle is below the bound, from squared edges and twice the area: sin^2 of the
    /// smallest angle is (2 area)^2 / (product of the two longer squared edges).
    bool is_narrow(double ab, double bc, double ca, double shortest, double area2) const {
        return area2 * area2 * shortest < squared_sine_ * (ab * bc * ca);
    }

    /// Queues the triangle if it is too large or narrow.
    void classify(Index t) {
        const TriangleShape s = shape_of(tris_[t]);
        const double shortest = s.squared[s.shortest()];
        const QueuedTriangle entry{t, tris_[t].v[0]};
        if (s.area2 > area2_bound(tris_[t]))
            oversized_.push_back(entry);
        else if (is_narrow(s.squared[0], s.squared[1], s.squared[2], shortest, s.area2))
            narrow_.push(entry, shortest);
    }

    /// Removes the stale entries of the stack, which would lie there until the end; the others keep their order.
    void purge() {
        std::erase_if(oversized_, [&](QueuedTriangle entry) { return !is_current(entry); });
        purge_at_ = std::max(min_purge_size, 2 * oversized_.size());
    }

    bool is_current(QueuedTriangle entry) const { return tris_[entry.triangle].v[0] == entry.newest; }

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

    /// Inserts the point of on_bisector(). If that would encroach upon the border, inserts the circumcentre instead, on
    /// whose distance from the border the guarantee for frozen borders rests (docs/decisions/0003).
    void insert_near(Index t, unsigned e, double height) {
        const Point p = on_bisector(tris_[t], e, height);
        if (insert(t, p)) return;
        const Point centre = on_bisector(tris_[t], e, HUGE_VAL);
        if (centre == p || !insert(t, centre)) ++refused_;
    }

    /// Inserts p, which lies in the circle of triangle t but for rounding. Returns false, and changes nothing, if p
    /// encroaches upon the border.
    bool insert(Index t, Point p) {
        const RelativeTriangle relative = relative_to(points_.data(), tris_[t], p);
        if (!in_circle(tris_[t], relative, p)) return false;
        find_cavity<false>(points_.data(), tris_.data(), t, relative, p, cavity_);
        if (!cavity_admits(p)) return false;
        if (points_.size() - border_count_ >= options_.max_points) fail_too_many_points(options_.max_points);
        const Index vertex = static_cast<Index>(points_.size());
        points_.push_back(p);
        sizes_.push_back(static_cast<float>(size_(p)));
        const std::size_t old_count = tris_.size();
        fill_cavity(tris_, cavity_, vertex);
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
        return det > incircle_error * (sum * sum) || in_circle_after_filter<false>(points_.data(), t, p);
    }

    /// Returns whether p lies strictly on the inner side of every edge of the cavity's boundary, and in the diametral
    /// circle of none that is a border edge.
    bool cavity_admits(Point p) const {
        const std::size_t k = cavity_.boundary.size();
        for (std::size_t i = 0; i < k; ++i) {
            const CavityEdge& a = cavity_.boundary[i];
            const CavityEdge& b = cavity_.boundary[i + 1 < k ? i + 1 : 0];
            if (a.outer.is_constrained() && a.ax * b.ax + a.ay * b.ay <= 0) return false;
            // The filter is twice the rounding error of a cross product of these lengths.
            if (a.area2 <= 1e-15 * (a.aa + b.aa) && core::inline_orient2d(points_[a.a], points_[b.a], p) <= 0)
                return false;
        }
        return true;
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
                if (is_narrow(a.aa, b.aa, ab, shortest, a.area2)) narrow_.push(entry, shortest);
            }
        }
    }

    void reserve(std::size_t triangles) {
        tris_.reserve(triangles + triangles / 8 + 16);
        points_.reserve(border_count_ + triangles / 2 + triangles / 16);
        sizes_.reserve(points_.capacity());
    }

    RefineStats count_leftovers() const;
    std::vector<char> find_sharp_corners() const;

    const SizeField& size_;
    const RefineOptions& options_;
    std::size_t border_count_;
    std::vector<Point> points_;  ///< the border points first
    std::vector<float> sizes_;   ///< h at each point
    Tris tris_;
    double squared_sine_ = 0;  ///< of the angle bound
    double off_centre_ = 0;    ///< height of the off-centre over the shortest edge, in lengths of that edge
    static constexpr std::size_t min_purge_size = std::size_t{1} << 16;
    std::vector<QueuedTriangle> oversized_;  ///< a stack
    std::size_t purge_at_ = min_purge_size;  ///< size of the stack beyond which purge() is called
    AngleQueue narrow_;
    Cavity cavity_;
    std::size_t refused_ = 0;
};

/// Returns a flag for each border point: 1 where the interior angle of the region is below 60 degrees.
std::vector<char> Refiner::find_sharp_corners() const {
    std::vector<char> sharp(border_count_, 0);
    // Each border point gets the other ends of one border edge out of it and of one into it, the region on their left.
    // Where the region touches itself at a vertex, one pair of edges speaks for it.
    std::vector<std::array<Index, 2>> around(border_count_, {no_index, no_index});
    for (const Tri& t : tris_)
        for (unsigned e = 0; e < 3; ++e) {
            if (!t.n[e].is_border()) continue;
            around[t.v[next(e)]][0] = t.v[previous(e)];
            around[t.v[previous(e)]][1] = t.v[next(e)];
        }
    for (Index v = 0; v < border_count_; ++v) {
        const auto [out, in] = around[v];
        if (out == no_index || in == no_index) continue;
        const Point a = points_[out] - points_[v], b = points_[in] - points_[v];
        sharp[v] = core::encloses_sharp_angle(a, b);
    }
    return sharp;
}

/// Counts the triangles that stayed beyond the bounds. Narrow ones at a sharp corner of the border are exempt.
RefineStats Refiner::count_leftovers() const {
    // A triangle is queued as long as something is wrong with it, so without a refused point none is left.
    if (refused_ == 0) return {};
    const std::vector<char> sharp = find_sharp_corners();
    RefineStats stats;
    stats.refused = refused_;
    for (const Tri& t : tris_) {
        const TriangleShape s = shape_of(t);
        const double shortest = s.squared[s.shortest()];
        // The allowance for rounding makes this count the triangles that check_mesh() counts.
        if (is_narrow(s.squared[0], s.squared[1], s.squared[2], shortest * (1 + 1e-9), s.area2)) {
            ++stats.below_bound;
            stats.exempt += std::any_of(t.v, t.v + 3, [&](Index v) { return v < border_count_ && sharp[v]; });
        }
        stats.oversized += s.area2 > area2_bound(t) * (1 + 1e-9);
    }
    return stats;
}

}  // namespace

Refinement refine_region(std::span<const Point> points, std::span<const Segment> segments, const SizeField& size,
                         const RefineOptions& options) {
    Refiner refiner(points, segments, size, options);
    refiner.run();
    return refiner.result();
}

void fail_too_many_points(std::size_t max_points) {
    throw MeshError(core::concat("refinement stopped after ", max_points, " points: the size field is too fine"));
}

}  // namespace lamina::delaunay
