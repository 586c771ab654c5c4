#include "app/flow_text.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include <fmt/format.h>

#include <lamina/flow.hpp>

#include "app/progress.hpp"
#include "app/summary.hpp"

namespace lamina::app {

namespace {

const char* state_name(BoundaryLayerState state) {
    if (state == BoundaryLayerState::laminar) return "laminar";
    return state == BoundaryLayerState::turbulent ? "turbulent" : "separated";
}

std::string flow_table(const Flow& flow) {
    std::string text = "element,side,x,y,s,speed,cp,momentum,displacement,thickness,shape,skin_friction,state\n";
    for (const ElementFlow& element : flow.elements)
        for (const auto& [name, side] : {std::pair("upper", &element.upper), std::pair("lower", &element.lower)})
            for (const FlowPoint& p : *side)
                text += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{}\n", element.name, name, p.at.x, p.at.y, p.s,
                                    p.speed, p.pressure_coefficient, p.momentum, p.displacement, p.thickness, p.shape,
                                    p.skin_friction, state_name(p.state));
    return text;
}

std::string side_line(const std::string& name, const std::vector<FlowPoint>& side, bool has_layers) {
    const auto largest = [&](double FlowPoint::*member) {
        return *std::max_element(side.begin(), side.end(),
                                 [&](const FlowPoint& a, const FlowPoint& b) { return a.*member < b.*member; });
    };
    const FlowPoint fastest = largest(&FlowPoint::speed);
    std::string text = fmt::format("least pressure coefficient {:.4g} at ({:.4g}, {:.4g})",
                                   fastest.pressure_coefficient, fastest.at.x, fastest.at.y);
    if (has_layers) {
        text += fmt::format(", largest thickness {:.4g}, largest skin friction {:.4g}",
                            largest(&FlowPoint::thickness).thickness, largest(&FlowPoint::skin_friction).skin_friction);
        const auto separated = std::find_if(
            side.begin(), side.end(), [](const FlowPoint& p) { return p.state == BoundaryLayerState::separated; });
        const auto attached = std::find_if(separated, side.end(),
                                           [](const FlowPoint& p) { return p.state != BoundaryLayerState::separated; });
        if (separated != side.end())
            text += fmt::format(
                ", separated from ({:.4g}, {:.4g}) {}", separated->at.x, separated->at.y,
                attached == side.end() ? "on" : fmt::format("to ({:.4g}, {:.4g})", attached->at.x, attached->at.y));
    }
    return summary_line(name, text);
}

std::string flow_summary(const FoundFlow& found) {
    const Flow& flow = found.flow;
    const bool has_layers = found.has_layers;
    std::string text = fmt::format("flow at {} degrees: lift coefficient {:.4f}", flow.alpha_deg, flow.lift);
    if (has_layers && !flow.estimated)
        text +=
            fmt::format(", drag coefficient {:.5f}, moment coefficient {:.4f}", found.forces.drag, found.forces.moment);
    text += fmt::format(", based on the chord {:.6g}\n", flow.chord);
    if (is_undisplaced(found)) text += undisplaced_line;
    for (std::size_t e = 0; e < flow.elements.size(); ++e) {
        const ElementFlow& element = flow.elements[e];
        text += fmt::format("{}: lift coefficient {:.4f}, stagnation point ({:.5g}, {:.5g})\n", element.name,
                            element.lift, element.stagnation.x, element.stagnation.y);
        if (found.is_coupled())
            text += fmt::format(
                "  layers turbulent from {:.4f} of the extent in x on the upper, {:.4f} on the lower side\n",
                found.transitions[e].upper, found.transitions[e].lower);
        text += side_line("upper", element.upper, has_layers) + side_line("lower", element.lower, has_layers);
    }
    return text;
}

/// Returns the pressures on each element against x, from the upper trailing edge round the nose to the lower one.
std::vector<ChartCurve> pressure_curves(const Flow& flow) {
    std::vector<ChartCurve> curves;
    for (const ElementFlow& element : flow.elements) {
        ChartCurve& curve = curves.emplace_back(ChartCurve{element.name, {}});
        const auto pressure = [](const FlowPoint& p) { return Point{p.at.x, p.pressure_coefficient}; };
        std::transform(element.upper.rbegin(), element.upper.rend(), std::back_inserter(curve.points), pressure);
        std::transform(element.lower.begin(), element.lower.end(), std::back_inserter(curve.points), pressure);
    }
    return curves;
}

/// Returns the pressures to show: all, unless few points at sharp corners, where speed has no limit, hide the rest.
std::array<double, 2> pressures_shown(const std::vector<ChartCurve>& curves) {
    constexpr std::size_t share = 25;
    constexpr double room = 2;
    std::vector<double> values;
    for (const ChartCurve& curve : curves)
        for (const Point p : curve.points) values.push_back(p.y);
    std::sort(values.begin(), values.end());
    const double usual = values[values.size() / share];
    return {std::max(values.front(), std::min(room * usual, -1.0)), 1};
}

std::string compressible_table(const CompressibleFlow& flow) {
    std::string text = "element,side,x,y,cp,mach,momentum,displacement,skin_friction\n";
    for (const CompressibleElement& element : flow.elements)
        for (const auto& [name, side] : {std::pair("upper", &element.upper), std::pair("lower", &element.lower)})
            for (const CompressibleWallPoint& p : side->points)
                text += fmt::format("{},{},{},{},{},{},{},{},{}\n", element.name, name, p.at.x, p.at.y,
                                    p.pressure_coefficient, p.mach, p.momentum, p.displacement, p.skin_friction);
    return text;
}

std::string compressible_side_line(const std::string& name, const CompressibleSide& side) {
    const auto fastest = std::max_element(
        side.points.begin(), side.points.end(),
        [](const CompressibleWallPoint& a, const CompressibleWallPoint& b) { return a.mach < b.mach; });
    std::string text =
        fmt::format("largest Mach number {:.4g} at ({:.4g}, {:.4g})", fastest->mach, fastest->at.x, fastest->at.y);
    for (const WallShock& shock : side.shocks)
        text += fmt::format(", shock at {:.3f} of the element's extent in x, ({:.4g}, {:.4g}), Mach {:.3f} to {:.3f}",
                            shock.position, shock.at.x, shock.at.y, shock.mach_ahead, shock.mach_behind);
    const auto separated = std::find_if(side.points.begin(), side.points.end(),
                                        [](const CompressibleWallPoint& p) { return p.skin_friction < 0; });
    if (separated != side.points.end()) {
        const auto attached = std::find_if(separated, side.points.end(),
                                           [](const CompressibleWallPoint& p) { return p.skin_friction > 0; });
        text += fmt::format(
            ", separated from ({:.4g}, {:.4g}) {}", separated->at.x, separated->at.y,
            attached == side.points.end() ? "on" : fmt::format("to ({:.4g}, {:.4g})", attached->at.x, attached->at.y));
    }
    return summary_line(name, text);
}

std::string compressible_summary(const CompressibleFlow& flow) {
    std::string text = fmt::format(
        "compressible flow at Mach {:.4g} and {} degrees, with{} boundary layers: lift "
        "coefficient {:.4f}, drag coefficient {:.4f}",
        flow.mach, flow.alpha_deg, flow.has_layers ? "" : "out", flow.lift, flow.drag);
    text += flow.has_layers ? fmt::format(", {:.4f} of them of boundary layers and {:.4f} of shocks", flow.viscous_drag,
                                          flow.wave_drag)
                            : std::string(" of shocks");
    text += fmt::format(", based on the chord {:.6g}\n", flow.chord);
    text += fmt::format("largest Mach number {:.4g}; sonic pressure coefficient cp* {:.4g}\n", flow.largest_mach,
                        flow.critical_pressure_coefficient);
    for (const CompressibleElement& element : flow.elements)
        text += element.name + ":\n" + compressible_side_line("upper", element.upper) +
                compressible_side_line("lower", element.lower);
    const bool has_shock =
        std::any_of(flow.elements.begin(), flow.elements.end(), [](const CompressibleElement& element) {
            return !element.upper.shocks.empty() || !element.lower.shocks.empty();
        });
    if (has_shock && !flow.has_layers && flow.mach < 1)
        text += "without boundary layers shocks lie too far back, on RAE 2822 by 6 to 9 % of the chord\n";
    if (!flow.converged)
        text += fmt::format("the flow is not steady after {} steps: the numbers are rough\n", flow.iterations);
    return text;
}

/// Returns the pressures on each element, and the one at which the flow is as fast as sound.
std::vector<ChartCurve> pressure_curves(const CompressibleFlow& flow) {
    std::vector<ChartCurve> curves;
    double first = HUGE_VAL, last = -HUGE_VAL;
    for (const CompressibleElement& element : flow.elements) {
        ChartCurve& curve = curves.emplace_back(ChartCurve{element.name, {}});
        const auto pressure = [](const CompressibleWallPoint& p) { return Point{p.at.x, p.pressure_coefficient}; };
        std::transform(element.upper.points.rbegin(), element.upper.points.rend(), std::back_inserter(curve.points),
                       pressure);
        std::transform(element.lower.points.begin(), element.lower.points.end(), std::back_inserter(curve.points),
                       pressure);
        for (const Point p : curve.points) first = std::min(first, p.x), last = std::max(last, p.x);
    }
    const double sonic = flow.critical_pressure_coefficient;
    curves.push_back({"cp*", {{first, sonic}, {last, sonic}}});
    return curves;
}

FlowText flow_text(const FoundFlow& found, const std::string& before) {
    std::vector<ChartCurve> curves = pressure_curves(found.flow);
    const std::array<double, 2> pressures = pressures_shown(curves);
    return {flow_table(found.flow), before + flow_summary(found), std::move(curves), pressures};
}

FlowText flow_text(CompressibleFlow flow) {
    std::vector<ChartCurve> curves = pressure_curves(flow);
    double low = 0, high = 0;
    for (const ChartCurve& curve : curves)
        for (const Point p : curve.points) low = std::min(low, p.y), high = std::max(high, p.y);
    std::string table = compressible_table(flow), summary = compressible_summary(flow);
    return {std::move(table), std::move(summary), std::move(curves), {low, high}, std::move(flow)};
}

}  // namespace

void draw_mach_numbers(const CompressibleFlow& flow, const std::string& file) {
    constexpr double margin = 0.6;  // of the longer side of the box round the bodies
    Box box;
    for (const CompressibleElement& element : flow.elements)
        for (const CompressibleSide* side : {&element.upper, &element.lower})
            for (const CompressibleWallPoint& p : side->points) box.include(p.at);
    const double away = margin * std::max(box.width(), box.height());
    Mesh mesh;
    mesh.points = flow.points;
    mesh.triangles = flow.triangles;
    const PlotWindow window{.box = {box.lower.x - away, box.upper.x + away, box.lower.y - away, box.upper.y + away}};
    plot_field(mesh, {"Mach number", flow.mach_numbers, 1.0}, file,
               {.window = window, .axes = true, .color_bar = true});
}

FlowText flow_text(FoundFlow found, const std::optional<double>& mach) {
    if (found.compressible) return flow_text(std::move(*found.compressible));
    print_warnings(found.flow.warnings);
    const std::string before =
        !mach ? ""
              : fmt::format(
                    "Mach {:.4g} is below the critical Mach number, but for short peaks: pressures and lift of "
                    "incompressible flow, after Karman and Tsien\n",
                    *mach);
    return flow_text(found, before);
}

}  // namespace lamina::app
