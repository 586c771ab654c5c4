// Writes a mesh of one triangle and reads it back.
#include <cstdio>

#include <lamina/io.hpp>

int main() {
    using namespace lamina;
    const auto id = [](std::size_t i) { return VertexId{i}; };
    Mesh mesh;
    mesh.points = {{0, 0}, {1, 0}, {0, 1}};
    mesh.triangles = {{{id(0), id(1), id(2)}}};
    mesh.markers.push_back({"wall", MarkerKind::wall, {{id(0), id(1)}, {id(1), id(2)}, {id(2), id(0)}}});
    write_mesh(mesh, "triangle.su2");
    return mesh_hash(read_mesh("triangle.su2")) == mesh_hash(mesh) ? 0 : 1;
}
