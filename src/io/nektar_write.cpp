// Writes the geometry of Nektar++ as XML: vertices, edges, cells made of edges, curves and composites, the named groups
// of cells or edges. Source: Nektar++ user guide, "XML session file, Geometry"; Nektar++ 5, library/SpatialDomains,
// MeshGraphIOXml.cpp, TriGeom.cpp and QuadGeom.cpp; NodalTriEvenlySpaced.cpp for the order of nodes.
//
// A curved cell has a curve of its own and one on each of its edges, both with nodes of the mesh's distribution;
// others have none, and solvers take them as straight. Nodes of a triangle stand as in CurvedNodes, those within it
// row by row; all nodes of a quadrilateral stand row by row. Those of an edge go from its first vertex to the second
// one.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "io/curved_lists.hpp"
#include "io/formats.hpp"
#include "io/mesh_parts.hpp"
#include "io/nektar_nodes.hpp"
#include "io/text_output.hpp"
#include "mesh/curved_nodes.hpp"

namespace lamina::io {

namespace {

/// Returns ascending numbers as Nektar++ lists them: "0-9,12".
std::string ranges_of(std::span<const std::uint32_t> numbers) {
    std::string text;
    for (std::size_t i = 0; i < numbers.size();) {
        const std::size_t first = i;
        while (++i < numbers.size() && numbers[i] == numbers[i - 1] + 1) continue;
        text += fmt::format("{}{}", text.empty() ? "" : ",", numbers[first]);
        if (i - first > 1) text += fmt::format("-{}", numbers[i - 1]);
    }
    return text;
}

/// Adds an attribute with a number to a tag.
void put_attribute(LineText& line, std::string_view name, std::size_t value) {
    line.tight(name).tight("=\"") << value;
    line.take_back() << "\"";
}

/// Adds the begin of an element with a number.
void begin_element(LineText& line, std::string_view tag, std::size_t number) {
    line.tight("<") << tag;
    put_attribute(line, "ID", number);
    line << ">";
}

class NektarWriter {
public:
    NektarWriter(const MeshView& mesh, const CurvedNodes& nodes, std::ostream& out)
        : mesh_(mesh), nodes_(nodes), cells_(mesh), out_(out) {
        const mesh::Adjacency adjacency = mesh::find_adjacency(mesh);
        edges_ = edges_as_first_met(mesh, adjacency);
        number_of_edge_.resize(cells_.size());
        for (std::uint32_t i = 0; i < edges_.size(); ++i) {
            number_of_edge_[edges_[i]] = i;
            if (adjacency.twin[edges_[i]] != mesh::no_edge) number_of_edge_[adjacency.twin[edges_[i]]] = i;
        }
        for (std::size_t cell = 0; cell < cells_.cells() && nodes_.order > 1; ++cell)
            if (is_bent(cell)) bent_cells_.push_back(cell);
    }

    void write() {
        out_ << "<?xml version=\"1.0\" encoding=\"utf-8\" ?>\n<NEKTAR>\n<GEOMETRY DIM=\"2\" SPACE=\"2\">\n";
        write_vertices();
        write_edges();
        write_cells();
        if (!bent_cells_.empty()) write_curves();
        write_composites();
        out_ << "</GEOMETRY>\n</NEKTAR>\n";
    }

private:
    /// Returns whether a node of a cell is off its place in the straight cell by more than rounding.
    bool is_bent(std::size_t cell) const {
        constexpr double rounding = 0x1p-49;
        const auto corners = static_cast<unsigned>(cells_.corners(cell));
        const std::vector<Point> places = nodes_of(cell);
        double largest = 0, off = 0;
        for (const Point p : places) largest = std::max({largest, std::abs(p.x), std::abs(p.y)});
        const std::span<const mesh::NodePlace> on_cell =
            mesh::places_of_nodes(corners, nodes_.order, nodes_.distribution);
        const Point a = places[1] - places[0], b = places[corners - 1] - places[0],
                    twist = corners == 4 ? places[2] - places[0] - a - b : Point{0, 0};
        for (std::size_t i = corners; i < on_cell.size(); ++i) {
            const auto [s, t] = on_cell[i];
            off = std::max(off, length(places[i] - places[0] - s * a - t * b - (s * t) * twist));
        }
        return off > rounding * largest;
    }
    std::vector<Point> nodes_of(std::size_t cell) const {
        std::vector<Point> places;
        mesh::for_each_node(mesh_, nodes_, cell, [&](std::size_t, Point p) { places.push_back(p); });
        return places;
    }

    void write_vertices() {
        out_ << "<VERTEX>\n";
        write_lines(out_, mesh_.points.size(), [&](LineText& line, std::size_t i) {
            begin_element(line, "V", i);
            line << mesh_.points[i] << "0 </V>";
        });
        out_ << "</VERTEX>\n";
    }
    void write_edges() {
        out_ << "<EDGE>\n";
        write_lines(out_, edges_.size(), [&](LineText& line, std::size_t i) {
            begin_element(line, "E", i);
            line << cells_.origin(edges_[i]).index() << cells_.target(edges_[i]).index() << "</E>";
        });
        out_ << "</EDGE>\n";
    }
    void write_cells() {
        out_ << "<ELEMENT>\n";
        write_lines(out_, cells_.cells(), [&](LineText& line, std::size_t cell) {
            const bool is_triangle = cells_.corners(cell) == 3;
            begin_element(line, is_triangle ? "T" : "Q", cell);
            for (std::size_t e = cells_.first(cell); e < cells_.first(cell + 1); ++e)
                line << std::size_t{number_of_edge_[e]};
            line << (is_triangle ? "</T>" : "</Q>");
        });
        out_ << "</ELEMENT>\n";
    }

    void write_curves() {
        std::vector<std::uint32_t> curved;
        for (const std::size_t cell : bent_cells_)
            for (std::size_t e = cells_.first(cell); e < cells_.first(cell + 1); ++e)
                curved.push_back(number_of_edge_[e]);
        std::sort(curved.begin(), curved.end());
        curved.erase(std::unique(curved.begin(), curved.end()), curved.end());
        const unsigned p = nodes_.order;
        const std::array<std::vector<std::size_t>, 2> orders{rows_of_nodes(3, p, std::size_t{3} * p),
                                                             rows_of_nodes(4, p, 0)};
        const std::size_t room_for_point = 60, room = 100 + room_for_point * orders[1].size();
        out_ << "<CURVED>\n";
        write_lines(
            out_, curved.size(),
            [&](LineText& line, std::size_t i) {
                const std::uint32_t edge = edges_[curved[i]];
                const std::size_t cell = cells_.cell_of(edge), corners = cells_.corners(cell),
                                  k = edge - cells_.first(cell);
                const std::vector<Point> places = nodes_of(cell);
                begin_curve(line, {"E", "EDGEID"}, i, curved[i], p + 1, type_of_nodes(4));
                put_point(line, places[k]);
                for (std::size_t node = 0; node + 1 < p; ++node) put_point(line, places[corners + k * (p - 1) + node]);
                put_point(line, places[(k + 1) % corners]);
                line << "</E>";
            },
            room);
        write_lines(
            out_, bent_cells_.size(),
            [&](LineText& line, std::size_t i) {
                const std::size_t cell = bent_cells_[i], corners = cells_.corners(cell);
                std::vector<Point> places = nodes_of(cell);
                begin_curve(line, {"F", "FACEID"}, curved.size() + i, cell, places.size(), type_of_nodes(corners));
                if (corners == 3 && p == 4 && nodes_.distribution == NodeDistribution::gauss_lobatto)
                    move_to_nektar_places(places, place_in_nodal_tri_elec);
                for (const std::size_t node : orders[corners - 3]) put_point(line, places[node]);
                line << "</F>";
            },
            room);
        out_ << "</CURVED>\n";
    }
    /// Returns what Nektar++ calls the nodes of triangles, or of squares and edges.
    std::string_view type_of_nodes(std::size_t corners) const {
        const bool is_even = nodes_.distribution == NodeDistribution::equidistant;
        if (corners == 3) return is_even ? "NodalTriEvenlySpaced" : "NodalTriElec";
        return is_even ? "PolyEvenlySpaced" : "GaussLobattoLegendre";
    }
    /// The name of a curve's tag, and of the attribute that says what is curved.
    struct CurveNames {
        std::string_view tag, of;
    };
    static void begin_curve(LineText& line, const CurveNames& names, std::size_t number, std::size_t of,
                            std::size_t points, std::string_view type) {
        line.tight("<") << names.tag;
        put_attribute(line, "ID", number);
        put_attribute(line, names.of, of);
        put_attribute(line, "NUMPOINTS", points);
        line.tight("TYPE=\"").tight(type) << "\">";
    }
    static void put_point(LineText& line, Point p) { line << p << "0"; }

    void write_composites() {
        out_ << "<COMPOSITE>\n";
        std::size_t count = 0;
        const auto write_one = [&](const std::string& name, char shape, std::vector<std::uint32_t> numbers) {
            std::sort(numbers.begin(), numbers.end());
            out_ << fmt::format("<C ID=\"{}\" NAME=\"{}\"> {}[{}] </C>\n", count++, name, shape, ranges_of(numbers));
        };
        for (CellBlock& block : cell_blocks(mesh_)) {
            const bool is_triangle = block.corners == 3;
            if (!is_triangle)
                for (std::uint32_t& cell : block.cells) cell += static_cast<std::uint32_t>(mesh_.triangles.size());
            write_one(fmt::format("{}_{}", block.region, is_triangle ? "triangles" : "quads"), is_triangle ? 'T' : 'Q',
                      std::move(block.cells));
        }
        const std::size_t of_cells = count;
        for (const Marker& marker : mesh_.markers) {
            std::vector<std::uint32_t> numbers = mesh::find_edges(mesh_, marker.edges);
            for (std::uint32_t& edge : numbers) edge = number_of_edge_[edge];
            write_one(marker.name, 'E', std::move(numbers));
        }
        out_ << fmt::format("</COMPOSITE>\n<DOMAIN> C[0-{}] </DOMAIN>\n", of_cells - 1);
    }

    MeshView mesh_;
    const CurvedNodes& nodes_;
    mesh::CellEdges cells_;
    std::ostream& out_;
    std::vector<std::uint32_t> edges_;           ///< the directed edge of each number
    std::vector<std::uint32_t> number_of_edge_;  ///< per directed edge
    std::vector<std::size_t> bent_cells_;        ///< ascending
};

}  // namespace

void write_nektar(const MeshView& mesh, const CurvedNodes& nodes, const std::filesystem::path& file,
                  std::ostream& out) {
    require_marker_names(mesh.markers, file, "Nektar++", "<>&\"", 127);
    NektarWriter(mesh, nodes, out).write();
}

}  // namespace lamina::io
