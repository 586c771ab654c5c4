// Remeshing: valid meshes, borders and layers that stay, lengths and shapes as asked for.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <set>
#include <string>
#include <vector>

#include <lamina/error.hpp>
#include <lamina/pipeline.hpp>
#include <lamina/threads.hpp>

#include "remeshing/metrics.hpp"
#include "support/sample_meshes.hpp"
#include "support/shapes.hpp"

namespace lamina::test {
namespace {

using Coordinates = std::array<double, 4>;

Mesh airfoil_mesh(bool with_layer) {
    CaseOptions options;
    options.far_field.size = 3;
    options.layer.enabled = with_layer;
    options.layer.first_height = 1e-3;
    options.layer.layers = 8;
    return generate_mesh(shapes::geometry({naca_airfoil("0012", 60).points}), options).mesh;
}

std::set<Coordinates> edges_of(const Mesh& mesh, const Marker& marker) {
    std::set<Coordinates> result;
    for (const Segment& edge : marker.edges) {
        const Point a = mesh.points[edge.a.index()], b = mesh.points[edge.b.index()];
        result.insert({a.x, a.y, b.x, b.y});
    }
    return result;
}

/// Checks what holds for all results, and returns their check.
MeshCheck expect_sound(const Mesh& before, const RemeshedMesh& made, bool borders_stay) {
    MeshCheck check = check_mesh(made.mesh);
    const MeshCheck old = check_mesh(before);
    EXPECT_TRUE(check.valid()) << (check.defects.empty() ? "" : check.defects.front().description);
    EXPECT_NEAR(check.area, old.area, 1e-12 * old.area);
    EXPECT_EQ(check.euler_characteristic, old.euler_characteristic);
    EXPECT_EQ(made.metric.size(), made.mesh.points.size());
    EXPECT_EQ(made.mesh.markers.size(), before.markers.size());
    for (std::size_t m = 0; m < before.markers.size(); ++m) {
        EXPECT_EQ(made.mesh.markers[m].name, before.markers[m].name);
        if (borders_stay) {
            EXPECT_EQ(edges_of(made.mesh, made.mesh.markers[m]), edges_of(before, before.markers[m]));
        }
    }
    return check;
}

bool same_bytes(const Mesh& a, const Mesh& b) {
    return a.points == b.points && a.triangles == b.triangles && mesh_hash(a) == mesh_hash(b);
}

TEST(Remesh, RandomMetricsGiveValidMeshesThatAreTheSameEachTime) {
    const char* asked = std::getenv("LAMINA_METRICS");
    const std::size_t metrics = asked != nullptr ? std::stoul(asked) : 24;
    const std::vector<Mesh> meshes{cut_square(9),
                                   annulus({.around = 48, .rings = 8, .layer_rings = 3}),
                                   annulus({.layer_rings = 3, .quads_in_layer = true}),
                                   airfoil_mesh(false),
                                   airfoil_mesh(true),
                                   box_with_hole(5)};
    for (std::size_t i = 0; i < metrics; ++i) {
        SCOPED_TRACE(i);
        core::Random random(i);
        const Mesh& mesh = meshes[i % meshes.size()];
        const auto metric = at_vertices(mesh, random_metric(random, random.real(0.08, 0.3)));
        const RemeshOptions options{.divide_borders = random.below(2) == 0, .vertices = random.real(200, 1500)};
        const RemeshedMesh made = remesh(mesh, metric, options);
        expect_sound(mesh, made, !options.divide_borders);
        EXPECT_TRUE(same_bytes(remesh(mesh, metric, options).mesh, made.mesh));
    }
}

TEST(Remesh, EdgesHaveTheLengthsAskedFor) {
    const Mesh mesh = cut_square(20);
    const MetricFormula formulas[] = {
        [](Point) {
            return stretched({1, 0}, 0.03, 0.03);
        },
        [](Point) {
            return stretched({0.6, 0.8}, 0.1, 0.005);
        },
        [](Point p) {
            return stretched({1, 0}, 0.05, std::min(0.05, 1e-3 + 0.2 * p.y));
        },
        [](Point p) {
            return stretched({0.8, -0.6}, 0.05, std::min(0.05, 2e-3 + 0.2 * std::abs(p.x + p.y - 1)));
        }};
    for (const MetricFormula& formula : formulas) {
        // The second mesh has the metric where it is small; the first one only what the coarse mesh holds of it.
        const RemeshOptions options{.divide_borders = true};
        const RemeshedMesh first = remesh(mesh, at_vertices(mesh, formula), options);
        const RemeshedMesh made = remesh(first.mesh, at_vertices(first.mesh, formula), options);
        expect_sound(mesh, made, false);
        EXPECT_GT(made.unit_edges, 0.97);
        EXPECT_GT(made.mean_quality, 0.93);
    }
}

TEST(Remesh, AMeshThatFitsItsMetricHardlyChanges) {
    const Mesh mesh = cut_square(10);
    const auto formula = [](Point p) { return stretched({1, 0}, 0.05, 0.01 + 0.05 * p.x); };
    const RemeshOptions options{.divide_borders = true};
    Mesh made = remesh(mesh, at_vertices(mesh, formula), options).mesh;
    for (int i = 0; i < 2; ++i) made = remesh(made, at_vertices(made, formula), options).mesh;
    const Mesh again = remesh(made, at_vertices(made, formula), options).mesh;
    EXPECT_NEAR(static_cast<double>(again.triangles.size()), static_cast<double>(made.triangles.size()),
                0.01 * static_cast<double>(made.triangles.size()));
    std::set<std::pair<double, double>> places;
    for (const Point p : made.points) places.insert({p.x, p.y});
    std::size_t kept = 0;
    for (const Point p : again.points) kept += places.count({p.x, p.y});
    EXPECT_GT(static_cast<double>(kept), 0.9 * static_cast<double>(made.points.size()));
}

TEST(Remesh, LayersStay) {
    for (const bool quads : {false, true}) {
        const Mesh mesh = annulus({.around = 36, .rings = 9, .layer_rings = 3, .quads_in_layer = quads});
        const auto metric = at_vertices(mesh, [](Point) { return stretched({1, 0}, 0.1, 0.02); });
        const RemeshedMesh made = remesh(mesh, metric);
        expect_sound(mesh, made, true);
        const auto cells_of_layer = [](const Mesh& of) {
            std::multiset<std::array<double, 3>> cells;
            for (std::size_t cell = 0; cell < of.triangles.size() + of.quads.size(); ++cell) {
                if (of.region[cell] != Region::layer) continue;
                const VertexId* v =
                    cell < of.triangles.size() ? of.triangles[cell].v : of.quads[cell - of.triangles.size()].v;
                cells.insert(
                    {of.points[v[0].index()].x, of.points[v[1].index()].y, static_cast<double>(of.layer[cell])});
            }
            return cells;
        };
        EXPECT_EQ(cells_of_layer(made.mesh), cells_of_layer(mesh));
        EXPECT_EQ(made.mesh.constraints.size(), mesh.constraints.size());
        for (std::size_t v = 0; v < 36; ++v) EXPECT_EQ(made.mesh.points[v], mesh.points[v]);
    }
}

TEST(Remesh, TurnedMirroredAndScaledInputsGiveMeshesAsGood) {
    const Mesh mesh = cut_square(12);
    const auto metric = at_vertices(mesh, [](Point p) { return stretched({0.6, 0.8}, 0.1, 0.005 + 0.05 * p.x); });
    const RemeshedMesh plain = remesh(mesh, metric, {.divide_borders = true});
    for (const double scale : {1.0, 1e-9, 1e9}) {
        for (const bool mirrored : {false, true}) {
            Mesh moved = mesh;
            std::vector<MetricTensor> moved_metric = metric;
            const double c = 0.28 * scale, s = 0.96 * scale;
            for (Point& p : moved.points) {
                const double y = mirrored ? -p.y : p.y;
                p = {c * p.x - s * y, s * p.x + c * y};
            }
            for (MetricTensor& m : moved_metric) {
                const double xy = mirrored ? -m.xy : m.xy, k = 1 / (scale * scale * scale * scale);
                m = {k * (c * c * m.xx - 2 * c * s * xy + s * s * m.yy),
                     k * (c * s * (m.xx - m.yy) + (c * c - s * s) * xy),
                     k * (s * s * m.xx + 2 * c * s * xy + c * c * m.yy)};
            }
            if (mirrored) {
                for (Triangle& t : moved.triangles) std::swap(t.v[1], t.v[2]);
                for (Segment& edge : moved.markers[0].edges) std::swap(edge.a, edge.b);
            }
            const RemeshedMesh made = remesh(moved, moved_metric, {.divide_borders = true});
            expect_sound(moved, made, false);
            EXPECT_NEAR(made.mean_quality, plain.mean_quality, 0.01);
            EXPECT_NEAR(made.unit_edges, plain.unit_edges, 0.02);
            EXPECT_NEAR(static_cast<double>(made.triangles), static_cast<double>(plain.triangles),
                        0.06 * static_cast<double>(plain.triangles));
        }
    }
}

TEST(Remesh, TheMetricIsScaledGradedAndLimited) {
    const Mesh mesh = cut_square(20);
    const auto metric = at_vertices(mesh, [](Point p) { return stretched({1, 0}, 1, p.x < 0.5 ? 0.2 : 1e-3); });
    const RemeshedMesh scaled = remesh(mesh, metric, {.divide_borders = true, .vertices = 3000, .max_ratio = 5});
    EXPECT_NEAR(static_cast<double>(scaled.mesh.points.size()), 3000, 700);
    for (const MetricTensor& m : scaled.metric) {
        const double mean = 0.5 * (m.xx + m.yy), radius = std::hypot(0.5 * (m.xx - m.yy), m.xy);
        EXPECT_LE(mean + radius, 25.01 * (mean - radius));
    }
    const auto jump = at_vertices(mesh, [](Point p) { return stretched({1, 0}, 0.2, p.x < 0.5 ? 0.2 : 0.01); });
    const RemeshedMesh graded = remesh(mesh, jump, {.divide_borders = true, .gradation = 0.3});
    EXPECT_GT(graded.triangles, remesh(mesh, jump, {.divide_borders = true}).triangles);
    EXPECT_GT(graded.mean_quality, 0.9);
}

TEST(Remesh, MetricsThatAreNoneAreRefusedByPlace) {
    const Mesh mesh = cut_square(5);
    const std::vector<MetricTensor> good(mesh.points.size(), {100, 0, 100});
    EXPECT_THROW(remesh(mesh, std::span(good).first(3)), InputError);
    for (const MetricTensor bad : {MetricTensor{1, 2, 1}, MetricTensor{-1, 0, -1}, MetricTensor{NAN, 0, 1},
                                   MetricTensor{0, 0, 1}, MetricTensor{HUGE_VAL, 0, 1}}) {
        std::vector<MetricTensor> metric = good;
        metric[7] = bad;
        try {
            remesh(mesh, metric);
            ADD_FAILURE() << "no error";
        } catch (const InputError& error) {
            EXPECT_EQ(error.place().points, std::vector<std::size_t>{7});
        }
    }
    EXPECT_THROW(remesh(mesh, good, {.max_ratio = 0.5}), OptionError);
    EXPECT_THROW(remesh(mesh, good, {.vertices = 1e30}), OptionError);
    EXPECT_THROW(remesh(annulus({.rings = 3, .layer_rings = 3}), std::vector<MetricTensor>(96)), MeshError);
}

TEST(Remesh, LayersOfMeshesWithoutRegionsStay) {
    Mesh mesh = airfoil_mesh(true);
    std::set<Coordinates> thin;
    for (const Triangle& t : mesh.triangles) {
        const Region region = mesh.region[static_cast<std::size_t>(&t - mesh.triangles.data())];
        const Point a = mesh.points[t.v[0].index()], b = mesh.points[t.v[1].index()];
        // Cells with a ratio of 5 are those of the layer by their shape.
        const Point c = mesh.points[t.v[2].index()];
        const double longest = std::max({distance(a, b), distance(b, c), distance(c, a)});
        if (region == Region::layer && longest * longest > 10 * cross(b - a, c - a)) thin.insert({a.x, a.y, b.x, b.y});
    }
    mesh.region.clear();
    mesh.layer.clear();
    const RemeshedMesh made = remesh(mesh, std::vector<MetricTensor>(mesh.points.size(), MetricTensor{4, 0, 4}), {});
    EXPECT_TRUE(check_mesh(made.mesh).valid());
    std::set<Coordinates> kept;
    for (const Triangle& t : made.mesh.triangles) {
        const Point a = made.mesh.points[t.v[0].index()], b = made.mesh.points[t.v[1].index()];
        kept.insert({a.x, a.y, b.x, b.y});
    }
    ASSERT_GT(thin.size(), 100u);
    for (const Coordinates& edge : thin) EXPECT_EQ(kept.count(edge), 1u) << edge[0] << ' ' << edge[1];
}

TEST(Reconnect, MakesShearedTrianglesBetterAndKeepsVerticesAndLayer) {
    for (const bool with_layer : {true, false}) {
        const Mesh mesh = airfoil_mesh(with_layer);
        Mesh sheared = mesh;
        for (Point& p : sheared.points) p.x += 0.6 * p.y;
        const Mesh better = reconnect(sheared);
        EXPECT_TRUE(check_mesh(better).valid());
        ASSERT_EQ(better.points.size(), mesh.points.size());
        EXPECT_GT(check_mesh(better).isotropic.mean_min_angle_deg,
                  check_mesh(sheared).isotropic.mean_min_angle_deg + 2);
        std::vector<bool> stays(mesh.points.size(), false);
        for (const Marker& marker : mesh.markers)
            for (const Segment& edge : marker.edges) stays[edge.a.index()] = stays[edge.b.index()] = true;
        for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
            if (mesh.region[t] == Region::layer)
                for (const VertexId v : mesh.triangles[t].v) stays[v.index()] = true;
        for (std::size_t v = 0; v < stays.size(); ++v)
            if (stays[v]) {
                EXPECT_EQ(better.points[v], sheared.points[v]) << v;
            }
        EXPECT_EQ(better.markers.size(), mesh.markers.size());
        for (std::size_t m = 0; m < mesh.markers.size(); ++m)
            EXPECT_EQ(edges_of(better, better.markers[m]), edges_of(sheared, sheared.markers[m]));
    }
}

TEST(Reconnect, KeepsCellsThatAreNoTrianglesBeyondTheLayer) {
    const Mesh all_layer = annulus({.rings = 3, .layer_rings = 3});
    const Mesh kept = reconnect(all_layer);
    EXPECT_TRUE(same_bytes(kept, all_layer));
    EXPECT_EQ(kept.layer, all_layer.layer);

    Mesh quads = annulus({.layer_rings = 2, .quads_in_layer = true});
    const Mesh better = reconnect(quads);
    ASSERT_EQ(better.quads.size(), quads.quads.size());
    for (std::size_t q = 0; q < quads.quads.size(); ++q)
        EXPECT_TRUE(std::equal(std::begin(quads.quads[q].v), std::end(quads.quads[q].v), better.quads[q].v)) << q;
    EXPECT_EQ(better.constraints, quads.constraints);
    EXPECT_TRUE(check_mesh(better).valid());
    EXPECT_TRUE(same_bytes(reconnect(quads), better));
    quads.region.clear();
    const std::size_t cells = quads.triangles.size() + quads.quads.size();
    EXPECT_EQ(reconnect(quads).region.size(), cells);
}

TEST(Reconnect, OneVertexMovesToTheMiddle) {
    Mesh mesh{.points = {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0.9, 0.5}}};
    mesh.markers = {{"side", MarkerKind::far_field, {}}};
    for (const std::size_t i : {0, 1, 2, 3}) {
        const VertexId a{i}, b{(i + 1) % 4};
        mesh.triangles.push_back({{a, b, VertexId{4u}}});
        mesh.markers[0].edges.push_back({a, b});
    }
    mesh.region.assign(4, Region::isotropic);
    const Mesh better = reconnect(mesh);
    EXPECT_TRUE(check_mesh(better).valid());
    EXPECT_LT(distance(better.points[4], {0.5, 0.5}), 0.05);
}

/// Beside a border that stays, a metric that asks for edges 1e8 times as short is lowered, and stays one.
TEST(Remesh, ImmenseMetricsAtBordersStayPositive) {
    const Mesh mesh = airfoil_mesh(true);
    RemeshOptions options;
    options.vertices = 2'000;
    std::vector<MetricTensor> metric(mesh.points.size(), MetricTensor{1, 0, 1});
    for (const VertexId v : wall_vertices(mesh).vertex) metric[v.index()] = {1e20, 0, 1e20};
    const RemeshedMesh made = remesh(mesh, metric, options);
    EXPECT_TRUE(check_mesh(made.mesh).valid());
    for (const MetricTensor& m : made.metric) EXPECT_TRUE(m.xx > 0 && m.xx * m.yy - m.xy * m.xy > 0);
    EXPECT_TRUE(std::isfinite(made.mean_quality));
}

}  // namespace
}  // namespace lamina::test
