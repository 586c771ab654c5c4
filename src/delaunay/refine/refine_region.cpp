// Refinement of a region with a frozen border: no segment is ever split, and a point that would encroach upon one is
// refused. docs/decisions/0003 says how long the segments may be.
#include "delaunay/refine/refine_region.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include <lamina/error.hpp>

#include "core/bounding_box.hpp"
#include "core/pages.hpp"
#include "core/segments.hpp"
#include "core/text.hpp"
#include "delaunay/constrain/insert_segments.hpp"
#include "delaunay/constrain/regions.hpp"
#include "delaunay/refine/estimate.hpp"
#include "delaunay/refine/refiner.hpp"
#include "delaunay/triangulate/settled_point.hpp"
#include "delaunay/triangulate/triangulate_points.hpp"

namespace lamina::delaunay {

namespace {

/// Returns the triangles of the region on the left of the segments, in an order that does not depend on the numbers of
/// the points, since the result of refinement depends on it.
Tris triangulate_region(std::span<const Point> border, std::span<const Segment> segments) {
    Tris tris = triangulate_points(border);
    insert_segments(border, segments, tris);
    return in_order_of_place(border, keep_left_of_segments(segments, tris, border.size()));
}

/// Refines one region.
class FrozenRefiner : public Refiner<FrozenRefiner> {
public:
    FrozenRefiner(std::span<const Point> border, std::size_t fixed_points, std::span<const Segment> segments,
                  const SizeField& size, const RefineOptions& options)
        : Refiner(options, {border.begin(), border.end()}, triangulate_region(border, segments)),
          size_(size),
          fixed_points_(fixed_points) {
        // n vertices have at most 2 n triangles.
        const double max_triangles = 2 * (static_cast<double>(border.size()) + static_cast<double>(options.max_points));
        const double expected = options.expected_triangles > 0 ? static_cast<double>(options.expected_triangles)
                                                               : estimate_loads(points_, tris_, size).total;
        if (!border.empty()) scale_ = unit_scale(core::longer_side(core::bounding_box(border)));
        unscale_ = 1 / scale_;
        if (scale_ != 1)
            for (Point& p : points_) p = scale_ * p;
        if (options.unit_length) set_unit(scale_ * *options.unit_length);
        sizes_.reserve(border.size());
        for (Point p : border) sizes_.push_back(stored(scale_ * size(p)));
        reserve(static_cast<std::size_t>(std::min(expected, max_triangles)));
    }

    /// Returns the refinement and stores its links, unless `links` is null. It may be called once only, since it frees
    /// the refiner's memory as it goes.
    Refinement refine(core::EdgeLinks* links);

private:
    friend class Refiner<FrozenRefiner>;
    double size_at(Point p, Index) const { return scale_ * size_(unscale_ * p); }
    double gradation() const { return size_.gradation(); }
    /// Returns whether the new point lies in the diametral circle of the edge.
    static bool is_blocked(const CavityEdge& a, const CavityEdge& b) { return a.ax * b.ax + a.ay * b.ay <= 0; }
    static constexpr bool always_counts = false;
    Index first_movable() const { return static_cast<Index>(fixed_points_); }
    static constexpr bool may_renumber = true;
    static constexpr bool must_mend(Index) { return true; }
    // Sizes are graded, so a cavity has few triangles.
    static constexpr bool is_in_sight(Index, Point) { return true; }
    Point settled(Point p, Index t) const {
        const auto& v = tris_[t].v;
        const float h = std::min({sizes_[v[0]], sizes_[v[1]], sizes_[v[2]]});
        return unit() * settled_point((1 / unit()) * p, h);
    }
    // Frozen borders are graded, so all edges are about as long as the borders nearby.
    static constexpr bool is_unresolved(Point, Point) { return false; }
    static void vertex_inserted(Index, std::size_t) {}
    void give_up(Index, Point) { ++refused_; }
    static constexpr bool split_next() { return false; }

    RefineStats count_leftovers() const;
    std::vector<char> find_sharp_corners() const;

    const SizeField& size_;
    std::size_t fixed_points_;  ///< number of points that stay where they are
    double scale_ = 1;          ///< the coordinates of the refiner over those of the input
    double unscale_ = 1;        ///< its inverse, exactly
};

/// Returns the link in the numbering of EdgeLink: edge e of a Tri, opposite its vertex e, begins at the next vertex.
core::EdgeLink edge_link_of(Link link) {
    return link.is_border() ? core::no_link : core::edge_link(link.triangle(), next(link.edge()));
}

Refinement FrozenRefiner::refine(core::EdgeLinks* links) {
    run();
    Refinement r;
    r.stats = count_leftovers();
    sizes_ = {};
    points_.erase(points_.begin(), points_.begin() + static_cast<std::ptrdiff_t>(fixed_points_));
    if (scale_ != 1)
        for (Point& p : points_) p = unscale_ * p;
    r.steiner_points = std::move(points_);
    r.triangles.reserve(tris_.size());
    if (links) links->resize(3 * tris_.size());
    // Each block gives its pages back once it is copied, so that memory does not peak here.
    constexpr std::size_t block = std::size_t{1} << 16;
    for (std::size_t from = 0; from < tris_.size(); from += block) {
        const std::size_t to = std::min(from + block, tris_.size());
        r.triangles.resize(to);
        for (std::size_t i = from; i < to; ++i) {
            const auto& v = tris_[i].v;
            r.triangles[i] = {VertexId{v[0]}, VertexId{v[1]}, VertexId{v[2]}};
            if (!links) continue;
            for (unsigned e = 0; e < 3; ++e) (*links)[3 * i + next(e)] = edge_link_of(tris_[i].n[e]);
        }
        core::give_back_pages(&tris_[from], (to - from) * sizeof(Tri));
    }
    return r;
}

/// Returns a flag for each border point: 1 where the interior angle of the region is below 60 degrees.
std::vector<char> FrozenRefiner::find_sharp_corners() const {
    std::vector<char> sharp(input_count_, 0);
    // Each border point gets the other ends of one border edge out of it and of one into it, the region on their left.
    // Where the region touches itself at a vertex, one pair of edges speaks for it.
    std::vector<std::array<Index, 2>> around(input_count_, {no_index, no_index});
    for (const Tri& t : tris_)
        for (unsigned e = 0; e < 3; ++e) {
            if (!t.n[e].is_border()) continue;
            around[t.v[next(e)]][0] = t.v[previous(e)];
            around[t.v[previous(e)]][1] = t.v[next(e)];
        }
    for (Index v = 0; v < input_count_; ++v) {
        const auto [out, in] = around[v];
        if (out == no_index || in == no_index) continue;
        const Point a = points_[out] - points_[v], b = points_[in] - points_[v];
        sharp[v] = core::encloses_sharp_angle(a, b);
    }
    return sharp;
}

/// Counts the triangles that stayed beyond the bounds. Narrow ones at a sharp corner of the border are exempt.
RefineStats FrozenRefiner::count_leftovers() const {
    // A triangle is queued as long as something is wrong with it, so without a refused point none is left.
    if (refused_ == 0 && !stopped()) return {};
    const std::vector<char> sharp = find_sharp_corners();
    RefineStats stats;
    const auto count = [&](const Tri& t) {
        const TriangleShape s = shape_of(t);
        const double shortest = s.squared[s.shortest()];
        // The allowance for rounding makes this count the triangles that check_mesh() counts.
        if (is_narrow(s.squared[0], s.squared[1], s.squared[2], shortest * (1 + 1e-9), s.area2)) {
            ++stats.below_bound;
            stats.exempt += std::any_of(t.v, t.v + 3, [&](Index v) { return v < input_count_ && sharp[v]; });
        }
        stats.oversized += is_oversized(t, s);
    };
    if (suspects_)
        for (const Index t : *suspects_) count(tris_[t]);
    else
        std::for_each(tris_.begin(), tris_.end(), count);
    count_refused(stats);
    stats.stopped = stopped();
    return stats;
}

}  // namespace

Refinement refine_region(std::span<const Point> points, std::size_t fixed_points, std::span<const Segment> segments,
                         const SizeField& size, const RefineOptions& options, core::EdgeLinks* links) {
    return FrozenRefiner(points, fixed_points, segments, size, options).refine(links);
}

double unit_scale(double extent) {
    // Within these bounds single precision holds the sizes, and double precision the sixth power of lengths down to
    // 2^-100 of the extent.
    constexpr double max_plain_extent = 0x1p60;
    if (!(extent > 0) || (extent <= max_plain_extent && extent >= 1 / max_plain_extent)) return 1;
    int exponent = 0;
    std::frexp(extent, &exponent);
    return std::ldexp(1.0, -exponent);
}

void fail_too_many_points(std::size_t max_points) {
    throw MeshError(core::concat("refinement stopped after ", max_points,
                                 " points, which are all that are allowed: the sizes or the angle bound ask for more"));
}

}  // namespace lamina::delaunay
