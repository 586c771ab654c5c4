// Pressures of compressible flow by formulas.
#include <algorithm>
#include <cmath>

#include <lamina/compressible_flow.hpp>
#include <lamina/flow.hpp>

#include "core/reproducible_math.hpp"
#include "flow/potential.hpp"

namespace lamina::flow {

namespace {

/// Returns the force of the pressures on one side, over the dynamic pressure. `sign` is 1 where the side follows the
/// outline, counter-clockwise, and -1 where it goes against it.
Point force_on(const std::vector<FlowPoint>& side, double sign) {
    Point force;
    for (std::size_t i = 1; i < side.size(); ++i) {
        const double pressure = 0.5 * (side[i - 1].pressure_coefficient + side[i].pressure_coefficient);
        force = force + sign * pressure * perpendicular(side[i].at - side[i - 1].at);
    }
    return force;
}

double lift_on(const ElementFlow& element, double alpha_deg) {
    const double alpha = core::radians(alpha_deg);
    const Point force = force_on(element.lower, 1) + force_on(element.upper, -1);
    return cross({core::cos_reproducible(alpha), core::sin_reproducible(alpha)}, force);
}

}  // namespace

double compressed_pressure_coefficient(double incompressible, double mach) {
    const double b = std::sqrt(1 - mach * mach), divisor = b + mach * mach / (1 + b) * incompressible / 2;
    return divisor > 0 ? incompressible / divisor : -HUGE_VAL;
}

double supersonic_length(const Flow& flow, double mach) {
    const double critical = critical_pressure_coefficient(mach);
    double length = 0;
    for (const ElementFlow& element : flow.elements)
        for (const auto* side : {&element.upper, &element.lower})
            for (std::size_t i = 1; i < side->size(); ++i) {
                const FlowPoint &a = (*side)[i - 1], &b = (*side)[i];
                const double middle = 0.5 * (a.pressure_coefficient + b.pressure_coefficient);
                if (compressed_pressure_coefficient(middle, mach) < critical) length += b.s - a.s;
            }
    return length / flow.chord;
}

}  // namespace lamina::flow

namespace lamina {

using namespace flow;

double critical_pressure_coefficient(double mach) {
    const double ratio = (1 + 0.2 * mach * mach) / 1.2;
    return (core::pow_reproducible(ratio, 3.5) - 1) / (0.7 * mach * mach);
}

Flow with_compressed_pressures(Flow flow, double mach) {
    const double vacuum = -1 / (0.7 * mach * mach);
    for (ElementFlow& element : flow.elements) {
        const double before = lift_on(element, flow.alpha_deg);
        for (auto* side : {&element.upper, &element.lower})
            for (FlowPoint& point : *side)
                point.pressure_coefficient =
                    std::max(compressed_pressure_coefficient(point.pressure_coefficient, mach), vacuum);
        const double more = (lift_on(element, flow.alpha_deg) - before) / flow.chord;
        element.lift += more;
        flow.lift += more;
    }
    return flow;
}

}  // namespace lamina
