// Writes MSH 2.2, ASCII, one cell thick in z: prisms and hexahedra, for gmshToFoam and other programs that read no
// plane meshes. Source: Gmsh reference manual, "Gmsh mesh file formats".
//
// For n points, point i of the mesh becomes the nodes i + 1 at z = 0 and n + i + 1 at z = 1. Physical surfaces are the
// markers and `frontAndBack`; physical volumes are the regions.
#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "io/formats.hpp"
#include "io/mesh_parts.hpp"
#include "io/msh_elements.hpp"
#include "io/text_output.hpp"

namespace lamina::io {

namespace {

class ExtrudedWriter {
public:
    ExtrudedWriter(const MeshView& mesh, std::ostream& out)
        : mesh_(mesh), out_(out), blocks_(cell_blocks(mesh)), points_(mesh.points.size()) {
        for (const CellBlock& block : blocks_)
            if (std::find(volumes_.begin(), volumes_.end(), block.region) == volumes_.end())
                volumes_.emplace_back(block.region);
    }

    void write() {
        write_header_and_names();
        write_nodes();
        write_elements();
    }

private:
    /// The physical groups are numbered: the markers from 1 on, then `frontAndBack`, then the volumes.
    std::size_t front_and_back_group() const { return mesh_.markers.size() + 1; }

    void write_header_and_names() {
        out_ << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n"
             << front_and_back_group() + volumes_.size() << '\n';
        for (std::size_t m = 0; m < mesh_.markers.size(); ++m)
            out_ << fmt::format("2 {} \"{}\"\n", m + 1, mesh_.markers[m].name);
        out_ << fmt::format("2 {} \"{}\"\n", front_and_back_group(), front_and_back);
        for (std::size_t v = 0; v < volumes_.size(); ++v)
            out_ << fmt::format("3 {} \"{}\"\n", front_and_back_group() + v + 1, volumes_[v]);
        out_ << "$EndPhysicalNames\n";
    }

    void write_nodes() {
        out_ << "$Nodes\n" << 2 * points_ << '\n';
        write_lines(out_, 2 * points_, [&](LineText& line, std::size_t i) {
            line << i + 1 << mesh_.points[i < points_ ? i : i - points_] << (i < points_ ? "0" : "1");
        });
        out_ << "$EndNodes\n";
    }

    void write_elements() {
        const std::size_t cells = mesh_.triangles.size() + mesh_.quads.size();
        out_ << "$Elements\n" << count_marker_edges(mesh_) + 3 * cells << '\n';
        for (std::size_t m = 0; m < mesh_.markers.size(); ++m) write_sides(mesh_.markers[m], m + 1);
        for (const CellBlock& block : blocks_) write_cells(block);
        out_ << "$EndElements\n";
    }
    void write_sides(const Marker& marker, std::size_t group) {
        write_elements(marker.edges.size(), msh_quad, group, [&](LineText& line, std::size_t i) {
            const std::size_t a = marker.edges[i].a.index() + 1, b = marker.edges[i].b.index() + 1;
            line << a << b << points_ + b << points_ + a;
        });
    }
    /// Writes the faces of the cells at z = 0, which run clockwise, and at z = 1, and the volumes between them.
    void write_cells(const CellBlock& block) {
        const std::size_t count = block.cells.size();
        const auto put_nodes = [&](LineText& line, std::size_t i, std::size_t shift) {
            for (std::size_t k = 0; k < block.corners; ++k) line << shift + block.vertices(mesh_, i)[k].index() + 1;
        };
        const MshElementType face = block.corners == 3 ? msh_triangle : msh_quad;
        write_elements(count, face, front_and_back_group(), [&](LineText& line, std::size_t i) {
            for (std::size_t k = block.corners; k-- > 0;) line << block.vertices(mesh_, i)[k].index() + 1;
        });
        write_elements(count, face, front_and_back_group(),
                       [&](LineText& line, std::size_t i) { put_nodes(line, i, points_); });
        const auto volume = std::find(volumes_.begin(), volumes_.end(), block.region) - volumes_.begin();
        write_elements(count, block.corners == 3 ? msh_prism : msh_hexahedron,
                       front_and_back_group() + 1 + static_cast<std::size_t>(volume),
                       [&](LineText& line, std::size_t i) {
                           put_nodes(line, i, 0);
                           put_nodes(line, i, points_);
                       });
    }
    /// Writes elements of one type and group; put_nodes(line, i) adds the nodes of element i.
    template <class F>
    void write_elements(std::size_t count, MshElementType type, std::size_t group, F&& put_nodes) {
        const std::string type_and_tags = fmt::format("{} 2 {} {}", int{type}, group, group);
        write_lines(out_, count, [&](LineText& line, std::size_t i) {
            line << next_element_ + i << type_and_tags;
            put_nodes(line, i);
        });
        next_element_ += count;
    }

    MeshView mesh_;
    std::ostream& out_;
    std::vector<CellBlock> blocks_;
    std::size_t points_;
    std::vector<std::string> volumes_;  ///< names of the regions
    std::size_t next_element_ = 1;
};

}  // namespace

void write_msh_extruded(const MeshView& mesh, const std::filesystem::path& file, std::ostream& out) {
    require_legal_marker_names(mesh.markers, file, "MSH for gmshToFoam");
    ExtrudedWriter(mesh, out).write();
}

}  // namespace lamina::io
