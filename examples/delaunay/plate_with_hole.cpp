// A square plate with a square hole and a slit, meshed with the triangulation alone.
#include <cstddef>
#include <exception>
#include <iostream>
#include <vector>

#include <lamina/delaunay.hpp>

int main() try {
    using namespace lamina;
    const std::vector<Point> points{{0, 0},   {4, 0},  {4, 4}, {0, 4},  // plate
                                    {1, 1},   {2, 1},  {2, 2}, {1, 2},  // hole
                                    {2.5, 3}, {3.5, 3}};                // slit
    std::vector<Segment> segments{{VertexId{8u}, VertexId{9u}}};
    for (std::size_t loop : {0, 4})
        for (std::size_t i = 0; i < 4; ++i) segments.push_back({VertexId{loop + i}, VertexId{loop + (i + 1) % 4}});

    const ConstrainedTriangulation coarse =
        triangulate(points, segments, {.keep = KeptRegion::inside_segments, .holes = {{1.5, 1.5}}});
    const ConstrainedRefinement fine = refine(points, coarse, SizeField(0.2), {.refine = {.min_angle_deg = 28}});

    std::vector<Point> all = points;
    all.insert(all.end(), fine.steiner_points.begin(), fine.steiner_points.end());
    for (const std::string& defect : check_triangulation(all, fine.triangles, fine.segments))
        std::cout << defect << '\n';
    std::cout << coarse.triangles.size() << " triangles, refined to " << fine.triangles.size() << "; "
              << fine.stats.below_bound << " under 28 degrees\n";
    return 0;
} catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 1;
}
