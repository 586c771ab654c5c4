// Compressible flow before the mesh: steady, with its shocks and, given a Reynolds number, with turbulent boundary
// layers that displace it. solve_compressible_flow() of pipeline.hpp finds it on a mesh of its own.
//
// Guarantees:
//  1. CompressibleFlow::converged tells whether the flow is steady; elsewhere the numbers are those of the last step.
//  2. The flow does not depend on the number of threads.
// Limits:
//  1. On RAE 2822 at Mach 0.729 to 0.75 lift is within 1.3 % of that of the Reynolds-averaged equations (SA), drag within
//     3 % (17 % behind strong shocks), shocks within 2 % of the chord. Without layers they lie 6 to 9 % too far back.
//  2. From Mach 1 on, and where layers and flow do not settle together, as in massive separation, there are no layers.
// Example:
//     const Geometry section = make_geometry({naca_airfoil("0012", 200)});
//     const CompressibleFlow flow = solve_compressible_flow(section, {.alpha_deg = 2.5, .reynolds = 6e6, .mach = 0.76});
//     assert(flow.converged && flow.has_layers && flow.elements[0].upper.shocks.size() == 1);
//     assert(std::abs(flow.elements[0].upper.shocks[0].position - 0.503) < 0.015);  // that of solutions with SA
#pragma once

#include <string>
#include <vector>

#include <lamina/export.hpp>
#include <lamina/ids.hpp>
#include <lamina/point.hpp>

namespace lamina {

/// The flow at one vertex of a wall.
struct CompressibleWallPoint {
    Point at;                         ///< the vertex
    double pressure_coefficient = 0;  ///< based on the free stream's dynamic pressure
    double mach = 0;                  ///< Mach number
    double momentum = 0;              ///< momentum thickness of the turbulent layer; 0 where there is none
    double displacement = 0;          ///< its displacement thickness
    double skin_friction = 0;  ///< wall shear stress over the free stream's dynamic pressure; below 0 if separated
};

/// A shock that ends a supersonic region at a wall.
struct WallShock {
    Point at;                ///< where the wall's Mach number falls through 1
    double position = 0;     ///< the same, as a share of the element's extent in x
    double mach_ahead = 0;   ///< largest Mach number of the wall ahead of it, since the flow became supersonic
    double mach_behind = 0;  ///< smallest one within some hundredths of the extent behind it
    /// Points from the wall up to where the flow ahead is hardly faster than sound: the Mach number is 1 behind them.
    std::vector<Point> front{};
};

/// The flow along one side of an element, from the stagnation point to the trailing edge.
struct CompressibleSide {
    std::vector<CompressibleWallPoint> points;  ///< in the direction of the flow
    std::vector<WallShock> shocks;              ///< in the same order
};

/// The flow along one element.
struct CompressibleElement {
    std::string name;        ///< of the element
    CompressibleSide upper;  ///< the side that follows the outline backwards
    CompressibleSide lower;  ///< the side that follows the outline, counter-clockwise round the body
};

/// Steady compressible flow.
struct CompressibleFlow {
    double mach = 0;       ///< Mach number of the free stream
    double alpha_deg = 0;  ///< its direction
    double chord = 1;      ///< the reference length of all coefficients, in units of the input
    double lift = 0;       ///< lift coefficient by the pressures on all walls
    double drag = 0;  ///< with layers viscous_drag + wave_drag, else by the pressures: wave drag and the mesh's error
    bool has_layers = false;  ///< whether boundary layers displace the flow
    double viscous_drag = 0;  ///< drag coefficient of boundary layers and wakes, where there are any
    double wave_drag = 0;     ///< estimate of the drag coefficient of the shocks, where there are boundary layers
    double critical_pressure_coefficient = 0;   ///< critical_pressure_coefficient()
    double largest_mach = 0;                    ///< the largest Mach number on the walls
    std::vector<CompressibleElement> elements;  ///< in the order of the geometry
    std::vector<Point> points;                  ///< vertices of the mesh that it was found on
    std::vector<Triangle> triangles;            ///< triangles of that mesh
    std::vector<double> mach_numbers;           ///< per vertex
    std::vector<Point> velocities;              ///< per vertex, as multiples of the free stream's speed of sound
    std::vector<double> pressures;              ///< per vertex, as a multiple of the free stream's
    int iterations = 0;                         ///< number of implicit steps
    double residual = 0;                        ///< of the density, over that of the first step
    bool converged = false;                     ///< whether the flow is steady
};

/// Returns the pressure coefficient at which flow is as fast as sound, cp*: that of the same entropy and total enthalpy
/// as the free stream of this Mach number. Precondition: mach > 0.
LAMINA_EXPORT double critical_pressure_coefficient(double mach);

}  // namespace lamina
