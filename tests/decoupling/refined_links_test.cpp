// refine_linked(): the neighbours that refinement hands over are those that a map of all edges finds, with and without
// lattices.
#include <gtest/gtest.h>

#include <map>
#include <vector>

#include <lamina/delaunay.hpp>

#include "core/edge_links.hpp"
#include "delaunay/refine/refine_region.hpp"

namespace lamina {
namespace {

/// Returns the border of a square with a line that dangles from one side. The triangles on both sides of the line are
/// neighbours.
std::vector<Point> border_points(std::size_t n) {
    std::vector<Point> points;
    const double length = static_cast<double>(n);
    for (std::size_t i = 0; i < n; ++i) points.push_back({static_cast<double>(i), 0});
    for (std::size_t i = 0; i < n; ++i) points.push_back({length, static_cast<double>(i)});
    for (std::size_t i = 0; i < n; ++i) points.push_back({length - static_cast<double>(i), length});
    for (std::size_t i = 0; i < n; ++i) points.push_back({0, length - static_cast<double>(i)});
    for (std::size_t i = 1; i < n / 3; ++i) points.push_back({static_cast<double>(n / 2), static_cast<double>(i)});
    return points;
}

TEST(RefinedLinks, AreThoseOfAMapOfEdges) {
    const std::size_t n = 60;
    const std::vector<Point> points = border_points(n);
    std::vector<Segment> segments;
    for (std::size_t i = 0; i < 4 * n; ++i) segments.push_back({VertexId{i}, VertexId{(i + 1) % (4 * n)}});
    VertexId before{n / 2};
    for (std::size_t i = 4 * n; i < points.size(); ++i) {
        segments.push_back({before, VertexId{i}});
        segments.push_back({VertexId{i}, before});
        before = VertexId{i};
    }
    for (const bool lattice : {true, false}) {
        RefineOptions options;
        options.lattice = lattice;
        const delaunay::LinkedRefinement linked = delaunay::refine_linked(points, segments, SizeField(1.0), options);
        const std::vector<Triangle>& triangles = linked.refinement.triangles;
        EXPECT_EQ(triangles, refine(points, segments, SizeField(1.0), options).triangles);
        ASSERT_GT(triangles.size(), n * n);
        ASSERT_EQ(linked.links.size(), 3 * triangles.size());
        std::map<Segment, core::EdgeLink> edges;
        for (std::size_t t = 0; t < triangles.size(); ++t)
            for (unsigned i = 0; i < 3; ++i)
                edges[{triangles[t].v[i], triangles[t].v[(i + 1) % 3]}] = core::edge_link(t, i);
        for (const auto& [ends, edge] : edges) {
            const auto twin = edges.find({ends.b, ends.a});
            EXPECT_EQ(linked.links[3 * core::triangle_of(edge) + core::edge_of(edge)],
                      twin != edges.end() ? twin->second : core::no_link);
        }
    }
}

}  // namespace
}  // namespace lamina
