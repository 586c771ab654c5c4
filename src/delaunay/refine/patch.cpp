// How patches settle.
#include "delaunay/refine/patch.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "core/predicates.hpp"
#include "delaunay/refine/triangle_shape.hpp"
#include "delaunay/triangulate/conditions.hpp"

namespace lamina::delaunay {

namespace {

/// The sum of the squared edges of an equilateral triangle over twice its area.
constexpr double equilateral_ratio = 3.4641016151377544;
/// No move makes a triangle with a smaller share of twice the area in the sum of squared edges: far beyond rounding.
constexpr double least_share = 1e-9;

/// The sum over the triangles round a vertex of squared edges over twice the area, as a function of its place, with the
/// first and second derivatives.
struct StarDistortion {
    double value = 0;
    Point gradient{0, 0};
    double xx = 0, xy = 0, yy = 0;
};

/// Returns the sum of StarDistortion for a vertex at p; infinity where a triangle turns over.
double star_distortion(Point p, const Point* points, const Index* ring, const Index* end) {
    double sum = 0;
    Point a = points[*ring] - p;
    for (++ring; ring != end; ++ring) {
        const Point b = points[*ring] - p;
        const double squared_sum = squared_length(a) + squared_length(b) + squared_length(b - a), area2 = cross(a, b);
        if (!(area2 > least_share * squared_sum)) return HUGE_VAL;
        sum += squared_sum / area2;
        a = b;
    }
    return sum;
}

/// Of s / A, where s is the sum of squared edges and A twice the area, the gradient is (s' - s A' / A) / A. The second
/// derivatives of s are those of 2 p^2, and those of A are 0.
StarDistortion star_derivatives(Point p, const Point* points, const Index* ring, const Index* end) {
    StarDistortion d;
    Point a = points[*ring] - p;
    for (++ring; ring != end; ++ring) {
        const Point b = points[*ring] - p;
        const double inverse = 1 / cross(a, b);
        const double value = (squared_length(a) + squared_length(b) + squared_length(b - a)) * inverse;
        const Point s = (-2 * inverse) * (a + b), area = inverse * Point{a.y - b.y, b.x - a.x};
        d.value += value;
        d.gradient = d.gradient + (s - value * area);
        d.xx += 4 * inverse - 2 * s.x * area.x + 2 * value * area.x * area.x;
        d.xy += 2 * value * area.x * area.y - s.x * area.y - s.y * area.x;
        d.yy += 4 * inverse - 2 * s.y * area.y + 2 * value * area.y * area.y;
        a = b;
    }
    return d;
}

}  // namespace

double cost_of(const Patch& patch) {
    double sum = 0;
    for (Index t = 0; t < patch.tris.size(); ++t) {
        if (patch.is_removed(t)) continue;
        const TriangleShape s = shape_of(patch.points, patch.tris[t]);
        sum += s.squared_sum() / (equilateral_ratio * s.area2) - 1;
    }
    const auto vertices = std::count_if(patch.degrees.begin(), patch.degrees.end(), [](unsigned d) { return d > 0; });
    return sum + PatchSettler::vertex_cost * static_cast<double>(vertices);
}

/// Lists the free vertices with their neighbours, counter-clockwise.
void PatchSettler::find_rings(const Patch& patch) {
    triangle_at_.assign(patch.points.size(), no_index);
    for (Index t = 0; t < patch.tris.size(); ++t)
        if (!patch.is_removed(t))
            for (const Index v : patch.tris[t].v) triangle_at_[v] = t;
    free_.clear();
    rings_.clear();
    for (Index v = 0; v < patch.points.size(); ++v) {
        if (patch.is_fixed[v]) continue;
        const std::size_t begin = rings_.size();
        Index t = triangle_at_[v];
        unsigned corner = corner_of(patch.tris[t], v);
        do {
            rings_.push_back(patch.tris[t].v[next(corner)]);
            const Link across = patch.tris[t].n[next(corner)];
            t = across.triangle();
            corner = next(across.edge());
        } while (t != triangle_at_[v]);
        rings_.push_back(rings_[begin]);
        free_.push_back({v, begin, rings_.size()});
    }
}

/// Moves every free vertex by a step of Newton's method towards the least distortion of its triangles. Steps are made
/// longer, as in successive over-relaxation, unless that increases the distortion.
void PatchSettler::move_all(Patch& patch) const {
    for (const FreeVertex& vertex : free_) {
        const Index *const ring = rings_.data() + vertex.ring_begin, *const end = rings_.data() + vertex.ring_end;
        const Point* const points = patch.points.data();
        Point& p = patch.points[vertex.v];
        const StarDistortion d = star_derivatives(p, points, ring, end);
        const double det = d.xx * d.yy - d.xy * d.xy;
        if (!(det > 0)) continue;
        const Point step{(d.xy * d.gradient.y - d.yy * d.gradient.x) / det,
                         (d.xy * d.gradient.x - d.xx * d.gradient.y) / det};
        for (const double share : {1.5, 0.75, 0.25}) {
            const Point place = p + share * step;
            if (!(star_distortion(place, points, ring, end) <= d.value)) continue;
            p = place;
            break;
        }
    }
}

/// Flips edges until the patch is Delaunay. Returns whether there were any to flip.
bool PatchSettler::restore_delaunay(Patch& patch) {
    bool any = false;
    pending_.clear();
    for (Index t = 0; t < patch.tris.size(); ++t)
        for (unsigned e = 0; e < 3; ++e)
            if (const Link across = patch.tris[t].n[e]; !across.is_constrained() && t < across.triangle())
                pending_.push_back({t, e});
    while (!pending_.empty()) {
        const auto [t, e] = pending_.back();
        pending_.pop_back();
        const Tri& tri = patch.tris[t];
        const Link across = tri.n[e];
        if (across.is_constrained()) continue;
        const Index n = across.triangle(), d = patch.tris[n].v[across.edge()];
        if (core::inline_incircle_perturbed(patch.points[tri.v[0]], patch.points[tri.v[1]], patch.points[tri.v[2]],
                                            patch.points[d]) <= 0)
            continue;
        any = true;
        --patch.degrees[tri.v[next(e)]];
        --patch.degrees[tri.v[previous(e)]];
        ++patch.degrees[tri.v[e]];
        ++patch.degrees[d];
        flip_edge(patch.tris, t, e);
        assert(is_counter_clockwise(patch.points, patch.tris[t]) && is_counter_clockwise(patch.points, patch.tris[n]));
        for (const QueuedEdge edge : {QueuedEdge{t, 0}, QueuedEdge{t, 2}, QueuedEdge{n, 0}, QueuedEdge{n, 1}})
            pending_.push_back(edge);
    }
    return any;
}

double PatchSettler::settle(Patch& patch, double bound) {
    constexpr int turns = 4, moves = 3;
    constexpr double still_to_gain = 0.1;  // with a tenth of this, the same meshes come out
    for (int turn = 0; turn < turns; ++turn) {
        find_rings(patch);
        for (int i = 0; i < moves; ++i) move_all(patch);
        const bool flipped = restore_delaunay(patch);
        if (turn == 0 && cost_of(patch) > bound + still_to_gain) return HUGE_VAL;
        if (!flipped && turn > 0) break;
    }
    return cost_of(patch);
}

}  // namespace lamina::delaunay
