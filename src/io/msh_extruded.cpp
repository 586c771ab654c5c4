// Writes MSH 2.2, ASCII, in space: prisms and hexahedra, for gmshToFoam and other programs that read no plane meshes
// (extrusion.hpp). Source: Gmsh reference manual, "Gmsh mesh file formats".
//
// Physical surfaces are the markers, and `frontAndBack` for plane flow, else the two planes; physical volumes are the
// regions. Where the planes are periodic, the nodes of the last are those of the first.
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
    ExtrudedWriter(const MeshView& mesh, const Extrusion& extrusion, std::ostream& out)
        : mesh_(mesh), extrusion_(extrusion), out_(out), blocks_(cell_blocks(mesh)), points_(mesh.points.size()) {
        for (const CellBlock& block : blocks_)
            if (std::find(volumes_.begin(), volumes_.end(), block.region) == volumes_.end())
                volumes_.emplace_back(block.region);
    }

    void write() {
        write_header_and_names();
        write_nodes();
        write_elements();
        if (extrusion_.periodic) write_periodic_nodes();
    }

private:
    /// The physical groups are numbered: the markers from 1 on, then the planes, then the volumes.
    std::size_t first_plane_group() const { return mesh_.markers.size() + 1; }
    std::size_t last_plane_group() const { return first_plane_group() + (extrusion_.is_plane_flow() ? 0 : 1); }

    void write_header_and_names() {
        out_ << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n"
             << last_plane_group() + volumes_.size() << '\n';
        for (std::size_t m = 0; m < mesh_.markers.size(); ++m)
            out_ << fmt::format("2 {} \"{}\"\n", m + 1, mesh_.markers[m].name);
        if (extrusion_.is_plane_flow())
            out_ << fmt::format("2 {} \"{}\"\n", first_plane_group(), front_and_back);
        else
            out_ << fmt::format("2 {} \"{}\"\n2 {} \"{}\"\n", first_plane_group(), first_plane, last_plane_group(),
                                last_plane);
        for (std::size_t v = 0; v < volumes_.size(); ++v)
            out_ << fmt::format("3 {} \"{}\"\n", last_plane_group() + v + 1, volumes_[v]);
        out_ << "$EndPhysicalNames\n";
    }

    void write_nodes() {
        std::vector<std::string> heights;
        for (std::size_t k = 0; k < extrusion_.planes(); ++k) heights.push_back(fmt::to_string(extrusion_.height(k)));
        out_ << "$Nodes\n" << heights.size() * points_ << '\n';
        write_lines(out_, heights.size() * points_, [&](LineText& line, std::size_t i) {
            line << i + 1 << mesh_.points[i % points_] << heights[i / points_];
        });
        out_ << "$EndNodes\n";
    }

    void write_elements() {
        const std::size_t cells = mesh_.triangles.size() + mesh_.quads.size();
        out_ << "$Elements\n" << extrusion_.cells * count_marker_edges(mesh_) + (2 + extrusion_.cells) * cells << '\n';
        for (std::size_t m = 0; m < mesh_.markers.size(); ++m) write_sides(mesh_.markers[m], m + 1);
        for (const CellBlock& block : blocks_) write_cells(block);
        out_ << "$EndElements\n";
    }
    void write_sides(const Marker& marker, std::size_t group) {
        const std::size_t edges = marker.edges.size();
        write_elements(extrusion_.cells * edges, msh_quad, group, [&](LineText& line, std::size_t i) {
            const std::size_t first = i / edges * points_ + 1;
            const std::size_t a = first + marker.edges[i % edges].a.index(),
                              b = first + marker.edges[i % edges].b.index();
            line << a << b << points_ + b << points_ + a;
        });
    }
    /// Writes the faces of the cells in the first plane, which run clockwise, and in the last, and the volumes.
    void write_cells(const CellBlock& block) {
        const std::size_t count = block.cells.size();
        const auto put_nodes = [&](LineText& line, std::size_t i, std::size_t shift) {
            for (std::size_t k = 0; k < block.corners; ++k) line << shift + block.vertices(mesh_, i)[k].index() + 1;
        };
        const MshElementType face = block.corners == 3 ? msh_triangle : msh_quad;
        write_elements(count, face, first_plane_group(), [&](LineText& line, std::size_t i) {
            for (std::size_t k = block.corners; k-- > 0;) line << block.vertices(mesh_, i)[k].index() + 1;
        });
        write_elements(count, face, last_plane_group(),
                       [&](LineText& line, std::size_t i) { put_nodes(line, i, extrusion_.cells * points_); });
        const auto volume = std::find(volumes_.begin(), volumes_.end(), block.region) - volumes_.begin();
        write_elements(extrusion_.cells * count, block.corners == 3 ? msh_prism : msh_hexahedron,
                       last_plane_group() + 1 + static_cast<std::size_t>(volume), [&](LineText& line, std::size_t i) {
                           put_nodes(line, i % count, i / count * points_);
                           put_nodes(line, i % count, (i / count + 1) * points_);
                       });
    }
    void write_periodic_nodes() {
        out_ << fmt::format("$Periodic\n1\n2 {} {}\nAffine 1 0 0 0 0 1 0 0 0 0 1 {} 0 0 0 1\n{}\n", last_plane_group(),
                            first_plane_group(), extrusion_.length, points_);
        write_lines(out_, points_,
                    [&](LineText& line, std::size_t i) { line << extrusion_.cells * points_ + i + 1 << i + 1; });
        out_ << "$EndPeriodic\n";
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
    const Extrusion& extrusion_;
    std::ostream& out_;
    std::vector<CellBlock> blocks_;
    std::size_t points_;
    std::vector<std::string> volumes_;  ///< names of the regions
    std::size_t next_element_ = 1;
};

}  // namespace

void write_msh_extruded(const MeshView& mesh, const std::filesystem::path& file, const Extrusion& extrusion,
                        std::ostream& out) {
    require_legal_marker_names(mesh.markers, file, "MSH for gmshToFoam");
    ExtrudedWriter(mesh, extrusion, out).write();
}

}  // namespace lamina::io
