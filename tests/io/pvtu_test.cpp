// PVTU files and OpenFOAM's cellDecomposition: the parts together are the mesh.
#include <gtest/gtest.h>

#include <sstream>
#include <string>
#include <vector>

#include <lamina/error.hpp>
#include <lamina/io.hpp>

#include "mesh/partition.hpp"
#include "support/pvtu_parts.hpp"
#include "support/sample_meshes.hpp"
#include "support/temporary_folder.hpp"

namespace lamina::test {
namespace {

/// Returns meshes with and without quadrilaterals, in and out of order.
std::vector<Mesh> meshes_to_divide() {
    return {annulus(), annulus({.around = 60, .rings = 12, .quads_in_layer = true}),
            shuffled(annulus({.around = 40, .rings = 9}), 3), box_with_hole()};
}

TEST(Pvtu, ListNamesTheParts) {
    for (const Mesh& mesh : meshes_to_divide())
        for (const std::size_t parts : {1u, 2u, 5u}) {
            SCOPED_TRACE(parts);
            const TemporaryFolder folder;
            write_mesh(mesh, folder / "a & b.pvtu", {.parts = parts});
            std::vector<std::string> names{"a & b.pvtu"};
            for (std::size_t i = 0; i < parts; ++i) names.push_back("a & b_" + std::to_string(i) + ".vtu");
            EXPECT_EQ(folder.names(), names);
            EXPECT_EQ(output_files(folder / "a & b.pvtu", {.parts = parts}).size(), parts + 1);
            std::string list = folder.read("a & b.pvtu");
            EXPECT_EQ(sources_of(list).size(), parts);
            EXPECT_NE(list.find("Source=\"a &amp; b_0.vtu\""), std::string::npos) << list;
        }
}

TEST(Pvtu, PartsMakeTheMeshAgain) {
    for (const Mesh& mesh : meshes_to_divide())
        for (const std::size_t parts : {1u, 3u, 8u}) {
            SCOPED_TRACE(parts);
            const TemporaryFolder folder;
            write_mesh(mesh, folder / "m.pvtu", {.parts = parts});
            const Mesh joined = join_parts(folder, "m.pvtu");
            EXPECT_EQ(mesh_hash(joined), mesh_hash(mesh));
            EXPECT_EQ(joined.points, mesh.points);
            EXPECT_EQ(check_mesh(joined).valid(), check_mesh(mesh).valid());
        }
}

TEST(Pvtu, LeavesNothingWhereItFails) {
    const TemporaryFolder folder;
    std::filesystem::create_directory(folder / "m_1.vtu");  // a part cannot take the place of a folder
    EXPECT_THROW(write_mesh(annulus(), folder / "m.pvtu", {.parts = 3}), IoError);
    for (const std::string& name : folder.names()) EXPECT_NE(name, "m.pvtu");
    EXPECT_THROW(write_mesh(annulus(), folder / "n.pvtu", {.parts = 0}), OptionError);
    EXPECT_THROW(read_mesh(folder / "m.pvtu"), UsageError);
}

TEST(OpenFoam, WritesTheDecomposition) {
    const TemporaryFolder folder;
    const Mesh mesh = annulus({.around = 60, .rings = 12, .quads_in_layer = true});
    write_mesh(mesh, folder / "case", {.format = "openfoam", .parts = 4});
    std::istringstream text(folder.read("case/constant/cellDecomposition"));
    for (std::string line; std::getline(text, line) && line != "}";) {
    }
    std::size_t count = 0;
    char parenthesis = 0;
    text >> count >> parenthesis;
    std::vector<std::uint32_t> parts(count);
    for (std::uint32_t& part : parts) text >> part;
    EXPECT_EQ(parts, mesh::partition_cells(mesh, 4));
    write_mesh(mesh, folder / "other", {.format = "openfoam"});
    EXPECT_FALSE(std::filesystem::exists(folder / "other/constant/cellDecomposition"));
}

}  // namespace
}  // namespace lamina::test
