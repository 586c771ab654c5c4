// The whole way from a NACA name to a checked mesh, by threads; counters: triangles, and triangles a second.
#include <benchmark/benchmark.h>

#include <lamina/pipeline.hpp>

namespace lamina {
namespace {

void naca0012(benchmark::State& state) {
    CaseOptions options;
    options.layer.first_height = 2.5e-5;
    options.layer.growth = 1.15;
    options.layer.max_ray_angle_deg = 4;
    options.far_field = 50;
    options.threads = static_cast<unsigned>(state.range(0));
    std::size_t triangles = 0;
    for (auto _ : state) triangles = generate_mesh({"naca:0012"}, options).mesh.triangles.size();
    state.counters["triangles"] = static_cast<double>(triangles);
    state.counters["triangles/s"] =
        benchmark::Counter(static_cast<double>(triangles), benchmark::Counter::kIsIterationInvariantRate);
}
BENCHMARK(naca0012)->ArgName("threads")->Arg(1)->Arg(2)->Arg(4)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace lamina
