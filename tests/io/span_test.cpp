// Meshes in space: the faces of OpenFOAM's, the volumes of all, and what is refused.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <map>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <lamina/error.hpp>
#include <lamina/io.hpp>

#include "support/sample_meshes.hpp"
#include "support/temporary_folder.hpp"

namespace lamina {
namespace {

using test::annulus;
using test::TemporaryFolder;

using Vector = std::array<double, 3>;

Vector operator+(Vector a, Vector b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
Vector operator-(Vector a, Vector b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Vector operator*(double s, Vector a) { return {s * a[0], s * a[1], s * a[2]}; }
double dot(Vector a, Vector b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Vector cross(Vector a, Vector b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// A polyMesh, with its patches in their order.
struct PolyMesh {
    std::vector<Vector> points;
    std::vector<std::vector<std::size_t>> faces;
    std::vector<std::size_t> owner, neighbour;
    std::string boundary;
};

PolyMesh read_poly_mesh(const TemporaryFolder& folder) {
    const auto numbers = [&](const char* name) {
        std::string text = folder.read(std::string("case/constant/polyMesh/") + name);
        text = text.substr(text.find("}\n") + 2);
        for (char& c : text)
            if (c == '(' || c == ')') c = ' ';
        return std::istringstream(text);
    };
    PolyMesh mesh;
    std::size_t n = 0;
    std::istringstream in = numbers("points");
    in >> n;
    mesh.points.resize(n);
    for (Vector& p : mesh.points) in >> p[0] >> p[1] >> p[2];
    in = numbers("faces");
    in >> n;
    mesh.faces.resize(n);
    for (auto& face : mesh.faces) {
        in >> n;
        face.resize(n);
        for (std::size_t& v : face) in >> v;
    }
    for (const auto& [name, list] : {std::pair("owner", &mesh.owner), std::pair("neighbour", &mesh.neighbour)}) {
        in = numbers(name);
        in >> n;
        list->resize(n);
        for (std::size_t& cell : *list) in >> cell;
        EXPECT_FALSE(in.fail()) << name;
    }
    mesh.boundary = folder.read("case/constant/polyMesh/boundary");
    return mesh;
}

Vector center(const PolyMesh& mesh, const std::vector<std::size_t>& face) {
    Vector sum{};
    for (const std::size_t v : face) sum = sum + mesh.points[v];
    return 1.0 / static_cast<double>(face.size()) * sum;
}
Vector area(const PolyMesh& mesh, const std::vector<std::size_t>& face) {
    Vector sum{};
    for (std::size_t k = 1; k + 1 < face.size(); ++k)
        sum = sum +
              0.5 * cross(mesh.points[face[k]] - mesh.points[face[0]], mesh.points[face[k + 1]] - mesh.points[face[0]]);
    return sum;
}

TEST(Span, OpenFoamsCellsAreClosedAndInOrder) {
    const TemporaryFolder folder;
    const Mesh mesh = annulus({.quads_in_layer = true});
    const std::size_t cells = mesh.triangles.size() + mesh.quads.size();
    for (const bool periodic : {false, true})
        for (const std::size_t across : {1, 2, 5}) {
            write_mesh(mesh, folder / "case",
                       {.format = "openfoam", .span = 0.3, .span_cells = across, .span_periodic = periodic});
            const PolyMesh foam = read_poly_mesh(folder);
            ASSERT_EQ(foam.points.size(), (across + 1) * mesh.points.size());
            EXPECT_EQ(foam.points.back()[2], 0.3);
            ASSERT_EQ(foam.owner.size(), foam.faces.size());
            std::vector<Vector> sum(across * cells, Vector{});
            std::vector<double> volume(across * cells, 0);
            for (std::size_t f = 0; f < foam.faces.size(); ++f) {
                const Vector normal = area(foam, foam.faces[f]);
                const double part = dot(normal, center(foam, foam.faces[f])) / 3;
                sum[foam.owner[f]] = sum[foam.owner[f]] + normal;
                volume[foam.owner[f]] += part;
                if (f >= foam.neighbour.size()) continue;
                ASSERT_LT(foam.owner[f], foam.neighbour[f]);
                sum[foam.neighbour[f]] = sum[foam.neighbour[f]] - normal;
                volume[foam.neighbour[f]] -= part;
                const bool in_order = f == 0 || std::pair(foam.owner[f - 1], foam.neighbour[f - 1]) <
                                                    std::pair(foam.owner[f], foam.neighbour[f]);
                EXPECT_TRUE(in_order) << f;
            }
            for (std::size_t c = 0; c < sum.size(); ++c) {
                EXPECT_LT(std::sqrt(dot(sum[c], sum[c])), 1e-12);
                EXPECT_GT(volume[c], 0);
            }
            const bool plane_flow = across == 1 && !periodic;
            EXPECT_EQ(foam.boundary.find("frontAndBack") != std::string::npos, plane_flow);
            EXPECT_EQ(foam.boundary.find("symmetryPlane;") != std::string::npos, across > 1 && !periodic);
            if (!periodic) continue;
            // Face i of one plane lies below face i of the other, and they begin with the same corner.
            for (std::size_t i = 0; i < cells; ++i) {
                const auto& low = foam.faces[foam.faces.size() - 2 * cells + i];
                const auto& high = foam.faces[foam.faces.size() - cells + i];
                for (std::size_t k = 0; k < low.size(); ++k)
                    EXPECT_EQ(low[k] + across * mesh.points.size(), high[(low.size() - k) % low.size()]);
            }
        }
}

TEST(Span, MshAndUgridHoldAllCells) {
    const TemporaryFolder folder;
    const Mesh mesh = annulus({.quads_in_layer = true});
    write_mesh(mesh, folder / "m.msh", {.format = "msh22-extruded", .span = 2, .span_cells = 4});
    std::map<int, std::size_t> counts;
    std::istringstream in(folder.read("m.msh"));
    std::string line;
    while (std::getline(in, line) && line != "$Elements") {
    }
    std::getline(in, line);
    while (std::getline(in, line) && line != "$EndElements") {
        std::istringstream words(line);
        int number = 0, type = 0;
        words >> number >> type;
        ++counts[type];
    }
    const std::size_t edges = mesh.markers[0].edges.size() + mesh.markers[1].edges.size();
    EXPECT_EQ(counts[6], 4 * mesh.triangles.size());
    EXPECT_EQ(counts[5], 4 * mesh.quads.size());
    EXPECT_EQ(counts[3], 4 * edges + 2 * mesh.quads.size());
    EXPECT_EQ(counts[2], 2 * mesh.triangles.size());
    EXPECT_NE(folder.read("m.msh").find("\"z1\""), std::string::npos);
    EXPECT_EQ(folder.read("m.msh").find("$Periodic"), std::string::npos);
    write_mesh(mesh, folder / "m.msh", {.span = 2, .span_cells = 4, .span_periodic = true});  // msh22-extruded
    EXPECT_NE(folder.read("m.msh").find("$Periodic"), std::string::npos);

    write_mesh(mesh, folder / "m.ugrid", {.format = "fun3d", .span = 2, .span_cells = 4});
    std::istringstream ugrid(folder.read("m.ugrid"));
    std::array<std::size_t, 7> sizes{};
    for (std::size_t& size : sizes) ugrid >> size;
    EXPECT_EQ(sizes, (std::array<std::size_t, 7>{5 * mesh.points.size(), 2 * mesh.triangles.size(),
                                                 4 * edges + 2 * mesh.quads.size(), 0, 0, 4 * mesh.triangles.size(),
                                                 4 * mesh.quads.size()}));
    std::vector<Vector> nodes(sizes[0]);
    for (Vector& node : nodes) ugrid >> node[0] >> node[1] >> node[2];
    std::size_t number = 0;
    for (std::size_t i = 0; i < 4 * sizes[1] + 5 * sizes[2]; ++i) ugrid >> number;
    for (std::size_t i = 0; i < sizes[5] + sizes[6]; ++i) {
        std::vector<std::size_t> v(i < sizes[5] ? 6 : 8);
        for (std::size_t& node : v) ugrid >> node;
        const auto at = [&](std::size_t k) { return nodes[v[k] - 1]; };
        EXPECT_GT(dot(cross(at(1) - at(0), at(2) - at(0)), at(v.size() / 2) - at(0)), 0);
    }
    EXPECT_FALSE(ugrid.fail());
}

TEST(Span, VtuHoldsAllCells) {
    const TemporaryFolder folder;
    const Mesh mesh = annulus({.around = 5, .rings = 2, .layer_rings = 1, .quads_in_layer = true});
    write_mesh(mesh, folder / "m.vtu", {.span = 1, .span_cells = 3});
    const std::string file = folder.read("m.vtu");
    const auto array = [&]<class T>(const std::string& name, std::vector<T> values) {
        const std::size_t tag = file.find("Name=\"" + name + "\""), attribute = file.find("offset=\"", tag) + 8;
        const std::size_t data = file.find('_', file.find("<AppendedData")) + 1 + std::stoul(file.substr(attribute));
        std::uint64_t bytes = 0;
        std::memcpy(&bytes, file.data() + data, sizeof bytes);
        values.resize(bytes / sizeof(T));
        std::memcpy(values.data(), file.data() + data + sizeof bytes, bytes);
        return values;
    };
    const auto types = array("types", std::vector<std::uint8_t>{});
    const auto offsets = array("offsets", std::vector<std::int64_t>{});
    const auto nodes = array("connectivity", std::vector<std::int64_t>{});
    const auto points = array("Points", std::vector<double>{});
    const auto markers = array("marker", std::vector<std::uint32_t>{});
    const std::size_t triangles = mesh.triangles.size(), quads = mesh.quads.size();
    EXPECT_EQ(std::count(types.begin(), types.end(), 13), static_cast<std::ptrdiff_t>(3 * triangles));
    EXPECT_EQ(std::count(types.begin(), types.end(), 12), static_cast<std::ptrdiff_t>(3 * quads));
    EXPECT_EQ(std::count(types.begin(), types.end(), 5), static_cast<std::ptrdiff_t>(2 * triangles));
    EXPECT_EQ(std::count(markers.begin(), markers.end(), 1), 15);
    EXPECT_EQ(std::count(markers.begin(), markers.end(), 4), static_cast<std::ptrdiff_t>(triangles + quads));
    ASSERT_EQ(offsets.back(), static_cast<std::int64_t>(nodes.size()));
    const auto at = [&](std::int64_t place) {
        const std::size_t node = static_cast<std::size_t>(nodes[static_cast<std::size_t>(place)]);
        return Vector{points[3 * node], points[3 * node + 1], points[3 * node + 2]};
    };
    for (std::size_t i = 0; i < 3 * (triangles + quads); ++i) {
        const std::int64_t first = i == 0 ? 0 : offsets[i - 1], corners = offsets[i] - first;
        EXPECT_EQ(corners, types[i] == 13 ? 6 : 8);
        EXPECT_GT(dot(cross(at(first + 1) - at(first), at(first + 2) - at(first)), at(first + corners / 2) - at(first)),
                  0);
    }
}

/// The formats that hold meshes in space, with a name that stands for each.
std::vector<std::pair<std::string, std::string>> formats_in_space() {
    std::vector<std::pair<std::string, std::string>> formats{
        {"vtu", "m.vtu"},     {"vtu-zlib", "z.vtu"}, {"msh22-extruded", "m.msh"},
        {"openfoam", "case"}, {"fun3d", "m.ugrid"},  {"fun3d", "m.b8.ugrid"}};
    for (const MeshFormat& format : mesh_formats())
        if (format.name.starts_with("cgns")) formats.emplace_back(format.name, format.name + ".cgns");
    return formats;
}

TEST(Span, IsReadBackAsThePlaneMesh) {
    const TemporaryFolder folder;
    for (const Mesh& mesh : {annulus({.quads_in_layer = true}), test::shuffled(annulus(), 4), test::box_with_hole()})
        for (const auto& [format, file] : formats_in_space())
            for (const auto& [periodic, across] : {std::pair(false, std::size_t{1}), std::pair(true, std::size_t{2}),
                                                   std::pair(false, std::size_t{5})}) {
                write_mesh(mesh, folder / file,
                           {.format = format, .span = 0.3, .span_cells = across, .span_periodic = periodic});
                const Mesh back = read_mesh(folder / file);
                EXPECT_EQ(mesh_hash(back), mesh_hash(mesh)) << format << across << periodic;
                EXPECT_EQ(back.points, mesh.points);
                EXPECT_EQ(check_mesh(back).valid(), check_mesh(mesh).valid());
                ASSERT_EQ(back.markers.size(), mesh.markers.size());
                for (std::size_t m = 0; m < mesh.markers.size(); ++m) {
                    EXPECT_EQ(back.markers[m].name, mesh.markers[m].name);
                    EXPECT_EQ(back.markers[m].edges, mesh.markers[m].edges);
                }
                const auto cells_of_layer = [](const Mesh& m) {
                    return std::count(m.region.begin(), m.region.end(), Region::layer);
                };
                if (format == "openfoam" || format == "fun3d")
                    EXPECT_TRUE(back.region.empty());
                else
                    EXPECT_EQ(cells_of_layer(back), cells_of_layer(mesh)) << format;
            }
}

TEST(Span, PointsThatStandTwiceInTheirPlaceStayApart) {
    // Both sides of a plate without thickness, from (1, 1) to (2, 1), in a box that it reaches.
    Mesh mesh;
    mesh.points = {{0, 0}, {1, 0}, {2, 0}, {0, 1}, {1, 1}, {2, 1}, {0, 2}, {1, 2}, {2, 2}, {2, 1}};
    const auto quad = [](std::size_t a, std::size_t b, std::size_t c, std::size_t d) {
        return Quad{{VertexId(a), VertexId(b), VertexId(c), VertexId(d)}};
    };
    const auto edge = [](std::size_t a, std::size_t b) { return Segment{VertexId(a), VertexId(b)}; };
    mesh.quads = {quad(0, 1, 4, 3), quad(1, 2, 5, 4), quad(3, 4, 7, 6), quad(4, 9, 8, 7)};
    mesh.markers = {{"plate", MarkerKind::wall, {edge(4, 9), edge(5, 4)}},
                    {"farfield",
                     MarkerKind::far_field,
                     {edge(0, 1), edge(1, 2), edge(2, 5), edge(9, 8), edge(8, 7), edge(7, 6), edge(6, 3), edge(3, 0)}}};
    const TemporaryFolder folder;
    for (const auto& [format, file] : formats_in_space()) {
        write_mesh(mesh, folder / file, {.format = format, .span = 0.3, .span_cells = 3});
        EXPECT_EQ(mesh_hash(read_mesh(folder / file)), mesh_hash(mesh)) << format;
    }
}

TEST(Span, CopiesThatDifferAreRefused) {
    const TemporaryFolder folder;
    const Mesh mesh = annulus({.around = 4, .rings = 1, .layer_rings = 1, .quads_in_layer = true});
    write_mesh(mesh, folder / "m.msh", {.format = "msh22-extruded", .span = 2, .span_cells = 2});
    std::vector<std::string> lines;
    std::istringstream whole(folder.read("m.msh"));
    for (std::string line; std::getline(whole, line);) lines.push_back(line);
    const auto place_of = [&](const std::string& line) {
        return static_cast<std::size_t>(std::find(lines.begin(), lines.end(), line) - lines.begin());
    };
    const auto expect_refused = [&](std::size_t place, const std::string& line, const char* reason) {
        std::string text;
        for (std::size_t i = 0; i < lines.size(); ++i) text += (i == place ? line : lines[i]) + '\n';
        folder.write("damaged.msh", text);
        try {
            read_mesh(folder / "damaged.msh");
            ADD_FAILURE() << reason;
        } catch (const InputError& error) {
            EXPECT_NE(std::string(error.what()).find(reason), std::string::npos) << error.what();
        }
    };
    const std::size_t n = mesh.points.size(), nodes = place_of("$Nodes") + 1;
    const auto node_line = [&](std::size_t node, double lean, int z) {
        const Point p = mesh.points[(node - 1) % n];
        return fmt::format("{} {} {} {}", node, p.x + lean, p.y, z);
    };
    expect_refused(nodes + 2 * n + 1, node_line(2 * n + 1, 0.01, 2), "straight above");
    expect_refused(nodes + n + 1, node_line(n + 1, 0, 3), "in the lowest of 4 planes");
    expect_refused(nodes + n + 1, node_line(n + 1, 0, 0), "in the lowest of 3 planes");
    // The last volume takes the place of the one before, so that a cell of the upper copy stands twice.
    const std::size_t end = place_of("$EndElements");
    expect_refused(end - 2, lines[end - 1], "differ from the lowest ones");
}

TEST(Span, IsRefusedWhereItCannotBe) {
    const TemporaryFolder folder;
    const Mesh mesh = annulus();
    EXPECT_THROW(write_mesh(mesh, folder / "m.su2", {.span = 1}), UsageError);
    EXPECT_THROW(write_mesh(mesh, folder / "m.cas", {.span = 1}), UsageError);
    EXPECT_THROW(write_mesh(mesh, folder / "m.vtu", {.span = -1}), UsageError);
    EXPECT_THROW(write_mesh(mesh, folder / "m.vtu", {.span_cells = 2}), UsageError);
    EXPECT_THROW(write_mesh(mesh, folder / "m.vtu", {.span_periodic = true}), UsageError);
    EXPECT_THROW(write_mesh(mesh, folder / "m.vtu", {.span = 1, .span_cells = 0}), UsageError);
    EXPECT_THROW(write_mesh(mesh, folder / "m.vtu", {.span = 1, .span_cells = 100'000'000}), UsageError);
    EXPECT_THROW(open_mesh_sink(folder / "m.vtu", {.span = 1}), UsageError);
    EXPECT_THROW(check_writable(folder / "m.vtu", {.span = -1}), UsageError);  // before the mesh is made
    EXPECT_TRUE(folder.names().empty());
}

}  // namespace
}  // namespace lamina
