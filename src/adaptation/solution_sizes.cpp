// Sizes that interpolate a solution best. For isotropic triangles of edge h the error of linear interpolation is some
// multiple of lambda h^2, and there are some 1 / h^2 triangles per unit of area. The integral of (lambda h^2)^p is
// least for a given integral of 1 / h^2 where h = c lambda^(-p / (2 p + 2)). Source: F. Alauzet, A. Loseille, J.
// Comput. Phys. 229 (2010), section 2.3.
#include <lamina/solution_sizes.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <utility>

#include <lamina/error.hpp>

#include "adaptation/counted_hessians.hpp"
#include "adaptation/error_norm.hpp"
#include "adaptation/factor_search.hpp"
#include "adaptation/goal.hpp"
#include "adaptation/outer_region.hpp"
#include "adaptation/vertex_patches.hpp"
#include "adaptation/wall_flow.hpp"
#include "adaptation/wall_sizes.hpp"
#include "core/reproducible_math.hpp"

namespace lamina::adaptation {

namespace {

/// What second derivatives ask for.
struct CurvatureShape {
    /// Per vertex of the mesh: the size, scaled so that such sizes would make one triangle of area h^2. It is infinite
    /// where lambda is 0, and everywhere if it is 0 everywhere.
    std::vector<double> size;
    double scale = 0;  ///< what lambda is multiplied by so that this comes out
    double error = 0;  ///< SolutionSizes::errors
};

CurvatureShape shape_of(const CountedHessians& hessians, const OuterVertices& vertices, const ErrorNorm& norm) {
    CurvatureShape shape{std::vector<double>(hessians.at.size(), HUGE_VAL)};
    const double p = norm.power();
    double triangles = 0, error = 0;
    for (std::size_t v = 0; v < shape.size.size(); ++v) {
        if (!vertices.counts(hessians, v)) continue;
        const double lambda = largest_curvature(hessians.at[v]),
                     difference = lambda * vertices.edge[v] * vertices.edge[v];
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

/// Makes the mesh of sizes from the isotropic cells.
class SizesMaker {
public:
    SizesMaker(const Solution& solution, const SolutionSizeOptions& options, std::span<const char> isotropic,
               const OuterVertices& vertices)
        : options_(options) {
        const Mesh& mesh = solution.mesh;
        const ErrorNorm norm(norm_of(options));
        shape_.assign(mesh.points.size(), HUGE_VAL);
        std::vector<double> scales;
        for (const CountedHessians& hessians : counted_hessians(solution, options)) {
            const CurvatureShape shape = shape_of(hessians, vertices, norm);
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

}  // namespace

}  // namespace lamina::adaptation

namespace lamina {

using namespace adaptation;

SolutionSizes solution_sizes(const Solution& solution, const SolutionSizeOptions& options, const VertexCount& count) {
    validate(options);
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
    while (search.goes_on()) {
        SizedMesh sizes = maker.with(search.factor());
        if (search.note(count ? count(sizes) : count_vertices(region, sizes))) result.sizes = std::move(sizes);
    }
    search.require_found(options);
    result.vertices = search.vertices();
    result.rounds = search.rounds();
    return result;
}

}  // namespace lamina
