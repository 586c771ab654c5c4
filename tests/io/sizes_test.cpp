// Sizes at the vertices of background meshes.
#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <string>

#include <lamina/error.hpp>
#include <lamina/io.hpp>

#include "support/sample_meshes.hpp"
#include "support/temporary_folder.hpp"

namespace lamina {
namespace {

using test::TemporaryFolder;

struct PointArray {
    std::string name;
    std::vector<double> values;
    std::size_t components = 1;
};

/// A VTU file of the mesh with arrays of point data put in.
std::string vtu_with(const Mesh& mesh, const std::vector<PointArray>& arrays, const TemporaryFolder& folder) {
    write_mesh(mesh, folder / "plain.vtu");
    std::string bytes = folder.read("plain.vtu");
    const std::size_t first = bytes.find('_', bytes.find("<AppendedData")) + 1;
    const std::size_t end = bytes.rfind("\n  </AppendedData>");
    std::string header = "<PointData>\n", appended;
    for (const PointArray& array : arrays) {
        header += "<DataArray type=\"Float64\" Name=\"" + array.name + "\" NumberOfComponents=\"" +
                  std::to_string(array.components) + "\" format=\"appended\" offset=\"" +
                  std::to_string(end - first + appended.size()) + "\"/>\n";
        const std::uint64_t length = array.values.size() * sizeof(double);
        std::string stored(sizeof length + length, '\0');
        std::memcpy(stored.data(), &length, sizeof length);
        std::memcpy(stored.data() + sizeof length, array.values.data(), length);
        appended += stored;
    }
    bytes.insert(end, appended);
    return bytes.insert(bytes.find("<Points>"), header + "</PointData>\n");
}

std::vector<double> some_sizes(std::size_t n) {
    std::vector<double> sizes(n);
    for (std::size_t i = 0; i < n; ++i) sizes[i] = 0.1 + 0.01 * static_cast<double>(i);
    return sizes;
}

void expect_bad(const std::filesystem::path& file, const std::string& said) {
    try {
        read_sizes(file);
        ADD_FAILURE() << "accepted: " << said;
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find(said), std::string::npos) << error.what();
        EXPECT_NE(std::string(error.what()).find(file.filename().string()), std::string::npos) << error.what();
    }
}

TEST(Sizes, AreReadFromPointDataOfVtu) {
    const TemporaryFolder folder;
    const Mesh mesh = test::annulus({.quads_in_layer = true});
    const std::vector<double> sizes = some_sizes(mesh.points.size());
    const std::vector<double> other(mesh.points.size(), -1);
    const std::vector<double> vectors(3 * mesh.points.size(), 7);
    for (const auto& arrays : {std::vector<PointArray>{{"h", sizes}, {"velocity", vectors, 3}},
                               std::vector<PointArray>{{"mach", other}, {"size", sizes}, {"velocity", vectors, 3}}}) {
        const SizedMesh read = read_sizes(folder.write("a.vtu", vtu_with(mesh, arrays, folder)));
        EXPECT_EQ(read.points, mesh.points);
        EXPECT_EQ(read.sizes, sizes);
        EXPECT_EQ(read.triangles.size(), mesh.triangles.size() + 2 * mesh.quads.size());
    }
}

TEST(Sizes, OfVtuThatAreWrongAreRefused) {
    const TemporaryFolder folder;
    const Mesh mesh = test::annulus();
    const std::size_t n = mesh.points.size();
    const auto refuse = [&](const std::vector<PointArray>& arrays, const std::string& said) {
        expect_bad(folder.write("a.vtu", vtu_with(mesh, arrays, folder)), said);
    };
    refuse({}, "no sizes");
    refuse({{"velocity", std::vector<double>(3 * n, 1), 3}}, "no sizes");
    refuse({{"mach", some_sizes(n)}, {"p", some_sizes(n)}}, "mach, p");
    refuse({{"size", some_sizes(n - 1)}}, "announced");
    for (const double wrong : {0.0, -1.0, HUGE_VAL, std::nan("")}) {
        std::vector<double> sizes = some_sizes(n);
        sizes[3] = wrong;
        refuse({{"size", sizes}}, "vertex 3");
    }
    Mesh empty;
    empty.points = {{0, 0}, {1, 0}};
    expect_bad(folder.write("a.vtu", vtu_with(empty, {{"size", {1, 1}}}, folder)), "no triangles");
    EXPECT_THROW(read_sizes(folder / "missing.vtu"), IoError);
    EXPECT_THROW(read_sizes(folder / "a.su2"), UsageError);
}

constexpr const char* square =
    "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n"
    "$Nodes\n5\n7 0 0 0\n8 1 0 0\n9 1 1 0\n4 0 1 0\n5 9 9 0\n$EndNodes\n"
    "$Elements\n2\n1 2 2 0 1 7 8 9\n2 2 2 0 1 7 9 4\n$EndElements\n";

std::string node_data(const std::string& name, const std::string& values, int count, int components = 1) {
    return "$NodeData\n1\n\"" + name + "\"\n1\n0.0\n3\n0\n" + std::to_string(components) + "\n" +
           std::to_string(count) + "\n" + values + "$EndNodeData\n";
}

TEST(Sizes, AreReadFromNodeDataOfMsh) {
    const TemporaryFolder folder;
    const std::string velocity = node_data("velocity", "7 1 2 3\n", 1, 3);
    const std::string size = node_data("size", "9 0.3\n7 0.1\n8 0.2\n4 0.4\n", 4);
    const std::string other = node_data("mach", "7 -1\n", 1);
    for (const std::string& data : {velocity + size, other + size}) {
        const SizedMesh read = read_sizes(folder.write("a.msh", square + data));
        // The node of no triangle is left out.
        EXPECT_EQ(read.points, (std::vector<Point>{{0, 0}, {1, 0}, {1, 1}, {0, 1}}));
        EXPECT_EQ(read.sizes, (std::vector<double>{0.1, 0.2, 0.3, 0.4}));
        EXPECT_EQ(read.triangles.size(), 2u);
    }
    expect_bad(folder.write("a.msh", square), "no sizes");
    expect_bad(folder.write("a.msh", square + node_data("size", "7 1\n8 1\n9 1\n", 3)), "vertex 3 has no size");
    expect_bad(folder.write("a.msh", square + node_data("size", "7 1\n8 1\n9 0\n4 1\n", 4)), "must be positive");
    expect_bad(folder.write("a.msh", square + node_data("size", "7 1\n3 1\n", 2)), "a.msh:27: node 3");
    expect_bad(folder.write("a.msh", square + node_data("size", "7 1\n", 2)), "a.msh:27");
}

TEST(Sizes, AreReadFromBinaryMsh) {
    const TemporaryFolder folder;
    const Mesh mesh = test::annulus();
    const std::vector<double> sizes = some_sizes(mesh.points.size());
    for (const char* format : {"msh41-binary", "msh22-binary"}) {
        write_mesh(mesh, folder / "a.msh", {.format = format});
        std::string data = node_data("size", "", static_cast<int>(sizes.size()));
        std::string values;
        for (std::size_t i = 0; i < sizes.size(); ++i) {
            const auto node = static_cast<std::int32_t>(i + 1);
            values.append(reinterpret_cast<const char*>(&node), sizeof node);
            values.append(reinterpret_cast<const char*>(&sizes[i]), sizeof(double));
        }
        data.insert(data.find("$EndNodeData"), values + "\n");
        const SizedMesh read = read_sizes(folder.write("a.msh", folder.read("a.msh") + data));
        EXPECT_EQ(read.points, mesh.points) << format;
        EXPECT_EQ(read.sizes, sizes) << format;
    }
}

}  // namespace
}  // namespace lamina
