// Finds the plane mesh whose extrusion a file holds (extrusion.hpp), and so checks that the file holds one.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include <lamina/mesh.hpp>

namespace lamina::io {

/// A mesh in space as files hold it.
struct SpaceMesh {
    /// A prism or a hexahedron: the corners of one face, and those of the opposite one in the same order.
    struct Volume {
        std::size_t corners = 3;  ///< of the face: 3 or 4
        std::array<std::uint32_t, 8> nodes{};
    };
    /// A face of the boundary, or of an internal marker.
    struct Face {
        std::size_t corners = 3;  ///< 3 or 4
        std::array<std::uint32_t, 4> nodes{};
        std::size_t marker = 0;
    };

    std::vector<Point> points;    ///< per node: its place in the plane
    std::vector<double> heights;  ///< per node: its third coordinate, the one across the span
    std::vector<Volume> volumes;
    std::vector<Face> faces;
};

/// A plane mesh, and where its parts stand in the mesh in space.
struct PlaneOfExtrusion {
    std::vector<std::uint32_t> nodes;  ///< per vertex: its node in the lowest plane, ascending
    std::vector<Point> points;         ///< per vertex
    std::vector<Triangle> triangles;
    std::vector<Quad> quads;
    std::vector<std::uint32_t> volumes;       ///< per triangle, then per quad: the volume on it, ascending in each
    std::vector<std::vector<Segment>> edges;  ///< per marker: the edges that its faces stand on, in the order of faces
};

/// Returns the values with these indices, such as those of the nodes of the lowest plane.
std::vector<double> values_at(std::span<const double> values, std::span<const std::uint32_t> indices);

/// Returns the plane mesh. Cells run counter-clockwise, and edges as the first face on them, for programs do not agree
/// on either. Faces in the lowest and in the highest plane make no edges.
///
/// Throws InputError about the file where it holds no extrusion: nodes of a plane do not stand straight above those of
/// the lowest plane, or some cells between two planes are not those between the lowest two. Precondition: all nodes and
/// markers are in range, and coordinates are finite.
PlaneOfExtrusion plane_of_extrusion(const SpaceMesh& mesh, std::size_t markers, const std::filesystem::path& file);

}  // namespace lamina::io
