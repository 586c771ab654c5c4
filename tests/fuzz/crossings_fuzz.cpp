// Inserts segments that cross. The triangulation must be valid.
#include <lamina/delaunay.hpp>
#include <lamina/error.hpp>

#include "fuzz/graphs.hpp"

void lamina::fuzz::fuzz(std::span<const std::uint8_t> input) {
    Numbers numbers(input);
    const Graph graph = read_graph(numbers, 40);
    try {
        const ConstrainedTriangulation t = triangulate(graph.points, graph.segments, {.crossings = Crossings::insert});
        std::vector<Point> points = graph.points;
        points.insert(points.end(), t.steiner_points.begin(), t.steiner_points.end());
        require(check_triangulation(points, t.triangles, t.segments).empty(), "the triangulation is not valid");
    } catch (const InputError&) {
    }
}
