#include "layers/directions/leans.hpp"

#include <algorithm>
#include <cmath>

#include "core/angles.hpp"
#include "core/reproducible_math.hpp"
#include "core/rounding.hpp"
#include "layers/directions/corners.hpp"
#include "layers/directions/lean_chain.hpp"
#include "layers/parameters.hpp"

namespace lamina::layers {

namespace {

/// Returns the bounds of the lean of the one ray of a vertex. shorter_edge: length of the shorter one of its edges.
LeanBounds bounds_of_ray(const RayVertex& at, const WallVertex& vertex, double first_height, double shorter_edge) {
    if (at.place == RayPlace::wake_end) return {0, 0};
    const double from_normals = core::radians(most_lean_from_normals_deg) - 0.5 * std::abs(vertex.turning);
    const double most = std::min({core::radians(most_lean_deg), from_normals,
                                  max_lean_between_edges(vertex.turning, first_height, shorter_edge)});
    return {-std::max(most, 0.0), std::max(most, 0.0)};
}

/// Returns the width that columns should have at the front, in heights of the front. Layers of a given number end lower or
/// higher than where cells are as high as wide, and rays of points that were given stay near their normals: there the rays
/// must not meet, and no more.
double wanted_width(OutlineKind kind, const LayerGrowth& growth, double angle) {
    const bool is_wanted = kind == OutlineKind::jagged || (kind == OutlineKind::smooth && !growth.layers);
    return is_wanted ? wanted_width_in_openings * angle : -HUGE_VAL;
}

/// Returns the heights at which widths are measured.
std::vector<double> measured_heights(std::span<const double> heights, OutlineKind kind, const LayerGrowth& growth) {
    const bool isotropic = !growth.layers && growth.least_heights.empty();
    const double factor = kind == OutlineKind::jagged && isotropic ? fronts_on_jagged : 1;
    std::vector<double> measured(heights.begin(), heights.end());
    for (double& height : measured) height *= factor;
    return measured;
}

/// The chain of an outline: its rays, and the columns behind them.
struct Leaners {
    std::vector<ColumnLack> lacks;
    std::vector<LeanBounds> bounds;
    std::vector<double*> leans;
};

/// Returns the chain problem of an outline: what its columns lack without leans, and where the leans of its rays go.
Leaners leaners_of(std::span<const RayVertex> outline, std::span<const double> heights, double wanted,
                   double first_height, std::span<WallVertex> vertices) {
    const std::size_t n = outline.size();
    constexpr ColumnLack nothing{-HUGE_VAL, -HUGE_VAL};
    Leaners result;
    double edge_before = distance(outline[n - 1].at, outline[0].at);
    for (std::size_t i = 0; i < n; ++i) {
        const std::size_t next = i + 1 < n ? i + 1 : 0;
        WallVertex &vertex = vertices[i], &after = vertices[next];
        const double edge = distance(outline[i].at, outline[next].at), height = std::max(heights[i], heights[next]);
        if (vertex.fan) {
            const double most = core::radians(most_fan_lean_deg),
                         given = std::min(most, most_given_share * vertex.turning);
            result.lacks.push_back(nothing);
            result.bounds.insert(result.bounds.end(), {{-most, given}, {-given, most}});
            result.leans.push_back(&vertex.lean[0]);
        } else {
            result.bounds.push_back(bounds_of_ray(outline[i], vertex, first_height, std::min(edge_before, edge)));
        }
        result.leans.push_back(&vertex.lean[vertex.fan]);
        const double opening = (vertex.fan ? 0 : 0.5 * vertex.turning) + (after.fan ? 0 : 0.5 * after.turning);
        const double width = edge / height;
        const ColumnLack lack{wanted - width - opening, -width / clearance - opening};
        result.lacks.push_back(height > 0 ? lack : nothing);
        edge_before = edge;
    }
    return result;
}

}  // namespace

double most_opening(OutlineKind kind, const LayerOptions& options) {
    const double angle = core::radians(options.max_ray_angle_deg);
    return kind == OutlineKind::jagged ? std::max(angle, core::radians(max_jagged_ray_angle_deg)) : angle;
}

void lean_rays(std::span<const RayVertex> outline, std::span<const double> heights, OutlineKind kind,
               const LayerOptions& options, const LayerGrowth& growth, std::vector<WallVertex>& vertices) {
    constexpr double lean_step = 0x1p-12;  // radians: leans that differ by rounding errors become equal
    // Columns need be no wider than where corners follow each other, however far rays may diverge.
    const double angle = std::min(most_opening(kind, options), core::radians(max_jagged_ray_angle_deg));
    const double wanted = wanted_width(kind, growth, angle),
                 fan_angle = std::min(core::radians(options.max_ray_angle_deg), angle);
    // On walls of twice as many edges and rays at half the angle a lack is spread over twice as many columns.
    const double weight = kind == OutlineKind::jagged ? 1 : weight_on_smooth,
                 stiffness = lean_stiffness * fan_angle * fan_angle;
    const Leaners leaners =
        leaners_of(outline, measured_heights(heights, kind, growth), wanted, growth.first_height, vertices);
    const ChainLeans solution = minimise_leans(leaners.lacks, leaners.bounds, weight, stiffness);
    for (std::size_t k = 0; k < leaners.leans.size(); ++k)
        *leaners.leans[k] = core::rounded_to_multiple(solution.leans[k], lean_step);
    for (WallVertex& vertex : vertices)
        if (!vertex.fan) vertex.lean[1] = vertex.lean[0];
}

}  // namespace lamina::layers
