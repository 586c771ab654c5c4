// Finds the two neighbouring cells of the layer whose areas differ most.
#pragma once

#include <cstdint>
#include <span>

#include <lamina/mesh.hpp>

namespace lamina::pipeline {

/// The ratio of the areas of two neighbours, and the middle of their common edge.
struct AreaJump {
    double ratio = 1;
    Point at{};
};

/// The largest ratios of the areas of two neighbouring cells of the layer.
struct AreaJumps {
    /// On the two sides of a fan of rays. The first cell of the fan is as high as wide at most: beside the cell on an
    /// edge of the wall it is as small as a first height is beside this edge.
    AreaJump beside_fans;
    AreaJump elsewhere;
};

/// Finds them in a mesh whose first triangles are those of the layer, followed by others or none; all its quads belong
/// to the layer. `columns` and `column_origins` are those of MeshResult; without them no neighbours are beside fans.
AreaJumps find_area_jumps(const Mesh& mesh, std::span<const std::uint32_t> columns,
                          std::span<const VertexId> column_origins);

}  // namespace lamina::pipeline
