// Steady compressible flow on a given triangulation. Vertex-centred finite volumes on the median dual, HLLC fluxes,
// second order with the limiter of van Albada; implicit steps by symmetric Gauss-Seidel in a fixed order. Boundary
// layers and wakes may displace it. It only adds, multiplies, divides, takes roots and calls reproducible functions,
// on one thread, so that every machine has the same bits.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include <lamina/ids.hpp>
#include <lamina/point.hpp>

namespace lamina::flow::euler {

/// Faster flow is refused.
inline constexpr double largest_mach = 10;

/// The wall of one body.
struct EulerWall {
    /// Vertices, counter-clockwise, from the trailing edge, or from the upper corner of its base, on.
    std::vector<VertexId> outline;
    /// Index of the lower corner of the base, from which the base leads back to the first vertex; the number of
    /// vertices where the trailing edge is sharp.
    std::size_t sides_end = 0;
};

/// A triangulation and its boundary.
struct EulerMesh {
    std::span<const Point> points;        ///< vertices
    std::span<const Triangle> triangles;  ///< counter-clockwise
    std::vector<EulerWall> walls;         ///< none: the free stream has nothing in its way
    std::span<const Segment> far_field;   ///< directed with the gas at their left
};

/// Options of solve_euler().
struct EulerOptions {
    double mach = 0;                   ///< Mach number of the free stream
    double alpha_deg = 0;              ///< angle at which it rises
    double chord = 1;                  ///< reference length of the coefficients
    std::optional<double> reynolds{};  ///< Reynolds number of the chord, with which turbulent layers displace the flow
    int max_iterations = 150;          ///< most steps
    int first_order_iterations = 20;   ///< steps of first order at the beginning
    int sweeps = 8;                    ///< symmetric sweeps per step
    /// Time step at the beginning, in those of explicit steps, and times the fall of the residual the longest one. Of
    /// 3, 4, 5, 7 and 10, shorter ones take more steps; with 7 the shock of NACA 0012 at Mach 2.5 swings, with 10 also
    /// that of a diamond at Mach 2.
    double first_cfl = 5;
    double cfl_growth = 1.5;  ///< most growth from step to step
    double tolerance = 1e-6;  ///< residual over the first one with which the flow is steady
    /// The flow is also steady once lift and drag have changed over some steps by less than this share, and the
    /// residual has fallen to `settled_residual` of the first one.
    double settled = 2e-3;
    double settled_residual = 0.01;  ///< see `settled`
    /// The share that will do after the last step, since shocks may go on trembling.
    double nearly_settled = 0.02;
};

/// The layer at one place of a wall.
struct WallLayer {
    double momentum = 0;  ///< momentum thickness, in chords; 0 where the layer is laminar
    double shape = 0;     ///< displacement thickness over momentum thickness; likewise
    /// Wall shear stress over the free stream's dynamic pressure; negative where the flow is separated.
    double friction = 0;
};

/// The layers of one body.
struct WallLayers {
    /// Per vertex of EulerWall::outline, and one more for the trailing edge as the end of the lower side.
    std::vector<WallLayer> layers;
    double wake_momentum = 0;  ///< momentum thickness of the wake at its end, in chords
    double wake_shape = 0;     ///< ShearLayer::shape there
    double wake_speed = 0;     ///< speed at its edge over that of the free stream
    double wake_density = 0;   ///< density over that of the free stream
};

/// Steady flow. The units are the density and the speed of sound of the free stream, whose pressure is 1 / 1.4.
struct EulerSolution {
    std::vector<double> densities;  ///< per vertex
    std::vector<Point> velocities;  ///< per vertex
    std::vector<double> pressures;  ///< per vertex
    double lift = 0;                ///< lift coefficient of the pressures on all walls
    double drag = 0;                ///< drag coefficient: that of shocks, and of the mesh's error
    /// Per wall; empty where no Reynolds number was given, and where flow and layers did not become steady together.
    std::vector<WallLayers> layers;
    double residual = 0;     ///< root mean square of the residuals of the density, over the first one
    int iterations = 0;      ///< number of steps
    bool converged = false;  ///< whether the flow is steady
};

/// Returns the steady flow. With a Reynolds number turbulent boundary layers and wakes displace it; where that does not
/// become steady it is found without them. Where it does not become steady, EulerSolution::converged is false, and the
/// numbers are those of the last step, all finite. Throws OptionError where the Mach number is not positive or above
/// `largest_mach`, and MeshError where vertices do not hang together.
EulerSolution solve_euler(const EulerMesh& mesh, const EulerOptions& options);

/// Returns the Mach number at a vertex.
double mach_at(const EulerSolution& solution, std::size_t vertex);

}  // namespace lamina::flow::euler
