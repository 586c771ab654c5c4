// Smoothing: vertices of a refined triangulation move to where the triangles round them are better, and edges flip until
// the triangulation is Delaunay again.
//
//        o-------o               o-------o
//       / \     / \             / \     / \         The vertex v moves towards the mean of the centroids of its
//      /   \ v /   \           /   \   /   \        triangles, weighted by area / h^2, if that makes them better.
//     o-----'-------o         o-----v-------o
//      \   /  \    /           \   / \     /
//       \ /    \  /             \ /   \   /
//        o------o                o-----o
//
// Source: centroidal patch triangulations: L. Chen, M. Holst, Comput. Methods Appl. Mech. Engrg. 200 (2011); smoothing
// that never makes the worst triangle worse: L. A. Freitag, C. Ollivier-Gooch, Int. J. Numer. Meth. Engng. 40 (1997);
// flips: C. L. Lawson, Mathematical Software III (1977).
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include <lamina/point.hpp>

#include "core/predicates.hpp"
#include "delaunay/cavity.hpp"
#include "delaunay/triangles.hpp"

namespace lamina::delaunay {

/// The arrays of a triangulation that smoothing changes. Vertices before `first_movable`, and those on constrained edges
/// and borders, stay where they are.
struct SmoothedArrays {
    std::vector<Point>& points;
    std::vector<float>& sizes;  ///< h at each point
    Tris& tris;
    Index first_movable;
};

/// Smooths a Delaunay triangulation, which stays Delaunay. `Rules` knows what a triangle may be; its members are
///     double size_at(Point p, Index t)       h at p, which lies in or near triangle t
///     bool is_allowed(double aa, double bb, double cc, double area2, double size_sum)
///                                            whether a triangle of these squared edges, twice this area, and this sum
///                                            of h at its vertices keeps its bounds
///     bool is_blocked(const CavityEdge& a, const CavityEdge& b)
///                                            whether a vertex may not stand so near to the constrained edge a-b
template <class Rules>
class Smoother {
public:
    Smoother(const SmoothedArrays& arrays, Rules rules)
        : points_(arrays.points),
          sizes_(arrays.sizes),
          tris_(arrays.tris),
          first_movable_(arrays.first_movable),
          rules_(rules) {}

    /// Moves the vertices of the triangles whose mean ratio is below the bound, up to `rounds` times, where that improves
    /// the worst of the triangles round them.
    void mend_worst(double mean_ratio_bound, unsigned rounds) {
        const double bound = mean_ratio_bound * equilateral_ratio;
        std::vector<Index> bad, touched;
        for (Index t = 0; t < tris_.size(); ++t)
            if (is_below(tris_[t], bound)) bad.push_back(t);
        for (unsigned round = 0; round < rounds && !bad.empty(); ++round) {
            touched.clear();
            for (const Index t : bad) {
                for (unsigned corner = 0; corner < 3 && is_below(tris_[t], bound); ++corner) {
                    if (!move(t, corner, HUGE_VAL)) continue;
                    for (const StarTriangle& s : star_) touched.push_back(s.t);
                    for (const Flip& flip : flips_) touched.insert(touched.end(), {flip.t, flip.n});
                }
            }
            std::swap(bad, touched);
        }
    }

    /// Moves every free vertex once, in the order of the triangles, where that improves the sum of the mean ratios and
    /// makes no triangle worse than the worst one was, or than the bound. Returns the number of vertices that moved.
    std::size_t sweep(double mean_ratio_bound) {
        const double bound = mean_ratio_bound * equilateral_ratio;
        std::vector<char> seen(points_.size(), 0);
        std::size_t moved = 0;
        for (Index t = 0; t < tris_.size(); ++t) {
            for (unsigned corner = 0; corner < 3; ++corner) {
                char& is_seen = seen[tris_[t].v[corner]];
                if (is_seen != 0) continue;
                is_seen = 1;
                moved += move(t, corner, bound);
            }
        }
        return moved;
    }

private:
    /// A triangle (v, a, b) of the star of v. The b of one is the a of the next.
    struct StarTriangle {
        Index t;
        unsigned corner;  ///< the place of v in t
        Index a_vertex;
        Point a;        ///< relative to v
        double a_size;  ///< h at a
    };
    struct QueuedEdge {
        Index t;
        unsigned e;
    };
    /// A flip, with the two triangles that it replaced.
    struct Flip {
        Index t, n;
        Tri old_t, old_n;
    };

    /// Twice the area of an equilateral triangle over the sum of its squared edges. The mean ratio of a triangle is this
    /// ratio of its own, divided by that of the equilateral one.
    static constexpr double equilateral_ratio = 0.28867513459481287;
    /// A move has to improve the ratio by this factor, so that rounding moves nothing for ever.
    static constexpr double min_gain = 1.0001;
    /// Moved triangles are fatter than this; rounding cannot turn them over.
    static constexpr double min_ratio = 1e-12;

    bool is_below(const Tri& t, double bound) const {
        const Point a = points_[t.v[0]], b = points_[t.v[1]], c = points_[t.v[2]];
        return cross(b - a, c - a) < bound * (squared_length(c - b) + squared_length(a - c) + squared_length(b - a));
    }

    /// Finds the triangles round a vertex, counter-clockwise. Returns false if the vertex may not move.
    bool find_star(Index t, unsigned corner) {
        const Index first = t, v = tris_[t].v[corner];
        if (v < first_movable_) return false;
        star_.clear();
        do {
            const Tri& tri = tris_[t];
            const Index a = tri.v[next(corner)];
            star_.push_back({t, corner, a, points_[a] - points_[v], sizes_[a]});
            const Link across = tri.n[next(corner)];
            if (across.is_constrained()) return false;
            t = across.triangle();
            corner = next(across.edge());
        } while (t != first);
        return true;
    }

    /// The move that the vertex of the star should make, and the ratios of its triangles before.
    struct Target {
        Point move;
        double worst_ratio, ratio_sum;
    };

    Target find_target(double size) const {
        double weights = 0, worst = 1, ratios = 0;
        Point sum{0, 0};
        for (std::size_t i = 0; i < star_.size(); ++i) {
            const StarTriangle& a = star_[i];
            const StarTriangle& b = star_[i + 1 < star_.size() ? i + 1 : 0];
            const double area2 = cross(a.a, b.a), size_sum = size + a.a_size + b.a_size;
            const double weight = area2 / (size_sum * size_sum);
            weights += weight;
            sum = sum + weight * (a.a + b.a);
            const double ratio = area2 / (squared_length(a.a) + squared_length(b.a) + squared_length(b.a - a.a));
            worst = std::min(worst, ratio);
            ratios += ratio;
        }
        return {(1 / (3 * weights)) * sum, worst, ratios};
    }

    /// Returns whether all triangles of the star are allowed after a move, better than the first bound of their ratios,
    /// and their sum above the second one.
    bool is_improved_by(Point move, double size, double ratio_bound, double sum_bound) const {
        double sum = 0;
        for (std::size_t i = 0; i < star_.size(); ++i) {
            const StarTriangle& from = star_[i];
            const StarTriangle& to = star_[i + 1 < star_.size() ? i + 1 : 0];
            const Point a = from.a - move, b = to.a - move;
            const double aa = squared_length(a), bb = squared_length(b), cc = squared_length(b - a),
                         area2 = cross(a, b);
            const double ratio = area2 / (aa + bb + cc);
            if (!(ratio > ratio_bound)) return false;
            sum += ratio;
            if (!rules_.is_allowed(aa, bb, cc, area2, size + from.a_size + to.a_size)) return false;
            const Link outer = tris_[from.t].n[from.corner];
            if (outer.is_constrained() && rules_.is_blocked({from.a_vertex, outer, a.x, a.y, aa, area2},
                                                            {to.a_vertex, outer, b.x, b.y, bb, area2}))
                return false;
        }
        return sum > sum_bound;
    }

    /// Moves one vertex of a triangle towards its target or half the way. If the worst ratio round it is below the
    /// bound, it has to become better, otherwise the sum of them. Returns whether the vertex moved.
    bool move(Index t, unsigned corner, double bound) {
        if (!find_star(t, corner)) return false;
        const Index v = tris_[t].v[corner];
        const Point old_place = points_[v];
        const float old_size = sizes_[v];
        const Target target = find_target(old_size);
        const bool mends = target.worst_ratio < bound;
        const double ratio_bound = std::max(mends ? min_gain * target.worst_ratio : bound, min_ratio);
        const double sum_bound = mends ? 0 : min_gain * target.ratio_sum;
        for (const double share : {1.0, 0.5}) {
            const Point place = old_place + share * target.move;
            const double size = rules_.size_at(place, t);
            if (!is_improved_by(place - old_place, size, ratio_bound, sum_bound)) continue;
            points_[v] = place;
            sizes_[v] = static_cast<float>(size);
            if (restore_delaunay(std::min(target.worst_ratio, bound))) return true;
            points_[v] = old_place;
            sizes_[v] = old_size;
        }
        return false;
    }

    /// Flips edges until the triangulation is Delaunay again. If that makes a triangle worse than the worst one was, or
    /// one that is not allowed, it undoes all flips and returns false.
    bool restore_delaunay(double worst_ratio) {
        flips_.clear();
        pending_.clear();
        for (const StarTriangle& s : star_) {
            pending_.push_back({s.t, s.corner});
            pending_.push_back({s.t, next(s.corner)});
        }
        while (!pending_.empty()) {
            const auto [t, e] = pending_.back();
            pending_.pop_back();
            if (is_delaunay(t, e)) continue;
            const Index n = tris_[t].n[e].triangle();
            flips_.push_back({t, n, tris_[t], tris_[n]});
            flip_edge(tris_, t, e);
            if (!is_good(tris_[t], worst_ratio) || !is_good(tris_[n], worst_ratio)) {
                undo_flips();
                return false;
            }
            for (const QueuedEdge edge : {QueuedEdge{t, 0}, QueuedEdge{t, 2}, QueuedEdge{n, 0}, QueuedEdge{n, 1}})
                pending_.push_back(edge);
        }
        return true;
    }

    void undo_flips() {
        for (auto flip = flips_.rbegin(); flip != flips_.rend(); ++flip) {
            for (unsigned e = 0; e < 3; ++e) {
                tris_[flip->t].v[e] = flip->old_t.v[e];
                tris_[flip->n].v[e] = flip->old_n.v[e];
                connect(tris_, flip->t, e, flip->old_t.n[e]);
                connect(tris_, flip->n, e, flip->old_n.n[e]);
            }
        }
    }

    bool is_delaunay(Index t, unsigned e) const {
        const Tri& tri = tris_[t];
        const Link across = tri.n[e];
        if (across.is_constrained()) return true;
        const Index d = tris_[across.triangle()].v[across.edge()];
        return core::inline_incircle_perturbed(points_[tri.v[0]], points_[tri.v[1]], points_[tri.v[2]], points_[d]) <=
               0;
    }

    /// Returns whether a triangle that a flip has made is allowed and not worse than the bound.
    bool is_good(const Tri& t, double bound) const {
        double size_sum = 0;
        for (const Index v : t.v) size_sum += sizes_[v];
        for (unsigned e = 0; e < 3; ++e) {
            const Point p = points_[t.v[e]], a = points_[t.v[next(e)]] - p, b = points_[t.v[previous(e)]] - p;
            const double aa = squared_length(a), bb = squared_length(b), cc = squared_length(b - a),
                         area2 = cross(a, b);
            if (e == 0 && !(area2 >= bound * (aa + bb + cc) && rules_.is_allowed(aa, bb, cc, area2, size_sum)))
                return false;
            if (t.n[e].is_constrained() && rules_.is_blocked({t.v[next(e)], t.n[e], a.x, a.y, aa, area2},
                                                             {t.v[previous(e)], t.n[e], b.x, b.y, bb, area2}))
                return false;
        }
        return true;
    }

    std::vector<Point>& points_;
    std::vector<float>& sizes_;
    Tris& tris_;
    Index first_movable_;
    Rules rules_;
    std::vector<StarTriangle> star_;
    std::vector<QueuedEdge> pending_;
    std::vector<Flip> flips_;  ///< since the last vertex moved
};

}  // namespace lamina::delaunay
