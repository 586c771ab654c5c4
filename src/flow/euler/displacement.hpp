// Boundary layers and wakes that push the gas away. The flux that they displace enters the flow without friction
// through walls and along wakes (M. J. Lighthill, J. Fluid Mech. 4 (1958)); where a wake is curved, a force stands for
// the pressure that its missing momentum does not keep up (R. C. Lock, M. C. P. Firmin, in Numerical Methods in Fluid
// Dynamics (1982)).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "flow/euler/dual_mesh.hpp"
#include "flow/euler/euler.hpp"
#include "flow/euler/gas.hpp"
#include "flow/euler/interaction.hpp"
#include "flow/euler/wake_line.hpp"

namespace lamina::flow::euler {

/// Layers along walls and wakes, which are found anew for each step of the flow.
class DisplacementLayers {
public:
    /// `mesh`, `dual` and `options`, which has a Reynolds number, outlive this. Wakes follow these states.
    DisplacementLayers(const EulerMesh& mesh, const DualMesh& dual, const EulerOptions& options,
                       std::span<const Four> states);

    /// Leads the layers along the flow, and takes what they displace a step nearer to that.
    void update(std::span<const Four> states);
    /// Adds what the layers do to the sums of the fluxes out of the control volumes.
    void add_fluxes(std::span<const Four> states, std::vector<Four>& sums) const;
    /// Returns the layers along each wall.
    std::vector<WallLayers> walls() const;

private:
    /// The turbulent layer along one side of an element.
    struct Side {
        std::vector<std::size_t> places;  ///< in the outline, from the stagnation point to the trailing edge
        std::vector<double> s;            ///< arc length of each
        std::vector<std::size_t> picked;  ///< the places that have stations: the first one is the first turbulent one
        std::vector<double> laminar_friction;  ///< per place before the first turbulent one, as WallLayer::friction
        std::vector<Station> stations;
        std::vector<StationLayer> layers;  ///< per station
    };
    struct Element {
        std::vector<std::uint32_t> outline;  ///< EulerWall::outline by the numbers of the dual mesh
        std::size_t sides_end = 0;           ///< EulerWall::sides_end
        double extent = 0;                   ///< the longer side of its box
        WakeStart wake_start;
        std::vector<WakePoint> wake;
        std::vector<double> wake_s;            ///< distance of each from the trailing edge along the line
        std::vector<std::size_t> wake_picked;  ///< the points of the wake that are stations
        std::vector<double> displaced;         ///< flux per place of the sides
        std::vector<double> wake_displaced;    ///< and per station of the wake
        std::vector<Point> wake_forces;        ///< per station of the wake
        std::array<Side, 2> sides;             ///< the upper one goes against the outline
        std::vector<StationLayer> wake_layers;
    };

    Element make_element(const EulerWall& wall) const;
    void lay_wake(Element& element, std::span<const Four> states) const;
    std::vector<Station> wake_stations(const Element& element, std::span<const Four> states) const;
    Side make_side(const Element& element, std::span<const Four> states, std::size_t stagnation, bool is_upper,
                   const Station& first_of_wake) const;
    void pick_stations(const Element& element, std::span<const Station> along, const Station& first_of_wake,
                       Side& side) const;
    void update(Element& element, std::span<const Four> states);
    std::vector<double> lead_wake(Element& element, std::vector<Station>& stations) const;
    void enter_side(Element& element, const Side& side, std::span<const double> displaced);
    void enter_wake(Element& element, std::span<const double> displaced);
    void turn_wake(Element& element, std::span<const Station> stations, std::span<const Four> states);
    std::uint32_t vertex(const Element& element, std::size_t place) const {
        return element.outline[place % element.outline.size()];
    }

    const DualMesh& dual_;
    const EulerOptions& options_;
    OuterGas gas_;
    NumberedTriangles triangles_;
    std::vector<Element> elements_;
    std::vector<double> sources_;  ///< mass per time that enters, per vertex
    std::vector<Point> forces_;    ///< per vertex
    bool is_first_ = true;         ///< nothing is displaced yet
};

}  // namespace lamina::flow::euler
