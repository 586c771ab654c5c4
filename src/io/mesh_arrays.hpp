// The arrays of a mesh that may lie in temporary files. Readers that are templates fill these or a Mesh.
#pragma once

#include <cstdint>
#include <string_view>
#include <utility>
#include <vector>

#include <lamina/io.hpp>
#include <lamina/mesh.hpp>

#include "core/scratch_memory.hpp"

namespace lamina::io {

/// The members have the names of those of Mesh.
struct MeshArrays {
    core::ScratchArray<Point> points;
    core::ScratchArray<Triangle> triangles;
    core::ScratchArray<Quad> quads;
    std::vector<Marker> markers;
    core::ScratchArray<Region> region;
    core::ScratchArray<std::uint32_t> piece;
    core::ScratchArray<std::uint16_t> layer;
    std::vector<Segment> constraints;

    explicit MeshArrays(bool in_files)
        : points(in_files), triangles(in_files), quads(in_files), region(in_files), piece(in_files), layer(in_files) {}
    MeshView view() const {
        MeshView view;
        view.points = points;
        view.triangles = triangles;
        view.quads = quads;
        view.markers = markers;
        view.region = region;
        view.piece = piece;
        view.layer = layer;
        view.constraints = constraints;
        return view;
    }
};

inline MeshView view_of(const Mesh& mesh) { return mesh; }
inline MeshView view_of(const MeshArrays& arrays) { return arrays.view(); }

/// Prepares for at most so many cells of either shape. A vector grows by itself, and takes no more than it needs.
inline void reserve_cells(Mesh&, std::size_t) {}
inline void reserve_cells(MeshArrays& arrays, std::size_t cells) {
    arrays.triangles.reserve(cells);
    arrays.quads.reserve(cells);
}

}  // namespace lamina::io

namespace lamina {

/// A StoredMesh holds a mesh in memory, or arrays.
struct StoredMesh::Arrays {
    Mesh mesh;
    CurvedNodes curved;
    bool has_arrays = false, in_files = false;
    io::MeshArrays arrays;
    std::vector<Region> region;  ///< in place of that of the arrays
    bool has_region = false;

    explicit Arrays(bool files) : has_arrays(true), in_files(files), arrays(files) {}
    Arrays(Mesh whole, CurvedNodes nodes) : mesh(std::move(whole)), curved(std::move(nodes)), arrays(false) {}
};

}  // namespace lamina
