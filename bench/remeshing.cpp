// Measures remeshing on the case of a layer at a line and an inclined shock, five passes from a coarse square: the time
// of each pass, and its ratio to a Delaunay triangulation of as many points as the result has. Whoever has mmg2d
// measures it beside with the same metric.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include <lamina/remesh.hpp>
#include <lamina/triangulation.hpp>

#include "paired.hpp"
#include "remeshing/metrics.hpp"
#include "support/sample_meshes.hpp"

namespace lamina::bench {
namespace {

MetricTensor layer_and_shock(Point p, double scale) {
    const double along = 0.02 * scale;
    MetricTensor m = test::stretched({1, 0}, along, scale * std::min(0.05, 2e-5 + 0.15 * p.y));
    const Point normal = unit(Point{1, -0.2});
    const double across = scale * std::min(0.02, 0.0005 + 0.15 * std::abs(dot(p - Point{0.5, 0}, normal)));
    const double more = std::max(1 / (across * across) - 1 / (along * along), 0.0);
    m.xx += more * normal.x * normal.x;
    m.xy += more * normal.x * normal.y;
    m.yy += more * normal.y * normal.y;
    return m;
}

/// Remeshes in as many passes as asked for, and times the last one.
void passes(benchmark::State& state) {
    const double scale = 1e-3 * static_cast<double>(state.range(0));
    const auto metric_of = [&](const Mesh& mesh) {
        return test::at_vertices(mesh, [&](Point p) { return layer_and_shock(p, scale); });
    };
    Mesh mesh = test::cut_square(40);
    for (int pass = 1; pass < state.range(1); ++pass)
        mesh = remesh(mesh, metric_of(mesh), {.divide_borders = true}).mesh;
    const std::vector<MetricTensor> metric = metric_of(mesh);
    const RemeshedMesh made = remesh(mesh, metric, {.divide_borders = true});
    measure(state, "triangles", [&] { return remesh(mesh, metric, {.divide_borders = true}).triangles; },
            {{"delaunay", [&] { return triangulate(made.mesh.points).triangles.size(); }}});
    state.counters["unit_edges"] = made.unit_edges;
    state.counters["mean_quality"] = made.mean_quality;
}
BENCHMARK(passes)
    ->ArgNames({"scale_1e-3", "pass"})
    ->ArgsProduct({{1000, 300}, {1, 2, 5}})
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace lamina::bench
