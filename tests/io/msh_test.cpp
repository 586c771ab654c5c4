// The bytes of MSH files, and MSH files as other programs write them.
#include <gtest/gtest.h>

#include <string>

#include <lamina/error.hpp>
#include <lamina/io.hpp>

#include "support/sample_meshes.hpp"
#include "support/temporary_folder.hpp"

namespace lamina {
namespace {

using test::TemporaryFolder;
using test::tiny;

constexpr const char* tiny_msh22 =
    "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n"
    "$PhysicalNames\n4\n1 1 \"wall\"\n1 2 \"farfield\"\n2 3 \"isotropic\"\n2 4 \"layer\"\n$EndPhysicalNames\n"
    "$Nodes\n5\n"
    "1 0.0000000000000000e+00 0.0000000000000000e+00 0\n"
    "2 1.0000000000000000e+00 0.0000000000000000e+00 0\n"
    "3 1.0000000000000001e-01 1.0000000000000001e-05 0\n"
    "4 -0.0000000000000000e+00 1.0000000000000000e+00 0\n"
    "5 -1.0000000000000000e+00 3.3333333333333331e-01 0\n"
    "$EndNodes\n"
    "$Elements\n7\n"
    "1 1 2 1 1 1 2\n2 1 2 1 1 2 3\n3 1 2 2 2 3 4\n4 1 2 2 2 4 5\n5 1 2 2 2 5 1\n"
    "6 2 2 3 3 1 2 3\n7 3 2 4 4 1 3 4 5\n"
    "$EndElements\n";

constexpr const char* tiny_msh41 =
    "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n"
    "$PhysicalNames\n4\n1 1 \"wall\"\n1 2 \"farfield\"\n2 3 \"isotropic\"\n2 4 \"layer\"\n$EndPhysicalNames\n"
    "$Entities\n0 2 2 0\n"
    "1 0 0 0 1 1e-05 0 1 1 0\n"
    "2 -1 0 0 0.1 1 0 1 2 0\n"
    "3 -1 0 0 1 1 0 1 3 0\n"
    "4 -1 0 0 1 1 0 1 4 0\n"
    "$EndEntities\n"
    "$Nodes\n1 5 1 5\n2 3 0 5\n1\n2\n3\n4\n5\n"
    "0.0000000000000000e+00 0.0000000000000000e+00 0\n"
    "1.0000000000000000e+00 0.0000000000000000e+00 0\n"
    "1.0000000000000001e-01 1.0000000000000001e-05 0\n"
    "-0.0000000000000000e+00 1.0000000000000000e+00 0\n"
    "-1.0000000000000000e+00 3.3333333333333331e-01 0\n"
    "$EndNodes\n"
    "$Elements\n4 7 1 7\n"
    "1 1 1 2\n1 1 2\n2 2 3\n"
    "1 2 1 3\n3 3 4\n4 4 5\n5 5 1\n"
    "2 3 2 1\n6 1 2 3\n"
    "2 4 3 1\n7 1 3 4 5\n"
    "$EndElements\n";

Mesh tiny_with_regions() {
    Mesh mesh = tiny();
    mesh.region = {Region::isotropic, Region::layer};
    return mesh;
}

TEST(Msh, WritesTheGoldenFiles) {
    const TemporaryFolder folder;
    write_mesh(tiny_with_regions(), folder / "m.msh");
    EXPECT_EQ(folder.read("m.msh"), tiny_msh41);
    write_mesh(tiny_with_regions(), folder / "m.msh", {.format = "msh22"});
    EXPECT_EQ(folder.read("m.msh"), tiny_msh22);
}

TEST(Msh, CurvedCellsWhoseNodesAreOutOfRangeAreNotProved) {
    const TemporaryFolder folder;
    const std::string large = "2.4937938687092768e154";
    folder.write("m.msh", "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n6\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 " + large +
                              " " + large + " 0\n5 0 0 0\n6 -" + large + " " + large +
                              " 0\n$EndNodes\n$Elements\n1\n1 9 2 0 0 1 2 3 4 5 6\n$EndElements\n");
    const CurvedMesh read = read_curved_mesh(folder / "m.msh");
    ASSERT_EQ(read.nodes.order, 2u);
    EXPECT_FALSE(check_curved(read.mesh, read.nodes).valid());
}

TEST(Msh, HoldsRegions) {
    const TemporaryFolder folder;
    for (const std::string format : {"msh41", "msh41-binary", "msh22", "msh22-binary"}) {
        write_mesh(tiny_with_regions(), folder / "m.msh", {.format = format});
        EXPECT_EQ(read_mesh(folder / "m.msh").region, tiny_with_regions().region);
        write_mesh(tiny(), folder / "m.msh", {.format = format});
        EXPECT_TRUE(read_mesh(folder / "m.msh").region.empty());
    }
}

TEST(Msh, ReadsOtherPrograms) {
    const TemporaryFolder folder;
    // Nodes have arbitrary numbers and lie in the plane z = 2. There is an element without tags, a point, a group
    // without a name, and comments.
    const auto v2 =
        folder.write("m.msh",
                     "$MeshFormat\r\n2 0 8\r\n$EndMeshFormat\r\n$Comments\nby hand\n$EndComments\n"
                     "$Nodes\n5\n7 0 0 2\n900 1 0 2\n3 0.1 1e-5 2\n4 0 1 2\n1 -1 0.33333333333333331 2\n$EndNodes\n"
                     "$PhysicalNames\n1\n1 2   \"farfield\"\n$EndPhysicalNames\n"
                     "$Elements\n8\n1 15 2 9 9 7\n2 1 2 5 1 900 7\n3 1 3 5 1 0 900 3\n4 1 2 2 2 3 4\n5 1 2 2 2 4 1\n"
                     "6 1 2 2 2 1 7\n7 2 0 7 900 3\n8 3 0 7 3 4 1\n$EndElements\n");
    Mesh expected = tiny();
    expected.markers[0].name = "curve5";
    EXPECT_EQ(mesh_hash(read_mesh(v2)), mesh_hash(expected));
    EXPECT_EQ(read_mesh(v2).markers[0].kind, MarkerKind::far_field);

    // Nodes lie on entities of every dimension. Physical groups have signs, and entities have borders.
    const auto v4 = folder.write(
        "n.msh",
        "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$PhysicalNames\n2\n1 7 \"wall\"\n1 8 \"farfield\"\n$EndPhysicalNames\n"
        "$Entities\n1 2 1 0\n1 0 0 0 0\n4 0 0 0 1 1 0 1 -7 2 1 -1\n5 0 0 0 1 1 0 2 8 9 2 1 -1\n1 0 0 0 1 1 0 0 2 4 5\n"
        "$EndEntities\n$Nodes\n3 5 1 5\n0 1 0 1\n1\n0 0 0\n1 4 0 2\n2\n3\n1 0 0\n0.1 1e-5 0\n2 1 0 2\n4\n5\n0 1 0\n"
        "-1 0.33333333333333331 0\n$EndNodes\n"
        "$Elements\n4 7 1 7\n1 4 1 2\n1 1 2\n2 2 3\n1 5 1 3\n3 3 4\n4 4 5\n5 5 1\n2 1 2 1\n6 1 2 3\n2 1 3 1\n7 1 3 4 "
        "5\n"
        "$EndElements\n");
    EXPECT_EQ(mesh_hash(read_mesh(v4)), mesh_hash(tiny()));
}

TEST(Msh, SaysWhereAFileIsMalformed) {
    const TemporaryFolder folder;
    const auto expect_complaint = [&](std::string text, const std::string& from, const std::string& to,
                                      std::size_t line, const std::string& said) {
        const std::size_t at = text.find(from);
        ASSERT_NE(at, std::string::npos) << from;
        text.replace(at, from.size(), to);
        try {
            read_mesh(folder.write("m.msh", text));
            ADD_FAILURE() << "no error for " << to;
        } catch (const InputError& error) {
            EXPECT_EQ(error.place().line, line) << error.what();
            EXPECT_NE(std::string(error.what()).find(said), std::string::npos) << error.what();
        }
    };
    expect_complaint(tiny_msh22, "2.2 0 8", "3 0 8", 2, "version '3'");
    expect_complaint(tiny_msh22, "2.2 0 8", "2.2 0 4", 2, "data size");
    expect_complaint(tiny_msh22, "1 1 \"wall\"", "1 1 wall", 7, "quotation");
    expect_complaint(tiny_msh22, "$Nodes\n5", "$Nodes\n99999999999", 12, "shorter");
    expect_complaint(tiny_msh22, "$Nodes\n5", "$Nodes\n6", 18, "node number expected, found '$EndNodes'");
    expect_complaint(tiny_msh22, "\n2 1.0", "\n1 1.0", 18, "same number");
    expect_complaint(tiny_msh22, "-1.0000000000000000e+00", "inf", 17, "finite");
    expect_complaint(tiny_msh22, "e-05 0\n", "e-05 1\n", 0, "not plane");
    expect_complaint(tiny_msh22, "6 2 2 3 3 1 2 3", "6 2 2 3 3 1 2 9", 26, "node 9");
    expect_complaint(tiny_msh22, "7 3 2 4 4 1 3 4 5", "7 4 2 4 4 1 3 4 5", 27, "element type 4");
    expect_complaint(tiny_msh22, "$EndElements\n", "", 28, "$EndElements expected");
    expect_complaint(tiny_msh41, "$EndEntities\n", "", 17, "$EndEntities expected, found '$Nodes'");
    expect_complaint(tiny_msh41, "2 3 0 5\n", "2 3 1 5\n", 20, "parametric");
    expect_complaint(tiny_msh41, "$Nodes", "$Knots", 19, "$EndKnots");
}

}  // namespace
}  // namespace lamina
