// The flow decides what an expert would guess (docs/decisions/0036).
#include "pipeline/flow_guidance.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <utility>
#include <variant>

#include <fmt/format.h>

#include <lamina/error.hpp>

#include "flow/corner_peaks.hpp"
#include "flow/euler/euler.hpp"
#include "flow/euler/lag_entrainment.hpp"
#include "flow/potential.hpp"
#include "flow/separation.hpp"
#include "geometry/sheets.hpp"
#include "geometry/symmetry.hpp"
#include "layers/heights/heights.hpp"
#include "pipeline/shock_sizes.hpp"

namespace lamina::pipeline {

namespace {

/// No layer is thicker than this for the boundary layer's sake, in chords of the configuration.
constexpr double thickest_layer = 0.08;
/// The pressure coefficient changes from one vertex of the wall to the next by at most this, or by so many times the
/// speed over the free stream's where that is above 1.
constexpr double max_change = 0.05;
/// No spacing is smaller than this for the flow's sake, in chords of the configuration.
constexpr double min_spacing = 2e-4;
/// Spacing at the corners of a base, in first heights; less where the flow passes them faster than the free stream.
/// With 100, y+ is a quarter too large there (docs/layer.md).
constexpr double base_corner_heights = 60;

/// Adds the heights along a side, from its stagnation point to its trailing edge.
void add_heights(const std::vector<FlowPoint>& side, std::size_t element, double most, bool reversed,
                 std::vector<layers::WallHeight>& heights) {
    const auto first = static_cast<std::ptrdiff_t>(heights.size());
    double height = 0;
    for (const FlowPoint& point : side) {
        // Layers along the wall do not follow flow that has left it.
        if (point.state != BoundaryLayerState::separated)
            height = std::max(height, std::min(room_above * point.thickness, most));
        heights.push_back({element, point.at, height});
    }
    if (reversed) std::reverse(heights.begin() + first, heights.end());
}

/// Adds spacings at both corners of a base. The cells of the fan there are as wide as the first layer is high times the
/// angle between rays.
void add_base_corners(const ElementFlow& flow, std::size_t element, const layers::LayerGrowth& growth,
                      std::vector<geometry::WallSpacing>& spacings) {
    const Point above = flow.upper.back().at, below = flow.lower.back().at;
    if (above == below) return;
    const double heights = base_corner_heights / std::max(flow.upper.back().speed, 1.0);
    const double spacing = heights * growth.first_height_on(element);
    for (const Point corner : {above, below}) spacings.push_back({element, corner, corner, spacing});
}

/// Adds spacings where the pressure changes along a side, but for the peaks at its corners and at a sharp nose.
void add_pressure_changes(const std::vector<FlowPoint>& side, const std::optional<Point>& sharp_nose,
                          std::size_t element, double chord, double fineness,
                          std::vector<geometry::WallSpacing>& spacings) {
    const auto without_peaks = [&](double (*number)(const FlowPoint&)) {
        return flow::without_corner_peaks(side, number, sharp_nose);
    };
    const std::vector<double> speeds = without_peaks([](const FlowPoint& p) { return p.speed; });
    const std::vector<double> suction = without_peaks([](const FlowPoint& p) { return -p.pressure_coefficient; });
    for (std::size_t i = 1; i < side.size(); ++i) {
        const FlowPoint &a = side[i - 1], &b = side[i];
        const double change = std::abs(suction[i] - suction[i - 1]),
                     allowed = max_change * std::max({speeds[i - 1], speeds[i], 1.0});
        const double spacing = std::max(allowed * (b.s - a.s) / change, min_spacing * chord) / fineness;
        if (spacing < b.s) spacings.push_back({element, a.at, b.at, spacing});
    }
}

/// Returns compressible flow beyond the critical Mach number. None where it is too fast to solve, and where no mesh can
/// be made to solve it on.
std::optional<CompressibleFlow> flow_beyond_critical(const Geometry& geometry, const FlowConditions& conditions,
                                                     const Flow& flow) {
    if (flow.estimated || !is_beyond_critical(flow, conditions) || *conditions.mach > flow::euler::largest_mach)
        return {};
    try {
        return solve_compressible_flow(geometry, conditions);
    } catch (const MeshError&) {
        return {};
    }
}

/// Adds what the shocks of compressible flow ask for.
void add_shocks(const CompressibleFlow& flow, double fineness, FlowGuidance& guidance) {
    ShockSizes sizes = sizes_at_shocks(flow, fineness);
    guidance.spacings.insert(guidance.spacings.end(), sizes.spacings.begin(), sizes.spacings.end());
    guidance.sources.insert(guidance.sources.end(), sizes.sources.begin(), sizes.sources.end());
    guidance.shocks.insert(guidance.shocks.end(), sizes.shocks.begin(), sizes.shocks.end());
    guidance.knows_shocks = sizes.knows_shocks;
}

/// Returns the height at the point of a chain of the same element that is nearest to p.
double nearest_height(Point p, std::span<const layers::WallHeight> chain) {
    const auto nearest =
        std::min_element(chain.begin(), chain.end(), [&](const layers::WallHeight& a, const layers::WallHeight& b) {
            return squared_length(a.at - p) < squared_length(b.at - p);
        });
    return nearest->height;
}

/// Fits the heights of an element to its sheets. Both sides of one by itself are as near to each vertex as each other,
/// and get the same heights. On those that stand on walls layers are no higher than what is left of the sheet up to its
/// tip.
void fit_to_sheets(const Element& element, std::vector<layers::WallHeight>& chain) {
    if (chain.empty()) return;
    if (geometry::is_sheet(element)) {
        const std::vector<layers::WallHeight> given = chain;
        // The sides meet at the nose, where heights of both are those of the stagnation point.
        const std::size_t n = given.size();
        std::size_t nose = 0;
        for (std::size_t i = 0; i < n; ++i)
            if (given[i].height < given[nose].height) nose = i;
        const std::span<const layers::WallHeight> upper(given.data(), nose + 1), lower(given.data() + nose, n - nose);
        for (std::size_t i = 0; i < n; ++i)
            chain[i].height = std::max(given[i].height, nearest_height(given[i].at, i <= nose ? lower : upper));
        return;
    }
    for (const SheetSides& sheet : element.sheets) {
        const auto nearest = std::min_element(chain.begin(), chain.end() - 1, [&](const auto& a, const auto& b) {
            return squared_length(a.at - sheet.begin) < squared_length(b.at - sheet.begin);
        });
        const double length = distance(sheet.begin, sheet.tip), height = std::min(nearest->height, length);
        const std::size_t e = nearest->element;
        chain.insert(nearest + 1, {{e, sheet.begin, height}, {e, sheet.tip, 0}, {e, sheet.end, height}});
    }
}

/// Returns the heights of the flow, with those on sheets.
std::vector<layers::WallHeight> heights_with_sheets(const Flow& flow, const Geometry& geometry) {
    const std::vector<layers::WallHeight> all = heights_of_flow(flow);
    std::vector<layers::WallHeight> result;
    for (std::size_t e = 0; e < geometry.elements.size(); ++e) {
        std::vector<layers::WallHeight> chain;
        std::copy_if(all.begin(), all.end(), std::back_inserter(chain),
                     [&](const layers::WallHeight& height) { return height.element == e; });
        fit_to_sheets(geometry.elements[e], chain);
        result.insert(result.end(), chain.begin(), chain.end());
    }
    return result;
}

/// Returns the first heights with which these frictions have a y+.
std::vector<double> first_heights_for(std::span<const double> frictions, double y_plus, double reynolds, double chord) {
    std::vector<double> heights;
    for (const double friction : frictions) heights.push_back(y_plus * chord / (reynolds * std::sqrt(0.5 * friction)));
    return heights;
}

/// Returns the skin friction at a point of a wall times its density, both by the free stream of this Mach number.
double friction_times_density(const CompressibleWallPoint& p, double mach) {
    const double pressure = 1 + 0.7 * mach * mach * p.pressure_coefficient;
    const double edge_temperature = (1 + 0.2 * mach * mach) / (1 + 0.2 * p.mach * p.mach);
    return p.skin_friction * pressure / (edge_temperature * (1 + 0.2 * flow::euler::recovery_factor * p.mach * p.mach));
}

}  // namespace

std::vector<double> first_heights_of_flow(const Flow& flow, double y_plus, double reynolds) {
    std::vector<double> frictions;
    for (const ElementFlow& element : flow.elements) frictions.push_back(largest_skin_friction(element));
    return first_heights_for(frictions, y_plus, reynolds, flow.chord);
}

std::vector<double> wall_frictions(const CompressibleFlow& flow) {
    std::vector<double> frictions;
    if (!flow.has_layers) return frictions;
    for (const CompressibleElement& element : flow.elements) {
        double& largest = frictions.emplace_back(0);
        for (const CompressibleSide* side : {&element.upper, &element.lower})
            for (const CompressibleWallPoint& p : side->points)
                largest = std::max(largest, friction_times_density(p, flow.mach));
        const CompressibleWallPoint &above = element.upper.points.back(), &below = element.lower.points.back();
        if (above.at == below.at) continue;
        for (const CompressibleWallPoint* corner : {&above, &below})
            largest = std::max(largest, flow::friction_rise_at_corners * friction_times_density(*corner, flow.mach));
    }
    // No height follows where the flow is separated all along an element.
    if (std::any_of(frictions.begin(), frictions.end(), [](double friction) { return !(friction > 0); })) return {};
    return frictions;
}

std::vector<layers::WallHeight> heights_of_flow(const Flow& flow) {
    std::vector<layers::WallHeight> heights;
    for (std::size_t e = 0; e < flow.elements.size(); ++e) {
        add_heights(flow.elements[e].upper, e, thickest_layer * flow.chord, true, heights);
        add_heights(flow.elements[e].lower, e, thickest_layer * flow.chord, false, heights);
    }
    return heights;
}

std::vector<geometry::WallSpacing> spacings_of_flow(const Flow& flow, const layers::LayerGrowth& growth) {
    std::vector<geometry::WallSpacing> spacings;
    // Layers that go on along the wake need no fans at the base.
    if (growth.wakes.empty())
        for (std::size_t e = 0; e < flow.elements.size(); ++e) add_base_corners(flow.elements[e], e, growth, spacings);
    for (std::size_t e = 0; e < flow.elements.size(); ++e)
        for (const auto* side : {&flow.elements[e].upper, &flow.elements[e].lower})
            add_pressure_changes(*side, flow.elements[e].sharp_nose, e, flow.chord, growth.fineness, spacings);
    return spacings;
}

std::vector<FlowSpacing> smallest_spacings(std::span<const geometry::WallSpacing> spacings, const Geometry& geometry) {
    std::vector<const geometry::WallSpacing*> smallest(geometry.elements.size(), nullptr);
    for (const geometry::WallSpacing& spacing : spacings) {
        const geometry::WallSpacing*& least = smallest[spacing.element];
        if (least == nullptr || spacing.spacing < least->spacing) least = &spacing;
    }
    std::vector<FlowSpacing> facts;
    for (std::size_t e = 0; e < smallest.size(); ++e)
        if (smallest[e] != nullptr && geometry.elements[e].resampled)
            facts.push_back(
                {geometry.elements[e].name, smallest[e]->spacing, midpoint(smallest[e]->a, smallest[e]->b)});
    return facts;
}

namespace {

/// Leaves out what is known of images of bodies, which are behind the elements of a geometry.
void leave_out_images(const Geometry& geometry, FlowGuidance& guidance, layers::LayerGrowth& growth) {
    const std::size_t elements = geometry.elements.size();
    Flow& flow = *guidance.flow;
    if (flow.elements.size() == elements) return;
    flow.elements.resize(elements);
    flow.lift = 0;
    for (const ElementFlow& element : flow.elements) flow.lift += element.lift;
    if (guidance.compressible) guidance.compressible->elements.resize(elements);
    std::erase_if(flow.warnings, [](const Warning& w) { return w.code == WarningCode::flow_separates; });
    if (std::optional<Warning> wide = flow::find_wide_wake(flow)) flow.warnings.push_back(std::move(*wide));
    const auto is_of_image = [&](const auto& fact) { return fact.element >= elements; };
    if (!guidance.wakes.empty()) guidance.wakes.resize(elements);
    if (!guidance.frictions.empty()) guidance.frictions.resize(elements);
    if (!growth.first_heights.empty()) growth.first_heights.resize(elements);
    std::erase_if(growth.least_heights, is_of_image);
    std::erase_if(growth.wakes, is_of_image);
    std::erase_if(guidance.spacings, is_of_image);
    std::erase_if(guidance.shocks, [&](const FlowShock& shock) {
        return std::none_of(geometry.elements.begin(), geometry.elements.end(),
                            [&](const Element& element) { return element.name == shock.element; });
    });
}

}  // namespace

namespace {

/// The flow at one angle of attack, and what it asks for.
struct AngleFlow {
    Flow flow;
    std::optional<CompressibleFlow> compressible{};
    std::vector<ElementWake> wakes{};
    std::vector<double> frictions{};
    std::vector<double> first_heights{};
    std::vector<layers::WallHeight> least_heights{};
};

AngleFlow flow_at_angle(const Geometry& geometry, const FlowWalls& walls, const FlowConditions& flow_conditions,
                        const LayerOptions& options, const ReferenceConditions& conditions, double fineness) {
    AngleFlow result{.flow = solve_flow(geometry, flow_conditions, walls)};
    const Flow& flow = result.flow;
    // Shocks are found round the bodies alone.
    if (!walls.pitch) result.compressible = flow_beyond_critical(geometry, flow_conditions, flow);
    if (result.compressible) result.frictions = wall_frictions(*result.compressible);
    if (!flow.estimated) result.wakes = wakes_of_flow(flow, fineness);
    if (!options.enabled) return result;
    if (const auto* y_plus = std::get_if<YPlus>(&options.first_height); y_plus && !flow.estimated)
        result.first_heights =
            layers::layer_growth(
                options, conditions,
                result.frictions.empty()
                    ? first_heights_of_flow(flow, y_plus->y_plus, *conditions.reynolds)
                    : first_heights_for(result.frictions, y_plus->y_plus, *conditions.reynolds, flow.chord))
                .first_heights;
    result.least_heights = heights_with_sheets(flow, geometry);
    return result;
}

/// Returns the smaller or larger of both numbers of each element; those of one side where the other has none.
template <class Choose>
std::vector<double> elementwise(std::vector<double> a, const std::vector<double>& b, Choose choose) {
    if (b.empty()) return a;
    if (a.empty()) return b;
    for (std::size_t e = 0; e < a.size(); ++e) a[e] = choose(a[e], b[e]);
    return a;
}

/// Raises heights to those that the flow at another angle asks for at the same points.
void raise_to(const std::vector<layers::WallHeight>& others, std::vector<layers::WallHeight>& heights) {
    for (auto first = heights.begin(); first != heights.end();) {
        const std::size_t e = first->element;
        const auto is_other = [&](const layers::WallHeight& height) { return height.element != e; };
        const auto end = std::find_if(first, heights.end(), is_other);
        std::vector<layers::WallHeight> chain;
        std::remove_copy_if(others.begin(), others.end(), std::back_inserter(chain), is_other);
        for (; first != end; ++first) first->height = std::max(first->height, layers::height_at(first->at, chain));
    }
}

/// Returns the wakes of all angles as one for each element: a fan without gaps.
std::vector<ElementWake> fan_of_wakes(const std::vector<AngleFlow>& flows, std::size_t middle) {
    std::vector<ElementWake> fan = flows[middle].wakes;
    for (std::size_t k = 0; k < flows.size(); ++k) {
        if (k == middle || flows[k].wakes.empty()) continue;
        if (fan.empty()) fan.resize(flows[k].wakes.size());
        for (std::size_t e = 0; e < fan.size(); ++e) add_to_fan(flows[k].wakes[e], fan[e]);
    }
    for (std::size_t k = 0; k + 1 < flows.size(); ++k)
        for (std::size_t e = 0; e < fan.size() && !flows[k].wakes.empty() && !flows[k + 1].wakes.empty(); ++e)
            close_gap(flows[k].wakes[e], flows[k + 1].wakes[e], fan[e]);
    return fan;
}

bool is_separated(const Flow& flow) {
    return std::any_of(flow.warnings.begin(), flow.warnings.end(),
                       [](const Warning& warning) { return warning.code == WarningCode::flow_separates; });
}

/// Returns what the flow at one angle would ask for alone.
AngleDecisions decisions_at_angle(const AngleFlow& at, std::span<const geometry::WallSpacing> spacings) {
    AngleDecisions decisions{.alpha_deg = at.flow.alpha_deg, .lift = at.flow.lift};
    if (!at.first_heights.empty())
        decisions.first_height = *std::min_element(at.first_heights.begin(), at.first_heights.end());
    for (const layers::WallHeight& least : at.least_heights)
        decisions.least_thickness = std::max(decisions.least_thickness, least.height);
    for (const geometry::WallSpacing& wall : spacings)
        if (decisions.smallest_spacing == 0 || wall.spacing < decisions.smallest_spacing)
            decisions.smallest_spacing = wall.spacing;
    decisions.separated = is_separated(at.flow);
    return decisions;
}

/// Adds the warnings of the flow at one angle of several, which say at which.
void add_warnings_at_angle(const Flow& at, Flow& flow) {
    for (Warning warning : at.warnings) {
        warning.message = fmt::format("at {} degrees: {}", at.alpha_deg, warning.message);
        flow.warnings.push_back(std::move(warning));
    }
}

}  // namespace

FlowGuidance guide_by_flow(const Geometry& given, const FlowWalls& walls, const FlowConditions& flow_conditions,
                           const LayerOptions& options, const ReferenceConditions& conditions,
                           layers::LayerGrowth& growth) {
    const Geometry geometry = geometry::with_images(given);
    const std::vector<FlowConditions> angles = conditions_of_angles(flow_conditions);
    std::vector<AngleFlow> flows;
    flows.reserve(angles.size());
    for (const FlowConditions& angle : angles)
        flows.push_back(flow_at_angle(geometry, walls, angle, options, conditions, growth.fineness));
    const auto nearest =
        std::min_element(angles.begin(), angles.end(), [&](const FlowConditions& a, const FlowConditions& b) {
            return std::abs(a.alpha_deg - flow_conditions.alpha_deg) <
                   std::abs(b.alpha_deg - flow_conditions.alpha_deg);
        });
    const auto middle = static_cast<std::size_t>(nearest - angles.begin());

    FlowGuidance guidance;
    guidance.flow = flows[middle].flow;
    if (flows.size() > 1) {
        guidance.flow->warnings.clear();
        for (const AngleFlow& at : flows) add_warnings_at_angle(at.flow, *guidance.flow);
    }
    guidance.frictions = flows[middle].frictions;
    guidance.wakes = fan_of_wakes(flows, middle);
    growth.first_heights = flows[middle].first_heights;
    growth.least_heights = flows[middle].least_heights;
    for (std::size_t k = 0; k < flows.size(); ++k) {
        if (k == middle) continue;
        const auto smaller = [](double a, double b) { return std::min(a, b); };
        const auto larger = [](double a, double b) { return std::max(a, b); };
        growth.first_heights = elementwise(std::move(growth.first_heights), flows[k].first_heights, smaller);
        guidance.frictions = elementwise(std::move(guidance.frictions), flows[k].frictions, larger);
        raise_to(flows[k].least_heights, growth.least_heights);
    }
    if (options.enabled && options.wake_layers)
        growth.wakes = wake_lines(*guidance.flow, guidance.wakes, growth.least_heights);
    for (const AngleFlow& at : flows) {
        const std::size_t own = guidance.spacings.size();
        if (!at.flow.estimated) {
            const std::vector<geometry::WallSpacing> spacings = spacings_of_flow(at.flow, growth);
            guidance.spacings.insert(guidance.spacings.end(), spacings.begin(), spacings.end());
        }
        if (at.compressible) add_shocks(*at.compressible, growth.fineness, guidance);
        if (flows.size() > 1)
            guidance.angles.push_back(decisions_at_angle(at, std::span(guidance.spacings).subspan(own)));
    }
    guidance.compressible = std::move(flows[middle].compressible);
    leave_out_images(given, guidance, growth);
    return guidance;
}

}  // namespace lamina::pipeline
