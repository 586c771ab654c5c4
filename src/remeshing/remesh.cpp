// Remeshing by local changes. Source: H. Borouchaki et al., Finite Elem. Anal. Des. 25 (1997); P. J. Frey, F. Alauzet,
// Comput. Methods Appl. Mech. Engrg. 194 (2005).
#include <lamina/remesh.hpp>

#include <algorithm>
#include <cmath>

#include <lamina/error.hpp>

#include "remeshing/asked_metric.hpp"
#include "remeshing/passes.hpp"
#include "remeshing/region.hpp"

namespace lamina::remeshing {

namespace {

/// Coarsens where the mesh is too fine, and then divides the longest edges first, so that triangles on the way are no
/// worse than they must be.
void fit_lengths(Passes& passes) {
    while (passes.contract_short() > 0) passes.swap_diagonals();
    for (double length = 0.5 * passes.longest_edge(); length > longest_in_order; length *= 0.5)
        passes.divide_longer(length);
    passes.divide_longer(longest_in_order);
}

/// Improves shapes, and puts the lengths in order that this changes. Where little changes a round costs little. On four
/// mild metrics the shares of edges from 0.7 to 1.4 long are 0.988 to 0.998 with 2 rounds, 0.990 to 0.998 with 4 (and
/// mean qualities 0.950 to 0.971 and 0.953 to 0.971), for 7 % of the time of five passes.
void improve(Passes& passes) {
    constexpr int rounds = 4;
    for (int round = 0; round < rounds; ++round) {
        passes.swap_diagonals();
        passes.move_vertices();
        passes.contract_short();
        passes.divide_longer(longest_in_order);
    }
    passes.swap_diagonals();
    passes.move_vertices();
    passes.swap_diagonals();
}

void measure(const MetricMesh& mesh, RemeshedMesh& result) {
    std::size_t edges = 0, unit_edges = 0;
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        const MeshTriangle& triangle = mesh.triangles[t];
        if (!triangle.is_used()) continue;
        ++result.triangles;
        // Rounding may leave nothing of the area of a sliver.
        if (triangle.distortion > 0) result.mean_quality += 1 / std::sqrt(static_cast<double>(triangle.distortion));
        for (unsigned e = 0; e < 3; ++e) {
            if (!is_border(triangle.n[e]) && triangle_of(triangle.n[e]) < t) continue;
            const double length = mesh.edge_length(triangle.v[after(e)], triangle.v[before(e)]);
            ++edges;
            if (length >= 0.7 && length <= 1.4) ++unit_edges;
        }
    }
    result.mean_quality /= static_cast<double>(result.triangles);
    result.unit_edges = static_cast<double>(unit_edges) / static_cast<double>(edges);
}

}  // namespace

}  // namespace lamina::remeshing

namespace lamina {

using namespace remeshing;

RemeshedMesh remesh(const MeshView& given, std::span<const MetricTensor> metric, const RemeshOptions& options) {
    validate(options);
    const MeshWithRegions with_regions(given);
    const MeshView& mesh = with_regions.view();
    const std::vector<MetricTensor> asked = asked_metric(mesh, metric, options);
    if (!(2 * vertices_of_metric(mesh, asked) <= static_cast<double>(most_triangles))) refuse_more_triangles();
    MetricMesh region = take_region(mesh, asked, options.divide_borders);
    limit_at_frozen_edges(region);
    if (region.triangles.empty()) throw MeshError("the mesh has no triangles beyond its layer");
    const BackgroundMetric background(region);
    Passes passes(region, background);
    fit_lengths(passes);
    region.renumber();
    improve(passes);

    RemeshedMesh result;
    measure(region, result);
    result.mesh = put_back(mesh, region, asked, result.metric);
    return result;
}

}  // namespace lamina
