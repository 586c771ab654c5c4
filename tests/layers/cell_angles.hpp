// Angles of the cells of a layer.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

#include "core/angles.hpp"
#include "layers/layer.hpp"

namespace lamina::test {

/// Returns the largest angle of a cell with these corners, in degrees.
inline double largest_angle_deg(const layers::Layer& layer, std::span<const VertexId> cell) {
    double largest = 0;
    for (std::size_t k = 0; k < cell.size(); ++k) {
        const auto at = [&](std::size_t i) { return layer.points[cell[i % cell.size()].index()]; };
        const Point u = at(k) - at(k + 1), v = at(k + 2) - at(k + 1);
        largest = std::max(largest, core::degrees(std::abs(std::atan2(cross(u, v), dot(u, v)))));
    }
    return largest;
}

}  // namespace lamina::test
