// Meshes that are handed on part by part while they are made, so that nobody holds them as a whole: by stream_mesh() to
// a file (open_mesh_sink()) or to a sink of your own, by share_mesh() to several processes.
//
// Guarantees:
//  1. Parts follow one another in the mesh, all triangles before all quadrilaterals, with numbers of their own.
//  2. What a sink of the library has taken is gone without a trace where commit() is not called.
// Example:
//     struct Counter : MeshSink {
//         std::size_t cells = 0;
//         Bytes format(const MeshPart& part) const override { return {std::string(part.triangles.size(), 't')}; }
//         void append(const Bytes& bytes) override { cells += bytes.front().size(); }
//         void finish(const MeshCounts&, std::span<const Marker>, std::span<const Segment>) override {}
//         void commit() override {}
//         std::size_t bytes() const override { return 0; }
//     };
//     const auto open = [] { return std::make_unique<Counter>(); };
//     const StreamedMesh made = stream_mesh({"naca:0012:60"}, {.layer = {.enabled = false}}, open);
//     assert(static_cast<const Counter&>(*made.sink).cells == made.counts.triangles);
#pragma once

#include <functional>

#include <lamina/mesh.hpp>

namespace lamina {

namespace mesh {
class MeshParts;
}

/// A part of a mesh. All numbers are those of the whole mesh.
struct MeshPart {
    std::size_t first_vertex = 0;             ///< number of the first point
    std::span<const Point> points{};          ///< vertices that no part before has
    std::size_t first_cell = 0;               ///< number of the first cell
    std::span<const Triangle> triangles{};    ///< its triangles
    std::span<const Point> shared{};          ///< the first vertices of the mesh, which cells of several parts may have
    Region region = Region::isotropic;        ///< of its cells
    std::uint32_t piece = 0;                  ///< the piece that made them
    std::span<const std::uint16_t> layers{};  ///< per cell: its layer from the wall, from 1; empty: 0 for all
    std::span<const Quad> quads{};            ///< its quadrilaterals
};

/// The size of a mesh.
struct MeshCounts {
    std::size_t vertices = 0;         ///< number of vertices
    std::size_t triangles = 0;        ///< number of triangles
    std::size_t quads = 0;            ///< number of quadrilaterals
    std::size_t layer_triangles = 0;  ///< how many of the triangles belong to the layer
};

/// The data of a mesh that its parts do not hold: all but cells and points.
struct MeshFrame {
    MeshCounts counts;                     ///< its size
    std::span<const Marker> markers;       ///< as Mesh::markers
    std::span<const Segment> constraints;  ///< as Mesh::constraints
};

/// A mesh file in the making.
class MeshSink {
public:
    using Bytes = std::vector<std::string>;  ///< the contents of a part, one string for each section of the file

    MeshSink() = default;
    MeshSink(const MeshSink&) = delete;
    MeshSink& operator=(const MeshSink&) = delete;
    virtual ~MeshSink() = default;

    virtual Bytes format(const MeshPart& part) const = 0;  ///< what append() takes; on several threads at once
    virtual void append(const Bytes& bytes) = 0;           ///< takes the next part; throws IoError
    /// Ends the mesh, after its last part. Throws IoError; UsageError for marker names that the format cannot hold.
    virtual void finish(const MeshCounts& counts, std::span<const Marker> markers,
                        std::span<const Segment> constraints) = 0;
    virtual void commit() = 0;              ///< makes the file appear, as a whole or not at all; throws IoError
    virtual std::size_t bytes() const = 0;  ///< the number of bytes that the parts have taken so far
};

}  // namespace lamina
