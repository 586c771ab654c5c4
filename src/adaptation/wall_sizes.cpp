#include "adaptation/wall_sizes.hpp"

#include <algorithm>
#include <cmath>

#include "adaptation/cell_gradients.hpp"
#include "core/reproducible_math.hpp"

namespace lamina::adaptation {

namespace {

/// Returns the roots of means over three edges.
EdgeValues roots_of_means(const WallFlow& wall, const EdgeValues& squares) {
    EdgeValues roots = means_of_three(wall, squares);
    for (double& root : roots) root = std::sqrt(root);
    return roots;
}

/// A field above the edges of a wall, in the cells of the layer.
class ColumnValues {
public:
    ColumnValues(const Mesh& mesh, const SolutionField& field) : values_(cell_values(mesh, field)) {}

    double in_cell(std::size_t cell) const { return values_[cell]; }
    /// Returns the value at this distance from the wall, linear between the middles of cells and constant beyond them.
    /// Middles rise from `row` on, which is moved to the last one below.
    double at_height(const WallFlowEdge& edge, double height, std::size_t& row) const {
        if (edge.column.empty()) return in_cell(edge.cell);
        while (row + 1 < edge.column.size() && edge.middle(row + 1) < height) ++row;
        const std::size_t above = std::min(row + 1, edge.column.size() - 1);
        const double low = edge.middle(row), high = edge.middle(above), below = in_cell(edge.column[row]);
        if (!(height > low && high > low)) return below;
        return below + std::min((height - low) / (high - low), 1.0) * (in_cell(edge.column[above]) - below);
    }

private:
    std::vector<double> values_;
};

/// Returns the second derivatives of a field along a wall, each the mean over the column of the edge in the p-norm: the
/// error of the column is that of a second derivative which is the same at all heights. They are roots of mean squares
/// over three edges, too.
EdgeValues column_curvatures(const WallFlow& wall, const ColumnValues& values, double p) {
    EdgeValues squares(wall.size(), 0.0);
    for (std::size_t i = 0; i < wall.size(); ++i) {
        const EdgesBeside beside(wall, i);
        const WallFlowEdge& edge = wall[i];
        double sum = 0, bottom = 0;
        std::size_t before = 0, after = 0;
        for (std::size_t row = 0; row < edge.column.size(); ++row) {
            const double height = edge.middle(row);
            const double second = beside.second_derivative(values.at_height(wall[beside.before], height, before),
                                                           values.in_cell(edge.column[row]),
                                                           values.at_height(wall[beside.after], height, after));
            if (second != 0) sum += (edge.tops[row] - bottom) * core::pow_reproducible(std::abs(second), p);
            bottom = edge.tops[row];
        }
        if (sum > 0) squares[i] = core::pow_reproducible(sum / bottom, 2 / p);
    }
    return roots_of_means(wall, squares);
}

/// Returns the second derivatives of values along a wall: roots of mean squares over three edges.
EdgeValues curvatures(const WallFlow& wall, const EdgeValues& values) {
    EdgeValues squares(wall.size(), 0.0);
    for (std::size_t i = 0; i < wall.size(); ++i) {
        const EdgesBeside beside(wall, i);
        const double second = beside.second_derivative(values[beside.before], values[i], values[beside.after]);
        squares[i] = second * second;
    }
    return roots_of_means(wall, squares);
}

/// Returns the spacing that this second derivative asks for with factor 1; it is infinite where there is no layer.
double spacing(const WallFlowEdge& edge, double curvature, const ErrorNorm& norm) {
    if (!(curvature > 0 && edge.layers > 0)) return HUGE_VAL;
    const double p = norm.power();
    const double triangles = edge.layers * 2 * equilateral_area * norm.power_on_triangle(),
                 column = 2 * norm.power_on_line() * edge.layer_height;
    return core::pow_reproducible(triangles / (column * core::pow_reproducible(curvature, p)), 1 / (2 * p + 1));
}

/// Returns the number of edges that these second derivatives ask for with factor 1.
double edges_asked(const std::vector<WallFlow>& walls, const std::vector<EdgeValues>& curvature,
                   const ErrorNorm& norm) {
    double edges = 0;
    for (std::size_t w = 0; w < walls.size(); ++w)
        for (std::size_t i = 0; i < walls[w].size(); ++i)
            edges += walls[w][i].length / spacing(walls[w][i], curvature[w][i], norm);
    return edges;
}

void raise(std::vector<EdgeValues>& values, const std::vector<EdgeValues>& others, double scale) {
    for (std::size_t w = 0; w < values.size(); ++w)
        for (std::size_t i = 0; i < values[w].size(); ++i) values[w][i] = std::max(values[w][i], scale * others[w][i]);
}

}  // namespace

EdgesBeside::EdgesBeside(const WallFlow& wall, std::size_t edge)
    : before((edge + wall.size() - 1) % wall.size()),
      after((edge + 1) % wall.size()),
      back_(0.5 * (wall[before].length + wall[edge].length)),
      ahead_(0.5 * (wall[edge].length + wall[after].length)) {}

double EdgesBeside::second_derivative(double at_before, double here, double at_after) const {
    return 2 * ((at_after - here) / ahead_ - (here - at_before) / back_) / (back_ + ahead_);
}

EdgeValues means_of_three(const WallFlow& wall, const EdgeValues& values) {
    EdgeValues means(wall.size(), 0.0);
    for (std::size_t i = 0; i < wall.size(); ++i) {
        const EdgesBeside beside(wall, i);
        double sum = 0, lengths = 0;
        for (const std::size_t j : {beside.before, i, beside.after}) {
            if (wall[j].at_corner) continue;
            sum += wall[j].length * values[j];
            lengths += wall[j].length;
        }
        means[i] = lengths > 0 ? sum / lengths : 0;
    }
    return means;
}

std::vector<EdgeValues> wall_curvatures(const Solution& solution, const std::vector<WallFlow>& walls,
                                        std::span<const double> scales, const ErrorNorm& norm) {
    std::vector<EdgeValues> curvature, friction;
    for (const WallFlow& wall : walls) {
        EdgeValues values(wall.size());
        std::transform(wall.begin(), wall.end(), values.begin(),
                       [](const WallFlowEdge& edge) { return edge.friction; });
        friction.push_back(curvatures(wall, values));
        curvature.emplace_back(wall.size(), 0.0);
    }
    for (std::size_t f = 0; f < scales.size(); ++f) {
        std::vector<EdgeValues> of_field;
        of_field.reserve(walls.size());
        const ColumnValues values(solution.mesh, solution.fields[f]);
        for (const WallFlow& wall : walls) of_field.push_back(column_curvatures(wall, values, norm.power()));
        raise(curvature, of_field, scales[f]);
    }
    const double by_fields = edges_asked(walls, curvature, norm), by_friction = edges_asked(walls, friction, norm);
    const double p = norm.power();
    if (by_friction > 0) raise(curvature, friction, core::pow_reproducible(by_fields / by_friction, (2 * p + 1) / p));
    return curvature;
}

WallSizes::WallSizes(std::vector<WallFlow> walls, std::vector<EdgeValues> curvatures, const ErrorNorm& norm,
                     double max_change)
    : walls_(std::move(walls)), of_factor_((2 * norm.power() + 2) / (2 * norm.power() + 1)), max_change_(max_change) {
    for (std::size_t w = 0; w < walls_.size(); ++w) {
        EdgeValues& spacings = spacing_.emplace_back();
        for (std::size_t i = 0; i < walls_[w].size(); ++i)
            spacings.push_back(spacing(walls_[w][i], curvatures[w][i], norm));
    }
}

std::vector<SizedWall> WallSizes::with(double factor) const {
    const double scale = core::pow_reproducible(factor, of_factor_);
    std::vector<SizedWall> result;
    for (std::size_t w = 0; w < walls_.size(); ++w) {
        SizedWall& wall = result.emplace_back();
        for (std::size_t i = 0; i < walls_[w].size(); ++i) {
            const WallFlowEdge& edge = walls_[w][i];
            const double asked = edge.layers > 0 ? scale * spacing_[w][i] : edge.length;
            wall.points.push_back(edge.at);
            wall.spacings.push_back(std::clamp(asked, edge.length / max_change_, edge.length * max_change_));
            wall.units.push_back(edge.wall_unit);
            wall.thicknesses.push_back(edge.thickness);
        }
    }
    return result;
}

}  // namespace lamina::adaptation
