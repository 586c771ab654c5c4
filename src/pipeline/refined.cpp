// Options of similar meshes: all lengths divided by one ratio (docs/decisions/0038).
#include <lamina/pipeline.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <variant>

#include <lamina/error.hpp>

#include "core/option_builders.hpp"
#include "core/reproducible_math.hpp"
#include "layers/growth_laws.hpp"

namespace lamina::pipeline {

namespace {

Length divided(Length length, double ratio) { return {length.value / ratio, length.unit}; }

void refine_surface(double ratio, SurfaceOptions& surface) {
    if (surface.treatment == SurfaceTreatment::keep)
        throw OptionError("surface", "must be auto or resample: points that are kept make no similar mesh");
    surface.treatment = SurfaceTreatment::resample;
    const auto multiply = [&](std::size_t& count, std::size_t least) {
        count = std::max<std::size_t>(least, std::llround(ratio * double(count)));
    };
    if (surface.points) multiply(*surface.points, 3);
    if (surface.base_edges) multiply(*surface.base_edges, 1);
    for (SideEdges& edges : surface.side_edges) {
        multiply(edges.upper, 1);
        multiply(edges.lower, 1);
        if (edges.base) multiply(*edges.base, 1);
    }
    surface.max_ratio = core::pow_reproducible(surface.max_ratio, 1 / ratio);
    for (double* length :
         {&surface.max_turning_deg, &surface.gradation, &surface.max_spacing, &surface.sharp_corner_spacing,
          &surface.corner_spacing, &surface.gap_spacing, &surface.min_spacing})
        *length /= ratio;
    surface.max_turning_deg = std::min(surface.max_turning_deg, 90.0);
    for (std::optional<double>* length : {&surface.leading_edge_spacing, &surface.trailing_edge_spacing})
        if (*length) **length /= ratio;
    surface.tolerance /= ratio * ratio;  // an edge is away from its curve by the square of its length
}

/// Returns the ratio of successive heights on a ray, with which the law is geometric.
double geometric_ratio(const LayerOptions& layer, const ReferenceConditions& conditions) {
    if (layer.growth_law != GrowthLaw::exponential) return layer.growth;
    return layers::growth_law_entry(layer.growth_law).ray_growth(layers::layer_growth(layer, conditions));
}

void multiply_first_height(double factor, LayerOptions& layer) {
    if (auto* height = std::get_if<Length>(&layer.first_height))
        height->value *= factor;
    else
        std::get<YPlus>(layer.first_height).y_plus *= factor;
}

/// A layer is numbered by n x `step` of the old ones, where n is its new number. Returns the ratio of the first
/// heights, the new one over the old one.
double refine_layer(double ratio, const ReferenceConditions& conditions, LayerOptions& layer) {
    if (!layer.enabled) return 1;
    if (layer.growth_law == GrowthLaw::aflr)
        throw OptionError("growth_law", "must not be aflr: its ratios are fixed, so that no other mesh is similar");
    double step = 1 / ratio;
    const double growth = geometric_ratio(layer, conditions);
    if (layer.layers) {
        const auto layers =
            std::max<std::int64_t>(layers::growth_law_entry(layer.growth_law).min_layers,
                                   std::max<std::int64_t>(1, std::llround(ratio * double(*layer.layers))));
        step = double(*layer.layers) / double(layers);
        layer.layers = static_cast<std::uint32_t>(layers);
    }
    double factor = 0;
    if (layer.growth_law == GrowthLaw::polynomial) {
        factor = core::pow_reproducible(step, layer.growth);
    } else {
        factor = (core::pow_reproducible(growth, step) - 1) / (growth - 1);
        layer.growth = core::pow_reproducible(layer.growth, step);
    }
    multiply_first_height(factor, layer);
    layer.max_ray_angle_deg = std::min(layer.max_ray_angle_deg / ratio, 90.0);
    return factor;
}

void multiply_first_heights(double factor, FarFieldOptions& far_field) {
    for (std::optional<OuterLayers>* layers : {&far_field.ground_layers, &far_field.tunnel_layers}) {
        if (!*layers) continue;
        if (auto* height = std::get_if<Length>(&**layers))
            height->value *= factor;
        else
            std::get<YPlus>(**layers).y_plus *= factor;
    }
}

void refine_sizing(double ratio, SizingOptions& sizing) {
    sizing.gradation /= ratio;
    for (std::optional<Length>* size : {&sizing.far_size, &sizing.wall_size})
        if (*size) *size = divided(**size, ratio);
    for (SizeSource& source : sizing.sources) source.size /= ratio;
    for (WakeOptions& wake : sizing.wakes)
        if (wake.size) wake.size = divided(*wake.size, ratio);
    if (!sizing.background) return;
    auto background = std::make_shared<SizedMesh>(*sizing.background);
    for (double& size : background->sizes) size /= ratio;
    if (background->gradation) *background->gradation /= ratio;
    for (SizedWall& wall : background->walls)
        for (double& spacing : wall.spacings) spacing /= ratio;
    sizing.background = std::move(background);
}

}  // namespace

}  // namespace lamina::pipeline

namespace lamina {

using namespace pipeline;

CaseOptions refined(const CaseOptions& options, double ratio, const ReferenceConditions& conditions) {
    require_in_range(positive_numbers, ratio, "ratio");
    CaseOptions result = options;
    refine_surface(ratio, result.surface);
    if (ratio == 1) return result;
    multiply_first_heights(refine_layer(ratio, conditions, result.layer), result.far_field);
    refine_sizing(ratio, result.sizing);
    result.fineness *= ratio;
    validate(result);
    return result;
}

CaseOptions with_scale(const CaseOptions& options, double scale) {
    require_in_range(positive_numbers, scale, "scale");
    CaseOptions result = options;
    result.vertices.reset();
    result.cells.reset();
    refine_surface(scale, result.surface);
    if (scale == 1) return result;
    LayerOptions& layer = result.layer;
    layer.max_ray_angle_deg = std::min(layer.max_ray_angle_deg / scale, 90.0);
    if (!layer.layers && layer.growth_law != GrowthLaw::aflr)
        layer.growth = core::pow_reproducible(layer.growth, 1 / scale);
    refine_sizing(scale, result.sizing);
    result.sizing.gradation = std::min(result.sizing.gradation, 1.0);
    result.fineness *= scale;
    validate(result);
    return result;
}

}  // namespace lamina
