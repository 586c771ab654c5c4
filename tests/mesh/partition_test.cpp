// partition_cells(): parts of equal size that are compact, whatever the order of the cells.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include <lamina/error.hpp>
#include <lamina/threads.hpp>

#include "mesh/adjacency.hpp"
#include "mesh/partition.hpp"
#include "support/sample_meshes.hpp"

namespace lamina::test {
namespace {

/// Returns the number of edges between two parts.
std::size_t edges_between_parts(const Mesh& mesh, const std::vector<std::uint32_t>& part_of_cell) {
    const mesh::CellEdges cells(mesh);
    const mesh::Adjacency adjacency = mesh::find_adjacency(mesh);
    std::size_t edges = 0;
    for (std::size_t e = 0; e < cells.size(); ++e)
        if (const std::uint32_t twin = adjacency.twin[e]; twin != mesh::no_edge && twin > e)
            edges += part_of_cell[cells.cell_of(e)] != part_of_cell[cells.cell_of(twin)];
    return edges;
}

TEST(Partition, IsEvenAndCompact) {
    for (const bool quads : {false, true}) {
        const Mesh ordered = annulus({.around = 240, .rings = 40, .quads_in_layer = quads});
        for (const Mesh& mesh : {ordered, shuffled(ordered, 5)}) {
            const std::size_t cells = mesh.triangles.size() + mesh.quads.size();
            for (const std::size_t parts : {1u, 2u, 3u, 7u, 8u, 100u}) {
                SCOPED_TRACE(parts);
                const std::vector<std::uint32_t> part_of_cell = mesh::partition_cells(mesh, parts);
                ASSERT_EQ(part_of_cell.size(), cells);
                std::vector<std::size_t> sizes(parts, 0);
                for (const std::uint32_t part : part_of_cell) sizes.at(part) += 1;
                for (const std::size_t size : sizes) {
                    EXPECT_GE(size, cells / parts);
                    EXPECT_LE(size, cells / parts + 1);
                }
                // A compact part of n cells has a border in proportion to the root of n. Random parts would have nearly
                // all edges between them.
                const double expected = 4 * std::sqrt(double(cells) * double(parts));
                EXPECT_LE(double(edges_between_parts(mesh, part_of_cell)), parts == 1 ? 0.0 : expected);
                with_threads(3, [&] { EXPECT_EQ(mesh::partition_cells(mesh, parts), part_of_cell); });
            }
        }
    }
}

TEST(Partition, OfFewCellsLeavesPartsEmpty) {
    const Mesh mesh = tiny();
    const std::vector<std::uint32_t> part_of_cell = mesh::partition_cells(mesh, 5);
    ASSERT_EQ(part_of_cell.size(), mesh.triangles.size() + mesh.quads.size());
    EXPECT_NE(part_of_cell[0], part_of_cell[1]);
    EXPECT_TRUE(mesh::partition_cells(Mesh{}, 3).empty());
    EXPECT_THROW(mesh::partition_cells(mesh, 0), OptionError);
}

}  // namespace
}  // namespace lamina::test
