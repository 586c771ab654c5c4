// The motion beyond the rays: the rigid motions of the walls, blended smoothly down to none at the outer boundary.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <lamina/mesh.hpp>

#include "morphing/rays.hpp"
#include "morphing/symmetric_system.hpp"
#include "morphing/wall_motion.hpp"

namespace lamina::morphing {

/// The solution of div(k grad m) = 0, in linear finite elements on the reference mesh, for each of the four numbers m
/// of a motion x -> x + turn (x - o) + shift about one origin o. On the rays it is their own, and on the rest of the
/// boundary none; but on horizontal lines of symmetry the shift along x is free, with no flux of it, so that vertices
/// slide: where a section 0.3 chords above slip ground moves along by 0.1, the smallest angle beyond the layer stays
/// 28.6 degrees, and falls to 19.8 with vertices that are held. The stiffness k of a triangle is 1 over the root of
/// twice its area, so that small cells leave the change to large ones. With area^-p the mean smallest angle beyond the
/// layer of a NACA 0012 turned by 20 degrees falls by 1.0, 0.3 and 0.3 degrees for p = 0, 1/4 and 1/2, and with a far
/// field of 10 chords by 2.3, 0.9 and 0.6; a slat lowered by 2 % of the chord goes 38 %, 56 % and 66 % of its way.
/// Source: A. Masud, T. J. R. Hughes, A space-time Galerkin/least-squares finite element formulation of the
/// Navier-Stokes equations for moving domain problems, Comput. Methods Appl. Mech. Eng. 146 (1997), for stiffness by
/// the size of cells.
class MotionField {
public:
    /// `wall` holds the wall vertices.
    MotionField(const Mesh& mesh, const Rays& rays, std::span<const Point> wall);

    /// Sets the displacements of the vertices beyond the rays, which are linear in the motions of the rays.
    void displace(std::span<const Motion> motions, std::span<Point> displacement) const;
    /// Adds to the gradient by the motions of a function whose gradient by the displacements is given.
    void add_gradient(std::span<const Point> by_displacement, std::span<Motion> by_motion) const;

private:
    /// An edge of the mesh from a vertex beyond the rays to one on a ray.
    struct Coupling {
        std::uint32_t free, ray;
        bool stretched;  ///< whether the latter is beyond the kept heights
        double value;
    };
    Point origin_{};
    std::vector<std::uint32_t> vertex_;  ///< those beyond the rays, and then those that slide
    std::vector<Point> from_origin_;     ///< per such vertex
    std::vector<Point> wall_;            ///< per ray: its wall vertex, from the origin
    std::vector<Point> kept_;            ///< per ray: the vertex beyond which it is stretched, from the origin
    std::vector<Coupling> couplings_;
    std::size_t inside_ = 0;  ///< number of the former
    SymmetricSystem system_;  ///< of those
    SymmetricSystem along_;   ///< of all, for the shift along x; without rows where none slides

    /// Returns the solution for both kinds. Those that slide have the shift along x alone.
    std::vector<Row> solve(std::span<const Row> right) const;
    Row row_of(const Motion& motion, const Coupling& coupling) const;
};

}  // namespace lamina::morphing
