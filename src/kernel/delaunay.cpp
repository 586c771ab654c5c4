// Plain Delaunay triangulation of large sets on several threads, exactly the sequential one.
//
// The points are cut into vertical strips, each triangulated alone. A triangle whose circle stays inside its strip
// holds no point of another one: it is final. Every other triangle of the whole joins vertices of triangles that are
// not final, because the star of a vertex all of whose triangles are final is complete. So the triangulation of those
// few vertices alone holds what is missing, and the edges of the final triangles bound it:
//
//      strip 1      |      strip 2
//      F  F  F  .  .|.  .  .  F  F       F: final triangles; dots: vertices of the others, triangulated together;
//      F  F  F  . . |  .  .  F  F  F     what lies between the two fronts of F is taken from there
//
// All triangulations obey the one tie rule, so their common edges agree (docs/decisions/0001).
#include <algorithm>
#include <cmath>

#include <lamina/error.hpp>

#include "core/parallel.hpp"
#include "kernel/triangulator.hpp"

namespace lamina {

namespace kernel {

namespace {

/// Strips depend on the number of points alone, so that the order of the triangles does, too.
constexpr std::size_t points_per_strip = 100'000;
constexpr std::size_t most_strips = 32;

struct Strip {
    std::vector<Index> points;
    double low = -HUGE_VAL, high = HUGE_VAL;  ///< no point of another strip lies strictly between
    // What its triangulation leaves behind, in numbers of the whole:
    std::vector<Triangle> triangles;  ///< final ones
    std::vector<Segment> front;       ///< their rim, the rest on the left
    std::vector<Index> loose;         ///< vertices of all other triangles
};

/// Strips of about the same number of points, cut between different x. Few or no points: fewer strips.
std::vector<Strip> cut_into_strips(std::span<const Point> points, std::size_t count) {
    // Cuts from a sample: every strip within a few percent of the mean.
    const std::size_t stride = std::max<std::size_t>(1, points.size() / (1000 * count));
    std::vector<double> sample;
    for (std::size_t i = 0; i < points.size(); i += stride) sample.push_back(points[i].x);
    std::sort(sample.begin(), sample.end());
    std::vector<double> cuts;
    for (std::size_t k = 1; k < count; ++k) cuts.push_back(sample[k * sample.size() / count]);
    cuts.erase(std::unique(cuts.begin(), cuts.end()), cuts.end());

    std::vector<Strip> strips(cuts.size() + 1);
    for (Strip& s : strips) s.points.reserve(points.size() / strips.size() + points.size() / (8 * strips.size()));
    for (Index i = 0; i < points.size(); ++i) {
        const auto strip = std::upper_bound(cuts.begin(), cuts.end(), points[i].x) - cuts.begin();
        strips[static_cast<std::size_t>(strip)].points.push_back(i);
    }
    // Points of the strip to the left lie below its low cut, those of the strip to the right on or above its high one.
    for (std::size_t k = 0; k < cuts.size(); ++k) strips[k].high = strips[k + 1].low = cuts[k];
    return strips;
}

/// Does the circle of a, b, c certainly lie between low and high in x? Rounding errors are allowed for generously.
bool circle_inside(Point a, Point b, Point c, double low, double high) {
    const Point u = b - a, v = c - a;
    const double uu = squared_length(u), vv = squared_length(v);
    const double left = u.x * v.y, right = u.y * v.x, twice = 2 * (left - right);
    // Below this the area, and with it the centre, has lost too many digits to say anything.
    if (!(std::abs(twice) > 1e-8 * (std::abs(left) + std::abs(right)))) return false;
    const double x = (v.y * uu - u.y * vv) / twice, y = (u.x * vv - v.x * uu) / twice;
    const double radius = std::sqrt(x * x + y * y);
    const double magnitude =
        ((std::abs(v.y) + std::abs(v.x)) * uu + (std::abs(u.y) + std::abs(u.x)) * vv) / std::abs(twice);
    const double margin = 1e-6 * magnitude + 1e-14 * std::abs(a.x);
    return a.x + x - radius - margin > low && a.x + x + radius + margin < high;
}

void triangulate_strip(std::span<const Point> points, Strip& strip) {
    std::vector<Point> own;
    own.reserve(strip.points.size());
    for (Index p : strip.points) own.push_back(points[p]);
    const Tris tris = triangulate_points(own);
    if (tris.empty()) {
        strip.loose = std::move(strip.points);
        return;
    }
    std::vector<char> is_final(tris.size(), 0), is_loose(own.size(), 0);
    for (Index t = 0; t < tris.size(); ++t) {
        const auto& v = tris[t].v;
        is_final[t] = !tris[t].is_ghost() && circle_inside(own[v[0]], own[v[1]], own[v[2]], strip.low, strip.high);
        if (!is_final[t])
            for (Index i : v)
                if (i != ghost_vertex) is_loose[i] = 1;
    }
    const auto global = [&](Index i) { return VertexId{std::size_t{strip.points[i]}}; };
    strip.triangles.reserve(tris.size());
    for (Index t = 0; t < tris.size(); ++t) {
        if (!is_final[t]) continue;
        const Tri& tri = tris[t];
        strip.triangles.push_back({{global(tri.v[0]), global(tri.v[1]), global(tri.v[2])}});
        for (unsigned e = 0; e < 3; ++e)
            if (!is_final[tri.n[e].triangle()])
                strip.front.push_back({global(tri.v[previous(e)]), global(tri.v[next(e)])});
    }
    for (Index i = 0; i < own.size(); ++i)
        if (is_loose[i]) strip.loose.push_back(strip.points[i]);
    strip.points = {};
}

/// What lies between the fronts of final triangles.
std::vector<Triangle> triangulate_between(std::span<const Point> points, std::span<const Strip> strips) {
    std::vector<Index> loose;
    for (const Strip& s : strips) loose.insert(loose.end(), s.loose.begin(), s.loose.end());
    std::vector<Point> own;
    own.reserve(loose.size());
    for (Index p : loose) own.push_back(points[p]);
    Tris tris = triangulate_points(own);

    std::vector<Segment> front;
    std::vector<Index> place(points.size(), no_index);
    for (Index i = 0; i < loose.size(); ++i) place[loose[i]] = i;
    const auto local = [&](VertexId v) { return VertexId{std::size_t{place[v.index()]}}; };
    for (const Strip& s : strips)
        for (const Segment& e : s.front) front.push_back({local(e.a), local(e.b)});
    if (!front.empty()) {
        insert_segments(own, front, tris);
        tris = keep_left_of_segments(front, tris, own.size());
    }
    std::vector<Triangle> triangles = without_ghosts(tris).triangles;
    for (Triangle& t : triangles)
        for (VertexId& v : t.v) v = VertexId{std::size_t{loose[v.index()]}};
    return triangles;
}

}  // namespace

}  // namespace kernel

Triangulation delaunay(std::span<const Point> points) {
    using namespace kernel;
    const std::size_t count = std::min(points.size() / points_per_strip, most_strips);
    const bool finite = std::all_of(points.begin(), points.end(), [](Point p) { return std::isfinite(p.x); });
    if (count < 2 || !finite) return without_ghosts(triangulate_points(points));

    std::vector<Strip> strips = cut_into_strips(points, count);
    try {
        parallel_for(strips.size(), 1, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) triangulate_strip(points, strips[i]);
        });
    } catch (const InputError&) {
        // Duplicates or coordinates out of range: named by their numbers in the strip. The whole set names them right.
        return without_ghosts(triangulate_points(points));
    }
    strips.push_back({});
    strips.back().triangles = triangulate_between(points, std::span(strips).first(strips.size() - 1));

    Triangulation result;
    std::size_t total = 0;
    for (const Strip& s : strips) total += s.triangles.size();
    result.triangles.reserve(total);
    for (Strip& s : strips) {
        result.triangles.insert(result.triangles.end(), s.triangles.begin(), s.triangles.end());
        s = {};
    }
    return result;
}

}  // namespace lamina
