// Delaunay refinement with a size field, a minimum angle and a frozen border.
// Sources: J. Ruppert, A Delaunay refinement algorithm for quality 2-dimensional mesh generation, J. Algorithms 18
// (1995); L. P. Chew, SoCG 1993; off-centres: A. Ungor, LATIN 2004; points at a prescribed size on the perpendicular
// bisector: S. Rebay, J. Comput. Phys. 106 (1993). Order of work and figures: docs/decisions/0002.
//
// Termination: no segment is ever split, and a point placed for an angle is farther from every vertex than the shortest
// edge of the triangle it mends (for bounds up to 30 degrees); points placed for size keep a distance of a share of h.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include <lamina/delaunay.hpp>
#include <lamina/error.hpp>

#include "core/equilateral.hpp"
#include "core/pages.hpp"
#include "core/reproducible_math.hpp"
#include "core/segments.hpp"
#include "core/text.hpp"
#include "delaunay/cavity.hpp"
#include "delaunay/estimate.hpp"
#include "delaunay/lattice.hpp"
#include "delaunay/triangulator.hpp"

namespace lamina::delaunay {

namespace {

/// Share of the bound that the area of a triangle made by a size-driven point aims at.
constexpr double aimed_area = 0.9;
/// Least height of such a triangle over its base, in lengths of the base; a base too long for that is no front, and the
/// circumcentre serves.
constexpr double least_front_height = 0.3;

/// A triangle that waits to be mended. Triangles are made with the new vertex first, so a slot that was reused since
/// has another one: such entries are stale and dropped.
struct Waiting {
    Index triangle;
    Index newest;  ///< its first vertex
};

/// Triangles that wait for their angle to be mended, by shortest edge: buckets of a factor 2^(1/4) in squared length.
class AngleQueue {
public:
    void push(Waiting w, double squared_shortest) {
        const std::size_t b = bucket(static_cast<float>(squared_shortest));
        buckets_[b].push_back(w);
        occupied_[b / 64] |= std::uint64_t{1} << (b % 64);
    }

    /// The most recent entry of the lowest bucket; false where none is left.
    bool pop(Waiting& w) {
        for (std::size_t word = 0; word < occupied_.size(); ++word) {
            if (occupied_[word] == 0) continue;
            const std::size_t b = word * 64 + static_cast<std::size_t>(std::countr_zero(occupied_[word]));
            w = buckets_[b].back();
            buckets_[b].pop_back();
            if (buckets_[b].empty()) occupied_[word] &= occupied_[word] - 1;
            return true;
        }
        return false;
    }

private:
    static constexpr std::size_t bucket_count = 1024;  // 8 exponent bits, 2 bits of mantissa
    static std::size_t bucket(float key) { return std::bit_cast<std::uint32_t>(key) >> 21; }

    std::array<std::vector<Waiting>, bucket_count> buckets_;
    std::array<std::uint64_t, bucket_count / 64> occupied_{};
};

[[noreturn]] void fail_too_many(std::size_t points) {
    throw MeshError(core::concat("refinement stopped after ", points, " points: the size field is too fine"));
}

class Refiner {
public:
    Refiner(std::span<const Point> border, std::span<const Segment> segments, const SizeField& size,
            const RefineOptions& options)
        : size_(size), options_(options), border_count_(border.size()), points_(border.begin(), border.end()) {
        const double bound = core::radians(options.min_angle_deg);
        const double s = core::sin_reproducible(bound);
        squared_sine_ = s * s;
        // An apex of the bound's angle over the shortest edge, 5 % nearer so that rounding leaves the angle above it.
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

    /// Size first, from a stack, so that work stays in cache; then angles, shortest edge first.
    void run() {
        for (Index t = 0; t < tris_.size(); ++t) classify(t);
        for (;;) {
            Waiting w;
            if (!oversized_.empty()) {
                if (oversized_.size() > purge_at_) purge();
                w = oversized_.back();
                oversized_.pop_back();
                if (is_current(w)) mend_size(w.triangle);
            } else if (narrow_.pop(w)) {
                if (is_current(w)) mend_angle(w.triangle);
            } else {
                return;
            }
        }
    }

    /// To be called once, after run(): gives its memory away as it goes.
    Refinement result() {
        Refinement r;
        r.stats = count_leftovers();
        sizes_ = {};
        oversized_ = {};
        narrow_ = {};
        points_.erase(points_.begin(), points_.begin() + static_cast<std::ptrdiff_t>(border_count_));
        r.steiner_points = std::move(points_);
        r.triangles.reserve(tris_.size());
        // In blocks whose pages are given back once they are copied: the peak of memory is not here.
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
    /// A triangle with its edges as the decisions need them.
    struct Shape {
        std::array<double, 3> squared;  ///< squared length of edge e
        double area2;                   ///< twice the area
        unsigned shortest() const {
            const unsigned m = squared[1] < squared[0] ? 1 : 0;
            return squared[2] < squared[m] ? 2 : m;
        }
    };

    Shape shape_of(const Tri& t) const {
        const Point a = points_[t.v[0]], b = points_[t.v[1]], c = points_[t.v[2]];
        return {{squared_length(c - b), squared_length(a - c), squared_length(b - a)}, cross(b - a, c - a)};
    }

    double area2_bound(const Tri& t) const {
        const double h = static_cast<double>(sizes_[t.v[0]]) + sizes_[t.v[1]] + sizes_[t.v[2]];
        return (2 * core::equilateral_area / 9) * (h * h);
    }

    /// sin^2 of the smallest angle = (2 area)^2 / (product of the two longer squared edges).
    bool is_narrow(double ab, double bc, double ca, double shortest, double area2) const {
        return area2 * area2 * shortest < squared_sine_ * (ab * bc * ca);
    }

    void classify(Index t) {
        const Shape s = shape_of(tris_[t]);
        const double shortest = s.squared[s.shortest()];
        const Waiting w{t, tris_[t].v[0]};
        if (s.area2 > area2_bound(tris_[t]))
            oversized_.push_back(w);
        else if (is_narrow(s.squared[0], s.squared[1], s.squared[2], shortest, s.area2))
            narrow_.push(w, shortest);
    }

    /// Stale entries deep in the stack would wait there until the end. The order of the others stays.
    void purge() {
        std::erase_if(oversized_, [&](Waiting w) { return !is_current(w); });
        purge_at_ = std::max(least_purge, 2 * oversized_.size());
    }

    bool is_current(Waiting w) const { return tris_[w.triangle].v[0] == w.newest; }

    /// Where a point on the perpendicular bisector of edge e stands, `reach` edge lengths inside from its middle, but
    /// never beyond the circumcentre. The segment from the middle to the circumcentre lies in the circumscribed circle.
    ///
    ///            w
    ///          / : \           tangent of the angle at w: cross / dot
    ///         /  x  \    x = circumcentre, dot / (2 cross) edge lengths above the middle
    ///        /   :   \         .
    ///       u ---m--- v
    Point on_bisector(const Tri& t, unsigned e, double reach) const {
        const Point u = points_[t.v[next(e)]], v = points_[t.v[previous(e)]], w = points_[t.v[e]];
        const Point edge = v - u, wu = u - w, wv = v - w;
        const double to_centre = 0.5 * dot(wu, wv) / cross(wu, wv);
        return midpoint(u, v) + std::min(reach, to_centre) * perpendicular(edge);
    }

    void mend_size(Index t) {
        const Tri& tri = tris_[t];
        const Shape s = shape_of(tri);
        // Height of a triangle of the aimed area over the shortest edge, in lengths of that edge.
        const unsigned e = s.shortest();
        const double reach = aimed_area * area2_bound(tri) / s.squared[e];
        insert_near(t, e, reach > least_front_height ? reach : HUGE_VAL);
    }

    void mend_angle(Index t) { insert_near(t, shape_of(tris_[t]).shortest(), off_centre_); }

    /// Inserts a point on the bisector of edge e; where it would encroach upon the border, the circumcentre, which
    /// keeps the distance that the guarantee for frozen borders is about (docs/decisions/0003).
    void insert_near(Index t, unsigned e, double reach) {
        const Point p = on_bisector(tris_[t], e, reach);
        if (insert(t, p)) return;
        const Point centre = on_bisector(tris_[t], e, HUGE_VAL);
        if (centre == p || !insert(t, centre)) ++refused_;
    }

    /// Inserts p, which lies in the circle of triangle t. False, and nothing changed, where p encroaches upon the
    /// border.
    bool insert(Index t, Point p) {
        const SeenTriangle seen = see(points_.data(), tris_[t], p);
        if (!in_circle(tris_[t], seen, p)) return false;
        find_cavity<false>(points_.data(), tris_.data(), t, seen, p, cavity_);
        if (!rim_is_free(p)) return false;
        if (points_.size() - border_count_ >= options_.max_points) fail_too_many(options_.max_points);
        const Index vertex = static_cast<Index>(points_.size());
        points_.push_back(p);
        sizes_.push_back(static_cast<float>(size_(p)));
        const std::size_t before = tris_.size();
        fill_cavity(tris_, cavity_, vertex);
        classify_fan(vertex, before);
        return true;
    }

    /// Does p lie in the circle of t? Rounding may have moved it out.
    bool in_circle(const Tri& t, const SeenTriangle& seen, Point p) const {
        double det = 0, sum = 0;
        for (unsigned i = 0; i < 3; ++i) {
            const double rr = squared_length(seen.r[i]);
            det += rr * seen.area2[i];
            sum += rr;
        }
        // The error bound of find_cavity().
        return det > 4e-16 * (sum * sum) || in_circle_after_filter<false>(points_.data(), t, p);
    }

    /// Every rim edge sees p on its inner side, and no border edge of the rim has p in its diametral circle.
    bool rim_is_free(Point p) const {
        const std::size_t k = cavity_.rim.size();
        for (std::size_t i = 0; i < k; ++i) {
            const RimEdge& a = cavity_.rim[i];
            const RimEdge& b = cavity_.rim[i + 1 < k ? i + 1 : 0];
            if (a.outer.is_constrained() && a.ax * b.ax + a.ay * b.ay <= 0) return false;
            // Twice the rounding error of a cross product of these lengths.
            if (a.area2 <= 1e-15 * (a.aa + b.aa) && core::inline_orient2d(points_[a.a], points_[b.a], p) <= 0)
                return false;
        }
        return true;
    }

    /// classify() for the new triangles, from the lengths that the cavity walk left behind.
    void classify_fan(Index vertex, std::size_t before) {
        const std::size_t k = cavity_.rim.size();
        const double h = sizes_[vertex];
        for (std::size_t i = 0; i < k; ++i) {
            const RimEdge& a = cavity_.rim[i];
            const RimEdge& b = cavity_.rim[i + 1 < k ? i + 1 : 0];
            const double sum = h + sizes_[a.a] + sizes_[b.a];
            const double ex = b.ax - a.ax, ey = b.ay - a.ay;
            const double ab = ex * ex + ey * ey;
            const Waiting w{cavity_.created(i, before), vertex};
            if (a.area2 > (2 * core::equilateral_area / 9) * (sum * sum)) {
                oversized_.push_back(w);
            } else {
                const double shortest = std::min(std::min(a.aa, b.aa), ab);
                if (is_narrow(a.aa, b.aa, ab, shortest, a.area2)) narrow_.push(w, shortest);
            }
        }
    }

    void reserve(std::size_t triangles) {
        tris_.reserve(triangles + triangles / 8 + 16);
        points_.reserve(border_count_ + triangles / 2 + triangles / 16);
        sizes_.reserve(points_.capacity());
    }

    RefineStats count_leftovers() const;

    const SizeField& size_;
    const RefineOptions& options_;
    std::size_t border_count_;
    std::vector<Point> points_;
    std::vector<float> sizes_;  ///< h at each point
    Tris tris_;
    double squared_sine_ = 0, off_centre_ = 0;
    static constexpr std::size_t least_purge = std::size_t{1} << 16;
    std::vector<Waiting> oversized_;
    std::size_t purge_at_ = least_purge;
    AngleQueue narrow_;
    Cavity cavity_;
    std::size_t refused_ = 0;
};

/// The region's interior angle at a vertex is below 60 degrees where the border turns back sharply: such corners
/// excuse the triangles in them.
RefineStats Refiner::count_leftovers() const {
    // Every triangle was queued as long as something was wrong with it: without a refusal nothing is left.
    if (refused_ == 0) return {};
    // A border edge into and one out of each border vertex (region on their left). Where the region touches itself at a
    // vertex one pair speaks for it.
    std::vector<char> sharp(border_count_, 0);
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

    RefineStats stats;
    stats.refused = refused_;
    for (const Tri& t : tris_) {
        const Shape s = shape_of(t);
        const double shortest = s.squared[s.shortest()];
        // What the check of the finished mesh would count: the bound, less rounding.
        if (is_narrow(s.squared[0], s.squared[1], s.squared[2], shortest * (1 + 1e-9), s.area2)) {
            ++stats.below_bound;
            stats.exempt += std::any_of(t.v, t.v + 3, [&](Index v) { return v < border_count_ && sharp[v]; });
        }
        stats.oversized += s.area2 > area2_bound(t) * (1 + 1e-9);
    }
    return stats;
}

}  // namespace

}  // namespace lamina::delaunay

namespace lamina {

using namespace delaunay;

namespace {

Refinement refine_all(std::span<const Point> points, std::span<const Segment> segments, const SizeField& size,
                      const RefineOptions& options) {
    Refiner refiner(points, segments, size, options);
    refiner.run();
    return refiner.result();
}

/// Refines the seam between border and patches, the rims of the patches being frozen like the border, and joins both.
Refinement refine_seam(std::span<const Point> points, std::span<const Segment> segments, const SizeField& size,
                       const RefineOptions& options, LatticePatches patches) {
    if (patches.points.size() > options.max_points) fail_too_many(options.max_points);
    // Seam: border points, then the rim's and the collar's.
    std::vector<Point> seam_points(points.begin(), points.end());
    std::vector<Segment> seam_segments(segments.begin(), segments.end());
    std::vector<VertexId> shared;
    std::vector<VertexId> in_seam(patches.points.size());
    const auto seam_vertex = [&](VertexId v) {
        VertexId& s = in_seam[v.index()];
        if (!s.valid()) {
            s = VertexId{seam_points.size()};
            seam_points.push_back(patches.points[v.index()]);
            shared.push_back(v);
        }
        return s;
    };
    for (const Segment& s : patches.rim) seam_segments.push_back({seam_vertex(s.a), seam_vertex(s.b)});
    for (VertexId v : patches.collar) seam_vertex(v);
    in_seam = {};
    RefineOptions seam_options = options;
    seam_options.expected_triangles = 3 * seam_points.size();
    Refinement seam = refine_all(seam_points, seam_segments, size, seam_options);

    // Result: border, patches, what the seam added.
    Refinement result;
    result.stats = seam.stats;
    const std::size_t border = points.size(), lattice = patches.points.size();
    result.steiner_points = std::move(patches.points);
    result.steiner_points.insert(result.steiner_points.end(), seam.steiner_points.begin(), seam.steiner_points.end());
    result.triangles = std::move(patches.triangles);
    for (Triangle& t : result.triangles)
        for (VertexId& v : t.v) v = VertexId{border + v.index()};
    for (const Triangle& t : seam.triangles) {
        Triangle& joined = result.triangles.emplace_back(t);
        for (VertexId& v : joined.v) {
            if (v.index() >= seam_points.size())
                v = VertexId{v.index() - seam_points.size() + border + lattice};
            else if (v.index() >= border)
                v = VertexId{border + shared[v.index() - border].index()};
        }
    }
    return result;
}

}  // namespace

Refinement refine(std::span<const Point> points, std::span<const Segment> segments, const SizeField& size,
                  const RefineOptions& options) {
    validate(options);
    if (options.lattice) {
        LatticePatches patches = fill_with_lattice(points, segments, size, options.max_points);
        if (!patches.empty()) return refine_seam(points, segments, size, options, std::move(patches));
    }
    return refine_all(points, segments, size, options);
}

}  // namespace lamina
