// Coves of high-lift sections, as flow with thin layers sees them.
#pragma once

#include <vector>

#include <lamina/point.hpp>

namespace lamina::flow {

/// Fairs the cove on the side with which an outline ends, from its nose to the trailing edge, if there is one. Layers
/// leave the wall at the corner c and come back at r, and the fluid between turns round slowly: it is taken for a part
/// of the body.
///
///      nose ___________________
///         (                    ``--.__  trailing edge      the curve from c to r leaves and arrives along
///          `---c- - - . . _  _______.r`                    the wall; r ends the cove but for a twentieth
///               \___________/
///
/// The flow through the slot behind a cove brings the layers back: `to_next`, the distance of the trailing edge from
/// the next element, is less than the cove is long. `is_corner` has a mark per point; only corners begin coves.
/// `extent` is the longer side of the box round the open outline. Source: M. Drela, Newton solution of coupled
/// viscous/inviscid multielement airfoil flows, AIAA paper 90-1470 (1990), which fairs coves by hand.
void fair_cove(std::vector<Point>& points, std::vector<bool>& is_corner, double extent, double to_next);

}  // namespace lamina::flow
