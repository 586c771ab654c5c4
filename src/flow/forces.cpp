// The forces of a flow before the mesh.
// Source: H. B. Squire, A. D. Young, The calculation of the profile drag of aerofoils, ARC R&M 1838 (1937).
#include <algorithm>
#include <vector>

#include <lamina/flow.hpp>

#include "core/reproducible_math.hpp"
#include "flow/panel_system.hpp"
#include "flow/potential.hpp"

namespace lamina::flow {

namespace {

/// Returns the force of the skin friction on a side along the free stream, over its dynamic pressure.
double friction_on(const std::vector<FlowPoint>& side, Point stream) {
    double force = 0;
    for (std::size_t i = 1; i < side.size(); ++i)
        force += 0.5 * (side[i - 1].skin_friction + side[i].skin_friction) * dot(side[i].at - side[i - 1].at, stream);
    return force;
}

/// Returns the moment of the pressures on a side, counter-clockwise about a point. `sign` is 1 where the side follows
/// the outline, counter-clockwise, and -1 where it goes against it.
double moment_on(const std::vector<FlowPoint>& side, double sign, Point about) {
    double moment = 0;
    for (std::size_t i = 1; i < side.size(); ++i) {
        const double pressure = 0.5 * (side[i - 1].pressure_coefficient + side[i].pressure_coefficient);
        moment += cross(midpoint(side[i - 1].at, side[i].at) - about,
                        sign * pressure * perpendicular(side[i].at - side[i - 1].at));
    }
    return moment;
}

/// Returns the foremost point of all walls.
Point foremost(const Flow& flow) {
    Point first = flow.elements.front().stagnation;
    for (const ElementFlow& element : flow.elements)
        for (const auto* side : {&element.upper, &element.lower})
            for (const FlowPoint& point : *side)
                if (point.at.x < first.x) first = point.at;
    return first;
}

}  // namespace

double momentum_far_behind(const std::vector<FlowPoint>& side) {
    const auto attached = std::find_if(side.rbegin(), side.rend(), [](const FlowPoint& point) {
        return point.state != BoundaryLayerState::separated;
    });
    const FlowPoint& end = attached == side.rend() ? side.back() : *attached;
    if (!(end.speed > 0)) return 0;
    return end.momentum * core::pow_reproducible(end.speed, 0.5 * (end.shape + 5));
}

}  // namespace lamina::flow

namespace lamina {

FlowForces flow_forces(const Flow& flow) {
    using namespace flow;
    FlowForces forces{.lift = flow.lift};
    if (flow.estimated) return forces;
    const Point stream = free_stream(flow.alpha_deg), about = foremost(flow) + Point{0.25 * flow.chord, 0};
    for (const ElementFlow& element : flow.elements) {
        for (const auto* side : {&element.upper, &element.lower}) {
            forces.drag += 2 * momentum_far_behind(*side) / flow.chord;
            forces.friction_drag += friction_on(*side, stream) / flow.chord;
        }
        const double moment = moment_on(element.lower, 1, about) + moment_on(element.upper, -1, about);
        forces.moment -= moment / (flow.chord * flow.chord);
    }
    return forces;
}

}  // namespace lamina
