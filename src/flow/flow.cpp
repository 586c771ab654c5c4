// The flow round the bodies: panels, their solution and its check, sides.
#include <lamina/flow.hpp>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/angles.hpp"
#include "flow/boundary_layer.hpp"
#include "flow/contour.hpp"
#include "flow/corner_peaks.hpp"
#include "flow/panel_system.hpp"
#include "flow/potential.hpp"
#include "flow/separation.hpp"
#include "flow/sides.hpp"

namespace lamina::flow {

namespace {

/// A defect of a solution, with the worst place.
struct Defect {
    std::size_t element;
    Point at;
    double number;
    std::string text;
};

std::optional<Defect> find_wild_speed(std::span<const PanelSheet> sheets) {
    for (std::size_t e = 0; e < sheets.size(); ++e) {
        const PanelSheet& sheet = sheets[e];
        double fastest = 0;
        std::size_t at = 0;
        for (std::size_t i = 0; i < sheet.strengths.size(); ++i) {
            const double speed = std::abs(sheet.strengths[i]);
            if (!std::isfinite(speed))
                return Defect{e, sheet.nodes[i], speed, "the equations of the panel method have no solution"};
            if (speed <= fastest) continue;
            fastest = speed;
            at = i;
        }
        if (fastest > max_flow_speed)
            return Defect{e, sheet.nodes[at], fastest,
                          fmt::format("the panel method gives {:.0f} times the free stream's speed", fastest)};
    }
    return std::nullopt;
}

/// Looks at the velocities through the middles of some panels, whose median tells whether the panels are short enough
/// for the flow. Beside sharp corners, where the velocity is infinite, no panel is.
std::optional<Defect> find_leak(const Flow& flow) {
    constexpr std::size_t max_samples = 40;
    const std::span<const PanelSheet> sheets = sheets_of(flow);
    const SheetVelocity velocity(flow);
    for (std::size_t e = 0; e < sheets.size(); ++e) {
        const PanelSheet& sheet = sheets[e];
        const std::size_t panels = sheet.nodes.size() - 1, stride = 1 + panels / max_samples;
        std::vector<double> leaks;
        for (std::size_t i = stride / 2; i < panels; i += stride) {
            const Point a = sheet.nodes[i], b = sheet.nodes[i + 1];
            leaks.push_back(std::abs(cross(unit(b - a), velocity(midpoint(a, b)))));
        }
        const auto median = leaks.begin() + static_cast<std::ptrdiff_t>(leaks.size() / 2);
        std::nth_element(leaks.begin(), median, leaks.end());
        if (!(*median <= max_flow_leak))
            return Defect{e, sheet.nodes.front(), *median, "the flow of the panel method crosses the wall"};
    }
    return std::nullopt;
}

std::optional<Defect> add_elements(Flow& flow) {
    for (std::size_t e = 0; e < flow.panels->sheets.size(); ++e) {
        const PanelSheet& sheet = flow.panels->sheets[e];
        std::optional<ElementFlow> sides = make_sides(sheet);
        if (!sides) return Defect{e, sheet.nodes.front(), 0, "the flow arrives at its trailing edge alone"};
        sides->lift = lift_of_pressures(sheet, flow.alpha_deg) / flow.chord;
        flow.elements.push_back(std::move(*sides));
    }
    return std::nullopt;
}

/// Makes the flow an estimate, and says why.
void fall_back(Flow& flow, std::span<const Contour> contours, const Geometry& geometry, const Defect& defect) {
    flow.estimated = true;
    flow.panels.reset();
    flow.elements.clear();
    for (const Contour& contour : contours) flow.elements.push_back(make_flat_plates(contour.nodes));
    const std::string& name = geometry.elements[defect.element].name;
    flow.warnings.push_back(
        {WarningCode::flow_estimated, name, defect.at, defect.number, "",
         fmt::format("{} at ({:.6g}, {:.6g}) of {}; the flow along all walls is taken for that along flat plates",
                     defect.text, defect.at.x, defect.at.y, name)});
}

/// Returns the speeds along a side as its boundary layer meets them.
std::vector<EdgePoint> edge_speeds(const std::vector<FlowPoint>& side, const std::optional<Point>& sharp_nose) {
    const std::vector<double> speeds = without_corner_peaks(
        side, [](const FlowPoint& p) { return p.speed; }, sharp_nose);
    std::vector<EdgePoint> edge(side.size());
    for (std::size_t i = 0; i < side.size(); ++i) edge[i] = {side[i].s, speeds[i]};
    return edge;
}

void add_boundary_layer(std::vector<FlowPoint>& side, const std::optional<Point>& sharp_nose, double viscosity,
                        bool turbulent) {
    const std::vector<LayerPoint> layer =
        boundary_layer(edge_speeds(side, sharp_nose), {.viscosity = viscosity, .turbulent = turbulent});
    for (std::size_t i = 0; i < side.size(); ++i) {
        side[i].momentum = layer[i].momentum;
        side[i].displacement = layer[i].displacement;
        side[i].thickness = layer[i].thickness;
        side[i].shape = layer[i].shape;
        side[i].skin_friction = layer[i].skin_friction;
        side[i].state = layer[i].state;
    }
}

}  // namespace

Flow with_share_of_lift(Flow flow, double share) {
    const auto blend = [&](double& with, double without) { with = without + share * (with - without); };
    if (!flow.panels) return flow;
    PanelSolution panels = *flow.panels;
    for (std::size_t e = 0; e < panels.sheets.size(); ++e) {
        PanelSheet& sheet = panels.sheets[e];
        const PanelSheet& without = panels.without_lift[e];
        for (std::size_t i = 0; i < sheet.strengths.size(); ++i) blend(sheet.strengths[i], without.strengths[i]);
        blend(sheet.base_strength, without.base_strength);
        blend(sheet.base_source, without.base_source);
    }
    flow.panels = std::make_shared<const PanelSolution>(std::move(panels));
    return flow;
}

}  // namespace lamina::flow

namespace lamina {

using namespace flow;

Flow solve_flow(const Geometry& geometry, const FlowConditions& conditions, const FlowWalls& walls) {
    const ReferenceConditions reference = reference_conditions(conditions, geometry);
    Flow flow;
    flow.alpha_deg = reference.alpha_deg;
    flow.chord = reference.chord;
    const std::vector<Contour> contours = make_contours(geometry);
    flow.panels = std::make_shared<const PanelSolution>(solve_panels(contours, flow.alpha_deg, walls));
    std::optional<Defect> defect = find_wild_speed(flow.panels->sheets);
    if (!defect) defect = find_leak(flow);
    if (!defect) defect = add_elements(flow);
    if (defect) fall_back(flow, contours, geometry, *defect);
    double total = 0;
    for (const PanelSheet& sheet : sheets_of(flow)) total += circulation(sheet);
    flow.lift = -2 * total / flow.chord;
    for (std::size_t e = 0; e < flow.elements.size(); ++e) {
        ElementFlow& element = flow.elements[e];
        element.name = geometry.elements[e].name;
        element.sharp_nose = contours[e].sharp_nose;
        if (!reference.reynolds) continue;
        for (auto* side : {&element.upper, &element.lower})
            add_boundary_layer(*side, element.sharp_nose, flow.chord / *reference.reynolds, !is_laminar(reference));
    }
    if (std::optional<Warning> wide; reference.reynolds && (wide = find_wide_wake(flow)))
        flow.warnings.push_back(std::move(*wide));
    return flow;
}

double largest_on_walls(const Flow& flow, double FlowPoint::*number) {
    double largest = 0;
    for (const ElementFlow& element : flow.elements) largest = std::max(largest, largest_on_walls(element, number));
    return largest;
}

double largest_on_walls(const ElementFlow& element, double FlowPoint::*number) {
    double largest = 0;
    for (const auto* side : {&element.upper, &element.lower})
        for (const FlowPoint& point : *side) largest = std::max(largest, point.*number);
    return largest;
}

double largest_skin_friction(const ElementFlow& element) {
    const FlowPoint &above = element.upper.back(), &below = element.lower.back();
    const double at_corners = above.at == below.at ? 0 : std::max(above.skin_friction, below.skin_friction);
    return std::max(largest_on_walls(element, &FlowPoint::skin_friction), friction_rise_at_corners * at_corners);
}

Point flow_velocity(const Flow& flow, Point p) { return SheetVelocity(flow)(p); }

}  // namespace lamina
