// The order in which pages store meshes, and the steps of their coordinates.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include <lamina/page.hpp>

#include "page/growth.hpp"
#include "page/packed_mesh.hpp"
#include "page/steps.hpp"
#include "page/traversal.hpp"
#include "support/sample_meshes.hpp"

namespace lamina {
namespace {

using test::annulus;
using test::shuffled;

std::vector<Mesh> sample_meshes() {
    std::vector<Mesh> meshes{annulus(), annulus({.quads_in_layer = true}), test::box_with_hole(9), test::tiny(),
                             annulus({.around = 3, .rings = 1, .layer_rings = 1})};
    for (unsigned seed = 0; seed < 5; ++seed) meshes.push_back(shuffled(annulus({.quads_in_layer = true}), seed));
    return meshes;
}

TEST(Page, TraversalVisitsEachCellAndVertexOnce) {
    for (const Mesh& mesh : sample_meshes()) {
        page::Traversal order = page::traverse(mesh);
        for (std::size_t i = 0; i < order.vertex.size(); ++i) EXPECT_EQ(order.new_number[order.vertex[i]], i);
        // A parent comes before its children, and a vertex is predicted from those before it.
        for (std::size_t i = 0; i < order.parent.size(); ++i)
            EXPECT_TRUE(order.parent[i] < i || order.parent[i] == page::no_vertex);
        for (std::size_t i = 1; i < order.prediction.size(); ++i)
            for (const std::uint32_t v : order.prediction[i]) EXPECT_LT(v, i);
        const auto expect_all = [](std::vector<std::uint32_t> numbers, std::size_t count) {
            std::sort(numbers.begin(), numbers.end());
            ASSERT_EQ(numbers.size(), count);
            for (std::size_t i = 0; i < count; ++i) EXPECT_EQ(numbers[i], i);
        };
        expect_all(order.cell, mesh.triangles.size() + mesh.quads.size());
        expect_all(order.vertex, mesh.points.size());
        // Nearly every vertex is found without its number being stored.
        EXPECT_LE(order.references.size(), 8 + order.cell.size() / 8);
    }
}

TEST(Page, StepsAreFineWhereCellsAreThin) {
    Mesh mesh;
    mesh.points = {{0, 0}, {1, 0}, {1, 1e-7}, {0, 1e-7}, {0, 1}, {1, 1}, {100, 100}};
    const auto quad = [](std::size_t a, std::size_t b, std::size_t c, std::size_t d) {
        return Quad{{VertexId(a), VertexId(b), VertexId(c), VertexId(d)}};
    };
    mesh.quads = {quad(0, 1, 2, 3), quad(3, 2, 5, 4)};
    const std::vector<std::int16_t> exponents = page::step_exponents(mesh);
    for (const std::size_t v : {0, 1, 2, 3}) EXPECT_LE(std::ldexp(1, exponents[v]), std::ldexp(1e-7, -16)) << v;
    for (const std::size_t v : {4, 5}) EXPECT_NEAR(std::ldexp(1, exponents[v]), std::ldexp(0.75, -16), 1e-5) << v;
    // No step is so fine that doubles would not hold the number of steps.
    for (const std::int16_t exponent : exponents) EXPECT_LE(page::steps_in(100, exponent), std::ldexp(1, 50));
    EXPECT_EQ(page::steps_in(-2.5, 0), -2);
    EXPECT_EQ(page::steps_in(2.5, 0), 3);
    EXPECT_EQ(page::steps_in(0.3, -2), 1);
}

TEST(Page, GrowthOfRingsIsThatOfTheirHeights) {
    // Radii grow by 1.2 from ring to ring, and so do heights.
    for (const bool quads : {false, true}) {
        const Mesh mesh = annulus({.around = 200, .rings = 8, .layer_rings = 8, .quads_in_layer = quads});
        const std::vector<std::uint32_t> histogram = page::growth_histogram(mesh);
        ASSERT_EQ(histogram.size(), page::growth_bins);
        EXPECT_EQ(std::accumulate(histogram.begin(), histogram.end(), 0u), 200u * 7);
        const auto bin = static_cast<std::size_t>((1.2 - page::least_growth) / page::growth_step + 1e-9);
        // Of quadrilaterals the area counts, which grows with the radius as well.
        const std::uint32_t near = histogram[bin - 1] + histogram[bin] + histogram[bin + 1];
        if (!quads) {
            EXPECT_EQ(near, 200u * 7);
        }
    }
    EXPECT_TRUE(page::growth_histogram(test::box_with_hole()).empty());
}

TEST(Page, DoesNotDependOnTheOrderOfBytesOrRuns) {
    const Mesh mesh = annulus({.around = 60, .rings = 30});
    EXPECT_EQ(page::pack_mesh(mesh), page::pack_mesh(mesh));
    EXPECT_LT(mesh_page(mesh, {"t"}).size(), 150'000 + 12 * mesh.triangles.size());
    EXPECT_NO_THROW(mesh_page(Mesh{}, {"empty"}));
}

}  // namespace
}  // namespace lamina
