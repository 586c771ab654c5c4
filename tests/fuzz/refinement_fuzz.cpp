// Refines a constrained triangulation with random bounds. The result must be valid, and no angle may stay below the
// bound that is not exempt unless a point was refused.
#include <lamina/delaunay.hpp>
#include <lamina/error.hpp>

#include "fuzz/graphs.hpp"

void lamina::fuzz::fuzz(std::span<const std::uint8_t> input) {
    Numbers numbers(input);
    ConstrainedRefineOptions options;
    options.refine.min_angle_deg = numbers.real(0, max_min_angle_deg);
    options.refine.max_points = 20'000;
    options.refine.lattice = numbers.below(2) == 0;
    options.split_segments = numbers.below(4) != 0;
    if (!options.split_segments) options.refine.regularize = numbers.below(2) == 0;
    const SizeField size(numbers.real(0.1, 30));
    const Graph graph = read_graph(numbers, 24);
    try {
        const ConstrainedTriangulation coarse = triangulate(
            graph.points, graph.segments, {.keep = KeptRegion::inside_segments, .crossings = Crossings::insert});
        const ConstrainedRefinement fine = refine(graph.points, coarse, size, options);
        std::vector<Point> points = graph.points;
        points.insert(points.end(), fine.steiner_points.begin(), fine.steiner_points.end());
        require(check_triangulation(points, fine.triangles, fine.segments).empty(), "the refinement is not valid");
        require(fine.stats.refused > 0 || fine.stats.below_bound == fine.stats.exempt, "an angle is below the bound");
    } catch (const InputError&) {
    } catch (const MeshError&) {
    }
}
