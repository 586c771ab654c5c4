// A layer triangulated in pieces has the triangles of the layer in one piece, whatever the depth of the decomposition.
#include <initializer_list>

#include <gtest/gtest.h>

#include <lamina/geometry.hpp>
#include <lamina/layers.hpp>

#include "core/parallel.hpp"
#include "layers/cells/fill.hpp"
#include "layers/layer.hpp"
#include "support/layers.hpp"
#include "support/point_sets.hpp"
#include "support/shapes.hpp"

namespace lamina::test {
namespace {

using delaunay::pieces::PiecewiseTriangulation;

LayerOptions layers(std::uint32_t count) { return test::layers_of(1e-5, 1.1, count); }

Geometry naca(const std::string& digits, std::size_t points) {
    Geometry geometry;
    geometry.elements.push_back(naca_airfoil(digits, points));
    return geometry;
}

Element placed(Element element, double scale, double angle, Point at) {
    element.points = shapes::moved(element.points, angle, scale, at);
    return element;
}

/// Returns slat, main element and flap, with narrow slots between them.
Geometry three_element(std::size_t points) {
    Geometry geometry;
    geometry.elements.push_back(placed(naca_airfoil("4412", points), 0.18, -0.5, {-0.15, -0.09}));
    geometry.elements.push_back(placed(naca_airfoil("4415", points), 1.0, 0.0, {0, 0}));
    geometry.elements.push_back(placed(naca_airfoil("4412", points), 0.35, -0.55, {0.985, -0.045}));
    return geometry;
}

enum class Balance { demanded, not_demanded };

/// Where balance is demanded, nearly all cuts must be made at depth 6, and the largest piece may have at most twice the
/// mean number of vertices.
void expect_same_at_depths(const std::string& name, const Layer& layer, Balance balance,
                           std::initializer_list<unsigned> depths) {
    const LayerEdges edges = layer.edges;
    const auto expected =
        canonical(triangulate(layer.points, edges.region, {.keep = KeptRegion::left_of_segments}).triangles);
    for (const unsigned depth : depths) {
        const PiecewiseTriangulation t = layers::triangulate_layer(layer, {.depth = depth, .leaf_vertices = 10});
        ASSERT_EQ(canonical(t.triangles), expected) << name << ", depth " << depth;
        EXPECT_EQ(t.stats.fallbacks, 0u) << name << ", depth " << depth;
        EXPECT_GE(t.stats.pieces, (std::size_t{1} << depth) * 3 / 4) << name << ", depth " << depth;
        if (depth != 6 || balance == Balance::not_demanded) continue;
        EXPECT_GE(t.stats.pieces, 60u) << name;
        EXPECT_LE(t.stats.largest_piece * t.stats.pieces, 2 * t.stats.piece_vertices) << name;
    }
}

void expect_same_at_every_depth(const std::string& name, const Layer& layer, Balance balance) {
    expect_same_at_depths(name, layer, balance, {0, 1, 2, 3, 4, 5, 6, 7});
}

TEST(LayerDecomposition, Naca0012) {
    expect_same_at_every_depth("30 layers", test::make_layer(naca("0012", 2000), layers(30)), Balance::demanded);
    expect_same_at_every_depth("60 layers", test::make_layer(naca("0012", 2000), layers(60)), Balance::demanded);
}

TEST(LayerDecomposition, ManySurfacePoints) {
    expect_same_at_depths("NACA 0012", test::make_layer(naca("0012", 20'000), layers(30)), Balance::demanded,
                          {0, 3, 6, 7});
    expect_same_at_depths("three elements", test::make_layer(three_element(20'000 / 3), layers(30)), Balance::demanded,
                          {6});
}

TEST(LayerDecomposition, Cambered) {
    expect_same_at_every_depth("4415", test::make_layer(naca("4415", 1000), layers(40)), Balance::demanded);
}

TEST(LayerDecomposition, ThreeElements) {
    expect_same_at_every_depth("three", test::make_layer(three_element(1000), layers(40)), Balance::demanded);
}

TEST(LayerDecomposition, Shapes) {
    LayerOptions options = layers(20);
    options.first_height = 1e-4;
    using namespace shapes;
    expect_same_at_every_depth("box", test::make_layer(shapes::geometry({refined(box(), 40)}), options),
                               Balance::not_demanded);
    expect_same_at_every_depth("circle", test::make_layer(shapes::geometry({circle(1, 200)}), options),
                               Balance::not_demanded);
    expect_same_at_every_depth("l", test::make_layer(shapes::geometry({refined(l_shape(), 40)}), options),
                               Balance::not_demanded);
    expect_same_at_every_depth("c", test::make_layer(shapes::geometry({refined(c_shape(0.1), 40)}), options),
                               Balance::not_demanded);
    expect_same_at_every_depth("notch", test::make_layer(shapes::geometry({refined(v_notch(0.4), 40)}), options),
                               Balance::not_demanded);
    expect_same_at_every_depth("comb", test::make_layer(shapes::geometry({refined(comb(5, 0.1), 40)}), options),
                               Balance::not_demanded);
    expect_same_at_every_depth("joukowski", test::make_layer(shapes::geometry({joukowski(0.1, 0.05, 400)}), options),
                               Balance::not_demanded);
    expect_same_at_every_depth("plate", test::make_layer(shapes::geometry({refined(plate(0.02, 20), 4)}), options),
                               Balance::not_demanded);
}

TEST(LayerDecomposition, LayersTruncatedToNothing) {
    // Walls so close to each other that no layer fits between them: their vertices are no part of the layer.
    LayerOptions options = layers(20);
    options.first_height = 1e-2;
    using namespace shapes;
    expect_same_at_depths("comb", test::make_layer(shapes::geometry({refined(comb(24, 1e-3), 100)}), options),
                          Balance::not_demanded, {0, 1, 2, 3, 4, 5, 6});
}

}  // namespace
}  // namespace lamina::test
