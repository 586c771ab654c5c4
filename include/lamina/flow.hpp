// The flow round the bodies before there is a mesh: incompressible potential flow by a panel method, and boundary
// layers along the walls. Free functions that can be called by themselves (`lamina flow`, docs/reference/flow.md).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <lamina/conditions.hpp>
#include <lamina/export.hpp>
#include <lamina/geometry.hpp>
#include <lamina/point.hpp>
#include <lamina/warning.hpp>

namespace lamina {

/// The state of a boundary layer.
enum class BoundaryLayerState {
    laminar,    ///< it is laminar
    turbulent,  ///< it is turbulent
    separated,  ///< it has left the wall here or further upstream; its numbers are those of a fixed shape
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

/// The flow along one element. A side runs from the stagnation point to the trailing edge and holds both. With the
/// wall at its right hand the flow on the upper side goes clockwise round the body.
struct ElementFlow {
    std::string name;              ///< of the element
    Point stagnation;              ///< the stagnation point at its nose
    double lift = 0;               ///< lift coefficient by the pressures, based on FlowConditions::chord
    std::vector<FlowPoint> upper;  ///< the side that follows the outline backwards
    std::vector<FlowPoint> lower;  ///< the side that follows the outline, counter-clockwise round the body
};

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

/// Potential flow with boundary layers.
struct Flow {
    double alpha_deg = 0;               ///< direction of the free stream
    double chord = 1;                   ///< the reference length of all coefficients, in units of the input
    double lift = 0;                    ///< lift coefficient of all elements by their circulation
    std::vector<ElementFlow> elements;  ///< in the order of the geometry
    std::vector<PanelSheet> sheets;     ///< in the same order; empty where the flow is an estimate
    /// The sheets in a flow along the same walls that has no circulation round any element, and so turns round trailing
    /// edges. See with_share_of_lift().
    std::vector<PanelSheet> sheets_without_lift;
    /// Whether the panel method failed. Then the speed is that of the free stream everywhere, which makes the boundary
    /// layers those of flat plates; sides begin where the outline is farthest from its trailing edge.
    bool estimated = false;
    /// Why the flow is an estimate (WarningCode::flow_estimated), or that it does not stay at the walls
    /// (WarningCode::flow_separates).
    std::vector<Warning> warnings;
};

/// Returns the flow along the same walls in which all elements have this share of their lift, as viscous flow has less
/// than potential flow. Only the sheets differ: the mean of those with and without lift, weighted by the share, since
/// potential flows may be added. With another share than 1 the flow turns round trailing edges.
LAMINA_EXPORT Flow with_share_of_lift(Flow flow, double share);

/// Returns the length of all walls, in chords, along which flow of a Mach number is expected to be faster than sound
/// (compressed_pressure_coefficient() of compressible_flow.hpp). Precondition: 0 < mach < 1.
LAMINA_EXPORT double supersonic_length(const Flow& flow, double mach);

/// Returns the flow with the pressures of compressible flow of a Mach number, compressed_pressure_coefficient(), but none
/// below a vacuum, and with the lift coefficients that follow from them. Speeds and boundary layers stay. Precondition:
/// 0 < mach < 1.
LAMINA_EXPORT Flow with_compressed_pressures(Flow flow, double mach);

/// Returns the potential flow round all elements and, where a Reynolds number is given, the boundary layers along their
/// sides. Takes geometry as read or as prepared; the panels choose their own points on smooth curves through the given
/// ones, so that the flow hardly depends on the spacing of the wall. Geometry 2^k times as large gives the same flow,
/// bit for bit. Does not depend on the number of threads.
///
/// Each element carries a vortex sheet of linear strength on some 200 straight panels. The stream function is constant
/// along each body, and the flow leaves each trailing edge smoothly (Kutta). Bases of blunt trailing edges get a panel
/// of sources and vortices that sends the flow off along the bisector of the sides; a trailing edge without a corner
/// gets a stagnation point. Flow that separates from the wall is not modelled: pressures in coves and behind thick
/// bases are those of attached flow. Where the solution is not finite, faster than max_flow_speed, or where it does not
/// follow the walls, a flat-plate estimate takes its place, and Flow::warnings says so.
///
/// Precondition: check_simple(). Throws OptionError for conditions out of range.
/// Source: J. Katz, A. Plotkin, Low-Speed Aerodynamics, 2nd ed. (2001), chapter 11; M. Drela, XFOIL: an analysis and
/// design system for low Reynolds number airfoils, in Low Reynolds Number Aerodynamics (1989), for the stream function,
/// the extrapolation at sharp trailing edges and the panel on the base; boundary layers: B. Thwaites, Aeronaut. Q. 1
/// (1949), while laminar; M. R. Head, ARC R&M 3152 (1958), when turbulent, which they are as soon as they can be.
LAMINA_EXPORT Flow solve_flow(const Geometry& geometry, const FlowConditions& conditions = {});

/// Faster flow, as a multiple of the free stream's speed, is taken for a failure of the panel method.
inline constexpr double max_flow_speed = 100;

/// So is a larger velocity through the panels of an element, as the median over their middles and a multiple of the
/// free stream's speed.
inline constexpr double max_flow_leak = 0.02;

/// Returns the largest value along all walls of a number of the flow there, such as &FlowPoint::thickness.
LAMINA_EXPORT double largest_on_walls(const Flow& flow, double FlowPoint::*number);

/// Returns the largest value along the wall of one element.
LAMINA_EXPORT double largest_on_walls(const ElementFlow& element, double FlowPoint::*number);

/// Returns the largest skin friction that solutions have on an element: that of its boundary layers, or that of the last
/// edges before the corners of its base, where the flow turns round them.
LAMINA_EXPORT double largest_skin_friction(const ElementFlow& element);

/// Returns the velocity at a point outside of the bodies as a multiple of the free stream's speed. Nearer to a wall
/// than its panels are long one sees that they are straight: along the wall itself, ElementFlow has better values.
LAMINA_EXPORT Point flow_velocity(const Flow& flow, Point p);

/// Options of streamline(). Lengths are multiples of Flow::chord.
struct StreamlineOptions {
    double tolerance = 1e-7;  ///< largest error of a step
    double max_step = 0.05;   ///< longest step
};

/// Returns the points of the streamline that begins at a point, in the direction of the flow, over this length in units
/// of the input. It ends early near a stagnation point, where the speed is a thousandth of the free stream's, and where
/// it would enter a body. One that begins at the trailing edge of an element, or at the middle of its base, leaves
/// along the bisector of the sides. Precondition: `from` lies outside of the bodies or is a trailing edge. Source:
/// J. R. Dormand, P. J. Prince, J. Comput. Appl. Math. 6 (1980).
LAMINA_EXPORT std::vector<Point> streamline(const Flow& flow, Point from, double length,
                                            const StreamlineOptions& options = {});

}  // namespace lamina
