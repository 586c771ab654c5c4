// Meshes in space: a plane mesh in several copies one above the other, with prisms and hexahedra between them.
//
// For n points, point i of the plane mesh becomes the nodes k n + i of the planes k = 0 ... cells. Likewise for m
// cells, cell c becomes the cells k m + c between the planes k and k + 1.
#pragma once

#include <cstddef>
#include <filesystem>

#include <lamina/io.hpp>

#include "io/openfoam_span.hpp"

namespace lamina::io {

/// Names of the first and of the last plane.
inline constexpr const char* first_plane = "z0";
inline constexpr const char* last_plane = "z1";

struct Extrusion {
    double length = openfoam_span;
    std::size_t cells = 1;
    bool periodic = false;

    std::size_t planes() const { return cells + 1; }
    /// Returns the height of a plane.
    double height(std::size_t plane) const {
        return plane == cells ? length : length * (static_cast<double>(plane) / static_cast<double>(cells));
    }
    /// Returns whether the mesh stands for a plane flow: it is one cell thick, and no plane continues the other.
    bool is_plane_flow() const { return cells == 1 && !periodic; }
};

/// Throws UsageError where the span is not positive, or where only its cells or its ends are given.
void require_span(const WriteOptions& options);
/// Returns the extrusion that the options ask for. Throws UsageError where programs that number by 32 bits could not
/// number its nodes or faces.
Extrusion extrusion_of(const MeshView& mesh, const std::filesystem::path& file, const WriteOptions& options);

}  // namespace lamina::io
