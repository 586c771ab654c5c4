// Metrics that interpolate a solution best. Source: A. Loseille, F. Alauzet, SIAM J. Numer. Anal. 49 (2011), section 4:
// M = c det(|H|)^(-1/(2p+2)) |H| in two dimensions.
#include <lamina/solution_metric.hpp>

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include <lamina/error.hpp>
#include <lamina/transfer.hpp>

#include "adaptation/counted_hessians.hpp"
#include "adaptation/factor_search.hpp"
#include "adaptation/outer_region.hpp"
#include "core/reproducible_math.hpp"
#include "remeshing/metric.hpp"

namespace lamina::adaptation {

namespace {

using namespace remeshing;
// Those of Hessians would hide them.
using remeshing::operator+;
using remeshing::operator*;

/// Gives the vertices of the layer the tensors of those beyond it that are nearest from edge to edge.
void continue_into_layer(const Mesh& mesh, std::vector<char> isotropic, const OuterVertices& vertices,
                         std::vector<MetricTensor>& tensors) {
    for (char& cell : isotropic) cell = !cell;
    const VertexCells layer(mesh, isotropic);
    std::vector<std::uint32_t> reached;
    std::vector<char> is_reached(mesh.points.size(), 0);
    const auto reach = [&](std::uint32_t v) {
        reached.push_back(v);
        is_reached[v] = 1;
    };
    for (std::uint32_t v = 0; v < mesh.points.size(); ++v)
        if (vertices.area[v] > 0) reach(v);
    for (std::size_t next = 0; next != reached.size();) {  // the list grows on the way
        const std::uint32_t from = reached[next++];
        for (const std::uint32_t cell : layer.at(from))
            for (const VertexId to : layer.corners(cell)) {
                if (is_reached[to.index()] != 0) continue;
                tensors[to.index()] = tensors[from];
                reach(to.value);
            }
    }
}

/// Returns, per vertex of chosen cells, the metric in which the edges of the cells there have the length 1: edges of
/// length 1 in all directions have half of the inverse of their metric as the mean of e e^T.
std::vector<MetricTensor> metrics_of_edges(const Mesh& mesh, const VertexCells& cells) {
    std::vector<MetricTensor> result(mesh.points.size());
    for (std::size_t v = 0; v < result.size(); ++v) {
        MetricTensor sum{0, 0, 0};
        double count = 0;
        for (const std::uint32_t cell : cells.at(v)) {
            const std::span<const VertexId> corners = cells.corners(cell);
            for (std::size_t i = 0; i < corners.size(); ++i) {
                const Point e =
                    mesh.points[corners[(i + 1) % corners.size()].index()] - mesh.points[corners[i].index()];
                sum = sum + MetricTensor{e.x * e.x, e.x * e.y, e.y * e.y};
                ++count;
            }
        }
        if (count > 0) result[v] = inverse((2 / count) * sum);
    }
    return result;
}

/// The tensors of sizes that a solution asks for, on its own mesh.
class SolutionMetric {
public:
    SolutionMetric(const Solution& solution, const SolutionSizeOptions& options, double max_ratio)
        : mesh_(solution.mesh),
          max_change_(options.max_change),
          least_share_(1 / (max_ratio * max_ratio)),
          isotropic_(isotropic_cells(mesh_)),
          vertices_(measure_vertices(mesh_, VertexCells(mesh_, isotropic_))),
          before_(metrics_of_edges(mesh_, VertexCells(mesh_, isotropic_))),
          metric_(mesh_.points.size(), MetricTensor{0, 0, 0}) {
        for (const CountedHessians& hessians : counted_hessians(solution, options))
            intersect_with(metrics_of(hessians, norm_of(options)));
    }

    /// Returns the number of vertices that the metric asks for with the factor 1.
    double vertices() const { return 2 / std::sqrt(3.0) * complexity(metric_); }
    /// Returns the number of vertices of the layer.
    double layer_vertices() const {
        return static_cast<double>(std::count(vertices_.area.begin(), vertices_.area.end(), 0.0));
    }
    /// Returns sizes times a factor, within bounds, at all vertices.
    std::vector<MetricTensor> sizes(double factor) const {
        std::vector<MetricTensor> result(metric_.size());
        for (std::size_t v = 0; v < result.size(); ++v) {
            if (vertices_.area[v] == 0) continue;
            result[v] = sizes_of(within_change((1 / (factor * factor)) * metric_[v], before_[v]));
        }
        continue_into_layer(mesh_, isotropic_, vertices_, result);
        return result;
    }

private:
    /// Returns the metric with no direction's size changed by more than max_change_. No size is asked for where it is
    /// 0.
    MetricTensor within_change(const MetricTensor& asked, const MetricTensor& before) const {
        const double most = max_change_ * max_change_;
        const MetricTensor largest_sizes = (1 / most) * before;
        if (asked.xx == 0) return largest_sizes;
        return inverse(intersection(inverse(intersection(asked, largest_sizes)), inverse(most * before)));
    }
    /// Returns the optimal metric of a field, scaled to a complexity of 1, with stretching within bounds.
    std::vector<MetricTensor> metrics_of(const CountedHessians& hessians, double p) const {
        std::vector<MetricTensor> metrics(metric_.size(), MetricTensor{0, 0, 0});
        for (std::size_t v = 0; v < metrics.size(); ++v) {
            if (!vertices_.counts(hessians, v)) continue;
            const Hessian h = absolute(hessians.at[v]);
            const Spectrum s = spectrum({h.xx, h.xy, h.yy});
            const MetricTensor limited = with_eigenvalues(s, s.large, std::max(s.small, least_share_ * s.large));
            metrics[v] = (1 / core::pow_reproducible(determinant(limited), 1 / (2 * p + 2))) * limited;
        }
        const double all = complexity(metrics);
        if (all > 0)
            for (MetricTensor& m : metrics) m = (1 / all) * m;
        return metrics;
    }
    double complexity(const std::vector<MetricTensor>& metrics) const {
        double sum = 0;
        for (std::size_t v = 0; v < metrics.size(); ++v)
            if (metrics[v].xx > 0) sum += vertices_.area[v] * std::sqrt(determinant(metrics[v]));
        return sum;
    }
    void intersect_with(const std::vector<MetricTensor>& metrics) {
        for (std::size_t v = 0; v < metrics.size(); ++v)
            if (metrics[v].xx > 0) metric_[v] = metric_[v].xx > 0 ? intersection(metric_[v], metrics[v]) : metrics[v];
    }

    const Mesh& mesh_;
    double max_change_, least_share_;  ///< of the smaller eigenvalue, in the larger one
    std::vector<char> isotropic_;
    OuterVertices vertices_;
    std::vector<MetricTensor> before_;  ///< per vertex: that of the edges of the mesh
    std::vector<MetricTensor> metric_;  ///< per vertex; 0 where nothing is asked
};

/// The mesh that is remeshed, and the metric on it.
class NextMesh {
public:
    NextMesh(const Mesh& mesh, const Solution& solution)
        : mesh_(mesh), sizes_{solution.mesh, {}}, borders_(border_edges(mesh, isotropic_cells(mesh))) {}

    /// Returns the metric that asks for sizes which are given on the mesh of the solution. At edges that stay it asks
    /// for no longer ones, in all directions, so that sizes grow from there.
    std::vector<MetricTensor> metric(const std::vector<MetricTensor>& sizes) {
        sizes_.fields = {{"xx", false, {}}, {"xy", false, {}}, {"yy", false, {}}};
        for (const MetricTensor& h : sizes) {
            sizes_.fields[0].values.push_back(h.xx);
            sizes_.fields[1].values.push_back(h.xy);
            sizes_.fields[2].values.push_back(h.yy);
        }
        const std::vector<SolutionField> fields = transfer(sizes_, mesh_);
        std::vector<MetricTensor> result;
        for (std::size_t v = 0; v < mesh_.points.size(); ++v)
            result.push_back(metric_of({fields[0].values[v], fields[1].values[v], fields[2].values[v]}));
        for (const Segment& edge : borders_) {
            const double eigenvalue = 1 / squared_length(mesh_.points[edge.b.index()] - mesh_.points[edge.a.index()]);
            for (const VertexId v : {edge.a, edge.b})
                result[v.index()] = intersection(result[v.index()], {eigenvalue, 0, eigenvalue});
        }
        return result;
    }

private:
    const Mesh& mesh_;
    Solution sizes_;
    std::vector<Segment> borders_;
};

}  // namespace

}  // namespace lamina::adaptation

namespace lamina {

using namespace adaptation;

RemeshedMesh remesh_to_solution(const Mesh& mesh, const Solution& solution, const SolutionSizeOptions& options,
                                double max_ratio) {
    validate(options);
    RemeshOptions of_remesher;
    of_remesher.gradation = options.gradation;
    of_remesher.max_ratio = max_ratio;
    validate(of_remesher);
    const SolutionMetric asked(solution, options, max_ratio);
    if (!(asked.vertices() > 0))
        throw OptionError("field", "is linear everywhere beyond the layer: no sizes follow from it");
    NextMesh next(mesh, solution);
    RemeshedMesh result;
    const double beyond = std::max(options.vertices - asked.layer_vertices(), 1.0);
    FactorSearch search(options.vertices, std::sqrt(asked.vertices() / beyond));
    while (search.goes_on()) {
        RemeshedMesh made = remesh(mesh, next.metric(asked.sizes(search.factor())), of_remesher);
        if (search.note(made.mesh.points.size())) result = std::move(made);
    }
    search.require_found(options);
    return result;
}

}  // namespace lamina
