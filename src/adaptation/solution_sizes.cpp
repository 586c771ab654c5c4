// Sizes that interpolate a solution best. For isotropic triangles of edge h the error of linear interpolation is some
// multiple of lambda h^2, and there are some 1 / h^2 triangles per unit of area. The integral of (lambda h^2)^p is least
// for a given integral of 1 / h^2 where h = c lambda^(-p / (2 p + 2)). Source: F. Alauzet, A. Loseille, J. Comput. Phys. 229
// (2010), section 2.3.
#include <lamina/solution_sizes.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <utility>

#include <fmt/format.h>

#include <lamina/error.hpp>

#include "adaptation/error_norm.hpp"
#include "adaptation/goal.hpp"
#include "adaptation/hessian.hpp"
#include "adaptation/outer_region.hpp"
#include "adaptation/vertex_patches.hpp"
#include "adaptation/wall_flow.hpp"
#include "adaptation/wall_sizes.hpp"
#include "core/reproducible_math.hpp"

namespace lamina::adaptation {

namespace {

/// What is known about the vertices of the isotropic cells. Lists have one entry per vertex of the mesh.
struct OuterVertices {
    std::vector<double> area;  ///< a third, or a quarter, of the cells at the vertex; 0 inside the layer
    std::vector<double> edge;  ///< mean length of the cells' edges there
};

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

/// Second derivatives that count: those of a field, or of what a goal makes of all fields.
struct Curvatures {
    std::vector<double> lambda;  ///< per vertex of the mesh
    double rounding = 0;         ///< smaller second differences are 0 but for rounding
};

/// What second derivatives ask for.
struct CurvatureShape {
    /// Per vertex of the mesh: the size, scaled so that such sizes would make one triangle of area h^2. It is infinite
    /// where lambda is 0, and everywhere if it is 0 everywhere.
    std::vector<double> size;
    double scale = 0;  ///< what lambda is multiplied by so that this comes out
    double error = 0;  ///< SolutionSizes::errors
};

CurvatureShape shape_of(const Curvatures& curvatures, const OuterVertices& vertices, const ErrorNorm& norm) {
    CurvatureShape shape{std::vector<double>(curvatures.lambda.size(), HUGE_VAL)};
    const double p = norm.power();
    double triangles = 0, error = 0;
    for (std::size_t v = 0; v < shape.size.size(); ++v) {
        const double lambda = curvatures.lambda[v], difference = lambda * vertices.edge[v] * vertices.edge[v];
        if (vertices.area[v] == 0 || !(difference > curvatures.rounding)) continue;
        shape.size[v] = norm.size(lambda);
        triangles += vertices.area[v] / (shape.size[v] * shape.size[v]);
        error += norm.power_on_triangle() * vertices.area[v] * core::pow_reproducible(difference, p);
    }
    if (triangles > 0) {
        for (double& size : shape.size) size *= std::sqrt(triangles);
        shape.scale = 1 / core::pow_reproducible(triangles, (p + 1) / p);
    }
    if (error > 0) shape.error = core::pow_reproducible(error, 1 / p);
    return shape;
}

Curvatures curvatures_of(const Mesh& mesh, const SolutionField& field) {
    constexpr double rounding = 1e-11;  // as a share of the largest value
    double largest = 0;
    for (const double value : field.values) largest = std::max(largest, std::abs(value));
    Curvatures curvatures{{}, rounding * largest};
    for (const Derivatives& at : recover_derivatives(mesh, field))
        curvatures.lambda.push_back(largest_curvature(at.hessian));
    return curvatures;
}

/// Returns the fields that are to be interpolated well: all but the components of the velocity that walls need, which stand
/// last.
std::span<const SolutionField> interpolated_fields(const Solution& solution, const SolutionSizeOptions& options) {
    const std::size_t of_walls = options.walls ? 2 : 0;
    return std::span(solution.fields).first(solution.fields.size() - std::min(solution.fields.size(), of_walls));
}

/// Returns the second derivatives of each field, or those of the goal.
std::vector<Curvatures> all_curvatures(const Solution& solution, const SolutionSizeOptions& options) {
    if (options.goal) return {{goal_curvatures(solution, *options.goal), 0}};
    std::vector<Curvatures> all;
    for (const SolutionField& field : interpolated_fields(solution, options))
        all.push_back(curvatures_of(solution.mesh, field));
    return all;
}

/// Makes the mesh of sizes from the isotropic cells.
class SizesMaker {
public:
    SizesMaker(const Solution& solution, const SolutionSizeOptions& options, std::span<const char> isotropic,
               const OuterVertices& vertices)
        : options_(options) {
        const Mesh& mesh = solution.mesh;
        const ErrorNorm norm(options.goal ? 1 : options.norm);
        shape_.assign(mesh.points.size(), HUGE_VAL);
        std::vector<double> scales;
        for (const Curvatures& curvatures : all_curvatures(solution, options)) {
            const CurvatureShape shape = shape_of(curvatures, vertices, norm);
            for (std::size_t v = 0; v < shape_.size(); ++v) shape_[v] = std::min(shape_[v], shape.size[v]);
            errors_.push_back(shape.error);
            scales.push_back(shape.scale);
        }
        if (options.walls) {
            std::vector<WallFlow> walls = find_wall_flow(solution, *options.walls);
            std::vector<EdgeValues> curvatures =
                options.goal ? goal_curvatures_of_walls(solution, *options.goal, walls, scales.front())
                             : wall_curvatures(solution, walls, scales, norm);
            walls_.emplace(std::move(walls), std::move(curvatures), norm, options.max_change);
        }
        if (std::all_of(shape_.begin(), shape_.end(), [](double size) { return size == HUGE_VAL; }))
            throw OptionError("field", "is linear everywhere beyond the layer: no sizes follow from it");
        keep_outer_vertices(mesh, isotropic, vertices);
    }

    /// Raises all sizes to these, which are given per point of base().
    void raise_to(std::vector<double> floors) { floors_ = std::move(floors); }
    /// Returns the points and triangles, without sizes.
    const SizedMesh& base() const { return base_; }
    /// Returns SolutionSizes::errors.
    const std::vector<double>& errors() const { return errors_; }
    /// Returns a number c with which the sizes would ask for about so many triangles if they had no bounds.
    double factor_for(double triangles) const {
        double asked = 0;
        for (std::size_t v = 0; v < area_.size(); ++v) asked += area_[v] / (shape_[v] * shape_[v]);
        return std::sqrt(asked / (equilateral_area * triangles));
    }
    SizedMesh with(double factor) const {
        SizedMesh sizes = base_;
        sizes.gradation = options_.gradation;
        if (walls_) sizes.walls = walls_->with(factor);
        for (std::size_t v = 0; v < shape_.size(); ++v) {
            const double size =
                std::clamp(factor * shape_[v], edge_[v] / options_.max_change, edge_[v] * options_.max_change);
            sizes.sizes.push_back(floors_.empty() ? size : std::max(size, floors_[v]));
        }
        return sizes;
    }

private:
    void keep_outer_vertices(const Mesh& mesh, std::span<const char> isotropic, const OuterVertices& vertices) {
        std::vector<VertexId> number(mesh.points.size());
        std::vector<double> shape;
        for (std::size_t v = 0; v < number.size(); ++v) {
            if (vertices.area[v] == 0) continue;
            number[v] = VertexId(base_.points.size());
            base_.points.push_back(mesh.points[v]);
            shape.push_back(shape_[v]);
            area_.push_back(vertices.area[v]);
            edge_.push_back(vertices.edge[v]);
        }
        shape_ = std::move(shape);
        const auto add = [&](VertexId a, VertexId b, VertexId c) {
            base_.triangles.push_back({{number[a.index()], number[b.index()], number[c.index()]}});
        };
        for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
            if (const auto& v = mesh.triangles[t].v; isotropic[t]) add(v[0], v[1], v[2]);
        for (std::size_t q = 0; q < mesh.quads.size(); ++q) {
            if (!isotropic[mesh.triangles.size() + q]) continue;
            const auto& v = mesh.quads[q].v;
            add(v[0], v[1], v[2]);
            add(v[0], v[2], v[3]);
        }
    }

    const SolutionSizeOptions& options_;
    SizedMesh base_;
    std::vector<double> shape_, area_, edge_, floors_;  ///< per point of base_
    std::vector<double> errors_;                        ///< per field
    std::optional<WallSizes> walls_;                    ///< none: walls stay as they are
};

/// Finds the factor with which the mesh has the number of vertices asked for.
class FactorSearch {
public:
    FactorSearch(double vertices, double first) : wanted_(vertices), factor_(first) {}

    double factor() const { return factor_; }
    double error() const { return error_; }
    /// Notes the number of vertices with factor(), and chooses the next one.
    void note(double vertices) {
        constexpr double widening = 4;
        error_ = vertices / wanted_ - 1;
        const double at = core::log_reproducible(factor_), miss = core::log_reproducible(vertices / wanted_);
        End &here = miss > 0 ? low_ : high_, &other = miss > 0 ? high_ : low_;
        // An end that stays would hold the secant back (Illinois method).
        if (last_ == &here) other.miss *= 0.5;
        last_ = &here;
        here = {at, miss, true};
        if (!low_.known || !high_.known) {
            // As many vertices as the inverse square of the factor, and some that do not depend on it: steps double.
            step_ = std::clamp(step_ == 0 ? 0.7 * miss : 2 * step_, -core::log_reproducible(widening),
                               core::log_reproducible(widening));
            factor_ = core::exp_reproducible(at + step_);
            return;
        }
        // The secant, kept off both ends.
        const double share = std::clamp(low_.miss / (low_.miss - high_.miss), 0.1, 0.9);
        factor_ = core::exp_reproducible(low_.at + share * (high_.at - low_.at));
    }

private:
    struct End {
        double at = 0, miss = 0;
        bool known = false;
    };
    double wanted_, factor_, error_ = HUGE_VAL;
    double step_ = 0;            ///< the last one, while only one end is known
    End low_, high_;             ///< logarithms of factors with too many and too few vertices
    const End* last_ = nullptr;  ///< the one that was replaced last
};

[[noreturn]] void refuse_number(const SolutionSizeOptions& options, std::size_t vertices) {
    const bool too_many = static_cast<double>(vertices) > options.vertices;
    throw OptionError(
        "vertices",
        fmt::format("cannot be {}: with sizes within a factor of {} of those of the solution's mesh, the "
                    "next mesh has {} {}",
                    options.vertices, options.max_change, too_many ? "no fewer than" : "no more than", vertices));
}

}  // namespace

}  // namespace lamina::adaptation

namespace lamina {

using namespace adaptation;

SolutionSizes solution_sizes(const Solution& solution, const SolutionSizeOptions& options, const VertexCount& count) {
    constexpr double good_enough = 0.01, acceptable = 0.02;
    constexpr int most_rounds = 16;
    validate(options);
    if (!options.goal && interpolated_fields(solution, options).empty())
        throw OptionError("field", "is needed: sizes follow from fields of the solution");
    const std::vector<char> isotropic = simple_region(solution.mesh, isotropic_cells(solution.mesh));
    const OuterVertices vertices = measure_vertices(solution.mesh, VertexCells(solution.mesh, isotropic));
    SizesMaker maker(solution, options, isotropic, vertices);
    OuterRegion region;
    if (!count || options.keep_borders) {
        region = find_outer_region(solution.mesh, isotropic);
        if (options.keep_borders) maker.raise_to(sizes_of_borders(region, maker.base().points));
    }

    SolutionSizes result;
    result.errors = maker.errors();
    result.vertices_before = solution.mesh.points.size();
    result.layer_vertices = result.vertices_before - maker.base().points.size();
    const double beyond = std::max(options.vertices - static_cast<double>(result.layer_vertices), 1.0);
    FactorSearch search(options.vertices, maker.factor_for(2 * beyond));
    double best = HUGE_VAL;
    while (result.rounds < most_rounds && best > good_enough) {
        SizedMesh sizes = maker.with(search.factor());
        const std::size_t made = count ? count(sizes) : count_vertices(region, sizes);
        ++result.rounds;
        search.note(static_cast<double>(made));
        if (std::abs(search.error()) >= best) continue;
        best = std::abs(search.error());
        result.vertices = made;
        result.sizes = std::move(sizes);
    }
    if (best > acceptable) refuse_number(options, result.vertices);
    return result;
}

}  // namespace lamina
