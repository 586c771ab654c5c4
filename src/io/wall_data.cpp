// Writes the table of the wall vertices as CSV.
#include <string>

#include <fmt/format.h>

#include <lamina/io.hpp>

#include "core/atomic_file.hpp"

namespace lamina {

void write_wall_data(const Mesh& mesh, const std::filesystem::path& file) {
    const WallVertices walls = wall_vertices(mesh);
    std::string text = "marker,vertex,x,y,arc_length,normal_x,normal_y,first_height\n";
    for (std::size_t i = 0; i < walls.vertex.size(); ++i) {
        const std::size_t v = walls.vertex[i].index();
        text += fmt::format("{},{},{:.16e},{:.16e},{:.16e},{:.16e},{:.16e},{:.16e}\n",
                            mesh.markers[walls.marker[i]].name, v, mesh.points[v].x, mesh.points[v].y,
                            walls.arc_length[i], walls.normal[i].x, walls.normal[i].y, walls.first_height[i]);
    }
    core::write_stream_atomically(file, [&](std::ostream& out) { out << text; });
}

}  // namespace lamina
