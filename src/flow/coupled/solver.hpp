// Layers and outer flow of one body solved together, by Newton's method on all stations at once.
// Source: M. Drela, XFOIL (1989), section 5; the sweep that prepares each step lets the speed answer the displaced flux at
// the same place, after A. E. P. Veldman, AIAA J. 19 (1981), so that it passes separation.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "flow/coupled/influence.hpp"
#include "flow/coupled/interval.hpp"

namespace lamina::flow::coupled {

/// The stations of one stretch: a side from the nose to the trailing edge, or the wake.
struct Stretch {
    std::vector<std::size_t> places;  ///< of Influence, downstream
    std::size_t transition = 0;       ///< the station at which the layer is turbulent first; 0 in the wake
    std::optional<double> trip;       ///< arc length from the stagnation point at the latest place of transition
    double turbulent_from = 0;        ///< arc length where the layer becomes turbulent
};

/// The layers of a flow, and where it stagnates.
struct CoupledLayers {
    std::vector<Station> stations;     ///< per place
    std::array<Stretch, 3> stretches;  ///< upper side, lower side, wake
    double stagnation = 0;             ///< arc length along the outline
    bool converged = false;
    int steps = 0;
};

/// Where layers become turbulent at the latest: arc lengths along the outline, on the upper and on the lower side.
using Trips = std::array<double, 2>;

/// Solves the flow. It begins with `start`, the layers of a similar flow on the same panels, or with layers in the flow
/// without displacement. Numbers are finite only where it has converged.
CoupledLayers solve_layers(const Influence& influence, const LayerConditions& conditions, const Trips& trips,
                           const CoupledLayers* start);

}  // namespace lamina::flow::coupled
