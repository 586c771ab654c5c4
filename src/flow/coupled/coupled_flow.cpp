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

/// Opens a trailing edge that is thinner than this share of the extent, by moving both sides apart with the third power
/// of the distance from the nose. Between sides that are closer to each other than panels are long, sources of one side
/// leak to the other: lift of the sharp NACA 0012 at a Reynolds number of 1e6 and 2 degrees is 0.15 to 0.21 with other
/// panels, and 0.208 to 0.213 with bases of 0.0005 to 0.002.
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

/// The wall of a body, with arc lengths, and its extent.
struct Wall {
    std::span<const Point> nodes;
    std::span<const double> s;
    Box box;
};

Wall wall_of(const Influence& flow, std::size_t body) {
    const auto [first, end, wake_end] = flow.bodies[body];
    Wall wall{std::span(flow.at).subspan(first, end - first), std::span(flow.s).subspan(first, end - first), {}};
    for (const Point p : wall.nodes) wall.box.include(p);
    return wall;
}

/// Returns the arc length along the outline at which it passes this x on its way from the trailing edge (or, on the
/// lower side, on its way to it), that of the trailing edge without one.
double arc_of_trip(const Wall& wall, const std::optional<double>& trip, bool upper) {
    const std::size_t n = wall.nodes.size();
    const double whole = wall.s[n - 1];
    if (!trip || *trip >= 1) return upper ? 0 : whole;
    const double x = wall.box.lower.x + *trip * wall.box.width();
    const auto node = [&](std::size_t k) { return upper ? k : n - 1 - k; };
    for (std::size_t k = 0; k + 1 < n; ++k) {
        const std::size_t a = node(k), b = node(k + 1);
        if (wall.nodes[b].x > x) continue;
        const double share = (wall.nodes[a].x - x) / (wall.nodes[a].x - wall.nodes[b].x);
        return wall.s[a] + std::clamp(share, 0.0, 1.0) * (wall.s[b] - wall.s[a]);
    }
    return upper ? 0 : whole;
}

std::vector<Trips> trips_of(const Influence& flow, const TransitionOptions& transition) {
    std::vector<Trips> trips;
    for (std::size_t e = 0; e < flow.bodies.size(); ++e) {
        const Wall wall = wall_of(flow, e);
        trips.push_back({arc_of_trip(wall, transition.trip, true),
                         arc_of_trip(wall, transition.trip_lower ? transition.trip_lower : transition.trip, false)});
    }
    return trips;
}

/// Returns the share of a wall's extent in x at an arc length along it.
double share_at(const Wall& wall, double s) {
    const auto behind =
        std::clamp(std::upper_bound(wall.s.begin(), wall.s.end(), s), wall.s.begin() + 1, wall.s.end() - 1);
    const auto j = static_cast<std::size_t>(behind - wall.s.begin());
    const double t = (s - wall.s[j - 1]) / (wall.s[j] - wall.s[j - 1]);
    return (wall.nodes[j - 1].x + t * (wall.nodes[j].x - wall.nodes[j - 1].x) - wall.box.lower.x) / wall.box.width();
}

/// Returns the sheet along the wall of a body in the units of the input.
PanelSheet sheet_of(const Contour& contour, const CoupledLayers& layers, std::size_t first, std::size_t nose) {
    PanelSheet sheet{contour.nodes, {}};
    for (std::size_t i = first; i < first + contour.nodes.size(); ++i)
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

/// Returns the drag coefficient: that of the momentum thickness far behind, which the one at the end of the wake
/// becomes.
double wake_drag(const Station& end) {
    return 2 * end.momentum * core::pow_reproducible(end.speed, 0.5 * (end.shape() + 5));
}

Warning not_coupled(const Flow& flow) {
    const std::string name = flow.elements.size() == 1 ? flow.elements.front().name : "all elements";
    return {
        WarningCode::flow_separates,
        flow.elements.front().name,
        {},
        flow.alpha_deg,
        "degrees",
        fmt::format("{} at {} degrees: flow and boundary layers found no common solution; the layers do not displace "
                    "the flow, and lift is too large",
                    name, flow.alpha_deg)};
}

/// All panels together are no more than this: time is that of their cube. Of 8 and 16 degrees CRM-HL needs a fifth of
/// the time with 450 that it needs with 600, and lift changes by at most 0.1 % where the same flow is found. More
/// elements have too few each.
constexpr double most_panels = 450;
constexpr std::size_t most_elements = 5;

FlowWalls in_chords(FlowWalls walls, double chord) {
    for (std::optional<double>* wall : {&walls.below, &walls.above})
        if (*wall) **wall /= chord;
    return walls;
}

PanelResponse response_of(std::span<const Contour> contours, const FlowWalls& walls, double chord) {
    std::vector<Contour> scaled;
    for (const Contour& contour : contours) scaled.push_back(to_solve(contour, chord));
    return make_response(scaled, in_chords(walls, chord));
}

/// What the flows round the same bodies have in common.
class Bodies {
public:
    Bodies(const Geometry& geometry, const FlowWalls& walls, double chord, const TransitionOptions& transition)
        : contours_(make_contours(geometry, {.most_panels = most_panels, .fair_coves = true})),
          response_(response_of(contours_, walls, chord)),
          chord_(chord),
          transition_(transition) {}

    void solve(double reynolds, CoupledFlow& found) {
        const LayerConditions conditions{1 / reynolds, transition_.critical_exponent};
        const Attempt attempt = reach(found.flow.alpha_deg, conditions);
        found.steps = attempt.layers.steps;
        found.converged = attempt.layers.converged && fill(attempt, conditions, found);
        if (!found.converged) found.flow.warnings.push_back(not_coupled(found.flow));
    }

private:
    /// The layers at an angle of attack, and their places.
    struct Attempt {
        double alpha_deg;
        Influence influence;
        CoupledLayers layers;
    };

    /// Solves the flow at an angle from layers without displacement, or from those of a flow that was found.
    Attempt solve_at(double alpha_deg, const LayerConditions& conditions, const Attempt* last) {
        Attempt result{alpha_deg, influence_at(response_, alpha_deg), {}};
        std::optional<CoupledLayers> start;
        if (last) start = carry_over(last->layers, last->influence, result.influence);
        result.layers = solve_layers(result.influence, conditions, trips_of(result.influence, transition_),
                                     start ? &*start : nullptr);
        if (result.layers.converged) last_ = result;
        return result;
    }

    /// Looks for a flow from layers without displacement, then from the last one found, or from one at half of the
    /// angle, in steps that are halved where they fail.
    Attempt reach(double alpha_deg, const LayerConditions& conditions) {
        constexpr int most_tries = 5;
        Attempt result = solve_at(alpha_deg, conditions, nullptr);
        if (result.layers.converged) return result;
        if (!last_ && (alpha_deg == 0 || !solve_at(0.5 * alpha_deg, conditions, nullptr).layers.converged))
            return result;
        double share = 1;  // of the way from the last one
        for (int tries = 0; tries < most_tries; ++tries) {
            const double from = last_->alpha_deg, to = share == 1 ? alpha_deg : from + share * (alpha_deg - from);
            result = solve_at(to, conditions, &*last_);
            if (result.layers.converged && to == alpha_deg) return result;
            if (from == alpha_deg) break;  // of another Reynolds number
            share = result.layers.converged ? 1 : 0.5 * share;
        }
        result.layers.converged = false;
        return result;
    }

    /// Returns whether the flow comes from a stagnation point of each body.
    bool fill(const Attempt& attempt, const LayerConditions& conditions, CoupledFlow& found) const {
        const auto& [alpha_deg, influence, layers] = attempt;
        std::vector<ElementFlow> elements;
        for (std::size_t e = 0; e < contours_.size(); ++e) {
            const BodyStretches& body = layers.bodies[e];
            const PanelSheet sheet =
                sheet_of(contours_[e], layers, influence.bodies[e].first, body.upper.places.front());
            std::optional<ElementFlow> sides = make_sides(sheet);
            if (!sides) return false;
            ElementFlow& element = elements.emplace_back(found.flow.elements[e]);
            element.stagnation = sides->stagnation;
            element.upper = std::move(sides->upper);
            element.lower = std::move(sides->lower);
            add_layers(body.upper, layers, conditions, chord_, element.upper);
            add_layers(body.lower, layers, conditions, chord_, element.lower);
            element.lift = lift_of_pressures(sheet, found.flow.alpha_deg) / chord_;
        }
        found.flow.elements = std::move(elements);
        found.flow.warnings.clear();  // which are about layers that leave flow that nothing displaces
        found.flow.lift = 0;
        for (const ElementFlow& element : found.flow.elements) found.flow.lift += element.lift;
        found.forces = flow_forces(found.flow);
        found.forces.drag = 0;
        for (std::size_t e = 0; e < contours_.size(); ++e) {
            const BodyStretches& body = layers.bodies[e];
            found.forces.drag += wake_drag(layers.stations[body.wake.places.back()]);
            const Wall wall = wall_of(influence, e);
            found.transitions.push_back({share_at(wall, body.stagnation - body.upper.turbulent_from),
                                         share_at(wall, body.stagnation + body.lower.turbulent_from)});
        }
        return true;
    }

    std::vector<Contour> contours_;
    PanelResponse response_;
    double chord_;
    const TransitionOptions& transition_;
    std::optional<Attempt> last_;  ///< the last one with a solution
};

}  // namespace

}  // namespace lamina::flow::coupled

namespace lamina {

bool can_be_coupled(const Geometry& geometry, const ReferenceConditions& reference, const FlowWalls& walls) {
    const std::size_t elements = geometry.elements.size();
    return elements > 0 && elements <= flow::coupled::most_elements && reference.reynolds &&
           !flow::is_laminar(reference) && !walls.pitch;
}

std::vector<CoupledFlow> solve_coupled_flow(const Geometry& geometry, std::span<const FlowConditions> conditions,
                                            const TransitionOptions& transition, const FlowWalls& walls) {
    validate(transition);
    std::optional<flow::coupled::Bodies> bodies;
    std::vector<CoupledFlow> flows;
    for (const FlowConditions& each : conditions) {
        const ReferenceConditions reference = reference_conditions(each, geometry);
        assert(can_be_coupled(geometry, reference, walls));
        CoupledFlow& found = flows.emplace_back(CoupledFlow{solve_flow(geometry, each, walls), {}});
        found.forces = flow_forces(found.flow);
        if (found.flow.estimated) continue;
        if (!bodies) bodies.emplace(geometry, walls, reference.chord, transition);
        bodies->solve(*reference.reynolds, found);
    }
    return flows;
}

}  // namespace lamina
