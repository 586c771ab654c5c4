// Files of curved cells: read back by lamina, and taken apart as MFEM and Nektar++ read them.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <lamina/error.hpp>
#include <lamina/io.hpp>
#include <lamina/pipeline.hpp>

#include "mesh/curved_nodes.hpp"
#include "support/temporary_folder.hpp"

namespace lamina::test {
namespace {

/// Returns a mesh of few cells, with a layer, round a NACA 0012 section.
MeshResult small_mesh(unsigned order, LayerTopology topology = LayerTopology::quads,
                      NodeDistribution distribution = NodeDistribution::equidistant) {
    CaseOptions options;
    options.layer = {.first_height = 1e-5, .layers = 5, .topology = topology};
    options.far_field.size = 3;
    options.sizing.gradation = 0.4;
    options.order = order;
    options.node_distribution = distribution;
    return generate_mesh({"naca:0012"}, options);
}

TEST(CurvedFiles, AreReadBack) {
    const TemporaryFolder folder;
    for (const LayerTopology topology : {LayerTopology::quads, LayerTopology::layered})
        for (unsigned order = 2; order <= max_cell_order; ++order) {
            const MeshResult result = small_mesh(order, topology);
            for (const std::string format : {"msh41", "msh41-binary", "msh22", "msh22-binary", "vtu", "vtu-zlib"}) {
                const std::filesystem::path file = folder.path() / ("curved." + format.substr(0, 3));
                write_curved_mesh(result.mesh, result.curved, file, {.format = format});
                const CurvedMesh read = read_curved_mesh(file);
                EXPECT_EQ(mesh_hash(read.mesh), mesh_hash(result.mesh));
                EXPECT_EQ(read.nodes.order, order);
                EXPECT_EQ(read.nodes.points, result.curved.points);
                EXPECT_EQ(read.nodes.triangle_nodes, result.curved.triangle_nodes);
                EXPECT_EQ(read.nodes.quad_nodes, result.curved.quad_nodes);
                EXPECT_TRUE(check_mesh(read.mesh).valid());
                EXPECT_TRUE(check_curved(read.mesh, read.nodes).valid());
                EXPECT_THROW(read_mesh(file), InputError);
            }
        }
}

TEST(CurvedFiles, AreWrittenAsMfemNumbersTheirNodes) {
    const TemporaryFolder folder;
    for (unsigned order = 2; order <= max_cell_order; ++order) {
        const NodeDistribution distribution =
            order == 3 ? NodeDistribution::gauss_lobatto : NodeDistribution::equidistant;
        const MeshResult result = small_mesh(order, LayerTopology::quads, distribution);
        const Mesh& mesh = result.mesh;
        const std::filesystem::path file = folder.path() / "curved.mesh";
        write_curved_mesh(mesh, result.curved, file);
        std::ifstream in(file);
        std::string word;
        const auto skip_to = [&](const std::string& section) {
            while (word != section && in >> word) continue;
            ASSERT_EQ(word, section);
        };
        std::size_t count = 0;
        skip_to("elements");
        in >> count;
        ASSERT_EQ(count, mesh.triangles.size() + mesh.quads.size());
        std::map<std::pair<std::size_t, std::size_t>, std::size_t> edges;  // numbered as they are met
        std::vector<std::vector<std::size_t>> cells;
        for (std::size_t attribute = 0, type = 0; cells.size() < count;) {
            in >> attribute >> type;
            std::vector<std::size_t>& corners = cells.emplace_back(type + 1);
            for (std::size_t& v : corners) in >> v;
            for (std::size_t i = 0; i < corners.size(); ++i)
                edges.try_emplace(std::minmax({corners[i], corners[(i + 1) % corners.size()]}), edges.size());
        }
        skip_to("FiniteElementCollection:");
        in >> word;
        EXPECT_EQ(word, (order == 3 ? "H1_2D_P" : "H1@U_2D_P") + std::to_string(order));
        skip_to("Ordering:");
        in >> word;
        std::vector<Point> places(mesh.points.size() + result.curved.points.size());
        for (Point& p : places) in >> p.x >> p.y;
        EXPECT_TRUE(in);
        EXPECT_FALSE(in >> word);
        const std::size_t within = order - 1;
        std::size_t inside = mesh.points.size() + edges.size() * within;
        for (std::size_t cell = 0; cell < cells.size(); ++cell) {
            const std::vector<std::size_t>& corners = cells[cell];
            const auto n = static_cast<unsigned>(corners.size());
            std::vector<Point> expected;
            mesh::for_each_node(mesh, result.curved, cell,
                                [&](std::size_t, Point place) { expected.push_back(place); });
            const auto lattice = mesh::lattice_of_cell(n, order);
            for (std::size_t i = 0; i < n; ++i) {
                EXPECT_EQ(places[corners[i]], expected[i]);
                const std::size_t a = corners[i], b = corners[(i + 1) % n];
                for (std::size_t k = 0; k < within; ++k)
                    EXPECT_EQ(places[mesh.points.size() + edges.at(std::minmax({a, b})) * within +
                                     (a < b ? k : within - 1 - k)],
                              expected[n + i * within + k]);
            }
            for (unsigned j = 1; j < order; ++j)
                for (unsigned i = 1; i < (n == 3 ? order - j : order); ++i, ++inside) {
                    const auto at = std::find_if(lattice.begin(), lattice.end(),
                                                 [&](const auto& place) { return place.i == i && place.j == j; });
                    EXPECT_EQ(places[inside], expected[static_cast<std::size_t>(at - lattice.begin())]);
                }
        }
        EXPECT_EQ(inside, places.size());
    }
}

/// What a file of Nektar++ holds, as its reader takes it.
struct NektarGeometry {
    struct Curve {
        std::string type;
        std::vector<Point> points;
    };
    std::vector<Point> vertices;
    std::vector<std::pair<std::size_t, std::size_t>> edges;
    std::vector<std::pair<char, std::vector<std::size_t>>> cells;  ///< T or Q, and edges
    std::map<std::size_t, Curve> of_edges, of_cells;
    std::map<std::string, std::pair<char, std::set<std::size_t>>> composites;  ///< by name: kind and numbers
    std::vector<std::string> names;                                            ///< of the composites
    std::string domain;                                                        ///< numbers of composites
};

/// Returns the numbers in a list such as "0-9,12".
std::set<std::size_t> numbers_in(std::string text) {
    std::replace(text.begin(), text.end(), ',', ' ');
    std::istringstream in(text);
    std::set<std::size_t> numbers;
    for (std::string part; in >> part;) {
        const std::size_t dash = part.find('-');
        const std::size_t first = std::stoul(part),
                          last = dash == part.npos ? first : std::stoul(part.substr(dash + 1));
        for (std::size_t i = first; i <= last; ++i) numbers.insert(i);
    }
    return numbers;
}

/// Reads a file of one element a line, whose sections have lines of their own.
NektarGeometry read_nektar(const std::filesystem::path& file) {
    NektarGeometry geometry;
    std::ifstream in(file);
    std::string section;
    for (std::string line; std::getline(in, line);) {
        for (char& c : line)
            if (std::string("<>=\"[]").find(c) != std::string::npos) c = ' ';
        std::istringstream words(line);
        std::string tag, word;
        words >> tag >> word;
        if (word != "ID") {
            section = tag;
            if (tag == "DOMAIN") words >> geometry.domain;
            continue;
        }
        std::size_t id = 0, of = 0, count = 0;
        words >> id;
        const auto read_points = [&](std::size_t n) {
            std::vector<Point> points(n);
            for (Point& p : points) {
                double z = 1;
                words >> p.x >> p.y >> z;
                EXPECT_EQ(z, 0);
            }
            return points;
        };
        if (section == "VERTEX") {
            EXPECT_EQ(id, geometry.vertices.size());
            geometry.vertices.push_back(read_points(1)[0]);
        } else if (section == "EDGE") {
            EXPECT_EQ(id, geometry.edges.size());
            words >> geometry.edges.emplace_back().first >> geometry.edges.back().second;
        } else if (section == "ELEMENT") {
            EXPECT_EQ(id, geometry.cells.size());
            auto& [shape, edges] = geometry.cells.emplace_back(tag[0], tag == "T" ? 3 : 4);
            for (std::size_t& edge : edges) words >> edge;
        } else if (section == "CURVED") {
            NektarGeometry::Curve curve;
            words >> word >> of >> word >> count >> word >> curve.type;
            curve.points = read_points(count);
            EXPECT_TRUE((tag == "E" ? geometry.of_edges : geometry.of_cells).emplace(of, curve).second);
        } else {
            EXPECT_EQ(section, "COMPOSITE");
            std::string name, kind, numbers;
            words >> word >> name >> kind >> numbers;
            EXPECT_EQ(id, geometry.names.size());
            geometry.names.push_back(name);
            EXPECT_TRUE(geometry.composites.emplace(name, std::pair(kind[0], numbers_in(numbers))).second);
        }
        EXPECT_TRUE(words) << line;
        words >> word;
        EXPECT_EQ(word, "/" + tag);
    }
    return geometry;
}

/// Returns the corners of a cell as Nektar++ finds them: corner i is where edge i begins that goes to edge i + 1.
std::vector<std::size_t> nektar_corners(const NektarGeometry& geometry, const std::vector<std::size_t>& edges) {
    std::vector<std::size_t> corners;
    for (std::size_t i = 0; i < edges.size(); ++i) {
        const auto [a, b] = geometry.edges[edges[i]];
        const auto next = geometry.edges[edges[(i + 1) % edges.size()]];
        corners.push_back(b == next.first || b == next.second ? a : b);
    }
    return corners;
}

/// Returns the places of the nodes of a curved cell in the order of Nektar++: of a square row by row, and of a triangle
/// corners, then edges counter-clockwise, then what is left row by row.
std::vector<std::pair<unsigned, unsigned>> nektar_places(char shape, unsigned p) {
    std::vector<std::pair<unsigned, unsigned>> corners, bottom, right, left, within;
    for (unsigned j = 0; j <= p; ++j)
        for (unsigned i = 0; i <= (shape == 'T' ? p - j : p); ++i) {
            auto& list = shape == 'Q'                               ? corners
                         : (i == 0 || i == p) && (j == 0 || j == p) ? corners
                         : j == 0                                   ? bottom
                         : i + j == p                               ? right
                         : i == 0                                   ? left
                                                                    : within;
            list.insert(&list == &left ? list.begin() : list.end(), {i, j});
        }
    for (const auto& list : {bottom, right, left, within}) corners.insert(corners.end(), list.begin(), list.end());
    return corners;
}

/// Expects the curves of a cell in the file to be those of the mesh, or its nodes to be those of the straight cell.
void expect_nektar_cell(const NektarGeometry& geometry, const MeshResult& result, std::size_t cell) {
    const unsigned p = result.curved.order;
    const auto& [shape, edges] = geometry.cells[cell];
    std::vector<Point> nodes;
    mesh::for_each_node(result.mesh, result.curved, cell, [&](std::size_t, Point place) { nodes.push_back(place); });
    const auto n = static_cast<unsigned>(edges.size());
    const std::vector<std::size_t> corners = nektar_corners(geometry, edges);
    for (std::size_t i = 0; i < n; ++i) EXPECT_EQ(geometry.vertices[corners[i]], nodes[i]);
    const auto lattice = mesh::lattice_of_cell(n, p);
    const auto node_at = [&](unsigned i, unsigned j) {
        return nodes[static_cast<std::size_t>(
            std::find_if(lattice.begin(), lattice.end(), [&](const auto& l) { return l.i == i && l.j == j; }) -
            lattice.begin())];
    };
    const auto curve = geometry.of_cells.find(cell);
    if (curve == geometry.of_cells.end()) {
        for (std::size_t k = n; k < nodes.size(); ++k) {
            const auto [s, t] = mesh::places_of_nodes(n, p, result.curved.distribution)[k];
            const Point straight =
                n == 3 ? nodes[0] + s * (nodes[1] - nodes[0]) + t * (nodes[2] - nodes[0])
                       : (1 - t) * ((1 - s) * nodes[0] + s * nodes[1]) + t * ((1 - s) * nodes[3] + s * nodes[2]);
            EXPECT_LT(distance(straight, nodes[k]), 1e-14);
        }
        return;
    }
    const bool is_lobatto = result.curved.distribution == NodeDistribution::gauss_lobatto;
    if (is_lobatto)
        EXPECT_EQ(curve->second.type, shape == 'T' ? "NodalTriElec" : "GaussLobattoLegendre");
    else
        EXPECT_EQ(curve->second.type, shape == 'T' ? "NodalTriEvenlySpaced" : "PolyEvenlySpaced");
    const auto places = nektar_places(shape, p);
    ASSERT_EQ(curve->second.points.size(), places.size());
    for (std::size_t k = 0; k < places.size(); ++k)
        if (is_lobatto && shape == 'T' && p == 4 && k >= 12)  // Nektar++ has these elsewhere
            EXPECT_LT(distance(curve->second.points[k], node_at(places[k].first, places[k].second)),
                      0.1 * distance(nodes[0], nodes[1]) + 0.1 * distance(nodes[0], nodes[2]));
        else
            EXPECT_EQ(curve->second.points[k], node_at(places[k].first, places[k].second));
    for (std::size_t i = 0; i < n; ++i) {
        ASSERT_TRUE(geometry.of_edges.contains(edges[i]));
        const NektarGeometry::Curve& of_edge = geometry.of_edges.at(edges[i]);
        EXPECT_EQ(of_edge.type, is_lobatto ? "GaussLobattoLegendre" : "PolyEvenlySpaced");
        std::vector<Point> along{nodes[i]};
        for (unsigned k = 0; k + 1 < p; ++k) along.push_back(nodes[n + i * (p - 1) + k]);
        along.push_back(nodes[(i + 1) % n]);
        if (geometry.edges[edges[i]].first != corners[i]) std::reverse(along.begin(), along.end());
        EXPECT_EQ(of_edge.points, along);
    }
}

TEST(CurvedFiles, AreWrittenAsNektarReadsThem) {
    const TemporaryFolder folder;
    for (const LayerTopology topology : {LayerTopology::quads, LayerTopology::layered})
        for (unsigned order = 1; order <= max_cell_order; ++order) {
            SCOPED_TRACE(testing::Message() << static_cast<int>(topology) << ", order " << order);
            const MeshResult result = small_mesh(
                order, topology, order > 2 ? NodeDistribution::gauss_lobatto : NodeDistribution::equidistant);
            const Mesh& mesh = result.mesh;
            const std::filesystem::path file = folder.path() / "curved.xml";
            if (order == 1)
                write_mesh(mesh, file);
            else
                write_curved_mesh(mesh, result.curved, file);
            const NektarGeometry geometry = read_nektar(file);
            EXPECT_EQ(geometry.vertices, mesh.points);
            ASSERT_EQ(geometry.cells.size(), mesh.triangles.size() + mesh.quads.size());
            EXPECT_EQ(geometry.of_cells.empty(), order == 1);
            EXPECT_LT(geometry.of_cells.size(), 3 * geometry.cells.size() / 4);  // the far field is straight
            if (order > 1)
                for (std::size_t cell = 0; cell < geometry.cells.size(); ++cell)
                    expect_nektar_cell(geometry, result, cell);
            std::set<std::size_t> grouped;
            for (const std::size_t number : numbers_in(geometry.domain)) {
                const auto& composite = geometry.composites.at(geometry.names.at(number));
                for (const std::size_t cell : composite.second) {
                    EXPECT_TRUE(grouped.insert(cell).second);
                    EXPECT_EQ(geometry.cells[cell].first, composite.first);
                }
            }
            EXPECT_EQ(grouped.size(), geometry.cells.size());
            for (const Marker& marker : mesh.markers) {
                const auto& [kind, numbers] = geometry.composites.at(marker.name);
                EXPECT_EQ(kind, 'E');
                std::set<std::pair<std::size_t, std::size_t>> expected, found;
                for (const Segment& edge : marker.edges)
                    expected.insert(std::minmax({std::size_t{edge.a.index()}, std::size_t{edge.b.index()}}));
                for (const std::size_t edge : numbers)
                    found.insert(std::minmax({geometry.edges[edge].first, geometry.edges[edge].second}));
                EXPECT_EQ(found, expected);
            }
        }
}

/// Expects a mesh of Nektar++ to be the one that was written, but for rounding of nodes of straight cells, and of those
/// that Nektar++ has at other places.
void expect_read_from_nektar(const MeshResult& result, const std::filesystem::path& file) {
    const CurvedMesh read = read_curved_mesh(file);
    EXPECT_EQ(mesh_hash(read.mesh), mesh_hash(result.mesh));
    EXPECT_EQ(read.nodes.order, result.curved.order);
    EXPECT_EQ(read.nodes.distribution, result.curved.distribution);
    EXPECT_TRUE(check_mesh(read.mesh).valid());
    const CurvedCheck check = check_curved(read.mesh, read.nodes);
    EXPECT_TRUE(check.valid());
    EXPECT_NEAR(check.min_scaled_jacobian, result.curved_check.min_scaled_jacobian, 1e-6);  // bounds are that tight
    for (std::size_t cell = 0; cell < result.mesh.triangles.size() + result.mesh.quads.size(); ++cell) {
        std::vector<Point> expected, found;
        mesh::for_each_node(result.mesh, result.curved, cell, [&](std::size_t, Point p) { expected.push_back(p); });
        mesh::for_each_node(read.mesh, read.nodes, cell, [&](std::size_t, Point p) { found.push_back(p); });
        ASSERT_EQ(found.size(), expected.size());
        for (std::size_t i = 0; i < found.size(); ++i)
            EXPECT_LT(distance(found[i], expected[i]), 0x1p-48 * (1 + length(expected[i]))) << cell << ' ' << i;
    }
    EXPECT_THROW(read_mesh(file), InputError);
}

TEST(CurvedFiles, AreReadBackFromNektar) {
    const TemporaryFolder folder;
    for (const LayerTopology topology : {LayerTopology::quads, LayerTopology::layered})
        for (const NodeDistribution distribution : {NodeDistribution::equidistant, NodeDistribution::gauss_lobatto})
            for (unsigned order = 2; order <= max_cell_order; ++order) {
                SCOPED_TRACE(testing::Message() << static_cast<int>(topology) << ' ' << static_cast<int>(distribution)
                                                << ", order " << order);
                const MeshResult result = small_mesh(order, topology, distribution);
                const std::filesystem::path file = folder.path() / "curved.xml";
                write_curved_mesh(result.mesh, result.curved, file);
                expect_read_from_nektar(result, file);
            }
}

/// A square of one cell, whose first edge is a curve of order 3, as people write it: with numbers of their own.
std::string nektar_text(const std::string& cell, const std::string& edges, const std::string& curves) {
    return "<NEKTAR>\n<GEOMETRY DIM='2' SPACE='2'>\n<!-- by hand -->\n<VERTEX XSCALE='2'>\n"
           "<V ID='7'> 0 0 0 </V> <V ID='3'> 1.0 0 0 </V> <V ID='5'> 1 1 0 </V> <V ID='4'>0 1 "
           "0</V>\n</VERTEX>\n<EDGE>\n" +
           edges + "</EDGE>\n<ELEMENT>\n" + cell + "</ELEMENT>\n<CURVED>\n" + curves +
           "</CURVED>\n<COMPOSITE>\n<C ID='0'> Q[9] </C>\n<C ID='1' NAME='wall'> E[2,5-6] </C>\n</COMPOSITE>\n"
           "<DOMAIN> C[0] </DOMAIN>\n</GEOMETRY>\n</NEKTAR>\n";
}

TEST(CurvedFiles, OfNektarMayHaveCurvesOfEdgesAlone) {
    const TemporaryFolder folder;
    const std::string edges = "<E ID='2'> 3 7 </E> <E ID='5'> 3 5 </E> <E ID='6'> 5 4 </E> <E ID='8'> 4 7 </E>\n",
                      cell = "<Q ID='9'> 2 5 6 8 </Q>\n",
                      curve =
                          "<E ID='0' EDGEID='2' TYPE='PolyEvenlySpaced' NUMPOINTS='4'>\n1 0 0 0.667 -0.09 0\n0.333 "
                          "-0.09 0 0 0 0</E>\n";
    const auto read = [&](const std::string& text) {
        folder.write("m.xml", text);
        return read_curved_mesh(folder / "m.xml");
    };
    const CurvedMesh square = read(nektar_text(cell, edges, curve));
    ASSERT_EQ(square.mesh.quads.size(), 1u);
    EXPECT_EQ(square.nodes.order, 3u);
    EXPECT_TRUE(check_curved(square.mesh, square.nodes).valid());
    EXPECT_EQ(square.mesh.markers.at(0).edges.size(), 3u);
    std::vector<Point> nodes;
    mesh::for_each_node(square.mesh, square.nodes, 0, [&](std::size_t, Point p) { nodes.push_back(p); });
    EXPECT_EQ(nodes[0], (Point{0, 0}));
    EXPECT_EQ(nodes[1], (Point{2, 0}));
    EXPECT_EQ(nodes[4], (Point{0.666, -0.09}));  // along the edge, which the file has the other way round
    EXPECT_NEAR(nodes[12].y, 1.0 / 3 - 0.06, 1e-14);
    EXPECT_NEAR(nodes[14].y, 2.0 / 3 - 0.03, 1e-14);

    for (const auto& [text, reason] : std::vector<std::pair<std::string, std::string>>{
             {nektar_text("<Q ID='9'> 2 6 5 8 </Q>", edges, curve), "do not follow each other"},
             {nektar_text("<H ID='9'> 2 5 6 8 </H>", edges, curve), "<H> in <ELEMENT>"},
             {nektar_text(cell, edges, "<E ID='0' EDGEID='2' TYPE='FourierEvenlySpaced' NUMPOINTS='2'>0 0 0 1 0 0</E>"),
              "FourierEvenlySpaced"},
             {nektar_text(cell, edges,
                          curve + "<E ID='1' EDGEID='5' TYPE='PolyEvenlySpaced' NUMPOINTS='3'>1 0 0 1.1 .5 0 1 "
                                  "1 0</E>"),
              "several orders"},
             {nektar_text(cell, edges, curve + curve), "second curve"},
             {nektar_text(cell, edges,
                          "<E ID='0' EDGEID='2' TYPE='PolyEvenlySpaced' NUMPOINTS='3'>1 0 0 1 1 0 1 0 "
                          "0</E>"),
              "where its edge has"},
             {"<NEKTAR><GEOMETRY DIM=\"2\"><VERTEX COMPRESSED=\"B64Z-LittleEndian\">eJw=</VERTEX></GEOMETRY>",
              "xml:uncompress"},
             {"<NEKTAR><GEOMETRY DIM=\"3\"></GEOMETRY></NEKTAR>", "DIM=\"2\""},
             {"<NEKTAR></NEKTAR>", "no <GEOMETRY>"}}) {
        try {
            read(text);
            ADD_FAILURE() << reason;
        } catch (const InputError& error) {
            EXPECT_NE(std::string(error.what()).find(reason), std::string::npos) << error.what();
        }
    }
}

TEST(CurvedFiles, WithNodesOfGaussAndLobattoAreForSomeFormats) {
    const auto reason = [](const char* file, unsigned order) -> std::string {
        try {
            require_curved_format(file, {}, order, NodeDistribution::gauss_lobatto);
        } catch (const UsageError& error) {
            return error.what();
        }
        return "";
    };
    for (const char* file : {"m.msh", "m.vtu", "m.cgns"}) {
        EXPECT_NE(reason(file, 3).find("evenly spaced nodes: those with Gauss and Lobatto's are mfem, nektar"),
                  std::string::npos);
        EXPECT_EQ(reason(file, 2), "");  // where both are the same
    }
    for (const char* file : {"m.xml", "m.mesh"}) EXPECT_EQ(reason(file, 4), "");
    const MeshResult quadratic = small_mesh(2, LayerTopology::quads, NodeDistribution::gauss_lobatto);
    EXPECT_EQ(quadratic.curved.distribution, NodeDistribution::equidistant);
    EXPECT_EQ(quadratic.curved.points, small_mesh(2).curved.points);
    EXPECT_THROW(small_mesh(1, LayerTopology::quads, NodeDistribution::gauss_lobatto), OptionError);
}

}  // namespace
}  // namespace lamina::test
