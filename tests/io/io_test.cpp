// SU2 and VTU files: meshes are written and read back, and broken files are refused.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <random>
#include <set>
#include <string>

#include <lamina/error.hpp>
#include <lamina/io.hpp>

#include "core/parallel.hpp"
#include "mesh/cell_lattice.hpp"
#include "support/curved_cell.hpp"
#include "support/sample_meshes.hpp"
#include "support/temporary_folder.hpp"

namespace lamina {
namespace {

using test::annulus;
using test::box_with_hole;
using test::shuffled;
using test::TemporaryFolder;
using test::tiny;

constexpr const char* tiny_su2 =
    "NDIME= 2\n"
    "NELEM= 2\n"
    "5 0 1 2 0\n"
    "9 0 2 3 4 1\n"
    "NPOIN= 5\n"
    "0.0000000000000000e+00 0.0000000000000000e+00 0\n"
    "1.0000000000000000e+00 0.0000000000000000e+00 1\n"
    "1.0000000000000001e-01 1.0000000000000001e-05 2\n"
    "-0.0000000000000000e+00 1.0000000000000000e+00 3\n"
    "-1.0000000000000000e+00 3.3333333333333331e-01 4\n"
    "NMARK= 2\n"
    "MARKER_TAG= wall\n"
    "MARKER_ELEMS= 2\n"
    "3 0 1\n"
    "3 1 2\n"
    "MARKER_TAG= farfield\n"
    "MARKER_ELEMS= 3\n"
    "3 2 3\n"
    "3 3 4\n"
    "3 4 0\n";

void expect_same_cells(const Mesh& a, const Mesh& b) {
    EXPECT_EQ(a.points, b.points);
    EXPECT_EQ(a.triangles, b.triangles);
    ASSERT_EQ(a.quads.size(), b.quads.size());
    for (std::size_t q = 0; q < a.quads.size(); ++q)
        for (int i = 0; i < 4; ++i) EXPECT_EQ(a.quads[q].v[i], b.quads[q].v[i]);
    ASSERT_EQ(a.markers.size(), b.markers.size());
    for (std::size_t m = 0; m < a.markers.size(); ++m) {
        EXPECT_EQ(a.markers[m].name, b.markers[m].name);
        EXPECT_EQ(a.markers[m].edges, b.markers[m].edges);
    }
}

TEST(Su2, WritesTheGoldenFile) {
    const TemporaryFolder folder;
    write_mesh(tiny(), folder / "m.su2");
    EXPECT_EQ(folder.read("m.su2"), tiny_su2);
}

TEST(MeshFiles, ComeBackAsTheyWere) {
    const TemporaryFolder folder;
    for (const Mesh& mesh : {tiny(), annulus(), annulus({.quads_in_layer = true}), shuffled(annulus(), 1),
                             box_with_hole(), shuffled(annulus({.around = 300, .rings = 40}), 2)})
        for (const char* name : {"m.su2", "m.VTU"}) {
            write_mesh(mesh, folder / name);
            const Mesh back = read_mesh(folder / name);
            expect_same_cells(mesh, back);
            EXPECT_EQ(mesh_hash(mesh), mesh_hash(back));
        }
}

TEST(MeshFiles, VtuHoldsEverything) {
    const TemporaryFolder folder;
    const Mesh mesh = annulus({.quads_in_layer = true});
    write_mesh(mesh, folder / "m.vtu");
    const Mesh back = read_mesh(folder / "m.vtu");
    EXPECT_EQ(mesh.region, back.region);
    EXPECT_EQ(mesh.piece, back.piece);
    EXPECT_EQ(mesh.layer, back.layer);
    EXPECT_EQ(mesh.constraints, back.constraints);
    EXPECT_EQ(back.markers[0].kind, MarkerKind::wall);
    EXPECT_EQ(back.markers[1].kind, MarkerKind::far_field);
    write_mesh(back, folder / "again.vtu");
    EXPECT_EQ(folder.read("m.vtu"), folder.read("again.vtu"));
}

/// Returns the values of an array of doubles or floats from a raw VTU file.
template <class T>
std::vector<T> vtu_array(const std::string& file, const std::string& name, std::size_t count) {
    const std::size_t tag = file.find("Name=\"" + name + "\""), attribute = file.find("offset=\"", tag) + 8;
    const std::size_t data = file.find("_", file.find("<AppendedData")) + 1 + std::stoul(file.substr(attribute));
    std::vector<T> values(count);
    std::memcpy(values.data(), file.data() + data + 8, count * sizeof(T));
    return values;
}

/// Returns the place of the node (i, j) in a Lagrange cell, by vtkHigherOrderQuadrilateral::PointIndexFromIJK() and
/// vtkHigherOrderTriangle::Index().
std::size_t vtk_place(unsigned corners, unsigned p, unsigned i, unsigned j) {
    if (corners == 4) {
        const bool at_i = i == 0 || i == p, at_j = j == 0 || j == p;
        if (at_i && at_j) return i > 0 ? (j > 0 ? 2 : 1) : (j > 0 ? 3 : 0);
        if (at_j) return 4 + (i - 1) + (j > 0 ? 2 * (p - 1) : 0);
        if (at_i) return 4 + (j - 1) + (i > 0 ? p - 1 : 3 * (p - 1));
        return 4 + 4 * (p - 1) + (i - 1) + (p - 1) * (j - 1);
    }
    const std::array<unsigned, 3> b{i, j, p - i - j};
    unsigned index = 0, least = 0, largest = p;
    for (unsigned order = p; *std::min_element(b.begin(), b.end()) > least; order -= 3) {
        index += 3 * order;
        largest -= 2;
        ++least;
    }
    for (std::size_t k = 0; k < 3; ++k, ++index)
        if (b[(k + 2) % 3] == largest) return index;
    for (std::size_t k = 0; k < 3; ++k) {
        if (b[(k + 1) % 3] == least) return index + b[k] - (least + 1);
        index += largest - (least + 1);
    }
    return index;
}

TEST(MeshFiles, VtuHasCurvedCellsInTheOrderOfVtk) {
    const TemporaryFolder folder;
    for (const unsigned corners : {3u, 4u})
        for (unsigned p = 2; p <= max_cell_order; ++p) {
            const auto lattice = mesh::lattice_of_cell(corners, p);
            const CurvedMesh cell = test::one_cell(corners, p);
            write_curved_mesh(cell.mesh, cell.nodes, folder / "m.vtu");
            const std::string file = folder.read("m.vtu");
            const auto points = vtu_array<double>(file, "Points", 3 * lattice.size());
            const auto connectivity = vtu_array<std::int64_t>(file, "connectivity", lattice.size());
            EXPECT_EQ(vtu_array<std::int64_t>(file, "offsets", 1)[0], std::int64_t(lattice.size()));
            EXPECT_EQ(vtu_array<std::uint8_t>(file, "types", 1)[0], corners == 3 ? 69 : 70);
            for (const auto [i, j] : lattice) {
                const auto node = static_cast<std::size_t>(connectivity[vtk_place(corners, p, i, j)]);
                EXPECT_EQ(points[3 * node], double(i) / p) << corners << " corners, order " << p;
                EXPECT_EQ(points[3 * node + 1], double(j) / p) << corners << " corners, order " << p;
            }
        }
}

TEST(MeshFiles, VtuIsReadWithQuadraticCells) {
    const TemporaryFolder folder;
    for (const unsigned corners : {3u, 4u}) {
        const CurvedMesh cell = test::one_cell(corners, 2);
        write_curved_mesh(cell.mesh, cell.nodes, folder / "m.vtu");
        std::string file = folder.read("m.vtu");
        const std::size_t types = file.rfind(corners == 3 ? "\x45\x44" : "\x46\x44");  // of the cell and its marker
        ASSERT_NE(types, std::string::npos);
        file.replace(types, 2, corners == 3 ? "\x16\x15" : "\x1c\x15");
        const CurvedMesh read = read_curved_mesh(folder.write("m.vtu", file));
        EXPECT_EQ(read.nodes.order, 2u);
        EXPECT_EQ(read.nodes.triangle_nodes, cell.nodes.triangle_nodes);
        EXPECT_EQ(read.nodes.quad_nodes, cell.nodes.quad_nodes);
        EXPECT_EQ(read.nodes.marker_nodes, cell.nodes.marker_nodes);
    }
}

TEST(MeshFiles, VtuHoldsQualityAndWallDistance) {
    const TemporaryFolder folder;
    const Mesh mesh = annulus({.around = 200, .quads_in_layer = true});
    write_mesh(mesh, folder / "m.vtu", {.wall_distance = true});
    const std::string file = folder.read("m.vtu");
    const auto distance = vtu_array<double>(file, "wall_distance", mesh.points.size());
    for (std::size_t i = 0; i < mesh.points.size(); ++i)
        ASSERT_NEAR(distance[i], length(mesh.points[i]) - 1, 2e-4) << i;  // the wall is a polygon, not a circle
    const auto quality = vtu_array<float>(file, "quality", mesh.triangles.size() + mesh.quads.size() + 400);
    for (std::size_t i = 0; i < mesh.triangles.size() + mesh.quads.size(); ++i) {
        ASSERT_GT(quality[i], 0);
        ASSERT_LE(quality[i], 1);
    }
    EXPECT_EQ(quality.back(), 0);
    write_mesh(mesh, folder / "plain.vtu");
    EXPECT_EQ(folder.read("plain.vtu").find("wall_distance"), std::string::npos);
}

TEST(Su2, ReadsOtherPrograms) {
    const TemporaryFolder folder;
    // The sections have another order. There are comments, line ends of Windows, boundary edges in the wrong direction,
    // and no indices at the ends of lines.
    const auto file = folder.write("m.su2",
                                   "% by hand\r\n"
                                   "NPOIN=5\r\n0 0\r\n1 0\r\n0.1 1e-5 \r\n+0 1\r\n-1 0.33333333333333331\r\n\r\n"
                                   "NDIME = 2 % plane\r\nNMARK= 2\r\n"
                                   "MARKER_TAG=\twall \r\nMARKER_ELEMS= 2\r\n3 1 0\r\n3\t2 1 \r\n"
                                   "MARKER_TAG= farfield\r\nMARKER_ELEMS=3\r\n3 2 3 0\r\n3 3 4 1\r\n3 0 4 2\r\n"
                                   "NELEM= 2\r\n9 0 2 3 4\r\n% between\r\n5 0 1 2\r\n");
    const Mesh mesh = read_mesh(file);
    EXPECT_EQ(mesh_hash(mesh), mesh_hash(tiny()));
    EXPECT_EQ(mesh.markers[1].kind, MarkerKind::far_field);
    EXPECT_TRUE(mesh.region.empty());
}

TEST(Su2, SaysWhereAFileIsMalformed) {
    const TemporaryFolder folder;
    const auto expect_complaint = [&](const std::string& from, const std::string& to, std::size_t line,
                                      const std::string& said) {
        std::string text = tiny_su2;
        const std::size_t at = text.find(from);
        ASSERT_NE(at, std::string::npos) << from;
        text.replace(at, from.size(), to);
        try {
            read_mesh(folder.write("m.su2", text));
            ADD_FAILURE() << "no error for " << to;
        } catch (const InputError& error) {
            EXPECT_EQ(error.place().line, line) << error.what();
            EXPECT_NE(std::string(error.what()).find(said), std::string::npos) << error.what();
        }
    };
    expect_complaint("NDIME= 2", "NDIME= 3", 1, "two-dimensional");
    expect_complaint("NELEM= 2", "NELEM= two", 2, "count expected, found 'two'");
    expect_complaint("NELEM= 2", "NELEM= 99999999999", 2, "shorter");
    expect_complaint("NELEM= 2", "NELEM= 3", 5, "cell type expected");
    expect_complaint("NELEM= 2", "NELEM= 1", 4, "belongs to no section");
    expect_complaint("5 0 1 2 0", "5 0 1 5 0", 3, "vertex index 5 where NPOIN= 5");
    expect_complaint("5 0 1 2 0", "5 0 1", 3, "vertex index expected");
    expect_complaint("5 0 1 2 0", "5 0 1 -2", 3, "vertex index expected");
    expect_complaint("5 0 1 2 0", "5 0 1 2 0 0", 3, "end of line expected");
    expect_complaint("5 0 1 2 0", "10 0 1 2 3", 3, "cell type 10");
    expect_complaint("1.0000000000000001e-01", "nan", 8, "finite");
    expect_complaint("1.0000000000000001e-01", "1e999", 8, "coordinate expected");
    expect_complaint("1.0000000000000001e-01", "0.1,", 8, "coordinate expected");
    expect_complaint("NPOIN= 5", "POINTS= 5", 20, "without NPOIN=");
    expect_complaint("NMARK= 2\n", "", 19, "without NMARK=");
    expect_complaint("NMARK= 2", "NMARK= 3", 20, "2 markers follow");
    expect_complaint("MARKER_TAG= wall", "MARKER_TAG= ", 12, "without a name");
    expect_complaint("MARKER_TAG= wall\n", "", 12, "without a MARKER_TAG=");
    expect_complaint("3 0 1\n", "1 0\n", 14, "type 1");
}

TEST(MeshFiles, ThatCannotBeReadOrWritten) {
    const TemporaryFolder folder;
    const Mesh mesh = annulus();
    EXPECT_THROW(read_mesh(folder / "none.su2"), IoError);
    EXPECT_THROW(read_mesh(folder / "none.vtu"), IoError);
    EXPECT_THROW(read_mesh(folder / "mesh.xyz"), UsageError);
    EXPECT_THROW(read_mesh(folder.write("empty.su2", "")), InputError);
    EXPECT_THROW(read_mesh(folder.write("empty.vtu", "")), InputError);
    std::filesystem::create_directory(folder / "folder.su2");
    EXPECT_THROW(read_mesh(folder / "folder.su2"), IoError);

    folder.write("file", "");
    const auto before = folder.names();
    for (const std::string name : {"none/m.su2", "file/m.vtu", "folder.su2"}) {
        EXPECT_THROW(check_writable(folder / name), IoError) << name;
        EXPECT_THROW(write_mesh(mesh, folder / name), IoError) << name;
    }
    EXPECT_THROW(check_writable(folder / "m.msh5"), UsageError);
    EXPECT_THROW(check_writable(folder / "m"), UsageError);
    Mesh named = mesh;
    named.markers[0].name = "main wing";
    EXPECT_THROW(write_mesh(named, folder / "m.su2"), UsageError);
    EXPECT_EQ(folder.names(), before);

    EXPECT_NO_THROW(check_writable(folder / "m.su2"));
    EXPECT_EQ(folder.names(), before);
    write_mesh(named, folder / "m.vtu");
    EXPECT_EQ(read_mesh(folder / "m.vtu").markers[0].name, "main wing");
}

}  // namespace
}  // namespace lamina
