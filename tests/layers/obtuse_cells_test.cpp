// Columns end below cells with large angles.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <string>
#include <vector>

#include <lamina/layers.hpp>

#include "cell_angles.hpp"
#include "core/angles.hpp"
#include "layers/layer.hpp"
#include "layers/stages.hpp"
#include "support/layers.hpp"
#include "support/shapes.hpp"

namespace lamina {
namespace {

using shapes::Outline;

constexpr double max_angle_deg = 150;

/// Outlines in whose corners thick layers have cells with angles above 150 degrees.
std::map<std::string, Outline> awkward_outlines() {
    std::mt19937 random(5);
    return {{"V", shapes::refined(shapes::v_notch(0.6), 20)},
            {"steep V", shapes::refined(shapes::v_notch(0.3), 40)},
            {"C", shapes::refined(shapes::c_shape(0.3), 10)},
            {"comb", shapes::refined(shapes::comb(3, 0.2), 20)},
            {"star", shapes::refined(shapes::star(18, 0.4, random), 15)}};
}

LayerOptions thick_layers(std::uint32_t layers) { return test::layers_of(1e-3, 1.2, layers); }

TEST(ObtuseCells, AreThoseWithALargeAngle) {
    std::size_t found_in_all = 0;
    for (const auto& [name, outline] : awkward_outlines())
        for (const LayerTopology topology : {LayerTopology::layered, LayerTopology::quads}) {
            SCOPED_TRACE(name);
            const Layer layer = test::make_layer(shapes::geometry({outline}), thick_layers(30));
            const LayerCells cells = fill_layer(layer, topology);
            const std::vector<ObtuseCell> found = obtuse_cells(layer, cells, max_angle_deg);
            // One ray in each corner of two walls that meet at 60 degrees or less.
            const auto is_excused = [&](std::uint32_t column) {
                const std::vector<Ray>& rays = layer.rays[0];
                const std::size_t n = rays.size(), next = (column + 1) % n;
                const auto is_in_corner = [&](std::size_t i) {
                    const auto off = [&](std::size_t other) {
                        const Point edge =
                            layer.points[rays[other].origin.index()] - layer.points[rays[i].origin.index()];
                        return edge == Point{} ? 180
                                               : core::degrees(std::abs(core::angle_between(edge, rays[i].direction)));
                    };
                    return std::max(off((i + 1) % n), off((i + n - 1) % n)) < 180 - max_angle_deg;
                };
                return is_in_corner(column) || is_in_corner(next);
            };
            std::vector<std::pair<std::uint32_t, std::uint16_t>> expected, actual;
            for (std::size_t i = 0; i < cells.triangles.size(); ++i)
                if (test::largest_angle_deg(layer, cells.triangles[i].v) > max_angle_deg &&
                    !is_excused(cells.triangle_column[i]))
                    expected.emplace_back(cells.triangle_column[i], cells.triangle_layer[i]);
            for (std::size_t i = 0; i < cells.quads.size(); ++i)
                if (test::largest_angle_deg(layer, cells.quads[i].v) > max_angle_deg &&
                    !is_excused(cells.quad_column[i]))
                    expected.emplace_back(cells.quad_column[i], cells.quad_layer[i]);
            for (const ObtuseCell& cell : found) actual.emplace_back(cell.column, cell.layer);
            EXPECT_EQ(actual, expected);
            found_in_all += found.size();
        }
    EXPECT_GT(found_in_all, 10u);
}

TEST(ObtuseCells, ColumnsEndBelowThem) {
    for (const auto& [name, outline] : awkward_outlines())
        for (const std::uint32_t layers : {15u, 30u}) {
            SCOPED_TRACE(name);
            const LayerOptions options = thick_layers(layers);
            const Geometry geometry = shapes::geometry({outline});
            Rays rays = grow_rays(geometry, options, test::growth_of(options));
            const std::vector<std::uint32_t> counts = rays.counts;
            const std::vector<double> limits = rays.limits;
            const LayerHeights heights = rays.heights;
            const Layer before = close_border(rays);
            const std::vector<ObtuseCell> obtuse =
                obtuse_cells(before, fill_layer(before, LayerTopology::layered), max_angle_deg);
            std::vector<ObtuseCell> above;
            std::copy_if(obtuse.begin(), obtuse.end(), std::back_inserter(above),
                         [](const ObtuseCell& cell) { return cell.layer > 1; });
            ASSERT_EQ(end_columns_below(obtuse, rays), !above.empty());
            const std::vector<std::size_t> next = rays.set.following();
            for (const ObtuseCell& cell : above)
                for (const std::size_t ray : {std::size_t{cell.column}, next[cell.column]}) {
                    if (counts[ray] < cell.layer) continue;
                    const double end = rays.heights.of(ray)[rays.counts[ray]];
                    EXPECT_LE(end, heights.of(ray)[cell.layer - 1u] * (1 + 1e-12)) << "it ends below the cell";
                }
            for (std::size_t i = 0; i < counts.size(); ++i) {
                EXPECT_LE(rays.limits[i], limits[i]);
                EXPECT_EQ(rays.counts[i] > 0, counts[i] > 0) << "first layers stay";
            }
            for (const std::string& finding : check_layer(close_border(rays), options)) ADD_FAILURE() << finding;
        }
}

TEST(ObtuseCells, NothingChangesWithoutThem) {
    Rays rays =
        grow_rays(shapes::geometry({shapes::circle(1, 100)}), thick_layers(20), test::growth_of(thick_layers(20)));
    const std::vector<double> limits = rays.limits;
    EXPECT_FALSE(end_columns_below({}, rays));
    EXPECT_FALSE(end_columns_below(std::vector<ObtuseCell>{{3, 1}}, rays));
    EXPECT_EQ(rays.limits, limits);
}

}  // namespace
}  // namespace lamina
