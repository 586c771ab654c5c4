// The region beyond the layers of a mesh, which is meshed anew with other sizes while the layers stay.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <lamina/mesh.hpp>
#include <lamina/sizing.hpp>

#include "decoupling/far_field.hpp"

namespace lamina::adaptation {

/// A stretch of the border of a domain.
struct DomainStretch {
    std::vector<VertexId> vertices;  ///< in their order; both ends alone of a side
    bool is_side = false;            ///< whether it is straight and is divided anew; fronts of layers and walls stay
};

/// The region of the isotropic cells: its borders, and what surrounds it.
struct OuterRegion {
    std::vector<Point> points;                   ///< the vertices of all borders that stay, and corners of the domain
    std::vector<std::vector<VertexId>> borders;  ///< indices into points, counter-clockwise round bodies and layers
    decoupling::FarField far_field;              ///< the outer border
    /// The outer border, clockwise, where fronts of layers or walls are a part of it, as on ground, on bodies that a
    /// line of symmetry cuts and in a row of blades; empty elsewhere.
    std::vector<DomainStretch> domain{};
    std::size_t inside_vertices = 0;  ///< number of vertices in and below the layers, without the borders'
};

/// Returns the edges that part isotropic cells from all else, with the isotropic cell on the left.
std::vector<Segment> border_edges(const Mesh& mesh, std::span<const char> isotropic);

/// Takes cells from the isotropic ones until the rest hangs together over edges and has simple loops as borders: cells
/// between others of the layer, and those at vertices where the region touches itself. Estimated regions need it.
std::vector<char> simple_region(const Mesh& mesh, std::vector<char> isotropic);

/// Returns the region of these cells. Sides of the domain are edges of markers of a far field or of symmetry. Throws
/// OptionError where the outermost border consists of sides and is not convex; all edges are sides of a mesh without
/// these markers. Precondition: the region is that of simple_region().
OuterRegion find_outer_region(const Mesh& mesh, std::span<const char> isotropic);

/// Returns the number of vertices of the mesh that has this region meshed with other sizes, and all else as it is.
/// Throws the errors of decouple() and refine().
std::size_t count_vertices(const OuterRegion& region, const SizedMesh& sizes);

/// Returns, for each point, the smallest size there that divides no edge of the borders of bodies.
std::vector<double> sizes_of_borders(const OuterRegion& region, std::span<const Point> points);

}  // namespace lamina::adaptation
