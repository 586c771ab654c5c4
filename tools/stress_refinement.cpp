// Refines random constrained triangulations and judges each of them.
//
//   lamina_stress_refinement COUNT [FIRST]     inputs FIRST .. FIRST + COUNT - 1
//
// Inputs are squares with isolated vertices, dangling segments, slits, fans and stars (planar_graphs.hpp). The angle
// bound is 20 to 33 degrees, the area bound random or missing, and lattices are on. Every refinement must be valid and
// constrained Delaunay, and may leave no angle below the bound that is not exempt and no triangle too large. The exit
// status is 1 where anything else happened.
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <ctime>
#include <exception>
#include <map>
#include <string>

#include <fmt/core.h>

#include <lamina/delaunay.hpp>

#include "core/random.hpp"
#include "support/planar_graphs.hpp"

namespace lamina {
namespace {

/// Returns what is wrong with the refinement of an input; an empty text if nothing is.
std::string judge(const test::PlanarGraph& graph, const SizeField& size, double min_angle_deg) {
    const ConstrainedTriangulation coarse =
        triangulate(graph.points, graph.segments, {.keep = KeptRegion::inside_segments});
    const ConstrainedRefinement fine = refine(graph.points, coarse, size, {.refine = {.min_angle_deg = min_angle_deg}});
    std::vector<Point> points = graph.points;
    points.insert(points.end(), fine.steiner_points.begin(), fine.steiner_points.end());
    if (const auto defects = check_triangulation(points, fine.triangles, fine.segments); !defects.empty())
        return defects.front();
    if (fine.stats.below_bound > fine.stats.exempt)
        return fmt::format("{} angles below {}, {} of them exempt", fine.stats.below_bound, min_angle_deg,
                           fine.stats.exempt);
    return fine.stats.oversized > 0 ? fmt::format("{} triangles too large", fine.stats.oversized) : "";
}

/// Judges an input and prints what is wrong with it. Returns whether nothing is.
bool passes(std::uint64_t seed, std::map<std::string, int>& kinds) {
    core::Random random(seed);
    constexpr std::array angles{20.0, 20.7, 25.0, 28.0, 30.0, 33.0};
    const double min_angle_deg = angles[random.below(angles.size())];
    const double h = random.below(3) == 0 ? 100.0 : 0.03 * std::pow(30.0, random.real());
    const test::RandomGraph input = test::random_planar_graph(random.bits());
    ++kinds[input.kind];
    std::string fault;
    const std::clock_t start = std::clock();
    try {
        fault = judge(input.graph, SizeField(h), min_angle_deg);
    } catch (const std::exception& error) {
        fault = error.what();
    }
    const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    if (fault.empty() && seconds > 20) fault = fmt::format("took {:.0f} s of processor time", seconds);
    if (!fault.empty()) fmt::print("{} ({}, {} degrees, h {:.4g}): {}\n", seed, input.kind, min_angle_deg, h, fault);
    return fault.empty();
}

int run(std::uint64_t count, std::uint64_t first) {
    std::map<std::string, int> kinds;
    std::uint64_t failures = 0;
    for (std::uint64_t i = 0; i < count; ++i) failures += passes(first + i, kinds) ? 0 : 1;
    for (const auto& [kind, n] : kinds) fmt::print("{:6} {}\n", n, kind);
    fmt::print("{:6} failures\n", failures);
    return failures > 0 ? 1 : 0;
}

}  // namespace
}  // namespace lamina

int main(int argc, char** argv) {
    std::uint64_t values[] = {0, 0};
    for (int i = 1; i < argc && i <= 2; ++i) std::from_chars(argv[i], argv[i] + std::strlen(argv[i]), values[i - 1]);
    if (argc < 2 || values[0] == 0) {
        fmt::print(stderr, "usage: lamina_stress_refinement COUNT [FIRST]\n");
        return 2;
    }
    return lamina::run(values[0], values[1]);
}
