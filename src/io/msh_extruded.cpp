// MSH 2.2, ASCII, one cell thick in z: prisms and hexahedra, for gmshToFoam and other programs that read no plane
// meshes. Source: Gmsh reference manual, "Gmsh mesh file formats".
//
// Node i of the mesh is i + 1 at z = 0, n behind it at z = 1. Physical surfaces: the markers and `frontAndBack`;
// physical volumes: the regions.
#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "io/formats.hpp"
#include "io/mesh_parts.hpp"
#include "io/text_output.hpp"

namespace lamina::io {

namespace {

enum ElementType : int { triangle_type = 2, quad_type = 3, hexahedron_type = 5, prism_type = 6 };

}  // namespace

void write_msh_extruded(const Mesh& mesh, const std::filesystem::path& file, std::ostream& out) {
    require_marker_names(mesh, file, "MSH", "\"", 127);
    const std::vector<CellBlock> blocks = cell_blocks(mesh);
    const std::size_t n = mesh.points.size(), cells = mesh.triangles.size() + mesh.quads.size();
    const std::size_t sides = mesh.markers.size() + 1;
    std::vector<std::string> volumes;
    for (const CellBlock& block : blocks)
        if (std::find(volumes.begin(), volumes.end(), block.region) == volumes.end())
            volumes.emplace_back(block.region);

    out << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n" << sides + volumes.size() << '\n';
    for (std::size_t m = 0; m < mesh.markers.size(); ++m)
        out << fmt::format("2 {} \"{}\"\n", m + 1, mesh.markers[m].name);
    out << fmt::format("2 {} \"{}\"\n", sides, front_and_back);
    for (std::size_t v = 0; v < volumes.size(); ++v) out << fmt::format("3 {} \"{}\"\n", sides + v + 1, volumes[v]);
    out << "$EndPhysicalNames\n$Nodes\n" << 2 * n << '\n';
    write_lines(out, 2 * n, [&](LineText& line, std::size_t i) {
        line << i + 1 << mesh.points[i < n ? i : i - n] << (i < n ? "0" : "1");
    });

    std::size_t edges = 0, number = 1;
    for (const Marker& marker : mesh.markers) edges += marker.edges.size();
    out << "$EndNodes\n$Elements\n" << edges + 3 * cells << '\n';
    // put(line, i) puts in the nodes of element i of one type and group.
    const auto write_elements = [&](std::size_t count, ElementType type, std::size_t group, auto&& put) {
        const std::string kind = fmt::format("{} 2 {} {}", int{type}, group, group);
        write_lines(out, count, [&](LineText& line, std::size_t i) {
            line << number + i << kind;
            put(line, i);
        });
        number += count;
    };
    for (std::size_t m = 0; m < mesh.markers.size(); ++m)
        write_elements(mesh.markers[m].edges.size(), quad_type, m + 1, [&](LineText& line, std::size_t i) {
            const std::size_t a = mesh.markers[m].edges[i].a.index() + 1, b = mesh.markers[m].edges[i].b.index() + 1;
            line << a << b << n + b << n + a;
        });
    for (const CellBlock& block : blocks) {
        const std::size_t count = block.cells.size();
        const auto put_plane = [&](LineText& line, std::size_t i, std::size_t shift) {
            for (std::size_t k = 0; k < block.corners; ++k) line << shift + block.vertices(mesh, i)[k].index() + 1;
        };
        const ElementType face = block.corners == 3 ? triangle_type : quad_type;
        write_elements(count, face, sides, [&](LineText& line, std::size_t i) {
            for (std::size_t k = block.corners; k-- > 0;) line << block.vertices(mesh, i)[k].index() + 1;
        });
        write_elements(count, face, sides, [&](LineText& line, std::size_t i) { put_plane(line, i, n); });
        const auto volume = std::find(volumes.begin(), volumes.end(), block.region) - volumes.begin();
        write_elements(count, block.corners == 3 ? prism_type : hexahedron_type,
                       sides + 1 + static_cast<std::size_t>(volume), [&](LineText& line, std::size_t i) {
                           put_plane(line, i, 0);
                           put_plane(line, i, n);
                       });
    }
    out << "$EndElements\n";
}

}  // namespace lamina::io
