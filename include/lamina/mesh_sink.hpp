// Meshes that are written part by part while they are made, so that nobody holds them as a whole.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include <lamina/mesh.hpp>

namespace lamina {

/// A part of a mesh. All numbers are those of the whole mesh, in which the parts follow one another.
struct MeshPart {
    std::size_t first_vertex = 0;             ///< number of the first point
    std::span<const Point> points{};          ///< vertices that no part before has
    std::size_t first_cell = 0;               ///< number of the first cell
    std::span<const Triangle> triangles{};    ///< its triangles; all triangles of the mesh come before all quads
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

/// How much is in a part.
struct PartCounts {
    std::size_t points = 0;     ///< number of points, those that it shares with other parts among them
    std::size_t triangles = 0;  ///< number of triangles
    std::size_t quads = 0;      ///< number of quadrilaterals
};

/// The parts of a mesh that one process holds, where several processes hold it together.
class MeshParts {
public:
    MeshParts() = default;
    MeshParts(const MeshParts&) = delete;
    MeshParts& operator=(const MeshParts&) = delete;
    virtual ~MeshParts() = default;

    /// Returns the places of these parts in the order of all parts of the mesh, ascending. Places of other processes lie
    /// between them.
    virtual std::vector<std::uint64_t> places() const = 0;
    /// Calls take() with part i of these. May be called on several threads at once. Throws IoError.
    virtual void visit(std::size_t i, const std::function<void(const MeshPart&)>& take) const = 0;
    /// Returns how much is in part i, without reading it.
    virtual PartCounts counts(std::size_t i) const = 0;
};

/// A frame holds what a mesh has beside the cells and points of its parts.
struct MeshFrame {
    MeshCounts counts;                     ///< its size
    std::span<const Marker> markers;       ///< as Mesh::markers
    std::span<const Segment> constraints;  ///< as Mesh::constraints
};

/// A mesh file in the making. What it has taken is gone without a trace where commit() is not called.
class MeshSink {
public:
    /// The contents of a part, one string for each section of the file.
    using Bytes = std::vector<std::string>;

    MeshSink() = default;
    MeshSink(const MeshSink&) = delete;
    MeshSink& operator=(const MeshSink&) = delete;
    virtual ~MeshSink() = default;

    /// Returns what append() takes for this part. May be called on several threads at once.
    virtual Bytes format(const MeshPart& part) const = 0;
    /// Takes the next part. Throws IoError.
    virtual void append(const Bytes& bytes) = 0;
    /// Ends the mesh, after its last part; constraints are those of Mesh::constraints. Throws IoError; UsageError for marker names that the format cannot hold.
    virtual void finish(const MeshCounts& counts, std::span<const Marker> markers,
                        std::span<const Segment> constraints) = 0;
    /// Makes the file appear under its name, as a whole or not at all. Throws IoError.
    virtual void commit() = 0;
    /// Returns the number of bytes that the parts have taken so far.
    virtual std::size_t bytes() const = 0;
};

}  // namespace lamina
