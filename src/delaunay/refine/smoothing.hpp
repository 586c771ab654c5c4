// Smoothing: vertices of a refined triangulation move to where the triangles round them are better, and edges flip
// until the triangulation is Delaunay again.
//
//        o-------o               o-------o
//       / \     / \             / \     / \         The vertex v moves to the mean of its neighbours, if the triangles
//      /   \ v /   \           /   \   /   \        round it keep their bounds. Where sizes change slowly this is what a
//     o-----'-------o         o-----v-------o       conformal image of a regular lattice would look like.
//      \   /  \    /           \   / \     /
//       \ /    \  /             \ /   \   /
//        o------o                o-----o
//
// First all vertices move together; then, one by one, those of ill-shaped triangles.
//
// Source: means of neighbours: L. R. Herrmann, J. Eng. Mech. Div. ASCE 102 (1976); smoothing that never makes the worst
// triangle worse: L. A. Freitag, C. Ollivier-Gooch, Int. J. Numer. Meth. Engng. 40 (1997); flips: C. L. Lawson,
// Mathematical Software III (1977).
#pragma once

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <initializer_list>
#include <utility>
#include <vector>

#include <lamina/point.hpp>

#include "core/interruption_point.hpp"
#include "core/predicates.hpp"
#include "delaunay/refine/triangle_shape.hpp"
#include "delaunay/triangulate/cavity.hpp"
#include "delaunay/triangulate/conditions.hpp"
#include "delaunay/triangulate/triangles.hpp"

namespace lamina::delaunay {

/// The arrays of a triangulation that smoothing changes. Vertices before `first_movable`, and those on constrained
/// edges and borders, stay where they are.
struct SmoothedArrays {
    std::vector<Point>& points;
    std::vector<float>& sizes;  ///< h at each point, in the unit of Rules::size_at()
    Tris& tris;
    Index first_movable;
};

/// Smooths a Delaunay triangulation, which stays Delaunay. `Rules` knows what a triangle may be; its members are
///     double size_at(Point p, Index t)       h at p, which lies in or near triangle t
///     bool is_allowed(double aa, double bb, double cc, double area2, double size_sum)
///                                            whether a triangle of these squared edges, twice this area, and this sum
///                                            of h at its vertices keeps its bounds
///     bool is_surely_allowed(double squared_sum, double area2, double size_sum)
///                                            the same for any triangle that is not ill-shaped, given the sum of its
///                                            squared edges; false where it depends on the edges themselves
///     double unit()                          the unit of sizes
///     double gradation(), size_error()       h at two points differs by at most this share of their distance, and this
///                                            share of h
///     bool is_blocked(const CavityEdge& a, const CavityEdge& b)
///                                            whether a vertex may not stand so near to the constrained edge a-b
template <class Rules>
class Smoother {
public:
    /// Triangles of a smaller mean ratio are ill-shaped.
    static constexpr double min_mean_ratio = 0.9;
    /// Twice the area of an equilateral triangle over the sum of its squared edges. The mean ratio of a triangle is its
    /// own ratio of this kind, divided by that of the equilateral one.
    static constexpr double equilateral_ratio = 0.28867513459481287;
    static constexpr double min_ratio = min_mean_ratio * equilateral_ratio;

    Smoother(const SmoothedArrays& arrays, Rules rules)
        : points_(arrays.points),
          sizes_(arrays.sizes),
          tris_(arrays.tris),
          first_movable_(arrays.first_movable),
          rules_(rules) {}

    /// Moves all free vertices at once to the means of their neighbours, `rounds` times, then those of ill-shaped
    /// triangles. Vertices keep the sizes of their old places where that makes no difference to smoothing, until
    /// update_sizes() is called.
    void smooth(unsigned rounds) {
        for (unsigned left = rounds; left > 0; left -= std::min(left, rounds_at_once)) {
            update_sizes();
            move_together(std::min(left, rounds_at_once));
        }
        mend_ill_shaped();
    }

    /// Returns, in ascending order, all triangles that may be ill-shaped or beyond the bounds now that smooth() has
    /// returned. Their vertices get the sizes at their places.
    std::vector<Index> suspects() {
        std::sort(suspects_.begin(), suspects_.end());
        suspects_.erase(std::unique(suspects_.begin(), suspects_.end()), suspects_.end());
        if (!states_.empty())
            for (const Index t : suspects_)
                for (const Index v : tris_[t].v) update_size(v);
        return std::move(suspects_);
    }

    /// Gives all vertices the sizes at their places.
    void update_sizes() {
        for (Index v = 0; v < states_.size(); ++v) update_size(v);
    }

    /// Moves the vertices of ill-shaped triangles one by one, a few times, where this makes the worst triangle round
    /// them better.
    void mend() {
        ill_shaped_.clear();
        for (Index t = 0; t < tris_.size(); ++t)
            if (is_ill_shaped(t)) ill_shaped_.push_back(t);
        mend_ill_shaped();
    }

private:
    /// A triangle (v, a, b) of the star of v. The b of one is the a of the next.
    struct StarTriangle {
        Index t;
        unsigned corner;  ///< the place of v in t
        Index a_vertex;
        Point a;  ///< relative to v
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
    /// A vertex, as one pass over all triangles finds it where all vertices move together. Its facts stand side by
    /// side, since each triangle writes all of them.
    struct Vertex {
        Point sum{0, 0};      ///< of its neighbours
        Index triangle = 0;   ///< one of its triangles
        unsigned degree = 0;  ///< their number
    };
    /// A vertex is in one of these states where all move together.
    enum class State : unsigned char {
        fixed,
        moved,
        moved_with_old_size,  ///< its size is the one at its old place
        returned,
    };

    static constexpr double clearly_fat_ratio = min_ratio * (1 + 1e-9);  // far beyond rounding
    /// Moves up to this many h change sizes so little that most triangles need not know it.
    static constexpr double max_move = 0.25;
    /// A move of one vertex has to improve the worst ratio by this factor, so that rounding moves nothing for ever.
    static constexpr double min_gain = 1.0001;
    /// Moved triangles are fatter than this; rounding cannot turn them over.
    static constexpr double least_ratio = 1e-12;
    /// So often vertices move together before the connectivity is looked at.
    static constexpr unsigned rounds_at_once = 5;
    static constexpr unsigned mending_rounds = 3;
    /// Vertices of triangles worse than a mean ratio of 0.86, which leaves no angle below 36.3 degrees, also move away
    /// from the means of their neighbours. Doing so for more triangles makes neighbours' areas differ more.
    static constexpr double lifted_ratio = 0.86 * equilateral_ratio;

    static double ratio_of(const TriangleShape& s) { return s.area2 / s.squared_sum(); }
    /// Returns the ratio of the triangle between its vertex and these two, relative to it.
    static double ratio_of_corner(Point a, Point b) {
        return cross(a, b) / (squared_length(a) + squared_length(b) + squared_length(b - a));
    }
    bool is_ill_shaped(Index t) const { return !(ratio_of(shape_of(points_, tris_[t])) >= min_ratio); }

    // ---- all vertices together ----------------------------------------------------------------------------------

    /// Moves all free vertices without a look at their triangles, then sends those back that have spoilt one, and moves
    /// these one by one.
    void move_together(unsigned rounds) {
        old_points_ = points_;
        old_sizes_ = sizes_;
        find_movers_and_sums();
        move_to_means();
        for (unsigned round = 1; round < rounds; ++round) {
            core::check_interruption();
            add_neighbours();
            move_to_means();
        }
        forget_sizes_of_moved();
        return_where_worse();
        // Flips may have taken a vertex out of the triangle that is known of it; it stays where it is then.
        for (const Index v : returned_)
            if (const unsigned corner = corner_of(v); corner < 3 && move(vertices_[v].triangle, corner))
                append_moved(suspects_);
    }

    /// Returns how many of so many triangles fetch_ahead() is of use for: all or, if the caches hold them anyway, none.
    static Index fetched_ahead(Index count) {
        constexpr Index cached = Index{1} << 16;
        return count > cached ? count : 0;
    }

    /// Calls fetch(v) for the vertices of the triangle that a loop will come to so much later. A loop over a
    /// triangulation that does not fit into the caches near the processor would wait for most first vertices otherwise.
    template <class Fetch>
    [[gnu::always_inline]] static void fetch_ahead(const Tri* tris, Index fetched, Index t, const Fetch& fetch) {
        constexpr Index ahead = 16;
        if (t + ahead >= fetched) return;
        for (const Index v : tris[t + ahead].v) fetch(v);
    }

    /// Calls visit(tri, t, vertices, points) for each triangle, with what is known of the vertices of later ones
    /// fetched.
    template <class Visit>
    void visit_triangles(Visit visit) {
        Vertex* const vertices = vertices_.data();
        const Point* const points = points_.data();
        const auto count = static_cast<Index>(tris_.size());
        const Index fetched = fetched_ahead(count);
        const Tri* const tris = tris_.data();
        for (Index t = 0; t < count; ++t) {
            fetch_ahead(tris, fetched, t, [&](Index v) {
                __builtin_prefetch(vertices + v, 1);
                __builtin_prefetch(points + v);
            });
            visit(tris[t], t, vertices, points);
        }
    }

    /// Finds the facts about each vertex, among them the sum of its neighbours. Each of its triangles contributes one.
    void find_movers_and_sums() {
        vertices_.assign(points_.size(), {});
        states_.assign(points_.size(), State::moved);
        std::fill(states_.begin(), states_.begin() + first_movable_, State::fixed);
        visit_triangles([&](const Tri& tri, Index t, Vertex* vertices, const Point* points) {
            for (unsigned i = 0; i < 3; ++i) {
                Vertex& vertex = vertices[tri.v[i]];
                vertex.sum = vertex.sum + points[tri.v[next(i)]];
                vertex.triangle = t;
                ++vertex.degree;
            }
            if (!has_constrained_edge(tri)) return;
            for (unsigned e = 0; e < 3; ++e)
                if (tri.n[e].is_constrained()) states_[tri.v[next(e)]] = states_[tri.v[previous(e)]] = State::fixed;
        });
    }

    void add_neighbours() {
        visit_triangles([](const Tri& tri, Index, Vertex* vertices, const Point* points) {
            for (unsigned i = 0; i < 3; ++i) {
                Vertex& vertex = vertices[tri.v[i]];
                vertex.sum = vertex.sum + points[tri.v[next(i)]];
            }
        });
    }

    /// Moves every free vertex to the mean of its neighbours, and forgets their sum.
    void move_to_means() {
        Point* const points = points_.data();
        for (Index v = first_movable_; v < points_.size(); ++v) {
            Vertex& vertex = vertices_[v];
            if (states_[v] == State::moved) points[v] = (1.0 / vertex.degree) * vertex.sum;
            vertex.sum = {0, 0};
        }
    }

    static bool has_constrained_edge(const Tri& t) {
        // All three are looked at without branches, since few triangles have any.
        return (static_cast<unsigned>(t.n[0].is_constrained()) | static_cast<unsigned>(t.n[1].is_constrained()) |
                static_cast<unsigned>(t.n[2].is_constrained())) != 0;
    }

    /// Notes that the vertices that have moved still have the sizes of their old places. Those that have moved far get
    /// the sizes of their new ones.
    void forget_sizes_of_moved() {
        constexpr double squared_far = max_move * max_move;
        for (Index v = first_movable_; v < points_.size(); ++v) {
            if (states_[v] != State::moved) continue;
            states_[v] = State::moved_with_old_size;
            const double h = rules_.unit() * sizes_[v];
            if (squared_length(points_[v] - old_points_[v]) > squared_far * (h * h)) update_size(v);
        }
    }

    void update_size(Index v) {
        if (states_[v] != State::moved_with_old_size) return;
        states_[v] = State::moved;
        sizes_[v] = static_cast<float>(rules_.size_at(points_[v], vertices_[v].triangle));
    }

    /// Returns h at a vertex.
    float size_of(Index v) {
        if (!states_.empty()) update_size(v);
        return sizes_[v];
    }

    /// Returns the place of a vertex in the triangle that is known of it, or 3.
    unsigned corner_of(Index v) const {
        const Tri& t = tris_[vertices_[v].triangle];
        return static_cast<unsigned>(std::find(t.v, t.v + 3, v) - t.v);
    }

    /// Sends vertices back to where they were until all triangles of moved ones are allowed, Delaunay, and not
    /// ill-shaped or not worse than before. Notes ill-shaped triangles.
    void return_where_worse() {
        core::check_interruption();
        returned_.clear();
        ill_shaped_.clear();
        suspects_.clear();
        least_share_ = std::max(0.0, 1 - rules_.size_error() - max_move * rules_.gradation());
        const double least_share = least_share_;
        const auto count = static_cast<Index>(tris_.size());
        const Index fetched = fetched_ahead(count);
        const Tri* const tris = tris_.data();
        const Point* const points = points_.data();
        const float* const sizes = sizes_.data();
        for (Index t = 0; t < count; ++t) {
            fetch_ahead(tris, fetched, t, [&](Index v) {
                __builtin_prefetch(points + v);
                __builtin_prefetch(sizes + v);
            });
            if (!is_clearly_good(tris[t], least_share)) check_suspect(t);
        }
        std::size_t looked_at = 0;
        while (looked_at < returned_.size()) {  // more may return meanwhile
            const Index v = returned_[looked_at++];
            find_star(vertices_[v].triangle, corner_of(v));
            for (const StarTriangle& s : star_) {
                check_suspect(s.t);
                if (const Link outer = tris_[s.t].n[s.corner]; !outer.is_constrained()) check_moved(outer.triangle());
            }
        }
    }

    /// Returns true only for triangles that need no closer look, given the least share that sizes at new places are of
    /// those at old ones. A triangle that is not ill-shaped has only acute angles.
    bool is_clearly_good(const Tri& tri, double least_share) const {
        const Point* const points = points_.data();
        const float* const sizes = sizes_.data();
        const Point p = points[tri.v[0]], a = points[tri.v[1]] - p, b = points[tri.v[2]] - p;
        const double sum = 2 * (squared_length(a) + squared_length(b) - dot(a, b)), area2 = cross(a, b);
        const float size_sum = sizes[tri.v[0]] + sizes[tri.v[1]] + sizes[tri.v[2]];
        return area2 >= clearly_fat_ratio * sum && !has_constrained_edge(tri) &&
               rules_.is_surely_allowed(sum, area2, least_share * static_cast<double>(size_sum));
    }

    void check_suspect(Index t) {
        suspects_.push_back(t);
        check_moved(t);
    }

    /// Sends the vertices of a triangle back if it is not as it should be. An edge between two acute angles is
    /// Delaunay, so only edges opposite obtuse ones are looked at.
    void check_moved(Index t) {
        constexpr double acute = 1 - 1e-9;  // far beyond rounding
        const Tri& tri = tris_[t];
        const TriangleShape shape = shape_of(points_, tri);
        const double sum = shape.squared_sum();
        bool is_good = is_allowed(tri, shape);
        if (!(shape.area2 >= min_ratio * sum)) {
            ill_shaped_.push_back(t);
            is_good = is_good && shape.area2 >= ratio_of(shape_of(old_points_, tri)) * sum;
        }
        if (!is_good) send_back(tri);
        const unsigned e = shape.longest();
        if (2 * shape.squared[e] < acute * sum) return;
        if (is_delaunay(t, e)) return;
        send_back(tri);
        send_back(tris_[tri.n[e].triangle()]);
    }

    void send_back(const Tri& t) {
        for (const Index v : t.v) {
            if (states_[v] != State::moved && states_[v] != State::moved_with_old_size) continue;
            states_[v] = State::returned;
            points_[v] = old_points_[v];
            sizes_[v] = old_sizes_[v];
            returned_.push_back(v);
        }
    }

    // ---- one vertex after another -------------------------------------------------------------------------------

    void mend_ill_shaped() {
        constexpr std::size_t triangles_between_looks = 4096;
        std::vector<Index> touched;
        std::size_t seen = 0;
        for (unsigned round = 0; round < mending_rounds && !ill_shaped_.empty(); ++round) {
            touched.clear();
            for (const Index t : ill_shaped_) {
                if (++seen % triangles_between_looks == 0) core::check_interruption();
                for (unsigned corner = 0; corner < 3 && is_ill_shaped(t); ++corner) {
                    if (move(t, corner)) append_moved(touched);
                }
            }
            std::swap(ill_shaped_, touched);
            suspects_.insert(suspects_.end(), ill_shaped_.begin(), ill_shaped_.end());
        }
    }

    /// Appends the triangles that the last move of one vertex has changed.
    void append_moved(std::vector<Index>& triangles) const {
        for (const StarTriangle& s : star_) triangles.push_back(s.t);
        for (const Flip& flip : flips_) triangles.insert(triangles.end(), {flip.t, flip.n});
    }

    /// Moves one vertex of a triangle, if that makes the worst triangle round it better: to the mean of its neighbours
    /// or half the way, else a part of the way to where the worst triangles would have it. Returns whether the vertex
    /// moved.
    bool move(Index t, unsigned corner) {
        if (!find_star(t, corner)) return false;
        const double worst = worst_ratio_of_star();
        if (move_towards(mean_of_star(), {1.0, 0.5}, worst)) return true;
        return worst < lifted_ratio && move_towards(mean_apex_of_star(), {0.5, 0.2, 0.08}, worst);
    }

    /// Moves the vertex of the star by the first of these shares of the way to a place, relative to it, that makes the
    /// worst triangle better. Returns whether there is one.
    bool move_towards(Point to, std::initializer_list<double> shares, double worst) {
        const Index t = star_[0].t, v = tris_[t].v[star_[0].corner];
        const Point old_place = points_[v];
        for (const double share : shares) {
            const Point place = old_place + share * to;
            // Sizes come last, since they take the longest and most places fail before.
            if (!is_improved_by(place - old_place, std::max(min_gain * worst, least_ratio))) continue;
            const float old_size = size_of(v);
            const double size = rules_.size_at(place, t);
            if (!is_allowed_at(place - old_place, size)) continue;
            points_[v] = place;
            sizes_[v] = static_cast<float>(size);
            if (restore_delaunay(worst)) return true;
            points_[v] = old_place;
            sizes_[v] = old_size;
        }
        return false;
    }

    /// Finds the triangles round a vertex, counter-clockwise. Returns false if the vertex may not move, or has so many
    /// that its moves would take a time that grows with their square: opposite narrow channels there are 1e5 round one
    /// vertex, each of which asks for a move.
    bool find_star(Index t, unsigned corner) {
        constexpr std::size_t most_triangles = 256;
        const Index first = t, v = tris_[t].v[corner];
        if (v < first_movable_) return false;
        star_.clear();
        do {
            const Tri& tri = tris_[t];
            const Index a = tri.v[next(corner)];
            star_.push_back({t, corner, a, points_[a] - points_[v]});
            const Link across = tri.n[next(corner)];
            if (across.is_constrained()) return false;
            t = across.triangle();
            corner = next(across.edge());
            if (star_.size() > most_triangles) return false;
        } while (t != first);
        return true;
    }

    double worst_ratio_of_star() const {
        double worst = 1;
        for (std::size_t i = 0; i < star_.size(); ++i) {
            const Point a = star_[i].a, b = star_[i + 1 < star_.size() ? i + 1 : 0].a;
            worst = std::min(worst, ratio_of_corner(a, b));
        }
        return worst;
    }

    /// Returns the mean of the neighbours of the star's vertex, relative to it.
    Point mean_of_star() const {
        Point sum{0, 0};
        for (const StarTriangle& s : star_) sum = sum + s.a;
        return (1.0 / static_cast<double>(star_.size())) * sum;
    }

    /// Returns the mean of the places, relative to the star's vertex, at which it would make its triangles equilateral.
    /// The worst triangles weigh so much that the others hardly count, but two of them that are alike count alike.
    /// Precondition: one of the triangles is ill-shaped.
    Point mean_apex_of_star() const {
        constexpr double height = 2 * equilateral_area;  // of an equilateral triangle with edges of 1
        Point sum{0, 0};
        double weights = 0;
        for (std::size_t i = 0; i < star_.size(); ++i) {
            const Point a = star_[i].a, b = star_[i + 1 < star_.size() ? i + 1 : 0].a;
            const double deficit = equilateral_ratio / std::max(ratio_of_corner(a, b), least_ratio) - 1;
            const double squared = deficit * deficit, weight = squared * squared * squared;
            sum = sum + weight * (midpoint(a, b) + height * perpendicular(b - a));
            weights += weight;
        }
        return (1 / weights) * sum;
    }

    /// Returns whether all triangles of the star are better than this ratio after a move of its vertex.
    bool is_improved_by(Point move, double ratio_bound) const {
        for (std::size_t i = 0; i < star_.size(); ++i) {
            const Point a = star_[i].a - move, b = star_[i + 1 < star_.size() ? i + 1 : 0].a - move;
            const double sum = squared_length(a) + squared_length(b) + squared_length(b - a);
            if (!(cross(a, b) > ratio_bound * sum)) return false;
        }
        return true;
    }

    /// Returns whether all triangles of the star are allowed after a move of its vertex to a place of this size.
    bool is_allowed_at(Point move, double size) {
        for (std::size_t i = 0; i < star_.size(); ++i) {
            const StarTriangle& from = star_[i];
            const StarTriangle& to = star_[i + 1 < star_.size() ? i + 1 : 0];
            const Point a = from.a - move, b = to.a - move;
            const double aa = squared_length(a), bb = squared_length(b), cc = squared_length(b - a),
                         area2 = cross(a, b);
            const auto is_within = [&](double at_a, double at_b) {
                return rules_.is_allowed(aa, bb, cc, area2, size + at_a + at_b);
            };
            if (!is_within(least_share_ * sizes_[from.a_vertex], least_share_ * sizes_[to.a_vertex]) &&
                !is_within(size_of(from.a_vertex), size_of(to.a_vertex)))
                return false;
            const Link outer = tris_[from.t].n[from.corner];
            if (outer.is_constrained() && rules_.is_blocked({from.a_vertex, outer, a.x, a.y, aa, area2},
                                                            {to.a_vertex, outer, b.x, b.y, bb, area2}))
                return false;
        }
        return true;
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
            assert(is_counter_clockwise(points_, tris_[t]) && is_counter_clockwise(points_, tris_[n]));
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
            assert(is_linked(tris_, flip->t) && is_linked(tris_, flip->n));
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

    double size_sum(const Tri& t) { return static_cast<double>(size_of(t.v[0])) + size_of(t.v[1]) + size_of(t.v[2]); }

    /// Returns whether a triangle that a flip has made is allowed and not worse than the bound.
    bool is_good(const Tri& t, double ratio_bound) {
        const TriangleShape shape = shape_of(points_, t);
        return shape.area2 >= ratio_bound * shape.squared_sum() && is_allowed(t, shape);
    }

    /// Returns whether a triangle keeps its bounds, and none of its vertices is too near to a constrained edge.
    bool is_allowed(const Tri& t, const TriangleShape& shape) {
        const double at_least = least_share_ * (static_cast<double>(sizes_[t.v[0]]) + sizes_[t.v[1]] + sizes_[t.v[2]]);
        const auto is_within = [&](double sum) {
            return rules_.is_allowed(shape.squared[0], shape.squared[1], shape.squared[2], shape.area2, sum);
        };
        // A triangle that is allowed for the least sizes that its vertices may have is allowed for their sizes, too.
        return (is_within(at_least) || is_within(size_sum(t))) && !is_blocked(t);
    }

    /// Returns whether a vertex of the triangle stands too near to a constrained edge of it.
    bool is_blocked(const Tri& t) const {
        for (unsigned e = 0; e < 3; ++e) {
            if (!t.n[e].is_constrained()) continue;
            const Point p = points_[t.v[e]], a = points_[t.v[next(e)]] - p, b = points_[t.v[previous(e)]] - p;
            const double area2 = cross(a, b);
            if (rules_.is_blocked({t.v[next(e)], t.n[e], a.x, a.y, squared_length(a), area2},
                                  {t.v[previous(e)], t.n[e], b.x, b.y, squared_length(b), area2}))
                return true;
        }
        return false;
    }

    std::vector<Point>& points_;
    std::vector<float>& sizes_;
    Tris& tris_;
    Index first_movable_;
    Rules rules_;
    // These hold the facts about each vertex, where all move together:
    std::vector<Vertex> vertices_;
    std::vector<State> states_;
    std::vector<Point> old_points_;
    std::vector<float> old_sizes_;
    double least_share_ = 1;         ///< sizes at the places of vertices are at least this share of those held
    std::vector<Index> returned_;    ///< vertices
    std::vector<Index> ill_shaped_;  ///< triangles
    std::vector<Index> suspects_;    ///< triangles that were not clearly good, or have changed later
    std::vector<StarTriangle> star_;
    std::vector<QueuedEdge> pending_;
    std::vector<Flip> flips_;  ///< since the last vertex moved
};

}  // namespace lamina::delaunay
