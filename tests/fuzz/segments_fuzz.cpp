// Inserts segments, which may not cross, and cuts holes. The triangulation must be valid.
#include <lamina/delaunay.hpp>
#include <lamina/error.hpp>

#include "fuzz/graphs.hpp"

void lamina::fuzz::fuzz(std::span<const std::uint8_t> input) {
    Numbers numbers(input);
    const Graph graph = read_graph(numbers, 60);
    ConstrainedOptions options;
    options.keep = static_cast<KeptRegion>(numbers.below(3));
    for (std::size_t i = numbers.below(3); i > 0; --i) {
        const double x = numbers.coordinate();
        options.holes.push_back({x, numbers.coordinate()});
    }
    try {
        const ConstrainedTriangulation t = triangulate(graph.points, graph.segments, options);
        require(check_triangulation(graph.points, t.triangles, t.segments).empty(), "the triangulation is not valid");
    } catch (const InputError&) {
    }
}
