// A forecast says what the mesh has that is then made.
#include <algorithm>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <lamina/forecast.hpp>

#include "pipeline/cases.hpp"

namespace lamina::test {
namespace {

/// Returns the height of the highest column by its cells.
double height_of_cells(const MeshResult& result) {
    const Mesh& mesh = result.mesh;
    double height = 0;
    const auto measure = [&](std::size_t cell, const auto& vertices) {
        const Point origin = mesh.points[result.column_origins[result.columns[cell]].index()];
        for (const VertexId v : vertices) height = std::max(height, distance(origin, mesh.points[v.index()]));
    };
    for (std::size_t i = 0; i + mesh.quads.size() < result.columns.size(); ++i) measure(i, mesh.triangles[i].v);
    for (std::size_t i = 0; i < mesh.quads.size(); ++i)
        measure(result.columns.size() - mesh.quads.size() + i, mesh.quads[i].v);
    return height;
}

void expect_as_made(const Geometry& geometry, const CaseOptions& options, const std::string& name) {
    SCOPED_TRACE(name);
    const MeshForecast forecast = forecast_mesh(geometry, options);
    EXPECT_TRUE(forecast.result.mesh.points.empty());
    const MeshResult made = generate_mesh(geometry, options);
    const auto in_layer = static_cast<double>(made.check.layer.cells), beyond = double(made.check.isotropic.cells);
    EXPECT_NEAR(forecast.layer_cells, in_layer, 0.02 * in_layer);
    EXPECT_NEAR(forecast.cells_beyond, beyond, 0.1 * beyond);
    const auto vertices = static_cast<double>(made.mesh.points.size());
    EXPECT_NEAR(forecast.vertices, vertices, 0.1 * vertices);
    EXPECT_EQ(forecast.result.first_heights, made.first_heights);
    if (options.layer.wake_layers) return;  // which are higher than those on walls
    double thickness = 0;
    for (const WallForecast& wall : forecast.walls) thickness = std::max(thickness, wall.thickness);
    EXPECT_NEAR(thickness, height_of_cells(made), 0.05 * thickness);
}

TEST(Forecast, SaysWhatTheMeshHas) {
    for (const LayerTopology topology : {LayerTopology::layered, LayerTopology::quads}) {
        CaseOptions options;
        options.far_field.size = 10;
        options.conditions = {.alpha_deg = 4, .reynolds = 1e6};
        options.layer.first_height = YPlus{1};
        options.layer.topology = topology;
        options.use_flow = true;
        const Geometry two_bodies =
            shapes::geometry({naca("2412", 80), shapes::moved(naca("0012", 60), -0.4, 0.3, {0.98, -0.03})});
        expect_as_made(shapes::geometry({naca("4412")}), options, "one section");
        expect_as_made(two_bodies, options, "two bodies");
        options.layer.wake_layers = true;
        expect_as_made(two_bodies, options, "two bodies with wake layers");
    }
}

TEST(Forecast, YPlusIsLargestAsAskedFor) {
    CaseOptions options;
    options.conditions = {.reynolds = 6e6};
    options.layer.first_height = YPlus{2};
    const Geometry geometry = shapes::geometry({naca("0012")});
    const YPlusRange on_plate = forecast_mesh(geometry, options).walls[0].y_plus.value();
    EXPECT_NEAR(on_plate.smallest, 2, 1e-9);
    EXPECT_NEAR(on_plate.largest, 2, 1e-9);
    options.use_flow = true;
    const YPlusRange by_flow = forecast_mesh(geometry, options).walls[0].y_plus.value();
    EXPECT_NEAR(by_flow.largest, 2, 1e-9);
    EXPECT_LE(by_flow.smallest, by_flow.median);
    EXPECT_LT(by_flow.median, by_flow.largest);
}

TEST(Forecast, FindsTheScaleOfABudget) {
    CaseOptions options = quick_options();
    options.surface.treatment = SurfaceTreatment::resample;
    options.vertices = 20'000;
    const MeshForecast forecast = forecast_mesh(shapes::geometry({naca("0012")}), options);
    EXPECT_NE(forecast.result.scale, 1);
    EXPECT_NEAR(forecast.vertices, 20'000, 0.03 * 20'000);
}

}  // namespace
}  // namespace lamina::test
