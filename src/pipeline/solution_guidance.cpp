#include "pipeline/solution_guidance.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <variant>

#include "core/segments.hpp"

namespace lamina::pipeline {

namespace {

/// Returns the element whose outline a wall follows: the nearest one to its first point, but no farther away than the
/// next point; nothing for walls of the domain.
std::optional<std::size_t> element_of(const SizedWall& wall, const Geometry& geometry) {
    const Point p = wall.points[0];
    std::optional<std::size_t> nearest;
    double least = distance(p, wall.points[1]);
    for (std::size_t e = 0; e < geometry.elements.size(); ++e) {
        const std::vector<Point>& outline = geometry.elements[e].points;
        for (std::size_t i = 0; i < outline.size(); ++i) {
            const double away = core::distance_to_segment(p, outline[i], outline[(i + 1) % outline.size()]);
            if (!(away < least)) continue;
            least = away;
            nearest = e;
        }
    }
    return nearest;
}

/// Returns the length at which y+ is 1, at each point. Where friction is below a tenth of its mean, as round stagnation
/// points, it is that of a tenth: the friction goes with the square of 1 / length.
std::vector<double> bounded_units(const std::vector<double>& units) {
    constexpr double least_friction = 0.1;
    double friction = 0;
    for (const double unit : units) friction += 1 / (unit * unit * static_cast<double>(units.size()));
    const double longest = 1 / std::sqrt(least_friction * friction);
    std::vector<double> bounded = units;
    for (double& unit : bounded) unit = std::min(unit, longest);
    return bounded;
}

/// Gives the growth of layers the first heights of y+ on the wall of an element, and the heights of its boundary layer.
void set_heights(std::size_t element, const SizedWall& wall, const LayerOptions& options, layers::LayerGrowth& growth) {
    for (std::size_t i = 0; i < wall.points.size(); ++i)
        growth.least_heights.push_back({element, wall.points[i], wall.thicknesses[i]});
    const auto* y_plus = std::get_if<YPlus>(&options.first_height);
    if (!y_plus) return;
    const std::vector<double> units = bounded_units(wall.units);
    for (std::size_t i = 0; i < wall.points.size(); ++i)
        growth.wall_first_heights.push_back({element, wall.points[i], y_plus->y_plus * units[i]});
    growth.first_heights[element] = y_plus->y_plus * *std::min_element(units.begin(), units.end());
}

}  // namespace

std::vector<geometry::WallSpacing> guide_by_solution(const std::vector<SizedWall>& walls, const Geometry& geometry,
                                                     const LayerOptions& options, const ReferenceConditions& conditions,
                                                     layers::LayerGrowth& growth) {
    std::vector<geometry::WallSpacing> spacings;
    if (options.enabled) {
        growth.first_heights.resize(geometry.elements.size(), growth.first_height);
        growth.least_heights.clear();
    }
    for (const SizedWall& wall : walls) {
        const std::optional<std::size_t> element = element_of(wall, geometry);
        if (!element) continue;
        for (std::size_t i = 0; i < wall.points.size(); ++i) {
            const std::size_t next = (i + 1) % wall.points.size();
            spacings.push_back(
                {*element, wall.points[i], wall.points[next], 0.5 * (wall.spacings[i] + wall.spacings[next])});
        }
        if (options.enabled) set_heights(*element, wall, options, growth);
    }
    growth.first_heights = layers::layer_growth(options, conditions, std::move(growth.first_heights)).first_heights;
    return spacings;
}

}  // namespace lamina::pipeline
