// Layers and outer flow of all bodies solved together, by Newton's method on all stations at once.
// Source: M. Drela, XFOIL (1989), section 5; the sweep that prepares each step lets the speed answer the displaced flux
// at the same place, after A. E. P. Veldman, AIAA J. 19 (1981), so that it passes separation.
#pragma once

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

/// The stretches of one body.
struct BodyStretches {
    Stretch upper, lower, wake;
    double stagnation = 0;  ///< arc length along the outline
};

/// The layers of a flow.
struct CoupledLayers {
    std::vector<Station> stations;  ///< per place
    std::vector<BodyStretches> bodies;
    bool converged = false;
    int steps = 0;
};

/// The places where the layers of a body become turbulent at the latest: arc lengths along the outline.
struct Trips {
    double upper, lower;
};

/// Returns the layers of one flow as those of another one round the same bodies to begin with. Places of the wakes,
/// which lie elsewhere, have layers as at the same distances from the trailing edges.
CoupledLayers carry_over(const CoupledLayers& layers, const Influence& from, const Influence& to);

/// Solves the flow. It begins with `start`, layers at its places, or with layers in the flow without displacement.
/// There are trips for each body. Numbers are finite only where it has converged.
CoupledLayers solve_layers(const Influence& influence, const LayerConditions& conditions, std::span<const Trips> trips,
                           const CoupledLayers* start);

}  // namespace lamina::flow::coupled
