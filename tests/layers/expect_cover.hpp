// Cells that cover a layer once.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include <lamina/layers.hpp>
#include <lamina/predicates.hpp>

#include "layers/layer.hpp"

namespace lamina::test {

inline constexpr LayerTopology topologies[] = {LayerTopology::delaunay, LayerTopology::layered, LayerTopology::quads};

/// Calls f(corners, layer) for each cell: triangles, then quads.
template <class F>
void for_each_cell(const layers::LayerCells& cells, F&& f) {
    ASSERT_EQ(cells.triangles.size(), cells.triangle_layer.size());
    ASSERT_EQ(cells.quads.size(), cells.quad_layer.size());
    for (std::size_t t = 0; t < cells.triangles.size(); ++t)
        f(std::vector<VertexId>(cells.triangles[t].v, cells.triangles[t].v + 3), cells.triangle_layer[t]);
    for (std::size_t q = 0; q < cells.quads.size(); ++q)
        f(std::vector<VertexId>(cells.quads[q].v, cells.quads[q].v + 4), cells.quad_layer[q]);
}

/// Returns whether every corner of a cell turns to the left. Exact.
inline bool strictly_convex(const layers::Layer& layer, const std::vector<VertexId>& cell) {
    const std::size_t n = cell.size();
    for (std::size_t i = 0; i < n; ++i)
        if (!(orient2d(layer.points[cell[i].index()], layer.points[cell[(i + 1) % n].index()],
                       layer.points[cell[(i + 2) % n].index()]) > 0))
            return false;
    return true;
}

inline double doubled_area(const layers::Layer& layer, const std::vector<VertexId>& cell) {
    double area = 0;
    const Point origin = layer.points[cell[0].index()];
    for (std::size_t i = 1; i + 1 < cell.size(); ++i)
        area += cross(layer.points[cell[i].index()] - origin, layer.points[cell[i + 1].index()] - origin);
    return area;
}

/// Expects cells that cover the layer once: they are convex, positive and numbered from 1 on; each directed edge is
/// used once, and those without a twin are the edges that bound the layer; all points are used, except wall vertices
/// beside which there is no layer; area and Euler characteristic are right.
inline void expect_cover(const layers::Layer& layer, const layers::LayerEdges& edges, const layers::LayerCells& cells) {
    std::set<Segment> directed;
    std::set<VertexId> used;
    std::size_t count = 0;
    double area = 0;
    for_each_cell(cells, [&](const std::vector<VertexId>& cell, std::uint16_t number) {
        ++count;
        EXPECT_GE(number, 1u) << "cells outside of the layer have 0";
        EXPECT_TRUE(strictly_convex(layer, cell));
        area += doubled_area(layer, cell);
        for (std::size_t i = 0; i < cell.size(); ++i) {
            EXPECT_TRUE(directed.insert({cell[i], cell[(i + 1) % cell.size()]}).second) << "edge used twice";
            used.insert(cell[i]);
        }
    });
    std::set<Segment> boundary;
    for (const Segment& e : directed)
        if (!directed.contains({e.b, e.a})) boundary.insert(e);
    EXPECT_EQ(boundary, std::set<Segment>(edges.region.begin(), edges.region.end()));

    std::set<VertexId> expected;
    for (std::size_t v = layer.wall_points; v < layer.points.size(); ++v) expected.insert(VertexId(v));
    for (const Segment& e : edges.region) expected.insert({e.a, e.b});
    EXPECT_EQ(used, expected);

    double enclosed = 0, magnitude = 0;
    for (const Segment& e : edges.region) {
        enclosed += cross(layer.points[e.a.index()], layer.points[e.b.index()]);
        magnitude += std::abs(cross(layer.points[e.a.index()], layer.points[e.b.index()]));
    }
    EXPECT_NEAR(area, enclosed, 1e-13 * magnitude);
    // V - E + F is that of the region, whatever the topology.
    const std::size_t undirected = (directed.size() + boundary.size()) / 2;
    const layers::LayerCells delaunay = fill_layer(layer, LayerTopology::delaunay);
    const std::size_t delaunay_edges = (3 * delaunay.triangles.size() + boundary.size()) / 2;
    EXPECT_EQ(count + delaunay_edges, delaunay.triangles.size() + undirected);
}

}  // namespace lamina::test
