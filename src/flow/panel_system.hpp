// The panel method: the strengths of vortex sheets that make the stream function constant along each body.
#pragma once

#include <span>
#include <vector>

#include <lamina/flow.hpp>
#include <lamina/point.hpp>

#include "flow/contour.hpp"

namespace lamina::flow {

/// Returns the unit vector in a direction given in degrees.
Point free_stream(double alpha_deg);

/// Returns the sheets of all contours. Their strengths are not finite where the system is singular.
std::vector<PanelSheet> solve_panels(std::span<const Contour> contours, double alpha_deg);

/// Returns the direction in which the flow leaves the trailing edge: between the two sides.
Point leaving_direction(std::span<const Point> nodes);

/// Returns whether a base joins the last node to the first one.
inline bool has_base(const PanelSheet& sheet) { return !(sheet.nodes.front() == sheet.nodes.back()); }

/// Returns the velocity at a point. On a panel, where the velocity along it jumps, that of either side may be returned.
Point sheet_velocity(std::span<const PanelSheet> sheets, double alpha_deg, Point p);

}  // namespace lamina::flow
