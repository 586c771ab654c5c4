// The two sides of an element, from the stagnation point to the trailing edge.
#pragma once

#include <optional>
#include <vector>

#include <lamina/flow.hpp>

#include "flow/panel_system.hpp"

namespace lamina::flow {

/// Returns the sides of an element without boundary layers. Of several stagnation points at which the flow arrives the
/// one with the least velocity potential counts, from which the flow comes to all others. Empty where the flow arrives
/// nowhere but at the trailing edge.
std::optional<ElementFlow> make_sides(const PanelSheet& sheet);

/// Returns the sides along which the speed is that of the free stream. They begin at the node that is farthest from
/// the trailing edge.
ElementFlow make_flat_plates(const std::vector<Point>& nodes);

/// Returns the lift coefficient of the pressures on an element, times the chord.
double lift_of_pressures(const PanelSheet& sheet, double alpha_deg);

/// Returns the circulation round an element, counter-clockwise.
double circulation(const PanelSheet& sheet);

}  // namespace lamina::flow
