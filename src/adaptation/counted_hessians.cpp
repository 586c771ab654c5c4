#include "adaptation/counted_hessians.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include <lamina/error.hpp>

#include "adaptation/goal.hpp"

namespace lamina::adaptation {

namespace {

CountedHessians hessians_of(const Mesh& mesh, const SolutionField& field) {
    constexpr double rounding = 1e-11;  // as a share of the largest value
    double largest = 0;
    for (const double value : field.values) largest = std::max(largest, std::abs(value));
    CountedHessians hessians{{}, rounding * largest};
    for (const Derivatives& at : recover_derivatives(mesh, field)) hessians.at.push_back(at.hessian);
    return hessians;
}

/// Returns the fields that are to be interpolated well: all but the components of the velocity that walls need, which
/// stand last.
std::span<const SolutionField> interpolated_fields(const Solution& solution, const SolutionSizeOptions& options) {
    const std::size_t of_walls = options.walls ? 2 : 0;
    return std::span(solution.fields).first(solution.fields.size() - std::min(solution.fields.size(), of_walls));
}

}  // namespace

OuterVertices measure_vertices(const Mesh& mesh, const VertexCells& cells) {
    OuterVertices vertices{std::vector<double>(mesh.points.size(), 0.0), std::vector<double>(mesh.points.size(), 0.0)};
    for (std::size_t v = 0; v < mesh.points.size(); ++v) {
        double lengths = 0, count = 0;
        for (const std::uint32_t cell : cells.at(v)) {
            const std::span<const VertexId> corners = cells.corners(cell);
            double doubled = 0;
            for (std::size_t i = 0; i < corners.size(); ++i) {
                const Point a = mesh.points[corners[i].index()],
                            b = mesh.points[corners[(i + 1) % corners.size()].index()];
                doubled += cross(a - mesh.points[v], b - mesh.points[v]);
                lengths += distance(a, b);
                ++count;
            }
            vertices.area[v] += 0.5 * doubled / static_cast<double>(corners.size());
        }
        if (count > 0) vertices.edge[v] = lengths / count;
    }
    return vertices;
}

std::vector<CountedHessians> counted_hessians(const Solution& solution, const SolutionSizeOptions& options) {
    if (options.goal) return {{goal_hessians(solution, *options.goal), 0}};
    const std::span<const SolutionField> fields = interpolated_fields(solution, options);
    if (fields.empty()) throw OptionError("field", "is needed: sizes follow from fields of the solution");
    std::vector<CountedHessians> all;
    for (const SolutionField& field : fields) all.push_back(hessians_of(solution.mesh, field));
    return all;
}

}  // namespace lamina::adaptation
