// Exact numbers of wall points and of rays in fans give similar sections layers that are numbered alike.
#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <lamina/option.hpp>

#include "pipeline/cases.hpp"

namespace lamina::test {
namespace {

using shapes::Outline;

constexpr std::size_t wall_points = 180;
constexpr std::uint32_t layer_count = 24;
/// Half a turn at 5 degrees between rays.
constexpr std::size_t rays_of_fan = 37;

CaseOptions equal_options() {
    CaseOptions options;
    find_row(option_table<CaseOptions>(), "exact-points").set(options, std::int64_t{wall_points});
    options.layer.layers = layer_count;
    options.layer.first_height = Length{2e-5};
    options.layer.topology = LayerTopology::quads;
    options.far_field.size = 10;
    return options;
}

/// A cell of the layer, and its column.
using ColumnCell = std::pair<std::uint32_t, std::array<VertexId, 4>>;

/// Returns the quadrilaterals below the last layer.
std::vector<ColumnCell> lower_quads(const MeshResult& result) {
    std::vector<ColumnCell> quads;
    const Mesh& mesh = result.mesh;
    const std::size_t layer_triangles = result.columns.size() - mesh.quads.size();
    for (std::size_t q = 0; q < mesh.quads.size(); ++q)
        if (mesh.layer[mesh.triangles.size() + q] < layer_count)
            quads.emplace_back(result.columns[layer_triangles + q], std::to_array(mesh.quads[q].v));
    return quads;
}

/// Expects that sections have layers with the same cells but for the last row, whose columns have more cells where they
/// divide their edges of the border, and that the points on the rays follow those of the wall.
void expect_equal_layers(const std::vector<Outline>& sections, const CaseOptions& options, std::size_t fans) {
    const std::size_t rays = wall_points + fans * (rays_of_fan - 1);
    std::vector<ColumnCell> first;
    std::vector<VertexId> origins;
    for (std::size_t s = 0; s < sections.size(); ++s) {
        SCOPED_TRACE(s);
        const MeshResult result = mesh_of({sections[s]}, options);
        expect_sound(result, options);
        EXPECT_EQ(result.mesh.markers[0].edges.size(), wall_points);
        EXPECT_EQ(result.surface_vertices, wall_points);
        ASSERT_EQ(result.column_origins.size(), rays);
        EXPECT_EQ(result.layer_coverage[0].all.incomplete_rays, 0u);
        const auto quads = lower_quads(result);
        EXPECT_EQ(quads.size(), wall_points * (layer_count - 1) + fans * (rays_of_fan - 1) * (layer_count - 2));
        for (const auto& [column, quad] : quads) {
            const std::size_t below = quad[0].index(), above = quad[1].index();
            EXPECT_EQ(above, below < wall_points ? wall_points + column * layer_count : below + 1)
                << "of ray " << column;
        }
        if (s == 0) {
            first = quads;
            origins = result.column_origins;
        }
        EXPECT_TRUE(quads == first);
        EXPECT_TRUE(result.column_origins == origins);
    }
}

TEST(EqualLayers, OfSectionsWithASharpTrailingEdge) {
    expect_equal_layers({naca("0012"), naca("0008"), naca("0024"), naca("4415"), naca("6409"), naca("23012"),
                         shapes::section(0.15, 0, 30)},
                        equal_options(), 1);
}

TEST(EqualLayers, OfSectionsWithABase) {
    const std::vector<Outline> sections{naca("0012", 120, TrailingEdge::blunt), naca("2415", 120, TrailingEdge::blunt),
                                        shapes::section(0.15, 0.004, 30), shapes::section(0.1, 0.002, 30)};
    expect_equal_layers(sections, equal_options(), 2);
    CaseOptions three_edges = equal_options();
    find_row(option_table<CaseOptions>(), "exact-points").set(three_edges, std::to_string(wall_points) + ":3");
    expect_equal_layers(sections, three_edges, 2);
}

TEST(EqualLayers, OfSectionsWithoutFans) {
    CaseOptions options = equal_options();
    options.layer.corners = CornerRays::refine;
    expect_equal_layers({naca("0012"), naca("4415")}, options, 0);
}

}  // namespace
}  // namespace lamina::test
