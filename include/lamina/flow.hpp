// The flow round the bodies before there is a mesh: incompressible potential flow by a panel method, and boundary
// layers along the walls.
//
// Guarantees:
//  1. The flow hardly depends on the spacing of the wall: panels have their own points on smooth curves through the
//     given ones. It does not depend on the number of threads, and is the same, bit for bit, at 2^k times the size.
//  2. Where the solution is not finite, faster than 100 times the free stream, or crosses the walls with 0.02 of its
//     speed or more, a flat-plate estimate takes its place, and Flow::warnings says so.
// Limits:
//  1. Flow that separates is not modelled: pressures in coves and behind thick bases are those of attached flow.
// Example:
//     const Flow flow = solve_flow(make_geometry({naca_airfoil("0012", 200)}), {.alpha_deg = 4, .reynolds = 1e6});
//     assert(flow.lift > 0.45 && flow.lift < 0.50);  // 2 pi sin(4 degrees) = 0.44 for a thin plate
//     assert(largest_on_walls(flow, &FlowPoint::thickness) > 0.01 && streamline(flow, {-1, 0}, 3).size() > 10);
//
// Source: J. Katz, A. Plotkin, Low-Speed Aerodynamics, 2nd ed. (2001), chapter 11; M. Drela, XFOIL, in Low Reynolds
// Number Aerodynamics (1989), for the stream function, the extrapolation at sharp trailing edges and the panel on the
// base; boundary layers: B. Thwaites, Aeronaut. Q. 1 (1949), laminar; M. R. Head, ARC R&M 3152 (1958), turbulent.
#pragma once

#include <memory>

#include <lamina/conditions.hpp>
#include <lamina/geometry.hpp>

namespace lamina {

namespace flow {
struct PanelSolution;
}

/// The state of a boundary layer.
enum class BoundaryLayerState {
    laminar,    ///< it is laminar
    turbulent,  ///< it is turbulent, as it is as soon as it can be
    separated,  ///< it has left the wall: here in a CoupledFlow, else here or upstream, then with a fixed shape
};

/// The flow at one point of a wall. Lengths are in units of the input.
struct FlowPoint {
    Point at;                         ///< the point
    double s = 0;                     ///< arc length from the stagnation point
    double speed = 0;                 ///< at the edge of the boundary layer, as a multiple of the free stream's
    double pressure_coefficient = 1;  ///< 1 - speed^2
    double momentum = 0;              ///< momentum thickness; this and all below are 0 without a Reynolds number
    double displacement = 0;          ///< displacement thickness
    double thickness = 0;             ///< total thickness
    double shape = 0;                 ///< shape factor: displacement over momentum thickness
    double skin_friction = 0;         ///< wall shear stress over the free stream's dynamic pressure
    BoundaryLayerState state = BoundaryLayerState::laminar;  ///< state of the boundary layer
};

/// The flow along one element. A side runs from the stagnation point to the trailing edge and holds both.
struct ElementFlow {
    std::string name;                   ///< of the element
    Point stagnation;                   ///< the stagnation point at its nose
    std::optional<Point> sharp_nose{};  ///< of a sheet: the tip opposite of its trailing edge, where speeds have a peak
    double lift = 0;                    ///< lift coefficient by the pressures, based on FlowConditions::chord
    std::vector<FlowPoint> upper;       ///< the side that follows the outline backwards, clockwise round the body
    std::vector<FlowPoint> lower;       ///< the side that follows the outline, counter-clockwise round the body
};

/// Potential flow with boundary layers.
struct Flow {
    double alpha_deg = 0;               ///< direction of the free stream
    double chord = 1;                   ///< the reference length of all coefficients, in units of the input
    double lift = 0;                    ///< lift coefficient of all elements by their circulation
    std::vector<ElementFlow> elements;  ///< in the order of the geometry
    /// The vortex sheets on the walls, which flow_velocity() and streamline() ask; null where the flow is an estimate.
    std::shared_ptr<const flow::PanelSolution> panels;
    bool estimated = false;         ///< whether the panel method failed: speeds are those of the free stream
    std::vector<Warning> warnings;  ///< WarningCode::flow_estimated, with the reason, and WarningCode::flow_separates
};

/// Returns the flow with the pressures of compressible flow of a Mach number, by the rule of Karman and Tsien, but none
/// below a vacuum, and with the lift coefficients that follow from them. Speeds and boundary layers stay. Precondition:
/// 0 < mach < 1. Source: T. von Karman, J. Aeronaut. Sci. 8 (1941), after H. S. Tsien.
LAMINA_EXPORT Flow with_compressed_pressures(Flow flow, double mach);
/// What images of the bodies stand for: flat walls along the free stream, as ground and ceiling, or a row of blades.
struct FlowWalls {
    std::optional<double> below{};  ///< y of the wall below, in units of the input
    std::optional<double> above{};  ///< y of the wall above
    /// Distance along y of the copies in an endless row. The free stream then is the flow far ahead of the row.
    std::optional<double> pitch{};
};

/// Returns the potential flow round all elements, as read or as prepared, between walls if there are any, and, where a
/// Reynolds number is given, the boundary layers along their sides. Each element carries a vortex sheet of linear
/// strength on some 200 straight panels. The stream function is constant along each body, and the flow leaves each
/// trailing edge smoothly (Kutta), a base along the bisector of the sides. Images of the bodies stand for walls.
/// Preconditions: check_simple(), and all elements lie between the walls. Throws OptionError for conditions out of
/// range.
LAMINA_EXPORT Flow solve_flow(const Geometry& geometry, const FlowConditions& conditions = {},
                              const FlowWalls& walls = {});
/// Forces of a flow, as coefficients based on Flow::chord.
struct FlowForces {
    double lift = 0;           ///< Flow::lift
    double drag = 0;           ///< of the boundary layers, by Squire and Young; 0 without any, and for an estimate
    double friction_drag = 0;  ///< the part of it that skin friction makes
    double moment = 0;         ///< of the pressures, nose up, about a quarter of the chord behind the foremost point
};

/// Returns the forces of a flow. The drag follows from the momentum thickness in the wake far behind, which that at the
/// trailing edge becomes: 2 theta (u_e)^((H + 5) / 2) / chord for each side. It holds where the flow is attached up to
/// the trailing edge: of a layer that leaves the wall before, the last attached point counts. Lift and moment are of
/// compressible pressures where the flow has them, with_compressed_pressures(); drag stays that of incompressible flow.
/// The moment leaves out the pressure on a base. Source: H. B. Squire, A. D. Young, ARC R&M 1838 (1937).
LAMINA_EXPORT FlowForces flow_forces(const Flow& flow);
/// Returns the largest value along all walls, or along those of one element, of a number such as &FlowPoint::thickness.
LAMINA_EXPORT double largest_on_walls(const Flow& flow, double FlowPoint::*number);
LAMINA_EXPORT double largest_on_walls(const ElementFlow& element, double FlowPoint::*number);  ///< the same
/// Returns the largest skin friction that solutions have on an element: that of its boundary layers, or that of the
/// last edges before the corners of its base, where the flow turns round them.
LAMINA_EXPORT double largest_skin_friction(const ElementFlow& element);
/// Returns the velocity at a point outside of the bodies as a multiple of the free stream's speed. Nearer to a wall
/// than its panels are long, ElementFlow has better values.
LAMINA_EXPORT Point flow_velocity(const Flow& flow, Point p);

/// Options of streamline(). Lengths are multiples of Flow::chord.
struct StreamlineOptions {
    double tolerance = 1e-7;  ///< largest error of a step
    double max_step = 0.05;   ///< longest step
};

/// Returns the points of the streamline that begins at a point outside of the bodies or at a trailing edge, which it
/// leaves along the bisector of the sides, over this length in units of the input. It ends early where the speed is a
/// thousandth of the free stream's, and at bodies. Source: Dormand, Prince, J. Comput. Appl. Math. 6 (1980).
LAMINA_EXPORT std::vector<Point> streamline(const Flow& flow, Point from, double length,
                                            const StreamlineOptions& options = {});

}  // namespace lamina
