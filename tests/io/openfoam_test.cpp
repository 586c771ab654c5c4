// The bytes of a polyMesh, the order of its faces, and the meshes that it cannot hold.
#include <gtest/gtest.h>

#include <string>

#include <lamina/error.hpp>
#include <lamina/io.hpp>

#include "support/sample_meshes.hpp"
#include "support/temporary_folder.hpp"

namespace lamina {
namespace {

using test::annulus;
using test::shuffled;
using test::TemporaryFolder;
using test::tiny;

std::string header(const std::string& type, const std::string& object, const std::string& note = "") {
    return "FoamFile\n{\n    version     2.0;\n    format      ascii;\n    class       " + type + ";\n" + note +
           "    location    \"constant/polyMesh\";\n    object      " + object + ";\n}\n\n";
}

TEST(OpenFoam, WritesTheGoldenFolder) {
    const TemporaryFolder folder;
    write_mesh(tiny(), folder / "case", {.format = "openfoam"});
    const auto read = [&](const std::string& name) { return folder.read("case/constant/polyMesh/" + name); };
    EXPECT_EQ(read("points"), header("vectorField", "points") +
                                  "10\n(\n"
                                  "(0.0000000000000000e+00 0.0000000000000000e+00 0)\n"
                                  "(1.0000000000000000e+00 0.0000000000000000e+00 0)\n"
                                  "(1.0000000000000001e-01 1.0000000000000001e-05 0)\n"
                                  "(-0.0000000000000000e+00 1.0000000000000000e+00 0)\n"
                                  "(-1.0000000000000000e+00 3.3333333333333331e-01 0)\n"
                                  "(0.0000000000000000e+00 0.0000000000000000e+00 1)\n"
                                  "(1.0000000000000000e+00 0.0000000000000000e+00 1)\n"
                                  "(1.0000000000000001e-01 1.0000000000000001e-05 1)\n"
                                  "(-0.0000000000000000e+00 1.0000000000000000e+00 1)\n"
                                  "(-1.0000000000000000e+00 3.3333333333333331e-01 1)\n"
                                  ")\n");
    EXPECT_EQ(read("faces"), header("faceList", "faces") +
                                 "10\n(\n4(2 0 5 7)\n"
                                 "4(0 1 6 5)\n4(1 2 7 6)\n4(2 3 8 7)\n4(3 4 9 8)\n4(4 0 5 9)\n"
                                 "3(2 1 0)\n4(4 3 2 0)\n3(5 6 7)\n4(5 7 8 9)\n)\n");
    const std::string note = "    note        \"nPoints:10  nCells:2  nFaces:10  nInternalFaces:1\";\n";
    EXPECT_EQ(read("owner"), header("labelList", "owner", note) + "10\n(\n0\n0\n0\n1\n1\n1\n0\n1\n0\n1\n)\n");
    EXPECT_EQ(read("neighbour"), header("labelList", "neighbour", note) + "1\n(\n1\n)\n");
    EXPECT_EQ(read("boundary"),
              header("polyBoundaryMesh", "boundary") +
                  "3\n(\n"
                  "    wall\n    {\n        type            wall;\n        nFaces          2;\n"
                  "        startFace       1;\n    }\n"
                  "    farfield\n    {\n        type            patch;\n        nFaces          3;\n"
                  "        startFace       3;\n    }\n"
                  "    frontAndBack\n    {\n        type            empty;\n        nFaces          4;\n"
                  "        startFace       6;\n    }\n"
                  ")\n");
    EXPECT_EQ(mesh_hash(read_mesh(folder / "case")), mesh_hash(tiny()));
}

/// Returns the numbers of a labelList.
std::vector<std::size_t> labels(const std::string& text) {
    std::istringstream in(text.substr(text.find("}\n") + 2));
    std::string bracket;
    std::size_t n = 0;
    in >> n >> bracket;
    std::vector<std::size_t> values(n);
    for (std::size_t& value : values) in >> value;
    EXPECT_TRUE(in.good());
    return values;
}

TEST(OpenFoam, AMeshWithAnAxisBecomesAWedge) {
    // A triangle with an edge on the axis, one with a corner there, and a square beside it.
    Mesh mesh;
    mesh.points = {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0, 2}, {1, 2}};
    mesh.triangles = {{{VertexId(0), VertexId(1), VertexId(2)}}, {{VertexId(0), VertexId(2), VertexId(3)}}};
    mesh.quads = {{{VertexId(3), VertexId(2), VertexId(5), VertexId(4)}}};
    const auto edge = [](int a, int b) { return Segment{VertexId(a), VertexId(b)}; };
    mesh.markers = {{"axis", MarkerKind::symmetry, {edge(0, 1)}},
                    {"farfield", MarkerKind::far_field, {edge(1, 2), edge(2, 5), edge(5, 4), edge(4, 3), edge(3, 0)}}};
    const TemporaryFolder folder;
    write_mesh(mesh, folder / "case", {.format = "openfoam"});
    const auto read = [&](const std::string& name) { return folder.read("case/constant/polyMesh/" + name); };
    EXPECT_NE(read("points").find("\n10\n(\n"), std::string::npos);
    EXPECT_NE(read("points").find(" -0.0218"), std::string::npos);
    EXPECT_NE(read("points").find(" 0.0218"), std::string::npos);
    EXPECT_EQ(read("faces"), header("faceList", "faces") +
                                 "13\n(\n3(2 0 6)\n4(2 3 7 6)\n"
                                 "3(1 2 6)\n4(2 5 9 6)\n4(5 4 8 9)\n4(4 3 7 8)\n3(3 0 7)\n"
                                 "3(2 1 0)\n3(3 2 0)\n4(4 5 2 3)\n3(0 1 6)\n3(0 6 7)\n4(7 6 9 8)\n)\n");
    EXPECT_NE(read("boundary").find("3\n(\n    farfield\n"), std::string::npos);
    EXPECT_NE(read("boundary").find("wedge"), std::string::npos);
    EXPECT_EQ(read("boundary").find("axis"), std::string::npos);
    EXPECT_THROW(write_mesh(mesh, folder / "deep", {.format = "openfoam", .span = 2}), UsageError);
    mesh.points[1].y = -0.1;
    EXPECT_THROW(write_mesh(mesh, folder / "below", {.format = "openfoam"}), UsageError);
}

TEST(OpenFoam, FacesAreInUpperTriangularOrder) {
    const TemporaryFolder folder;
    for (const Mesh& mesh : {annulus({.around = 100, .rings = 60}), shuffled(annulus({.quads_in_layer = true}), 5)}) {
        write_mesh(mesh, folder / "polyMesh");
        const auto owner = labels(folder.read("polyMesh/owner")), neighbour = labels(folder.read("polyMesh/neighbour"));
        ASSERT_GT(owner.size(), neighbour.size());
        for (std::size_t f = 0; f < neighbour.size(); ++f) {
            ASSERT_LT(owner[f], neighbour[f]);
            const bool ascends =
                f == 0 || owner[f - 1] < owner[f] || (owner[f - 1] == owner[f] && neighbour[f - 1] < neighbour[f]);
            ASSERT_TRUE(ascends);
        }
    }
}

TEST(OpenFoam, ReplacesAMeshAndNothingElse) {
    const TemporaryFolder folder;
    write_mesh(tiny(), folder / "polyMesh");
    folder.write("polyMesh/cellZones", "of the old mesh");
    write_mesh(annulus(), folder / "polyMesh");
    EXPECT_FALSE(std::filesystem::exists(folder / "polyMesh/cellZones"));
    EXPECT_EQ(folder.names(), std::vector<std::string>{"polyMesh"});

    std::filesystem::create_directories(folder / "thesis/polyMesh");
    folder.write("thesis/polyMesh/chapter1", "precious");
    EXPECT_THROW(check_writable(folder / "thesis/polyMesh"), IoError);
    EXPECT_THROW(write_mesh(tiny(), folder / "thesis/polyMesh"), IoError);
    EXPECT_EQ(folder.read("thesis/polyMesh/chapter1"), "precious");
}

TEST(OpenFoam, RefusesMeshesThatItCannotHold) {
    const TemporaryFolder folder;
    const auto expect_refused = [&](const Mesh& mesh, const std::string& said) {
        try {
            write_mesh(mesh, folder / "case", {.format = "openfoam"});
            ADD_FAILURE() << "no error: " << said;
        } catch (const Error& error) {
            EXPECT_NE(std::string(error.what()).find(said), std::string::npos) << error.what();
        }
    };
    Mesh mesh = tiny();
    mesh.markers[0].name = "main wing";
    expect_refused(mesh, "'main wing'");
    mesh.markers[0].name = "frontAndBack";
    expect_refused(mesh, "'frontAndBack'");
    // OpenFOAM reads these as numbers, or as nothing.
    for (const char* name : {"0012", "4412flap", "1e5", ".5", "-1", "+"}) {
        mesh.markers[0].name = name;
        expect_refused(mesh, std::string("'") + name + "'");
    }
    mesh = tiny();
    mesh.markers[0].edges.pop_back();
    expect_refused(mesh, "exactly one marker");
    mesh = tiny();
    std::swap(mesh.markers[0].edges[0].a, mesh.markers[0].edges[0].b);
    expect_refused(mesh, "on the boundary");
    EXPECT_TRUE(folder.names().empty());
}

}  // namespace
}  // namespace lamina
