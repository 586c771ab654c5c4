// A mesh that arrays of Python may still see.
#pragma once

#include <memory>
#include <string>
#include <utility>

#include <lamina/curved_mesh.hpp>
#include <lamina/error.hpp>
#include <lamina/mesh.hpp>

namespace lamina::python {

/// A mesh that arrays of Python may still see. It never changes.
struct SharedMesh {
    std::shared_ptr<const Mesh> mesh;
    std::shared_ptr<const CurvedNodes> nodes =
        std::make_shared<const CurvedNodes>();  ///< of order 1 for straight cells
    const Mesh& operator*() const { return *mesh; }
};

inline SharedMesh shared(Mesh mesh, CurvedNodes nodes = {}) {
    return {std::make_shared<const Mesh>(std::move(mesh)), std::make_shared<const CurvedNodes>(std::move(nodes))};
}

/// Throws UsageError where a mesh has curved cells, which `what` knows nothing of.
inline void require_straight(const SharedMesh& mesh, const char* what) {
    if (mesh.nodes->order > 1) throw UsageError(std::string(what) + " takes straight cells alone");
}

/// Throws MeshError where a mesh is not valid.
inline void require_valid(const Mesh& mesh) {
    const MeshCheck check = check_mesh(mesh);
    if (!check.valid()) throw MeshError("the mesh is not valid: " + check.defects[0].description, check.defects[0].at);
}

}  // namespace lamina::python
