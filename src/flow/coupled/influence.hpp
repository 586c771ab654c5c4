// What fluid that enters through a wall or into a wake does to the speeds along both. A displacement thickness acts on
// the flow outside as sources do whose strength is the growth of speed x displacement thickness.
// Source: M. Drela, XFOIL (1989), section 3 (wall transpiration, sources along the wake).
#pragma once

#include <vector>

#include "flow/contour.hpp"

namespace lamina::flow::coupled {

/// The panels of one body, and what its vortex sheet answers. It serves all angles of attack.
struct BodyResponse {
    Contour contour;               ///< in chords
    std::vector<double> lengths;   ///< of the panels
    std::vector<Point> along;      ///< their unit vectors
    std::vector<double> answers;   ///< strengths_per_stream_function()
    std::vector<double> to_walls;  ///< strength at node i for unit sources on panel j, row by row
};

BodyResponse make_response(Contour contour);

/// The places of a flow, those of the wall in the order of its nodes, then those of the wake from the trailing edge on, and
/// the speeds there: along the outline on the wall, downstream in the wake. Place i has
///
///     speed[i] + sum over j of matrix[i * places + j] x flux[j],
///
/// where the flux is (speed along the outline or downstream) x displacement thickness.
struct Influence {
    std::vector<Point> at;
    std::size_t wall = 0;       ///< number of places on the wall
    std::vector<double> s;      ///< arc length along the outline; in the wake from the trailing edge
    std::vector<double> speed;  ///< without fluxes
    std::vector<double> matrix;
};

/// Returns the influence at an angle of attack. The wake follows the streamline of flow without friction.
Influence influence_at(const BodyResponse& body, double alpha_deg);

}  // namespace lamina::flow::coupled
