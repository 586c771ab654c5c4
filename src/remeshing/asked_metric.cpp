#include "remeshing/asked_metric.hpp"

#include <cmath>
#include <deque>

#include <fmt/format.h>

#include <lamina/error.hpp>

#include "core/interruption_point.hpp"
#include "remeshing/metric.hpp"
#include "remeshing/region.hpp"

namespace lamina::remeshing {

namespace {

/// Raises the smaller eigenvalue to the larger one over the square of the ratio.
MetricTensor with_ratio(const MetricTensor& m, double max_ratio) {
    const Spectrum s = spectrum(m);
    const double least = s.large / (max_ratio * max_ratio);
    return s.small >= least ? m : with_eigenvalues(s, s.large, least);
}

/// Lets sizes grow no faster than by `growth` per unit of distance: the metric of each vertex holds at its neighbours
/// with sizes that have grown, and both are intersected. Vertices whose metric has changed are visited again.
/// Source: F. Alauzet, Finite Elem. Anal. Des. 46 (2010), section 4, growth in metric space.
class Gradation {
public:
    Gradation(const MeshView& mesh, double growth) : mesh_(mesh), growth_(growth), first_(mesh.points.size() + 1, 0) {
        const auto for_each_edge = [&](const auto& visit) {
            for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
                for (unsigned i = 0; is_remeshed(mesh, t) && i < 3; ++i) {
                    const auto& v = mesh.triangles[t].v;
                    visit(v[i].value, v[(i + 1) % 3].value);
                    visit(v[(i + 1) % 3].value, v[i].value);
                }
        };
        for_each_edge([&](std::uint32_t from, std::uint32_t) { ++first_[from + 1]; });
        for (std::size_t v = 1; v < first_.size(); ++v) first_[v] += first_[v - 1];
        neighbours_.resize(first_.back());
        std::vector<std::size_t> end(first_.begin(), first_.end() - 1);
        for_each_edge([&](std::uint32_t from, std::uint32_t to) { neighbours_[end[from]++] = to; });
    }

    void apply(std::vector<MetricTensor>& metric) const {
        // Changes below this share are left, so that the work ends.
        constexpr double noticeable = 1.001;
        std::deque<std::uint32_t> waiting;
        std::vector<char> waits(metric.size(), 1);
        constexpr std::size_t vertices_per_look = 4096;
        for (std::uint32_t v = 0; v < metric.size(); ++v) waiting.push_back(v);
        for (std::size_t step = 0; !waiting.empty(); ++step) {
            if (step % vertices_per_look == 0) core::check_interruption();
            const std::uint32_t v = waiting.front();
            waiting.pop_front();
            waits[v] = 0;
            for (std::size_t i = first_[v]; i < first_[v + 1]; ++i) {
                const std::uint32_t to = neighbours_[i];
                const Point edge = mesh_.points[to] - mesh_.points[v];
                const double grown = 1 + growth_ * std::sqrt(product(metric[v], edge, edge));
                const MetricTensor spread = (1 / (grown * grown)) * metric[v];
                const MetricTensor both = intersection(metric[to], spread);
                if (!(determinant(both) > noticeable * determinant(metric[to])) || !is_metric(both)) continue;
                metric[to] = both;
                if (waits[to] == 0) waiting.push_back(to);
                waits[to] = 1;
            }
        }
    }

private:
    const MeshView& mesh_;
    double growth_;
    std::vector<std::size_t> first_;         ///< per vertex: where its neighbours begin
    std::vector<std::uint32_t> neighbours_;  ///< those inside the region twice
};

void require_metrics(const MeshView& mesh, std::span<const MetricTensor> metric) {
    if (metric.size() != mesh.points.size())
        throw InputError({}, fmt::format("{} metric tensors for {} vertices", metric.size(), mesh.points.size()));
    for (std::size_t v = 0; v < metric.size(); ++v)
        if (!is_metric(metric[v]))
            throw InputError({.at = mesh.points[v], .points = {v}},
                             fmt::format("metric ({}, {}, {}) of vertex {}: must be finite and positive definite",
                                         metric[v].xx, metric[v].xy, metric[v].yy, v));
}

}  // namespace

std::vector<MetricTensor> asked_metric(const MeshView& mesh, std::span<const MetricTensor> metric,
                                       const RemeshOptions& options) {
    require_metrics(mesh, metric);
    std::vector<MetricTensor> result;
    result.reserve(metric.size());
    for (const MetricTensor& m : metric) result.push_back(with_ratio(m, options.max_ratio));
    if (options.vertices) {
        const double scale = *options.vertices / vertices_of_metric(mesh, result);
        for (MetricTensor& m : result) m = scale * m;
        require_metrics(mesh, result);
    }
    if (options.gradation) Gradation(mesh, *options.gradation).apply(result);
    return result;
}

}  // namespace lamina::remeshing

namespace lamina {

using namespace remeshing;

double vertices_of_metric(const MeshView& given, std::span<const MetricTensor> metric) {
    require_metrics(given, metric);
    const MeshWithRegions with_regions(given);
    const MeshView& mesh = with_regions.view();
    double complexity = 0;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        if (!is_remeshed(mesh, t)) continue;
        const auto& v = mesh.triangles[t].v;
        const Point a = mesh.points[v[0].index()], b = mesh.points[v[1].index()], c = mesh.points[v[2].index()];
        const MetricTensor sizes[] = {sizes_of(metric[v[0].index()]), sizes_of(metric[v[1].index()]),
                                      sizes_of(metric[v[2].index()])};
        // The root of the determinant of M is the inverse of that of H, which is linear; the middles of edges integrate
        // quadratic functions exactly.
        double density = 0;
        for (int i = 0; i < 3; ++i) density += 1 / determinant(0.5 * (sizes[i] + sizes[(i + 1) % 3]));
        complexity += 0.5 * cross(b - a, c - a) * density / 3;
    }
    // A triangle with edges of length 1 has the area sqrt(3) / 4, and there are two of them for each vertex.
    return 2 / std::sqrt(3.0) * complexity;
}

}  // namespace lamina
