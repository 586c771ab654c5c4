// Checks a mesh of two triangles and hashes it.
#include <cstdio>

#include <lamina/mesh.hpp>

int main() {
    using namespace lamina;
    const auto id = [](std::size_t i) { return VertexId{i}; };
    Mesh mesh;
    mesh.points = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    mesh.triangles = {{{id(0), id(1), id(2)}}, {{id(0), id(2), id(3)}}};
    mesh.markers.push_back(
        {"wall", MarkerKind::wall, {{id(0), id(1)}, {id(1), id(2)}, {id(2), id(3)}, {id(3), id(0)}}});
    const MeshCheck check = check_mesh(mesh);
    std::printf("%s %s\n", check.valid() ? "valid" : check.defects.front().description.c_str(),
                mesh_hash(mesh).c_str());
    return check.valid() ? 0 : 1;
}
