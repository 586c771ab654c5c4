// Periodic borders in files.
#include <gtest/gtest.h>

#include <string>

#include <lamina/io.hpp>

#include "mesh/periodic.hpp"
#include "support/temporary_folder.hpp"

namespace lamina {
namespace {

/// Returns a strip of squares. Its border above is stored in another order than the one below.
Mesh strip() {
    Mesh mesh;
    constexpr std::size_t squares = 3;
    const auto v = [](std::size_t x, std::size_t y) { return VertexId(2 * x + y); };
    for (std::size_t x = 0; x <= squares; ++x)
        for (std::size_t y = 0; y < 2; ++y) mesh.points.push_back({static_cast<double>(x), static_cast<double>(y) / 3});
    Marker lower{"periodic_lower", MarkerKind::periodic, {}}, upper{"periodic_upper", MarkerKind::periodic, {}};
    for (const std::size_t x : {0, 1, 2}) {
        mesh.triangles.push_back({{v(x, 0), v(x + 1, 0), v(x + 1, 1)}});
        mesh.triangles.push_back({{v(x, 0), v(x + 1, 1), v(x, 1)}});
        lower.edges.push_back({v(x, 0), v(x + 1, 0)});
    }
    for (const std::size_t x : {1, 2, 0}) upper.edges.push_back({v(x + 1, 1), v(x, 1)});
    mesh.markers = {lower,
                    upper,
                    {"inlet", MarkerKind::far_field, {{v(0, 1), v(0, 0)}}},
                    {"outlet", MarkerKind::far_field, {{v(squares, 0), v(squares, 1)}}}};
    return mesh;
}

TEST(PeriodicBorders, AreReadBackFromEveryFormat) {
    const test::TemporaryFolder folder;
    for (const MeshFormat& format : mesh_formats()) {
        if (!format.readable) continue;
        const std::string extension = format.extensions.front();
        const auto file = folder.path() / format.name / (extension.starts_with('.') ? "m" + extension : extension);
        std::filesystem::create_directory(folder.path() / format.name);
        write_mesh(strip(), file, {.format = format.name});
        const Mesh mesh = read_mesh(file);
        const auto [pair, mismatch] = mesh::find_periodic_pair(mesh.points, mesh.markers);
        ASSERT_TRUE(pair) << format.name << (mismatch ? mismatch->reason : "");
        EXPECT_EQ(pair->vertices.size(), 4u) << format.name;
    }
}

TEST(PeriodicBorders, FacesOfCyclicPatchesAreInTheSameOrder) {
    const test::TemporaryFolder folder;
    write_mesh(strip(), folder / "case", {.format = "openfoam"});
    const std::string patches = folder.read("case/constant/polyMesh/boundary");
    EXPECT_NE(patches.find("type            cyclic;\n        nFaces          3;"), std::string::npos);
    EXPECT_NE(patches.find("neighbourPatch  periodic_upper;"), std::string::npos);
    EXPECT_NE(patches.find("separationVector (0 -0.3333333333333333 0);"), std::string::npos);
    // The first vertices of faces are twins: 2 x below, 2 x + 1 above.
    const std::string faces = folder.read("case/constant/polyMesh/faces");
    EXPECT_NE(faces.find("4(0 2 10 8)\n4(2 4 12 10)\n4(4 6 14 12)\n4(1 9 11 3)\n4(3 11 13 5)\n4(5 13 15 7)"),
              std::string::npos)
        << faces;
}

TEST(PeriodicBorders, TrianglesFilesNameTheKind) {
    const test::TemporaryFolder folder;
    write_mesh(strip(), folder / "m.poly", {.format = "triangle"});
    EXPECT_NE(folder.read("m.poly").find("# marker 1 periodic periodic_lower\n"), std::string::npos);
}

TEST(PeriodicBorders, GmshKnowsTwins) {
    const test::TemporaryFolder folder;
    write_mesh(strip(), folder / "m.msh", {.format = "msh41"});
    EXPECT_NE(folder.read("m.msh").find(
                  "$Periodic\n1\n1 2 1\n16 1 0 0 0 0 1 0 0.3333333333333333 0 0 1 0 0 0 0 1\n4\n2 1\n4 3\n6 5\n8 7\n"),
              std::string::npos);
}

}  // namespace
}  // namespace lamina
