// The bytes of Fluent's files, and files as other programs write them.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include <lamina/error.hpp>
#include <lamina/files.hpp>
#include <lamina/io.hpp>

#include "support/sample_meshes.hpp"
#include "support/temporary_folder.hpp"

namespace lamina {
namespace {

using test::annulus;
using test::TemporaryFolder;
using test::tiny;

constexpr const char* tiny_fluent =
    "(0 \"a mesh of lamina\")\n"
    "(2 2)\n"
    "(10 (0 1 5 0 2))\n"
    "(12 (0 1 2 0))\n"
    "(13 (0 1 6 0))\n"
    "(10 (1 1 5 1 2)(\n"
    "0.0000000000000000e+00 0.0000000000000000e+00\n"
    "1.0000000000000000e+00 0.0000000000000000e+00\n"
    "1.0000000000000001e-01 1.0000000000000001e-05\n"
    "-0.0000000000000000e+00 1.0000000000000000e+00\n"
    "-1.0000000000000000e+00 3.3333333333333331e-01\n"
    "))\n"
    "(12 (2 1 2 1 0)(\n"
    "1 3\n"
    "))\n"
    "(13 (3 1 1 2 2)(\n"
    "3 1 1 2\n"
    "))\n"
    "(13 (4 2 3 3 2)(\n"
    "1 2 1 0\n"
    "2 3 1 0\n"
    "))\n"
    "(13 (5 4 6 9 2)(\n"
    "3 4 2 0\n"
    "4 5 2 0\n"
    "5 1 2 0\n"
    "))\n"
    "(45 (2 fluid fluid)())\n"
    "(45 (3 interior interior)())\n"
    "(45 (4 wall wall)())\n"
    "(45 (5 pressure-far-field farfield)())\n";

/// Returns the text with one part of it replaced.
std::string replaced(std::string text, const std::string& from, const std::string& to) {
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

TEST(Fluent, WritesTheGoldenFile) {
    const TemporaryFolder folder;
    write_mesh(tiny(), folder / "m.cas");
    EXPECT_EQ(folder.read("m.cas"), tiny_fluent);
}

TEST(Fluent, BinaryFilesMayEndNowhere) {
    const TemporaryFolder folder;
    write_mesh(tiny(), folder / "m.cas", {.format = "fluent-binary"});
    const std::string whole = folder.read("m.cas");
    bool in_list = false;
    for (std::size_t n = 0; n < whole.size(); ++n) {
        write_file(folder / "cut.cas", whole.substr(0, n));
        try {
            const Mesh mesh = read_mesh(folder / "cut.cas");  // names of markers alone are missing
            EXPECT_EQ(mesh.points, tiny().points) << n;
        } catch (const InputError& error) {
            in_list |= std::string(error.what()).find("ends within a list") != std::string::npos;
        }
    }
    EXPECT_TRUE(in_list);
}

TEST(Fluent, BinaryFilesHoldThePointsBitForBit) {
    const TemporaryFolder folder;
    const Mesh mesh = tiny();
    write_mesh(mesh, folder / "m.cas", {.format = "fluent-binary"});
    const std::string file = folder.read("m.cas");
    const std::string points(reinterpret_cast<const char*>(mesh.points.data()), mesh.points.size() * sizeof(Point));
    EXPECT_NE(file.find("(3010 (1 1 5 1 2)\n(" + points + ")\nEnd of Binary Section   3010)\n"), std::string::npos);
    EXPECT_NE(file.find("(2012 (2 1 2 1 0)\n("), std::string::npos);
    EXPECT_NE(file.find("(2013 (5 4 6 9 2)\n("), std::string::npos);
}

TEST(Fluent, IsToldFromGmshByItsContents) {
    const TemporaryFolder folder;
    const Mesh mesh = annulus({.quads_in_layer = true});
    for (const char* format : {"fluent", "fluent-binary"}) {
        write_mesh(mesh, folder / "m.msh", {.format = format});
        EXPECT_EQ(mesh_hash(read_mesh(folder / "m.msh")), mesh_hash(mesh));
    }
    write_mesh(mesh, folder / "m.msh");
    EXPECT_EQ(folder.read("m.msh").substr(0, 11), "$MeshFormat");
    EXPECT_EQ(mesh_hash(read_mesh(folder / "m.msh")), mesh_hash(mesh));
}

TEST(Fluent, KeepsKindsAsTypesOfZones) {
    const TemporaryFolder folder;
    Mesh mesh = annulus();
    const auto type_of_outer = [&](const char* name, MarkerKind kind) {
        mesh.markers[1].name = name;
        mesh.markers[1].kind = kind;
        write_mesh(mesh, folder / "m.cas");
        const std::string file = folder.read("m.cas");
        EXPECT_TRUE(kind == MarkerKind::other || kind == read_mesh(folder / "m.cas").markers[1].kind) << name;
        const std::size_t at = file.find("(45 (5 ") + 7;
        return file.substr(at, file.find(' ', at) - at);
    };
    EXPECT_EQ(type_of_outer("farfield", MarkerKind::far_field), "pressure-far-field");
    EXPECT_EQ(type_of_outer("inlet", MarkerKind::far_field), "velocity-inlet");
    EXPECT_EQ(type_of_outer("outlet", MarkerKind::far_field), "pressure-outlet");
    EXPECT_EQ(type_of_outer("symmetry", MarkerKind::symmetry), "symmetry");
    EXPECT_EQ(type_of_outer("unknown", MarkerKind::other), "wall");
    mesh.markers[1].name = "interior";
    EXPECT_THROW(write_mesh(mesh, folder / "m.cas"), UsageError);
}

TEST(Fluent, ReadsOtherPrograms) {
    const TemporaryFolder folder;
    // As TGrid and Gambit write: nodes in two zones out of order, numbers of nodes in front of faces, faces of the
    // boundary with their cell on the right, a cell zone of one shape, capital digits, ends of lines of Windows.
    std::string text =
        "(1 \"TGrid 2D (with a parenthesis\")\r\n(2 2)\r\n(10 (0 1 5 0))\r\n(13(0 1 6 0))\r\n(12 (0 1 2 0))\r\n"
        "(10 (6 4 5 1 2) (\r\n -0.0 1\r\n-1.0E+00 +.33333333333333331\r\n))\r\n"
        "(10 (7 1 3 1) (\r\n0 0  1. 0\r\n0.1 1e-5))\r\n"
        "(12 (B 1 1 1 1))(12 (C 2 2 1 3)())\r\n"
        "(13 (8 1 1 2 0)(\r\n2 3 1 1 2\r\n))\r\n(13 (A 2 3 3 2)(2 1 0 1 3 2 0 1))\r\n"
        "(13 (9 4 6 9 5)(\r\n2 3 4 2 0\r\n2 5 4 0 2\r\n2 5 1 2 0))\r\n"
        "(37 ((rp-var \"a ) quoted\") (nested (b . 2))))\r\n"
        "(45 (11 fluid tri)())(45 (12 fluid quad)())(45 (8 interior default-interior)())\r\n"
        "(39 (10 wall wall 1)(\r\n(a . 1) (b () (c . #f))))\r\n(39 (9 pressure-far-field farfield)())\r\n";
    const Mesh mesh = read_mesh(folder.write("m.msh", text));
    EXPECT_EQ(mesh_hash(mesh), mesh_hash(tiny()));
    ASSERT_EQ(mesh.markers.size(), 2U);
    EXPECT_EQ(mesh.markers[0].kind, MarkerKind::wall);
    EXPECT_EQ(mesh.markers[1].kind, MarkerKind::far_field);
    EXPECT_TRUE(mesh.region.empty());
}

template <class T>
std::string big_endian(std::initializer_list<T> values) {
    std::string bytes;
    for (const T value : values) {
        const auto* const first = reinterpret_cast<const char*>(&value);
        bytes.append(std::reverse_iterator(first + sizeof value), std::reverse_iterator(first));
    }
    return bytes;
}

TEST(Fluent, ReadsSinglePrecisionOfEitherByteOrder) {
    const TemporaryFolder folder;
    const std::string end = ")\nEnd of Binary Section   ";
    const std::string text =
        "(2 2)(4 (66 0 0 1 2 4 4 4 8 8 4))\n(10 (0 1 3 0 2))(12 (0 1 1 0))(13 (0 1 3 0))\n(2010 (1 1 3 1 2)(" +
        big_endian<float>({0, 0, 1.5F, 0, 0, 0.25F}) + end + "2010)\n(12 (2 1 1 1 1))\n" + "(2040 (2 1 1)(" +
        big_endian<std::int32_t>({40}) + end + "2040)\n(3013 (4 1 3 3 2)(" +
        big_endian<std::int32_t>({1, 2, 1, 0, 2, 3, 1, 0, 3, 1, 1, 0}) + end + "3013)\n(45 (4 wall body)())\n";
    const Mesh mesh = read_mesh(folder.write("m.cas", text));
    EXPECT_EQ(mesh.points, (std::vector<Point>{{0, 0}, {1.5, 0}, {0, 0.25}}));
    ASSERT_EQ(mesh.triangles.size(), 1U);
    EXPECT_EQ(mesh.markers[0].name, "body");
    EXPECT_EQ(mesh.markers[0].edges.size(), 3U);
    EXPECT_TRUE(check_mesh(mesh).valid());
}

TEST(Fluent, SaysWhereAFileIsMalformed) {
    const TemporaryFolder folder;
    const auto expect_complaint = [&](const std::string& from, const std::string& to, std::size_t line,
                                      const std::string& said) {
        try {
            read_mesh(folder.write("m.cas", replaced(tiny_fluent, from, to)));
            ADD_FAILURE() << "no error for " << to;
        } catch (const InputError& error) {
            EXPECT_EQ(error.place().line, line) << error.what();
            EXPECT_NE(std::string(error.what()).find(said), std::string::npos) << error.what();
        }
    };
    expect_complaint("(2 2)", "(2 3)", 2, "3 dimensions");
    expect_complaint("(2 2)\n", "", 0, "without the dimension");
    expect_complaint("(2 2)", "2 2", 2, "'(' expected");
    expect_complaint("1 5 1 2)", "1 ffffffff 1 2)", 6, "no room");
    expect_complaint("1 5 1 2)", "1 5 1 3)", 6, "two coordinates");
    expect_complaint("1.0000000000000001e-05", "nan", 9, "finite");
    expect_complaint("1.0000000000000001e-05", "x", 9, "coordinate expected");
    expect_complaint("1 3\n", "1 2\n", 14, "shape 2");
    expect_complaint("1 2 1 0\n", "1 6 1 0\n", 0, "node 6 where there are 5");
    expect_complaint("1 2 1 0\n", "1 2 3 0\n", 0, "cell 3 where there are 2");
    expect_complaint("1 2 1 0\n", "1 2 0 0\n", 0, "has no cell");
    expect_complaint("1 2 1 0\n", "1 2 2 0\n", 0, "too many faces");
    expect_complaint("1 2 1 0\n", "1 4 1 0\n", 0, "not closed");
    expect_complaint("(13 (0 1 6 0))", "(13 (0 1 7 0))", 0, "7 faces are declared, but 6 are there");
    expect_complaint("(45 (4 wall wall)())\n", "", 0, "names zone 4");
    expect_complaint("(45 (2", "(58 (1 1 1 1)())\n(45 (2", 28, "hanging nodes");
}

}  // namespace
}  // namespace lamina
