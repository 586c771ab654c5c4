#include "adaptation/wall_sizes.hpp"

#include <algorithm>
#include <cmath>

#include "core/reproducible_math.hpp"

namespace lamina::adaptation {

namespace {

using EdgeValues = std::vector<double>;

/// Returns a field at the middles of the edges of a wall: at the wall, or in the cells on it.
EdgeValues values_on(const WallFlow& wall, const SolutionField& field) {
    EdgeValues values;
    for (const WallFlowEdge& edge : wall)
        values.push_back(field.at_cells
                             ? field.values[edge.cell]
                             : 0.5 * (field.values[edge.ends.a.index()] + field.values[edge.ends.b.index()]));
    return values;
}

/// Returns the second derivatives of values along a wall: roots of mean squares over three edges. Edges at corners have that of
/// the edge beside them.
EdgeValues curvatures(const WallFlow& wall, const EdgeValues& values) {
    const std::size_t n = wall.size();
    const auto at = [&](std::size_t i, std::size_t shift) { return (i + n + shift) % n; };
    EdgeValues second(n, 0.0);
    for (std::size_t i = 0; i < n; ++i) {
        const std::size_t before = at(i, n - 1), after = at(i, 1);
        if (wall[i].at_corner) continue;
        const double back = 0.5 * (wall[before].length + wall[i].length),
                     ahead = 0.5 * (wall[i].length + wall[after].length);
        second[i] = 2 * ((values[after] - values[i]) / ahead - (values[i] - values[before]) / back) / (back + ahead);
    }
    EdgeValues mean(n, 0.0);
    for (std::size_t i = 0; i < n; ++i) {
        double squares = 0, lengths = 0;
        for (const std::size_t j : {at(i, n - 1), i, at(i, 1)}) {
            if (wall[j].at_corner) continue;
            squares += wall[j].length * second[j] * second[j];
            lengths += wall[j].length;
        }
        mean[i] = lengths > 0 ? std::sqrt(squares / lengths) : 0;
    }
    return mean;
}

/// Returns the spacing that this second derivative asks for with factor 1, to the power 5.
double spacing_to_the_fifth(const WallFlowEdge& edge, double curvature) {
    return edge.layers * 2 * equilateral_area * square_error_on_triangle /
           (2 * square_error_on_line * edge.layer_height * curvature * curvature);
}

/// Returns the number of edges that these second derivatives ask for with factor 1.
double edges_asked(const std::vector<WallFlow>& walls, const std::vector<EdgeValues>& curvature) {
    double edges = 0;
    for (std::size_t w = 0; w < walls.size(); ++w)
        for (std::size_t i = 0; i < walls[w].size(); ++i)
            if (curvature[w][i] > 0 && walls[w][i].layers > 0)
                edges += walls[w][i].length /
                         core::pow_reproducible(spacing_to_the_fifth(walls[w][i], curvature[w][i]), 0.2);
    return edges;
}

void raise(std::vector<EdgeValues>& values, const std::vector<EdgeValues>& others, double scale) {
    for (std::size_t w = 0; w < values.size(); ++w)
        for (std::size_t i = 0; i < values[w].size(); ++i) values[w][i] = std::max(values[w][i], scale * others[w][i]);
}

}  // namespace

WallSizes::WallSizes(const Solution& solution, std::vector<WallFlow> walls, std::span<const double> scales,
                     double max_change)
    : walls_(std::move(walls)), max_change_(max_change) {
    std::vector<EdgeValues> friction;
    for (const WallFlow& wall : walls_) {
        EdgeValues values;
        for (const WallFlowEdge& edge : wall) values.push_back(edge.friction);
        friction.push_back(curvatures(wall, values));
        curvature_.emplace_back(wall.size(), 0.0);
    }
    for (std::size_t f = 0; f < scales.size(); ++f) {
        std::vector<EdgeValues> of_field;
        for (const WallFlow& wall : walls_) of_field.push_back(curvatures(wall, values_on(wall, solution.fields[f])));
        raise(curvature_, of_field, scales[f]);
    }
    // Friction is no field of the region beyond: it gets as many edges as the fields do.
    const double by_fields = edges_asked(walls_, curvature_), by_friction = edges_asked(walls_, friction);
    if (by_friction > 0) raise(curvature_, friction, core::pow_reproducible(by_fields / by_friction, 2.5));
}

std::vector<SizedWall> WallSizes::with(double factor) const {
    const double scale = core::pow_reproducible(factor, 1.2);
    std::vector<SizedWall> result;
    for (std::size_t w = 0; w < walls_.size(); ++w) {
        SizedWall& wall = result.emplace_back();
        for (std::size_t i = 0; i < walls_[w].size(); ++i) {
            const WallFlowEdge& edge = walls_[w][i];
            double spacing = edge.length;
            if (edge.layers > 0)
                spacing = curvature_[w][i] > 0
                              ? scale * core::pow_reproducible(spacing_to_the_fifth(edge, curvature_[w][i]), 0.2)
                              : HUGE_VAL;
            wall.points.push_back(edge.at);
            wall.spacings.push_back(std::clamp(spacing, edge.length / max_change_, edge.length * max_change_));
            wall.units.push_back(edge.wall_unit);
            wall.thicknesses.push_back(edge.thickness);
        }
    }
    return result;
}

}  // namespace lamina::adaptation
