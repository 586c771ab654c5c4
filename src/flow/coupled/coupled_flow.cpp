#include <lamina/coupled_flow.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "core/reproducible_math.hpp"
#include "flow/boundary_layer.hpp"
#include "flow/coupled/solver.hpp"
#include "flow/panel_system.hpp"
#include "flow/sides.hpp"

namespace lamina::flow::coupled {

namespace {

/// Opens a trailing edge that is thinner than this share of the extent, by moving both sides apart with the third power of the
/// distance from the nose. Between sides that are closer to each other than panels are long, sources of one side leak to the
/// other: lift of the sharp NACA 0012 at a Reynolds number of 1e6 and 2 degrees is 0.15 to 0.21 with other panels, and 0.208
/// to 0.213 with bases of 0.0005 to 0.002.
void open_trailing_edge(Contour& contour) {
    constexpr double least_base = 5e-4;
    std::vector<Point>& nodes = contour.nodes;
    const double width = distance(nodes.front(), nodes.back()), missing = least_base * contour.extent - width;
    if (contour.rounded || missing <= 0) return;
    const Point across = perpendicular(leaving_direction(nodes)), end = midpoint(nodes.front(), nodes.back());
    const auto farther = [&](Point a, Point b) { return distance(a, end) < distance(b, end); };
    const auto nose = std::max_element(nodes.begin(), nodes.end(), farther);
    const double reach = distance(*nose, end);
    const Point front = *nose;
    for (auto p = nodes.begin(); p != nodes.end(); ++p) {
        const double share = std::clamp(dot(*p - front, end - front) / (reach * reach), 0.0, 1.0);
        *p = *p + (p < nose ? 0.5 : -0.5) * missing * share * share * share * across;
    }
    contour.blunt = true;
}

Contour to_solve(Contour contour, double chord) {
    open_trailing_edge(contour);
    for (Point& p : contour.nodes) p = (1 / chord) * p;
    contour.extent /= chord;
    return contour;
}

Box box_of(const Contour& contour) {
    Box box;
    for (const Point p : contour.nodes) box.include(p);
    return box;
}

/// Returns the arc length along the outline at which it passes this x on its way from the trailing edge (or, on the lower side,
/// on its way to it), that of the trailing edge without one.
double arc_of_trip(const Influence& flow, const Box& box, const std::optional<double>& trip, bool upper) {
    const double whole = flow.s[flow.wall - 1];
    if (!trip || *trip >= 1) return upper ? 0 : whole;
    const double x = box.lower.x + *trip * box.width();
    const auto node = [&](std::size_t k) { return upper ? k : flow.wall - 1 - k; };
    for (std::size_t k = 0; k + 1 < flow.wall; ++k) {
        const std::size_t a = node(k), b = node(k + 1);
        if (flow.at[b].x > x) continue;
        const double share = (flow.at[a].x - x) / (flow.at[a].x - flow.at[b].x);
        return flow.s[a] + std::clamp(share, 0.0, 1.0) * (flow.s[b] - flow.s[a]);
    }
    return upper ? 0 : whole;
}

/// Returns the share of the section's extent in x at an arc length along its outline.
double share_at(const Influence& flow, const Box& box, double s) {
    const auto first = flow.s.begin(), end = first + static_cast<std::ptrdiff_t>(flow.wall);
    const auto behind = std::clamp(std::upper_bound(first, end, s), first + 1, end - 1);
    const auto j = static_cast<std::size_t>(behind - first);
    const double t = (s - flow.s[j - 1]) / (flow.s[j] - flow.s[j - 1]);
    return (flow.at[j - 1].x + t * (flow.at[j].x - flow.at[j - 1].x) - box.lower.x) / box.width();
}

/// Returns the sheet along the walls in the units of the input.
PanelSheet sheet_of(const Contour& contour, const CoupledLayers& layers, std::size_t nose) {
    PanelSheet sheet{contour.nodes, {}};
    for (std::size_t i = 0; i < contour.nodes.size(); ++i)
        sheet.strengths.push_back(i <= nose ? -layers.stations[i].speed : layers.stations[i].speed);
    return sheet;
}

/// Puts the layers of a stretch into the points of a side, which begins with the stagnation point.
void add_layers(const Stretch& stretch, const CoupledLayers& layers, const LayerConditions& conditions, double chord,
                std::vector<FlowPoint>& side) {
    for (std::size_t k = 0; k < stretch.places.size() && k + 1 < side.size(); ++k) {
        const Station& s = layers.stations[stretch.places[k]];
        const bool laminar = k < stretch.transition;
        const Closure c = close_layer(s.shear, s.momentum, s.displacement, s.speed, conditions.viscosity,
                                      laminar ? Regime::laminar : Regime::turbulent);
        FlowPoint& p = side[k + 1];
        p.momentum = chord * s.momentum;
        p.displacement = chord * s.displacement;
        p.thickness = chord * c.thickness.value;
        p.shape = c.shape.value;
        p.skin_friction = c.friction.value * s.speed * s.speed;
        p.state = p.skin_friction < 0 ? BoundaryLayerState::separated
                  : laminar           ? BoundaryLayerState::laminar
                                      : BoundaryLayerState::turbulent;
    }
    if (side.size() < 2) return;
    side[0].momentum = side[1].momentum, side[0].displacement = side[1].displacement;
    side[0].thickness = side[1].thickness, side[0].shape = side[1].shape;
}

/// Returns the drag coefficient: that of the momentum thickness far behind, which the one at the end of the wake becomes.
double wake_drag(const Station& end) {
    return 2 * end.momentum * core::pow_reproducible(end.speed, 0.5 * (end.shape() + 5));
}

Warning not_coupled(const Flow& flow) {
    return {
        WarningCode::flow_separates,
        flow.elements.front().name,
        {},
        flow.alpha_deg,
        "degrees",
        fmt::format("{} at {} degrees: flow and boundary layers found no common solution; the layers do not displace "
                    "the flow, and lift is too large",
                    flow.elements.front().name, flow.alpha_deg)};
}

/// What flows round one section have in common.
class Section {
public:
    Section(const Geometry& geometry, double chord, const TransitionOptions& transition)
        : contour_(make_contours(geometry).front()),
          body_(make_response(to_solve(contour_, chord))),
          box_(box_of(body_.contour)),
          chord_(chord),
          transition_(transition) {}

    void solve(double reynolds, CoupledFlow& found) {
        const Influence influence = influence_at(body_, found.flow.alpha_deg);
        const LayerConditions conditions{1 / reynolds, transition_.critical_exponent};
        const Trips trips{
            arc_of_trip(influence, box_, transition_.trip, true),
            arc_of_trip(influence, box_, transition_.trip_lower ? transition_.trip_lower : transition_.trip, false)};
        CoupledLayers layers = solve_layers(influence, conditions, trips, nullptr);
        if (!layers.converged && last_) layers = solve_layers(influence, conditions, trips, &*last_);
        found.steps = layers.steps;
        found.converged = layers.converged && fill(influence, layers, conditions, found);
        if (found.converged)
            last_ = std::move(layers);
        else
            found.flow.warnings.push_back(not_coupled(found.flow));
    }

private:
    /// Returns whether the flow comes from a stagnation point.
    bool fill(const Influence& influence, const CoupledLayers& layers, const LayerConditions& conditions,
              CoupledFlow& found) const {
        const auto& [upper, lower, wake] = layers.stretches;
        const PanelSheet sheet = sheet_of(contour_, layers, upper.places.front());
        std::optional<ElementFlow> sides = make_sides(sheet);
        if (!sides) return false;
        ElementFlow& element = found.flow.elements.front();
        element.stagnation = sides->stagnation;
        element.upper = std::move(sides->upper);
        element.lower = std::move(sides->lower);
        add_layers(upper, layers, conditions, chord_, element.upper);
        add_layers(lower, layers, conditions, chord_, element.lower);
        element.lift = found.flow.lift = lift_of_pressures(sheet, found.flow.alpha_deg) / chord_;
        found.forces = flow_forces(found.flow);
        found.forces.drag = wake_drag(layers.stations.back());
        found.transition_upper = share_at(influence, box_, layers.stagnation - upper.turbulent_from);
        found.transition_lower = share_at(influence, box_, layers.stagnation + lower.turbulent_from);
        found.flow.warnings.clear();  // which are about layers that leave flow that nothing displaces
        return true;
    }

    Contour contour_;
    BodyResponse body_;
    Box box_;
    double chord_;
    const TransitionOptions& transition_;
    std::optional<CoupledLayers> last_;
};

}  // namespace

}  // namespace lamina::flow::coupled

namespace lamina {

bool can_be_coupled(const Geometry& geometry, const ReferenceConditions& reference, const FlowWalls& walls) {
    return geometry.elements.size() == 1 && reference.reynolds && !flow::is_laminar(reference) && !walls.below &&
           !walls.above && !walls.pitch;
}

std::vector<CoupledFlow> solve_coupled_flow(const Geometry& geometry, std::span<const FlowConditions> conditions,
                                            const TransitionOptions& transition) {
    validate(transition);
    std::optional<flow::coupled::Section> section;
    std::vector<CoupledFlow> flows;
    for (const FlowConditions& each : conditions) {
        const ReferenceConditions reference = reference_conditions(each, geometry);
        assert(can_be_coupled(geometry, reference));
        CoupledFlow& found = flows.emplace_back(CoupledFlow{solve_flow(geometry, each), {}});
        found.forces = flow_forces(found.flow);
        if (found.flow.estimated) continue;
        if (!section) section.emplace(geometry, reference.chord, transition);
        section->solve(*reference.reynolds, found);
    }
    return flows;
}

}  // namespace lamina
