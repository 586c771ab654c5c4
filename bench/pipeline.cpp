// The time from a NACA name to a checked mesh.
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

#include <lamina/pipeline.hpp>

#include "decoupling/subdomain.hpp"
#include "layers/layer.hpp"
#include "paired.hpp"
#include "pipeline/derived_options.hpp"
#include "sizing/requests.hpp"
#include "thesis_case.hpp"

namespace lamina::bench {
namespace {

/// Measures the whole run with a gradation of 0.1. Argument: number of threads.
void naca0012(benchmark::State& state) {
    CaseOptions options = thesis_case(0.1);
    options.threads = static_cast<unsigned>(state.range(0));
    std::size_t triangles = 0;
    for (auto _ : state) triangles = generate_mesh({"naca:0012"}, options).mesh.triangles.size();
    state.counters["triangles"] = static_cast<double>(triangles);
    state.counters["triangles/s"] =
        benchmark::Counter(static_cast<double>(triangles), benchmark::Counter::kIsIterationInvariantRate);
}
BENCHMARK(naca0012)->ArgName("threads")->Arg(1)->Arg(2)->Arg(4)->Unit(benchmark::kMillisecond)->UseRealTime();

#ifdef LAMINA_BENCH_TRIANGLE
/// Returns the refinement, by Triangle, of the region between the layer and the far field, both divided as lamina
/// divides them.
Work triangle_outside_the_layer(const CaseOptions& options) {
    const std::vector<std::string> input{"naca:0012"};
    const layers::LayerGrowth growth = layers::layer_growth(options.layer, {});
    const Geometry geometry = surface::prepare_within(
        read_geometry(input), options.surface,
        pipeline::spacing_limits(options.layer, growth, pipeline::wall_gradation(options.sizing, 1), 1), {});
    const decoupling::FarField far_field = decoupling::place_far_field(bounding_box(geometry), 1, options.far_field);
    const layers::Layer layer = layers::make_layer(geometry, options.layer, growth,
                                                   pipeline::border_options(options.sizing, options.refine, 1, {}));
    const SizeField field = sizing::make_size_field(border_loops(layer), {}, options.sizing, 1, far_field.box());
    const decoupling::Decoupling outer = decoupling::decouple({layer.points, layer.borders, field, far_field});

    std::vector<Point> points;
    std::vector<VertexId> new_id(outer.points.size());
    std::vector<Segment> segments = outer.far_field;
    for (const auto& border : layer.borders)
        for (std::size_t i = 0; i < border.size(); ++i)
            segments.push_back({border[i], border[i + 1 < border.size() ? i + 1 : 0]});
    for (Segment& s : segments)
        for (VertexId* v : {&s.a, &s.b}) {
            VertexId& id = new_id[v->index()];
            if (!id.valid()) {
                id = VertexId{points.size()};
                points.push_back(outer.points[v->index()]);
            }
            *v = id;
        }
    return triangle_refine(points, segments, {0.5, 0}, field, options.refine.min_angle_deg);
}
#endif

/// Measures the whole run of lamina, layer and check included, on one thread, against Triangle, which meshes the region
/// outside the layer alone. Argument: gradation in units of 1e-5.
void whole_run(benchmark::State& state) {
    const CaseOptions options = thesis_case(1e-5 * static_cast<double>(state.range(0)));
    std::vector<Reference> references;
#ifdef LAMINA_BENCH_TRIANGLE
    references.push_back({"triangle", triangle_outside_the_layer(options)});
#endif
    measure(
        state, "triangles",
        [&] {
            const MeshResult result = generate_mesh({"naca:0012"}, options);
            state.counters["check_s"] = result.seconds.check;
            return result.mesh.triangles.size();
        },
        references);
}
BENCHMARK(whole_run)->Arg(597)->Arg(472)->Iterations(3)->UseManualTime()->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace lamina::bench
