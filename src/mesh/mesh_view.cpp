#include <lamina/mesh.hpp>

namespace lamina {

MeshView::MeshView(const Mesh& mesh)
    : points(mesh.points),
      triangles(mesh.triangles),
      quads(mesh.quads),
      markers(mesh.markers),
      region(mesh.region),
      piece(mesh.piece),
      layer(mesh.layer),
      constraints(mesh.constraints) {}

}  // namespace lamina
