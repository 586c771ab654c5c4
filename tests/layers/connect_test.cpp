// The cells of the grid of rays and layers. They are positive, cover the layer exactly once, and lie row by row.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <set>

#include <lamina/predicates.hpp>

#include "core/angles.hpp"
#include "core/parallel.hpp"
#include "layers/cells/fill.hpp"
#include "layers/cells/polygon_cutter.hpp"
#include "layers/expect_cover.hpp"
#include "support/layers.hpp"
#include "support/shapes.hpp"

namespace lamina {
namespace {

using shapes::Outline;
using test::expect_cover;
using test::for_each_cell;
using test::topologies;

/// Expects all corners of each cell of layer n to lie on layers n - 1 and n; the tip above a divided step, one higher.
void expect_rows(const Layer& layer, const LayerCells& cells) {
    std::set<VertexId> tips;
    for (const auto& rays : layer.rays)
        for (const Ray& ray : rays) tips.insert(ray.tip());
    for_each_cell(cells, [&](const std::vector<VertexId>& cell, std::uint16_t n) {
        EXPECT_GE(n, 1);
        for (VertexId v : cell) {
            EXPECT_LE(layer.layer_of_point[v.index()], n + tips.count(v));
            EXPECT_GE(layer.layer_of_point[v.index()] + 1, n);
        }
    });
}

/// Returns the number of edges between tips that are divided. Division points come behind the points of the rays.
std::size_t divided_tops(const Layer& layer) {
    std::size_t ray_points = layer.wall_points, count = 0;
    for (const auto& rays : layer.rays)
        for (const Ray& ray : rays) ray_points += ray.layers;
    for (const auto& border : layer.borders)
        for (std::size_t k = 0; k < border.size(); ++k)
            count += border[k].index() < ray_points && border[(k + 1) % border.size()].index() >= ray_points;
    return count;
}

/// Expects each topology to cover the layer, and the grid to do so row by row.
void expect_connected(const Geometry& geometry, const LayerOptions& options) {
    const Layer layer = test::make_layer(geometry, options);
    ASSERT_EQ(check_layer(layer, options), std::vector<std::string>{});
    const LayerEdges edges = layer.edges;
    for (LayerTopology topology : topologies) {
        SCOPED_TRACE(static_cast<int>(topology));
        const LayerCells cells = fill_layer(layer, topology);
        expect_cover(layer, edges, cells);
        if (topology != LayerTopology::delaunay) expect_rows(layer, cells);
        if (topology != LayerTopology::quads) {
            EXPECT_TRUE(cells.quads.empty());
        }
    }
}
void expect_connected(const Outline& outline, const LayerOptions& options) {
    expect_connected(shapes::geometry({outline}), options);
}

// A point far beyond the neighbouring rays, as layers much thicker than the body once made them.
TEST(Connect, ALayerWhoseCellsWouldCrossIsTriangulated) {
    LayerOptions options;
    options.layers = 6;
    options.first_height = 1e-3;
    Layer layer = test::make_layer(shapes::geometry({shapes::section(0.12, 0, 60)}), options);
    const std::size_t i = layer.rays[0].size() / 4;
    const Ray &ray = layer.rays[0][i], &other = layer.rays[0][i + 3];
    ASSERT_GE(std::min(ray.layers, other.layers), 4u);
    Point& moved = layer.points[ray.vertex(2).index()];
    moved = midpoint(layer.points[other.vertex(2).index()], layer.points[other.vertex(3).index()]);
    for (LayerTopology topology : topologies) {
        const LayerCells cells = fill_layer(layer, topology);
        EXPECT_EQ(cells.grid_refused, topology != LayerTopology::delaunay);
        EXPECT_TRUE(cells.quads.empty());
        expect_cover(layer, layer.edges, cells);
    }
}

TEST(Connect, CoversTheLayerOfAnySection) {
    for (const Outline& outline :
         {shapes::section(0.12, 0, 60), shapes::section(0.12, 0.01, 60), shapes::joukowski(0.08, 0.15, 120),
          shapes::circle(0.5, 7), shapes::ellipse(1, 0.05, 90), shapes::plate(0.05, 16), shapes::wedge(),
          shapes::diamond(), shapes::box(), shapes::refined(shapes::l_shape(), 9),
          shapes::refined(shapes::v_notch(0.4), 12), shapes::refined(shapes::c_shape(0.02), 12),
          shapes::refined(shapes::comb(4, 0.1), 5)})
        for (CornerRays corners : {CornerRays::fan, CornerRays::refine})
            expect_connected(outline, test::thesis_layer(corners));
}

TEST(Connect, CoversTruncatedLayers) {
    std::mt19937 random(12);
    for (int k = 0; k < 120; ++k) {
        SCOPED_TRACE(k);
        const Outline outline =
            shapes::refined(shapes::star(3 + random() % 20, 0.05 + 0.009 * static_cast<double>(random() % 100), random),
                            1 + random() % 5);
        LayerOptions options = test::thesis_layer(random() % 2 == 0 ? CornerRays::fan : CornerRays::refine);
        options.first_height = std::pow(10, -5 + 0.04 * static_cast<double>(random() % 100));
        options.growth = 1.05 + 0.005 * static_cast<double>(random() % 100);
        options.layers = 1 + random() % 40;
        options.thickness = std::max(test::first_height(options), 0.5);
        options.max_ray_angle_deg = static_cast<double>(2 + random() % 20);
        expect_connected(outline, options);
        if (HasFailure()) break;
    }
}

TEST(Connect, CoversTheLayersOfSeveralBodies) {
    const Outline main = shapes::section(0.12, 0, 40);
    for (double gap : {0.1, 0.01, 1e-4}) {
        const Outline flap = shapes::moved(shapes::section(0.12, 0.01, 30), -0.5, 0.3, {1 + gap, -0.01});
        expect_connected(shapes::geometry({main, flap}), test::thesis_layer());
    }
}

TEST(Connect, MakesNothingWhereTheLayerIsDisabled) {
    LayerOptions options = test::thesis_layer();
    options.enabled = false;
    const Layer layer = test::make_layer(shapes::geometry({shapes::box()}), options);
    for (LayerTopology topology : topologies) {
        const LayerCells cells = fill_layer(layer, topology);
        EXPECT_TRUE(cells.triangles.empty() && cells.quads.empty());
    }
}

TEST(Connect, QuadsFillTheGridWhereTheBorderIsNotDivided) {
    const Layer layer = test::make_layer(shapes::geometry({shapes::circle(0.5, 100)}), test::thesis_layer());
    ASSERT_EQ(divided_tops(layer), 0u);
    const std::size_t columns = layer.rays[0].size();
    const LayerCells quads = layers::connect_layer(layer, layers::GridCells::whole),
                     split = layers::connect_layer(layer, layers::GridCells::split);
    EXPECT_EQ(quads.quads.size(), 30 * columns);
    EXPECT_TRUE(quads.triangles.empty());
    EXPECT_EQ(split.triangles.size(), 60 * columns);

    const Layer fans = test::make_layer(shapes::geometry({shapes::section(0.12, 0, 80)}), test::thesis_layer());
    std::size_t in_fans = 0;
    for (std::size_t i = 0; i + 1 < fans.rays[0].size(); ++i)
        in_fans += fans.rays[0][i].origin == fans.rays[0][i + 1].origin;
    const LayerCells cells = layers::connect_layer(fans, layers::GridCells::whole);
    EXPECT_EQ(static_cast<std::size_t>(std::count(cells.triangle_layer.begin(), cells.triangle_layer.end(), 1)),
              in_fans);
    EXPECT_EQ(cells.quads.size(), 30 * fans.rays[0].size() - in_fans - divided_tops(fans));
}

TEST(Connect, GentleCurvatureHasTheRowsOfTheDelaunayTriangulation) {
    LayerOptions options = test::thesis_layer();
    options.layers = 20;
    for (const Outline& outline : {shapes::circle(0.5, 300), shapes::ellipse(1, 0.6, 600)}) {
        const Layer layer = test::make_layer(shapes::geometry({outline}), options);
        ASSERT_EQ(divided_tops(layer), 0u);
        const LayerCells delaunay = fill_layer(layer, LayerTopology::delaunay);
        const LayerCells layered = layers::connect_layer(layer, layers::GridCells::split);
        expect_rows(layer, delaunay);
        auto a = delaunay.triangle_layer, b = layered.triangle_layer;
        std::sort(a.begin(), a.end());
        std::sort(b.begin(), b.end());
        EXPECT_EQ(a, b);
    }
}

/// Returns the largest angle of a triangle in radians.
double largest_angle(const Layer& layer, VertexId a, VertexId b, VertexId c) {
    const Point p[] = {layer.points[a.index()], layer.points[b.index()], layer.points[c.index()]};
    double max_angle = 0;
    for (int i = 0; i < 3; ++i) {
        const Point u = p[(i + 1) % 3] - p[i], v = p[(i + 2) % 3] - p[i];
        max_angle = std::max(max_angle, std::atan2(cross(u, v), dot(u, v)));
    }
    return max_angle;
}

/// Returns what a triangle adds to the sum by which cuts are chosen.
double burden(const Layer& layer, VertexId a, VertexId b, VertexId c) {
    return std::pow(1 + std::cos(largest_angle(layer, a, b, c)), -4);
}

TEST(Connect, TheOtherDiagonalIsNoBetter) {
    for (const Outline& outline : {shapes::joukowski(0.1, 0.3, 100), shapes::refined(shapes::c_shape(0.3), 11)}) {
        const Layer layer = test::make_layer(shapes::geometry({outline}), test::thesis_layer());
        const LayerCells split = layers::connect_layer(layer, layers::GridCells::split),
                         whole = layers::connect_layer(layer, layers::GridCells::whole);
        std::map<Segment, VertexId> opposite;
        for (const Triangle& t : split.triangles)
            for (int i = 0; i < 3; ++i) opposite[{t.v[i], t.v[(i + 1) % 3]}] = t.v[(i + 2) % 3];
        for (const Quad& q : whole.quads) {
            const auto [a, b, c, d] = q.v;
            const double ac = burden(layer, a, b, c) + burden(layer, a, c, d);
            const double bd = burden(layer, a, b, d) + burden(layer, b, c, d);
            const bool made_ac = opposite.at({a, b}) == c;
            EXPECT_EQ(opposite.at({c, d}) == a, made_ac);
            EXPECT_LT(made_ac ? ac : bd, (1 + 1e-4) * (made_ac ? bd : ac));
        }
    }
}

TEST(Connect, SymmetricSectionHasMirroredDiagonals) {
    const Layer layer = test::make_layer(shapes::geometry({shapes::section(0.12, 0, 70)}), test::thesis_layer());
    std::vector<Point> centers, mirrored;
    for (const Triangle& t : layers::connect_layer(layer, layers::GridCells::split).triangles) {
        Point sum;
        for (VertexId v : t.v) sum = sum + layer.points[v.index()];
        centers.push_back((1.0 / 3) * sum);
        mirrored.push_back({centers.back().x, -centers.back().y});
    }
    std::sort(mirrored.begin(), mirrored.end(), lexicographically_less);
    std::size_t without_image = 0;
    for (Point p : centers) {
        auto at =
            std::lower_bound(mirrored.begin(), mirrored.end(), Point{p.x - 1e-10, -HUGE_VAL}, lexicographically_less);
        const auto near = [&](Point q) { return std::abs(q.y - p.y) < 1e-10; };
        while (at != mirrored.end() && at->x < p.x + 1e-10 && !near(*at)) ++at;
        without_image += at == mirrored.end() || !near(*at);
    }
    EXPECT_LE(without_image, 60u);  // in a column on the axis, which is its own image, either diagonal may be taken
}

TEST(Connect, DoesNotDependOnThreads) {
    const Layer layer = test::make_layer(shapes::geometry({shapes::section(0.12, 0, 900), shapes::circle(0.1, 2000)}),
                                         test::thesis_layer());
    for (layers::GridCells form : {layers::GridCells::split, layers::GridCells::whole}) {
        LayerCells one;
        with_threads(1, [&] { one = layers::connect_layer(layer, form); });
        for (unsigned threads : {2u, 4u}) {
            with_threads(threads, [&] {
                const LayerCells many = layers::connect_layer(layer, form);
                EXPECT_EQ(many.triangles, one.triangles);
                EXPECT_TRUE(std::equal(many.quads.begin(), many.quads.end(), one.quads.begin(), one.quads.end(),
                                       [](const Quad& p, const Quad& q) { return std::equal(p.v, p.v + 4, q.v); }));
                EXPECT_EQ(many.triangle_layer, one.triangle_layer);
                EXPECT_EQ(many.quad_layer, one.quad_layer);
                EXPECT_EQ(many.triangle_column, one.triangle_column);
                EXPECT_EQ(many.quad_column, one.quad_column);
            });
        }
    }
}

/// A layer on two sides of a square wall. A ray of one layer stands on the fan at the corner (1, 1), beside bare rays,
/// which have no layers:
///
///    q--------p        q and p are tips of one layer; the border runs 0 - 1 - 2 - p - q - 0, and the tests
///     \       |        divide it
///      3------2        corner 2 of the wall has two rays, the first of them bare
///      |      |
///      0------1        corners 0 and 1 have bare rays
struct LayerAtCorner {
    Layer layer;
    VertexId p, q;
    LayerAtCorner() {
        layer.points = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
        layer.wall_points = 4;
        layer.walls = {{VertexId(0), VertexId(1), VertexId(2), VertexId(3)}};
        p = add({1, 1.2}, 1);
        q = add({-0.1, 1.2}, 1);
        const auto ray = [](std::size_t origin, Point direction, std::uint32_t layers, std::size_t first) {
            Ray made{};
            made.origin = VertexId(origin);
            made.direction = direction;
            made.layers = layers;
            made.first_point = first;
            return made;
        };
        layer.rays = {{ray(0, {-1, 0}, 0, 4), ray(1, {1, 0}, 0, 4), ray(2, {1, 0}, 0, 4), ray(2, {0, 1}, 1, p.index()),
                       ray(3, {0, 1}, 1, q.index())}};
        layer.borders = {{VertexId(0), VertexId(1), VertexId(2), p, q}};
    }
    VertexId add(Point at, std::uint16_t n) {
        layer.points.push_back(at);
        layer.layer_of_point.resize(layer.points.size(), 0);
        layer.layer_of_point.back() = n;
        return VertexId(layer.points.size() - 1);
    }
    /// Adds a division point to the border behind a vertex.
    void divide(VertexId after, Point at) {
        auto& border = layer.borders[0];
        border.insert(std::find(border.begin(), border.end(), after) + 1, add(at, after == p ? 1 : 0));
    }
    void expect_covered() const {
        Layer closed = layer;
        closed.edges = layer_edges(closed);
        const LayerEdges& edges = closed.edges;
        for (LayerTopology topology : {LayerTopology::layered, LayerTopology::quads}) {
            const LayerCells cells = fill_layer(closed, topology);
            expect_cover(closed, edges, cells);
            expect_rows(layer, cells);
        }
    }
};

TEST(Connect, BorderAlongARay) {
    LayerAtCorner corner;
    corner.expect_covered();
    corner.divide(VertexId(2), {1, 1.1});
    corner.expect_covered();
    corner.divide(VertexId(2), {1, 1.05});
    corner.divide(corner.p, {0.55, 1.2});
    corner.divide(corner.q, {-0.05, 0.6});  // towards the bare corner 0, a triangle has a divided top
    corner.expect_covered();
}

TEST(Connect, DividedStepsAreCutWithTheCellBelow) {
    // The rays of wall corners 1 and 3 have one layer, that of corner 2 between them two, and that of corner 0 none.
    Layer layer;
    layer.points = {{0, 0},      {1, 0},     {1, 1},     {0, 1},        // wall
                    {1.1, -0.1}, {1.1, 1.1}, {1.2, 1.2}, {-0.1, 1.1}};  // tip of 1, both points of 2, tip of 3
    layer.layer_of_point = {0, 0, 0, 0, 1, 1, 2, 1};
    layer.wall_points = 4;
    layer.walls = {{VertexId(0), VertexId(1), VertexId(2), VertexId(3)}};
    layer.rays.resize(1);
    const Point directions[] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
    const std::size_t first[] = {4, 4, 5, 7};
    for (std::size_t i = 0; i < 4; ++i) {
        Ray& ray = layer.rays[0].emplace_back();
        ray.origin = VertexId(i);
        ray.direction = unit(directions[i]);
        ray.layers = i == 2 ? 2 : i == 0 ? 0 : 1;
        ray.first_point = first[i];
    }
    layer.borders = {{VertexId(0)}};
    const auto divide = [&](std::size_t from, std::size_t to, int parts) {
        const Point a = layer.points[from], b = layer.points[to];
        layer.borders[0].push_back(VertexId(from));
        for (int k = 1; k < parts; ++k) {
            layer.borders[0].push_back(VertexId(layer.points.size()));
            layer.points.push_back(a + (static_cast<double>(k) / parts) * (b - a));
            layer.layer_of_point.push_back(1);
        }
    };
    divide(4, 6, 9);
    divide(6, 7, 9);
    layer.borders[0].push_back(VertexId(7));
    layer.edges = layer_edges(layer);

    // In a fan from one corner of the step alone, the last triangle would be the flattest.
    const double fan = std::max(largest_angle(layer, VertexId(5), VertexId(layer.points.size() - 1), VertexId(7)),
                                largest_angle(layer, VertexId(5), VertexId(4), VertexId(8)));
    for (LayerTopology topology : {LayerTopology::layered, LayerTopology::quads}) {
        const LayerCells cells = fill_layer(layer, topology);
        expect_cover(layer, layer.edges, cells);
        expect_rows(layer, cells);
        double max_angle = 0;
        for (const Triangle& t : cells.triangles)
            max_angle = std::max(max_angle, largest_angle(layer, t.v[0], t.v[1], t.v[2]));
        EXPECT_LT(max_angle, fan - 0.05);
    }
}

TEST(Connect, TopsThatNoFansFillAreTriangulated) {
    // The division points lie far from any line, as rounding would put them in cells that are a few roundings high.
    LayerAtCorner corner;
    corner.divide(corner.p, {0.2, 1.02});
    corner.divide(corner.p, {0.5, 1.19});
    corner.divide(corner.p, {0.8, 1.02});
    corner.expect_covered();
}

/// Returns the least sum of burdens of a triangulation of the polygon with these corners, by trying all of them.
double least_burden(const Layer& layer, const std::vector<VertexId>& corners) {
    if (corners.size() < 3) return 0;
    double least = HUGE_VAL;
    const VertexId first = corners.front(), last = corners.back();
    for (std::size_t k = 1; k + 1 < corners.size(); ++k) {
        const auto at = [&](VertexId v) { return layer.points[v.index()]; };
        if (!(orient2d(at(first), at(corners[k]), at(last)) > 0)) continue;
        const auto apex = corners.begin() + static_cast<std::ptrdiff_t>(k);
        least =
            std::min(least, burden(layer, first, corners[k], last) + least_burden(layer, {corners.begin(), apex + 1}) +
                                least_burden(layer, {apex, corners.end()}));
    }
    return least;
}

TEST(PolygonCutter, FindsTheBestTriangulation) {
    std::mt19937 random(7);
    for (int k = 0; k < 60; ++k) {
        SCOPED_TRACE(k);
        Layer polygon;
        polygon.points = shapes::star(3 + k % 6, 0.02 + 0.015 * k, random);
        std::vector<VertexId> corners;
        double inside = 0;
        for (std::size_t i = 0; i < polygon.points.size(); ++i) {
            corners.emplace_back(i);
            inside += cross(polygon.points[i], polygon.points[(i + 1) % polygon.points.size()]) / 2;
        }
        for (bool first_leads : {false, true}) {
            std::vector<Triangle> triangles;
            ASSERT_TRUE(layers::PolygonCutter(polygon.points).cut(corners, first_leads, triangles));
            EXPECT_EQ(triangles.size() + 2, corners.size());
            double sum = 0, area = 0;
            for (const Triangle& t : triangles) {
                const auto [a, b, c] = t.v;
                const Point p = polygon.points[a.index()], q = polygon.points[b.index()], r = polygon.points[c.index()];
                EXPECT_GT(orient2d(p, q, r), 0);
                sum += burden(polygon, a, b, c);
                area += cross(q - p, r - p) / 2;
            }
            EXPECT_NEAR(area, inside, 1e-12);
            EXPECT_NEAR(sum / least_burden(polygon, corners), 1, 1e-3);
        }
    }
}

TEST(PolygonCutter, TrianglesOfAStripJoinBothSides) {
    // A box with a triangle below it, which is one of the best triangulation, and has all its corners on one side.
    Layer strip;
    strip.points = {{0, 0}, {2, -1.9}, {4, 0}, {4, 8}, {0, 8}};
    std::vector<VertexId> corners;
    for (std::size_t i = 0; i < strip.points.size(); ++i) corners.emplace_back(i);
    const auto joins_both = [](const Triangle& t) {
        const auto is_below = [](VertexId v) { return v.index() < 3; };
        return std::any_of(std::begin(t.v), std::end(t.v), is_below) &&
               !std::all_of(std::begin(t.v), std::end(t.v), is_below);
    };
    const auto sum_of = [&](const std::vector<Triangle>& triangles) {
        double sum = 0;
        for (const Triangle& t : triangles) sum += burden(strip, t.v[0], t.v[1], t.v[2]);
        return sum;
    };
    for (bool first_leads : {false, true}) {
        std::vector<Triangle> best, joined;
        layers::PolygonCutter cutter(strip.points);
        ASSERT_TRUE(cutter.cut(corners, first_leads, best));
        ASSERT_TRUE(cutter.cut_strip(corners, 3, first_leads, joined));
        EXPECT_FALSE(std::all_of(best.begin(), best.end(), joins_both));
        EXPECT_TRUE(std::all_of(joined.begin(), joined.end(), joins_both));
        EXPECT_EQ(joined.size(), best.size());
        EXPECT_GT(sum_of(joined), sum_of(best));
    }
}

TEST(PolygonCutter, RefusesPolygonsThatRunBackwards) {
    const Outline box = shapes::box();
    std::vector<VertexId> corners;
    for (std::size_t i = box.size(); i-- > 0;) corners.emplace_back(i);
    std::vector<Triangle> triangles;
    EXPECT_FALSE(layers::PolygonCutter(box).cut(corners, true, triangles));
    EXPECT_TRUE(triangles.empty());
}

}  // namespace
}  // namespace lamina
