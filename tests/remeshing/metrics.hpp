// Metrics that are given by formulas.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include <lamina/remesh.hpp>

#include "core/random.hpp"

namespace lamina::test {

using MetricFormula = std::function<MetricTensor(Point)>;

/// The metric that asks for the length `along` in a direction (a unit vector), and `across` perpendicular to it.
inline MetricTensor stretched(Point direction, double along, double across) {
    const double a = 1 / (along * along), b = 1 / (across * across);
    const Point d = direction;
    return {a * d.x * d.x + b * d.y * d.y, (a - b) * d.x * d.y, a * d.y * d.y + b * d.x * d.x};
}

inline std::vector<MetricTensor> at_vertices(const Mesh& mesh, const MetricFormula& formula) {
    std::vector<MetricTensor> result;
    for (const Point p : mesh.points) result.push_back(formula(p));
    return result;
}

/// Returns a random metric for a domain in and around the unit square: a shock, a circle, a layer at a line, sizes that
/// jump, sizes without direction, or directions that turn. `size` is about the length of edges far from what it
/// resolves.
inline MetricFormula random_metric(core::Random& random, double size) {
    const double angle = random.real(0, 6.28), thin = size * std::pow(10, random.real(-3, -0.5));
    const Point middle{random.real(0, 1), random.real(0, 1)}, normal{std::cos(angle), std::sin(angle)};
    const double radius = random.real(0.1, 0.6), growth = random.real(0.05, 0.6);
    const auto sized = [=](double distance) { return std::min(size, thin + growth * std::abs(distance)); };
    switch (random.below(6)) {
        case 0:
            return [=](Point p) { return stretched(perpendicular(normal), size, sized(dot(p - middle, normal))); };
        case 1:
            return [=](Point p) {
                const Point from = p - middle;
                const double r = length(from);
                return stretched(r > 0 ? (1 / r) * perpendicular(from) : Point{1, 0}, size, sized(r - radius));
            };
        case 2:
            return [=](Point p) { return stretched({1, 0}, 0.5 * size, sized(p.y)); };
        case 3:
            return [=](Point p) {
                return dot(p - middle, normal) > 0 ? stretched(normal, size, 0.1 * size)
                                                   : stretched({0, 1}, size, size);
            };
        case 4:
            return [=](Point p) {
                const double h = sized(length(p - middle));
                return stretched({1, 0}, std::max(h, 0.1 * size), std::max(h, 0.1 * size));
            };
        default:
            return [=](Point p) {
                const double turn = 4 * (p.x + p.y) + angle;
                return stretched({std::cos(turn), std::sin(turn)}, size, 0.15 * size);
            };
    }
}

}  // namespace lamina::test
