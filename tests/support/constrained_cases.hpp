// Points and segments that triangulation is both measured and validated on.
#pragma once

#include <cstddef>
#include <vector>

#include <lamina/triangulation.hpp>

#include "support/point_sets.hpp"

namespace lamina::test {

/// Points and segments between them that do not cross.
struct ConstrainedCase {
    std::vector<Point> points;
    std::vector<Segment> segments;
};
/// Returns random points and, as segments, one in `one_edge_in` of the edges of the Delaunay triangulation of these
/// points stretched by 16 in y (exactly). Most of them are no Delaunay edges of the points as they are.
inline ConstrainedCase stretched_edges_case(std::size_t points, std::size_t one_edge_in) {
    ConstrainedCase c{random_points(points, 11), {}};
    std::vector<Point> stretched = c.points;
    for (Point& p : stretched) p.y *= 16;
    std::size_t edge = 0;
    for (const Triangle& t : triangulate(stretched).triangles)
        for (int i = 0; i < 3; ++i) {
            const VertexId a = t.v[i], b = t.v[(i + 1) % 3];
            if (a < b && edge++ % one_edge_in == 0) c.segments.push_back({a, b});
        }
    return c;
}

}  // namespace lamina::test
