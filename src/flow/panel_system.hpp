// The panel method: the strengths of vortex sheets that make the stream function constant along each body.
#pragma once

#include <span>
#include <vector>

#include <lamina/flow.hpp>
#include <lamina/point.hpp>

#include "flow/contour.hpp"
#include "flow/images.hpp"

namespace lamina::flow {

/// Returns the unit vector in a direction given in degrees.
Point free_stream(double alpha_deg);

/// The vortex sheet on the panels of one element.
struct PanelSheet {
    /// Ends of the panels, counter-clockwise from the trailing edge to the trailing edge: the last one equals the first
    /// one, or a straight base without a wall condition joins them.
    std::vector<Point> nodes;
    /// Strength of the sheet per node, linear between them. Since the fluid inside the body is at rest, it is the
    /// velocity along the outline outside of it, counter-clockwise, as a multiple of the free stream's.
    std::vector<double> strengths;
    double base_strength = 0;  ///< constant strength of the vortex sheet on the base
    double base_source = 0;    ///< constant strength of the source sheet on the base, which feeds the wake
};

/// The sheets of all contours in the free stream (Flow::panels): with flow that leaves each trailing edge smoothly, and
/// with flow that has no circulation round any of them.
struct PanelSolution {
    std::vector<PanelSheet> sheets, without_lift;
    FlowWalls walls;  ///< in which the sheets have images
};

/// Returns the sheets of a flow; none where it is an estimate.
inline std::span<const PanelSheet> sheets_of(const Flow& flow) {
    return flow.panels ? std::span<const PanelSheet>(flow.panels->sheets) : std::span<const PanelSheet>{};
}

/// Returns the sheets of all contours between walls, along which the stream runs. Their strengths are not finite where
/// the system is singular.
PanelSolution solve_panels(std::span<const Contour> contours, double alpha_deg, const FlowWalls& walls = {});

/// Returns what the sheets of bodies between walls answer to a stream function: the strength at node i for a unit of it
/// at node j, row by row, with the nodes of all bodies in their order. Lengths have the unit of the contours.
/// Precondition: there is no row of blades.
std::vector<double> strengths_per_stream_function(std::span<const Contour> contours, const FlowWalls& walls);

/// Returns the direction in which the flow leaves the trailing edge: between the two sides.
Point leaving_direction(std::span<const Point> nodes);

/// Strengths of the vortices and sources on a base that send the flow off in that direction, over the speed at the
/// trailing edge.
struct BaseStrengths {
    double vortices = 0, sources = 0;
};

/// Returns the strengths on the base of a body. `along` is its unit vector, from the last node to the first one.
BaseStrengths base_strengths(std::span<const Point> nodes, Point along);

/// Returns the sheet of a body with these strengths at its nodes.
PanelSheet make_sheet(const std::vector<Point>& nodes, std::span<const double> strengths, const BaseStrengths& base);

/// Returns whether a base joins the last node to the first one.
inline bool has_base(const PanelSheet& sheet) { return !(sheet.nodes.front() == sheet.nodes.back()); }

/// The velocity that sheets, and their images in walls, add to the free stream. Lengths and directions of panels are
/// worked out once, for many points.
class SheetVelocity {
public:
    SheetVelocity(std::span<const PanelSheet> sheets, double alpha_deg, const FlowWalls& walls = {});
    explicit SheetVelocity(const Flow& flow);

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

    /// Returns what the sheets without their images induce at a point.
    Point induced_by_sheets(Point p) const;

    Point stream_;
    std::vector<Image> images_;
    std::vector<Point> starts_;  ///< of the sheets
    std::vector<std::vector<Panel>> sheets_;
};

}  // namespace lamina::flow
