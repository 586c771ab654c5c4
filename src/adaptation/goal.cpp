#include "adaptation/goal.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include <lamina/error.hpp>

#include "adaptation/cell_gradients.hpp"
#include "adaptation/vertex_patches.hpp"

namespace lamina::adaptation {

namespace {

/// The fields of a solution and of its adjoint.
struct FlowAndAdjoint {
    const SolutionField &u, &v, &p;
    const SolutionField &adjoint_u, &adjoint_v, &adjoint_p;
};

FlowAndAdjoint fields_of(const Solution& solution, const GoalOptions& options) {
    const std::vector<std::string> names = options.fields();
    const auto field = [&](std::size_t i) -> const SolutionField& { return field_named(solution, names[i], "goal"); };
    const FlowAndAdjoint fields{field(0), field(1), field(2), field(3), field(4), field(5)};
    for (std::size_t i = 0; i < names.size(); ++i) {
        require_fitting(solution.mesh, field(i));
        if (field(i).at_cells != fields.u.at_cells)
            throw OptionError("goal", "needs flow and adjoint at the same places");
    }
    return fields;
}

/// One equation: the fluxes in x and in y, and the adjoint.
struct Equation {
    SolutionField along_x, along_y;
    const SolutionField& adjoint;
};

std::array<Equation, 3> equations_of(const FlowAndAdjoint& flow) {
    const SolutionField empty{"flux", flow.u.at_cells, {}};
    std::array<Equation, 3> equations{Equation{empty, empty, flow.adjoint_u}, Equation{empty, empty, flow.adjoint_v},
                                      Equation{flow.u, flow.v, flow.adjoint_p}};
    for (std::size_t i = 0; i < flow.u.values.size(); ++i) {
        const double u = flow.u.values[i], v = flow.v.values[i], p = flow.p.values[i];
        equations[0].along_x.values.push_back(u * u + p);
        equations[0].along_y.values.push_back(u * v);
        equations[1].along_x.values.push_back(u * v);
        equations[1].along_y.values.push_back(v * v + p);
    }
    return equations;
}

/// The flow, and the gradients of the adjoint, in the cells.
struct GoalCells {
    std::vector<Point> velocity;
    std::vector<double> pressure;
    std::vector<Point> of_u, of_v, of_p;  ///< gradients of the adjoint
};

GoalCells goal_cells(const Mesh& mesh, const FlowAndAdjoint& flow) {
    const CellReconstruction reconstruction(mesh);
    const auto gradients = [&](const SolutionField& field) {
        return reconstruction.gradients(cell_values(mesh, field));
    };
    GoalCells cells{
        {}, cell_values(mesh, flow.p), gradients(flow.adjoint_u), gradients(flow.adjoint_v), gradients(flow.adjoint_p)};
    const std::vector<double> u = cell_values(mesh, flow.u), v = cell_values(mesh, flow.v);
    for (std::size_t cell = 0; cell < u.size(); ++cell) cells.velocity.push_back({u[cell], v[cell]});
    return cells;
}

/// Sums over the equations, in the frame of an edge of the wall: s is along it, n is away from it.
class WallColumns {
public:
    WallColumns(const Mesh& mesh, const GoalCells& cells, const WallFlow& wall)
        : mesh_(mesh), cells_(cells), wall_(wall) {}

    /// Returns the mean over the column of an edge.
    double mean_over(std::size_t i) const {
        const EdgesBeside beside(wall_, i);
        const WallFlowEdge &before = wall_[beside.before], &edge = wall_[i], &after = wall_[beside.after];
        const std::size_t rows = std::min({before.column.size(), edge.column.size(), after.column.size()});
        const Point s = unit(mesh_.points[edge.ends.b.index()] - mesh_.points[edge.ends.a.index()]),
                    normal = perpendicular(s);
        double sum = 0, bottom = 0;
        for (std::size_t row = 0; row < rows; ++row) {
            const Fluxes first = fluxes(before.column[row], s, normal), here = fluxes(edge.column[row], s, normal),
                         last = fluxes(after.column[row], s, normal);
            const Fluxes weight = weights(edge.column[row], s, normal);
            double product = 0;
            for (std::size_t f = 0; f < here.size(); ++f)
                product += weight[f] * std::abs(beside.second_derivative(first[f], here[f], last[f]));
            sum += (edge.tops[row] - bottom) * product;
            bottom = edge.tops[row];
        }
        return bottom > 0 ? sum / bottom : 0;
    }

private:
    /// Along s: those of the momentum along s, of that along n, and of mass; then those along n.
    using Fluxes = std::array<double, 6>;

    Fluxes fluxes(std::size_t cell, Point s, Point n) const {
        const double along = dot(cells_.velocity[cell], s), away = dot(cells_.velocity[cell], n),
                     p = cells_.pressure[cell];
        return {along * along + p, along * away, along, along * away, away * away + p, away};
    }
    Fluxes weights(std::size_t cell, Point s, Point n) const {
        const auto derivatives = [&](Point direction) {
            const double of_u = dot(cells_.of_u[cell], direction), of_v = dot(cells_.of_v[cell], direction);
            return std::array{std::abs(s.x * of_u + s.y * of_v), std::abs(n.x * of_u + n.y * of_v),
                              std::abs(dot(cells_.of_p[cell], direction))};
        };
        const auto by_s = derivatives(s), by_n = derivatives(n);
        return {by_s[0], by_s[1], by_s[2], by_n[0], by_n[1], by_n[2]};
    }

    const Mesh& mesh_;
    const GoalCells& cells_;
    const WallFlow& wall_;
};

}  // namespace

std::vector<EdgeValues> goal_curvatures_of_walls(const Solution& solution, const GoalOptions& options,
                                                 const std::vector<WallFlow>& walls, double scale) {
    const GoalCells cells = goal_cells(solution.mesh, fields_of(solution, options));
    std::vector<EdgeValues> curvatures;
    for (const WallFlow& wall : walls) {
        const WallColumns columns(solution.mesh, cells, wall);
        EdgeValues values(wall.size(), 0.0);
        for (std::size_t i = 0; i < wall.size(); ++i)
            if (!wall[i].at_corner) values[i] = scale * columns.mean_over(i);
        curvatures.push_back(means_of_three(wall, values));
    }
    return curvatures;
}

std::vector<Hessian> goal_hessians(const Solution& solution, const GoalOptions& options) {
    std::vector<Hessian> sums(solution.mesh.points.size());
    for (const Equation& equation : equations_of(fields_of(solution, options))) {
        const std::vector<Derivatives> adjoint = recover_derivatives(solution.mesh, equation.adjoint),
                                       along_x = recover_derivatives(solution.mesh, equation.along_x),
                                       along_y = recover_derivatives(solution.mesh, equation.along_y);
        for (std::size_t i = 0; i < sums.size(); ++i)
            sums[i] = sums[i] + std::abs(adjoint[i].gradient.x) * absolute(along_x[i].hessian) +
                      std::abs(adjoint[i].gradient.y) * absolute(along_y[i].hessian);
    }
    return sums;
}

}  // namespace lamina::adaptation
