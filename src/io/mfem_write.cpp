// Writes the mesh format of MFEM, version 1.0: cells, edges of markers and vertices, and the nodes of curved cells as a
// grid function. Source: MFEM, "Mesh Formats"; mesh/mesh_readers.cpp, mesh/mesh.cpp (GetElementToEdgeTable) and
// fem/fe_coll.cpp of MFEM 4.
//
// Cells and markers have numbers for names, which a comment tells. The nodes are those of "H1@U", Lagrange's
// polynomials whose nodes are evenly spaced, or of "H1", whose nodes are those of NodeDistribution::gauss_lobatto.
// Their places stand vertex by vertex, edge by edge and cell by cell. Edges are numbered as cells have them first, and
// the nodes of each go from its vertex of the lower number to the other one. Those within cells go row by row.
#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "io/curved_lists.hpp"
#include "io/formats.hpp"
#include "io/mesh_parts.hpp"
#include "io/text_output.hpp"
#include "mesh/curved_nodes.hpp"

namespace lamina::io {

namespace {

enum MfemGeometry : std::size_t { mfem_segment = 1, mfem_triangle = 2, mfem_square = 3 };

class MfemWriter {
public:
    MfemWriter(const MeshView& mesh, const CurvedNodes& nodes, std::ostream& out)
        : mesh_(mesh), nodes_(nodes), cells_(mesh), out_(out) {}

    void write() {
        write_names();
        write_cells();
        write_boundary();
        write_vertices();
    }

private:
    void write_names() {
        out_ << "MFEM mesh v1.0\n\n# attributes of elements:";
        std::vector<std::string_view> regions;
        attributes_.resize(cells_.cells());
        for (const CellBlock& block : cell_blocks(mesh_)) {
            auto region = std::find(regions.begin(), regions.end(), block.region);
            if (region == regions.end()) region = regions.insert(region, block.region);
            const auto attribute = static_cast<std::uint8_t>(region - regions.begin() + 1);
            for (const std::uint32_t cell : block.cells)
                attributes_[cell + (block.corners == 4 ? mesh_.triangles.size() : 0)] = attribute;
        }
        for (std::size_t i = 0; i < regions.size(); ++i) out_ << fmt::format(" {} {}", i + 1, regions[i]);
        out_ << "\n# attributes of the boundary:";
        for (std::size_t m = 0; m < mesh_.markers.size(); ++m)
            out_ << fmt::format(" {} {}", m + 1, mesh_.markers[m].name);
        out_ << "\n\ndimension\n2\n\n";
    }
    void write_cells() {
        out_ << "elements\n" << cells_.cells() << '\n';
        write_lines(out_, cells_.cells(), [&](LineText& line, std::size_t cell) {
            const std::size_t corners = cells_.corners(cell);
            line << std::size_t{attributes_[cell]} << std::size_t{corners == 3 ? mfem_triangle : mfem_square};
            for (std::size_t i = 0; i < corners; ++i) line << cells_.corner(cell, i).index();
        });
    }
    void write_boundary() {
        out_ << "\nboundary\n" << count_marker_edges(mesh_) << '\n';
        for (std::size_t m = 0; m < mesh_.markers.size(); ++m)
            write_lines(out_, mesh_.markers[m].edges.size(), [&](LineText& line, std::size_t i) {
                const Segment& edge = mesh_.markers[m].edges[i];
                line << m + 1 << std::size_t{mfem_segment} << edge.a.index() << edge.b.index();
            });
    }
    void write_vertices() {
        out_ << "\nvertices\n" << mesh_.points.size() << '\n';
        if (nodes_.order == 1)
            out_ << "2\n";
        else
            out_ << fmt::format(
                "\nnodes\nFiniteElementSpace\nFiniteElementCollection: H1{}_2D_P{}\nVDim: 2\nOrdering: 1\n\n",
                nodes_.distribution == NodeDistribution::equidistant ? "@U" : "", nodes_.order);
        write_lines(out_, mesh_.points.size(), [&](LineText& line, std::size_t i) { line << mesh_.points[i]; });
        if (nodes_.order == 1) return;
        write_nodes_of_edges();
        write_nodes_of_cells();
    }
    void write_nodes_of_edges() {
        const std::vector<std::uint32_t> edges = edges_as_first_met(mesh_, mesh::find_adjacency(mesh_));
        const std::size_t within = nodes_.order - 1;
        write_lines(out_, edges.size() * within, [&](LineText& line, std::size_t i) {
            const std::size_t edge = edges[i / within], cell = cells_.cell_of(edge), k = i % within;
            const bool is_ascending = cells_.origin(edge) < cells_.target(edge);
            line << node(cell, (edge - cells_.first(cell)) * within + (is_ascending ? k : within - 1 - k));
        });
    }
    void write_nodes_of_cells() {
        std::size_t first = 0;
        for (const auto& [corners, cells] :
             {std::pair(3u, mesh_.triangles.size()), std::pair(4u, mesh_.quads.size())}) {
            const std::size_t border = std::size_t{corners} * nodes_.order;
            const std::vector<std::size_t> rows = rows_of_nodes(corners, nodes_.order, border);
            const std::size_t within = rows.size() - border;
            write_lines(out_, cells * within, [&, corners = corners](LineText& line, std::size_t i) {
                line << node(first + i / within, rows[border + i % within] - corners);
            });
            first += cells;
        }
    }
    /// Returns the place of a node of a cell, counted behind its corners.
    Point node(std::size_t cell, std::size_t i) const {
        return nodes_.points[mesh::inner_nodes(mesh_, nodes_, cell)[i].index() - mesh_.points.size()];
    }

    MeshView mesh_;
    const CurvedNodes& nodes_;
    mesh::CellEdges cells_;
    std::ostream& out_;
    std::vector<std::uint8_t> attributes_;  ///< of cells
};

}  // namespace

void write_mfem(const MeshView& mesh, const CurvedNodes& nodes, const std::filesystem::path& file, std::ostream& out) {
    require_marker_names(mesh.markers, file, "MFEM", "", 127);
    MfemWriter(mesh, nodes, out).write();
}

}  // namespace lamina::io
