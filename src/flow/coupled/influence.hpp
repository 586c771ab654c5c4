// What fluid that enters through walls or into wakes does to the speeds along them. A displacement thickness acts on
// the flow outside as sources do whose strength is the growth of speed x displacement thickness.
// Source: M. Drela, XFOIL (1989), section 3 (wall transpiration, sources along the wake).
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <lamina/flow.hpp>

#include "flow/contour.hpp"
#include "flow/images.hpp"

namespace lamina::flow::coupled {

/// The panels of one body.
struct BodyPanels {
    Contour contour;              ///< in chords
    std::vector<double> lengths;  ///< of the panels
    std::vector<Point> along;     ///< their unit vectors
    std::size_t first_node = 0, first_panel = 0;
};

/// The panels of all bodies, and what their vortex sheets answer. It serves all angles of attack.
struct PanelResponse {
    std::vector<BodyPanels> bodies;
    std::vector<Image> images;  ///< the bodies themselves first
    FlowWalls walls;            ///< in chords
    std::size_t nodes = 0, panels = 0;
    std::vector<double> answers;   ///< strengths_per_stream_function()
    std::vector<double> to_walls;  ///< strength at node i for unit sources on panel j, row by row
};

/// Returns the response of bodies between walls. Lengths of both are in chords.
PanelResponse make_response(std::span<const Contour> contours, const FlowWalls& walls);

/// The places of one body: those of its wall in the order of its nodes, then those of its wake from the trailing edge
/// on.
struct BodyPlaces {
    std::size_t first, wake, end;
};

/// The places of a flow, and the speeds there: along the outline on walls, downstream in wakes. Place i has
///
///     speed[i] + sum over j of matrix[i * places + j] x flux[j],
///
/// where the flux is (speed along the outline or downstream) x displacement thickness.
struct Influence {
    std::vector<BodyPlaces> bodies;
    std::vector<Point> at;
    std::vector<double> s;      ///< arc length along the outline; in the wake from the trailing edge
    std::vector<double> speed;  ///< without fluxes
    std::vector<double> matrix;
};

/// Returns the influence at an angle of attack. Wakes follow the streamlines of flow without friction.
Influence influence_at(const PanelResponse& response, double alpha_deg);

}  // namespace lamina::flow::coupled
