// Meshes: made, seen as typed arrays, written.
#pragma once

#include <string>

#include <emscripten/val.h>

#include <lamina/curved_mesh.hpp>
#include <lamina/mesh.hpp>

namespace lamina::web {

/// A mesh that JavaScript holds by this object, until it calls delete().
class HeldMesh {
public:
    HeldMesh(Mesh mesh, CurvedNodes nodes) : mesh_(std::move(mesh)), nodes_(std::move(nodes)) {}

    /// Returns an object with copies of the arrays: points, triangles, quads, region, piece, layer, constraints, and
    /// markers with name, kind and edges.
    emscripten::val arrays() const;
    /// Writes the mesh to a file of the module's file system. Throws what write_mesh() and write_curved_mesh() throw.
    void write(const std::string& file, const std::string& format, bool wall_distance) const;
    /// Returns mesh_hash().
    std::string hash() const { return mesh_hash(mesh_); }

private:
    Mesh mesh_;
    CurvedNodes nodes_;  ///< of cells of an order above 1
};

/// Makes a mesh from inputs, which are names of files in the module's file system or of NACA sections, with the options
/// of an object. Returns an object: mesh (a HeldMesh), warnings, facts. `progress` is called with the name of each
/// stage that begins, unless it is null.
emscripten::val generate(const emscripten::val& inputs, const emscripten::val& options,
                         const emscripten::val& progress);

/// Returns name, points, title, format and repairs of each element that the inputs hold.
emscripten::val outlines(const emscripten::val& inputs);

/// Returns the triangles of the Delaunay triangulation of points: three numbers of points for each.
emscripten::val delaunay(const emscripten::val& points);

}  // namespace lamina::web
