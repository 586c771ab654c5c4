// A mesh that arrays of Python may still see.
#pragma once

#include <memory>
#include <utility>

#include <lamina/mesh.hpp>

namespace lamina::python {

/// A mesh that arrays of Python may still see. It never changes.
struct SharedMesh {
    std::shared_ptr<const Mesh> mesh;
    const Mesh& operator*() const { return *mesh; }
};

inline SharedMesh shared(Mesh mesh) { return {std::make_shared<const Mesh>(std::move(mesh))}; }

}  // namespace lamina::python
