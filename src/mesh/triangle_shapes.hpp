// The shapes of many triangles at a time, in vector registers where the processor has them.
#pragma once

#include <cstddef>
#include <span>

#include <lamina/ids.hpp>
#include <lamina/point.hpp>

#include "core/cell_shape.hpp"

namespace lamina::mesh {

/// The measures of up to `capacity` triangles: those of CellShape, in the same bits as core::measure_triangle() gives
/// them, and two signs with a margin for rounding.
struct TriangleShapes {
    static constexpr std::size_t capacity = 256;

    std::size_t size = 0;
    double area[capacity], min_angle_deg[capacity], max_angle_deg[capacity], aspect_ratio[capacity],
        mean_ratio[capacity];
    /// > 0 where the triangle is surely counter-clockwise; elsewhere orient2d() has to tell.
    double turn[capacity];
    /// > 0 where all three angles are surely acute, since the scalar products of edges exceed their rounding errors. No
    /// vertex lies in the circle of a triangle behind an edge with two acute angles opposite: they add up to less than
    /// 180 degrees.
    double acuteness[capacity];

    core::CellShape shape(std::size_t i) const {
        return {area[i], min_angle_deg[i], max_angle_deg[i], aspect_ratio[i], mean_ratio[i]};
    }
};

/// Measures at most TriangleShapes::capacity triangles. The bits of the result are the same on every processor.
void measure_triangles(const Point* points, std::span<const Triangle> triangles, TriangleShapes& shapes);

/// Sums and extremes of the measures of some triangles.
struct ShapeTotals {
    double area = 0, min_angle_sum = 0, max_angle_sum = 0, mean_ratio_sum = 0;
    double min_angle_deg = 180, max_angle_deg = 0, max_aspect_ratio = 0;
};

/// Adds them up in a fixed order.
ShapeTotals add_up(const TriangleShapes& shapes);

}  // namespace lamina::mesh
