// A mesh that arrays of Python may still see.
#pragma once

#include <memory>
#include <utility>

#include <lamina/error.hpp>
#include <lamina/mesh.hpp>

namespace lamina::python {

/// A mesh that arrays of Python may still see. It never changes.
struct SharedMesh {
    std::shared_ptr<const Mesh> mesh;
    const Mesh& operator*() const { return *mesh; }
};

inline SharedMesh shared(Mesh mesh) { return {std::make_shared<const Mesh>(std::move(mesh))}; }

/// Throws MeshError where a mesh is not valid.
inline void require_valid(const Mesh& mesh) {
    const MeshCheck check = check_mesh(mesh);
    if (!check.valid()) throw MeshError("the mesh is not valid: " + check.defects[0].description, check.defects[0].at);
}

}  // namespace lamina::python
