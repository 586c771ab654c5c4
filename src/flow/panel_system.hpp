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

/// The sheets of all contours in the free stream: with flow that leaves each trailing edge smoothly, and with flow that
/// has no circulation round any of them.
struct PanelSolution {
    std::vector<PanelSheet> sheets, without_lift;
};

/// Returns the sheets of all contours. Their strengths are not finite where the system is singular.
PanelSolution solve_panels(std::span<const Contour> contours, double alpha_deg);

/// Returns the direction in which the flow leaves the trailing edge: between the two sides.
Point leaving_direction(std::span<const Point> nodes);

/// Returns whether a base joins the last node to the first one.
inline bool has_base(const PanelSheet& sheet) { return !(sheet.nodes.front() == sheet.nodes.back()); }

/// The velocity that sheets add to the free stream. Lengths and directions of panels are worked out once, for many points.
class SheetVelocity {
public:
    SheetVelocity(std::span<const PanelSheet> sheets, double alpha_deg);

    /// Returns the velocity at a point. On a panel, where the velocity along it jumps, that of either side may be
    /// returned.
    Point operator()(Point p) const;

private:
    /// A panel, or the base of a body.
    struct Panel {
        Point end;  ///< its second node
        Point along;
        double length, strength, slope, source;
    };

    Point stream_;
    std::vector<Point> starts_;  ///< of the sheets
    std::vector<std::vector<Panel>> sheets_;
};

}  // namespace lamina::flow
