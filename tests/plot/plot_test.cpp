// Pictures of meshes.
#include <cairo.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <memory>
#include <numeric>
#include <set>
#include <string>
#include <vector>

#include <lamina/error.hpp>
#include <lamina/option.hpp>
#include <lamina/plot.hpp>

#include "plot/color_scale.hpp"
#include "support/sample_meshes.hpp"
#include "support/temporary_folder.hpp"

namespace lamina {
namespace {

using test::annulus;
using test::box_with_hole;
using test::TemporaryFolder;

TEST(ColorScale, OfSizesIsThatOfSidesOfSquares) {
    Mesh mesh;
    mesh.points = {{0, 0}, {20, 0}, {20, 10}, {0, 10}, {0, 0.02}};
    mesh.triangles = {{{VertexId{0u}, VertexId{1u}, VertexId{2u}}}, {{VertexId{0u}, VertexId{1u}, VertexId{4u}}}};
    const plot::CellColors colors =
        plot::color_cells(mesh, plot::visible_cells(mesh, {{-1, -1}, {21, 11}}), PlotColor::size);
    EXPECT_NEAR(colors.low, 0.5 * std::log10(0.2), 1e-12);
    EXPECT_NEAR(colors.high, 1, 1e-12);
}

/// Returns the width and the height that the header of a PNG file gives.
std::pair<unsigned, unsigned> png_size(const std::string& png) {
    const auto number = [&](std::size_t at) {
        unsigned value = 0;
        for (std::size_t i = 0; i < 4; ++i) value = value << 8 | static_cast<unsigned char>(png[at + i]);
        return value;
    };
    return {number(16), number(20)};
}

TEST(Plot, WritesEveryFormatAndColor) {
    const TemporaryFolder folder;
    const Mesh mesh = annulus({.quads_in_layer = true});
    std::set<std::string> pictures;
    for (const PlotColor color :
         {PlotColor::none, PlotColor::quality, PlotColor::size, PlotColor::piece, PlotColor::layer}) {
        plot_mesh(mesh, folder / "m.png", {.color = color, .width_px = 300});
        pictures.insert(folder.read("m.png"));
        EXPECT_EQ(png_size(folder.read("m.png")), std::pair(300u, 300u));
        plot_mesh(box_with_hole(), folder / "plain.png", {.color = color, .width_px = 50});  // has no cell data
    }
    EXPECT_EQ(pictures.size(), 5u);
    plot_mesh(mesh, folder / "m.svg");
    EXPECT_EQ(folder.read("m.svg").substr(0, 5), "<?xml");
    plot_mesh(mesh, folder / "m.PDF");
    EXPECT_EQ(folder.read("m.PDF").substr(0, 5), "%PDF-");
}

TEST(Plot, DrawsFieldsInEveryFormat) {
    const TemporaryFolder folder;
    const Mesh mesh = annulus({.quads_in_layer = true});
    PlotField field{"x", {}, {}};
    for (const Point p : mesh.points) field.values.push_back(p.x);
    std::set<std::string> pictures;
    const auto picture = [&] {
        plot_field(mesh, field, folder / "m.png", {.width_px = 300, .color_bar = true});
        pictures.insert(folder.read("m.png"));
    };
    picture();
    field.line = 0.1;
    picture();
    field.values.assign(mesh.points.size(), 2);  // has no colours
    picture();
    EXPECT_EQ(pictures.size(), 3u);
    plot_field(mesh, field, folder / "m.svg", {.width_px = 300});
    EXPECT_NE(folder.read("m.svg").find("<image"), std::string::npos);
    plot_field(mesh, field, folder / "m.pdf", {.width_px = 300});
    field.values.pop_back();
    EXPECT_THROW(plot_field(mesh, field, folder / "m.png"), UsageError);
}

TEST(Plot, KeepsTheAspectOfTheWindow) {
    const TemporaryFolder folder;
    const Mesh mesh = annulus();
    plot_mesh(mesh, folder / "m.png", {.window = PlotWindow{{0, 2, 0, 0.5}}, .width_px = 400});
    EXPECT_EQ(png_size(folder.read("m.png")), std::pair(400u, 100u));
    plot_mesh(mesh, folder / "m.png", {.window = PlotWindow{{0, 0.5, 0, 2}}, .width_px = 400});
    EXPECT_EQ(png_size(folder.read("m.png")), std::pair(100u, 400u));
    // One window lies far inside a cell, the other far away from all.
    plot_mesh(mesh, folder / "m.png", {.window = PlotWindow{{1.1, 1.1 + 1e-12, 0.1, 0.1 + 1e-12}}, .width_px = 40});
    plot_mesh(mesh, folder / "m.png", {.window = PlotWindow{{1e6, 1e6 + 1, 0, 1}}, .width_px = 40});
    EXPECT_THROW(plot_mesh(mesh, folder / "m.png", {.window = PlotWindow{{1, 1, 0, 1}}}), UsageError);
    EXPECT_THROW(plot_mesh(mesh, folder / "m.png", {.window = PlotWindow{{0, NAN, 0, 1}}}), UsageError);
    EXPECT_THROW(plot_mesh(mesh, folder / "m.png", {.width_px = 0}), UsageError);
    EXPECT_NO_THROW(plot_mesh(Mesh{}, folder / "empty.png", {.width_px = 20}));
}

TEST(Plot, ShowsPlacesByName) {
    const TemporaryFolder folder;
    const Mesh mesh = annulus({.around = 48});
    const auto picture = [&](const std::string& place) {
        plot_mesh(mesh, folder / "m.png", {.window = PlotWindow{.place = place}, .width_px = 200});
        return folder.read("m.png");
    };
    EXPECT_EQ(picture("nose"), picture("nose:1"));
    EXPECT_NE(picture("nose"), picture("tail"));
    EXPECT_EQ(png_size(picture("walls")), std::pair(200u, 200u));
    EXPECT_THROW(picture("slot"), UsageError);
    EXPECT_THROW(picture("nose:2"), UsageError);
    // The table reads names and numbers, and writes what it reads.
    const Option<PlotOptions>& option = find_row(option_table<PlotOptions>(), "window");
    for (const std::string text : {"nose:2", "0,2,-0.5,0.5"}) {
        PlotOptions options;
        option.set(options, text);
        EXPECT_EQ(std::get<std::string>(*option.get(options)), text);
    }
    PlotOptions options;
    for (const std::string text : {"0,1,2", "1,0,0,1", "Nose", ""}) EXPECT_THROW(option.set(options, text), UsageError);
}

TEST(Plot, AxesAndBarsLeaveTheLongerSideAsAsked) {
    const TemporaryFolder folder;
    const Mesh mesh = annulus({.around = 48});
    std::set<std::string> pictures;
    for (const int bits : {0, 1, 2, 4, 7}) {
        for (const bool upright : {false, true}) {
            const PlotWindow window{.box = {1, upright ? 1.5 : 2, 0, upright ? 1.0 : 0.5}};
            plot_mesh(mesh, folder / "m.png",
                      {.color = PlotColor::size,
                       .window = window,
                       .width_px = 400,
                       .axes = (bits & 1) != 0,
                       .scale_bar = (bits & 2) != 0,
                       .color_bar = (bits & 4) != 0});
            pictures.insert(folder.read("m.png"));
            const auto [width, height] = png_size(folder.read("m.png"));
            EXPECT_EQ(upright ? height : width, 400u);
        }
    }
    EXPECT_EQ(pictures.size(), 10u);
    // Windows far from the origin, and far too small for their numbers, have axes, too.
    for (const double size : {1e-12, 1e-3, 1e6})
        EXPECT_NO_THROW(plot_mesh(mesh, folder / "m.png",
                                  {.window = PlotWindow{.box = {1, 1 + size, 1e3, 1e3 + size}},
                                   .width_px = 60,
                                   .axes = true,
                                   .scale_bar = true}));
}

TEST(Plot, ManyCellsBelowAPixelTakeLittleRoom) {
    const TemporaryFolder folder;
    const Mesh mesh = box_with_hole(121);
    const auto size = [&](const std::string& name, int width) {
        plot_mesh(mesh, folder / name, {.width_px = width});
        return folder.read(name).size();
    };
    // 29,000 triangles: as paths of an SVG they take more than 100 bytes each.
    EXPECT_GT(size("l.svg", 2000), 100 * mesh.triangles.size());
    EXPECT_LT(size("m.svg", 100), 4 * mesh.triangles.size());
    const std::size_t large_pdf = size("l.pdf", 2000);
    EXPECT_LT(size("m.pdf", 100), large_pdf / 4);
    // Images have a largest size, pictures have not.
    const Mesh graded = annulus({.around = 400, .rings = 40});
    EXPECT_NO_THROW(plot_mesh(graded, folder / "m.svg", {.width_px = 3000}));
    EXPECT_GT(folder.read("m.svg").size(), 100'000u);
    EXPECT_NE(folder.read("m.svg").find("<path"), std::string::npos);  // the large ones and the walls
}

TEST(Plot, DrawsOutlinesWithoutCells) {
    const TemporaryFolder folder;
    Mesh mesh = annulus({.around = 48});
    mesh.triangles.clear();
    plot_mesh(mesh, folder / "m.svg", {.axes = true});
    EXPECT_NE(folder.read("m.svg").find("<path"), std::string::npos);
}

TEST(Chart, WritesEveryFormat) {
    const TemporaryFolder folder;
    const std::vector<ChartCurve> curves{{"one", {{0, 1}, {0.5, -3}, {1, 0.25}}}, {"two", {{0.2, 0}, {0.9, -50}}}};
    plot_chart(curves, folder / "c.png", {.x_label = "x", .y_label = "y", .width_px = 300});
    EXPECT_EQ(png_size(folder.read("c.png")), std::pair(300u, 200u));
    plot_chart(curves, folder / "d.png", {.y_downwards = true, .y_range = {{-4, 1}}, .width_px = 300});
    EXPECT_NE(folder.read("c.png"), folder.read("d.png"));
    plot_chart(curves, folder / "c.svg");
    EXPECT_EQ(folder.read("c.svg").substr(0, 5), "<?xml");
    plot_chart(curves, folder / "c.any", {.format = "pdf"});
    EXPECT_EQ(folder.read("c.any").substr(0, 5), "%PDF-");
    EXPECT_THROW(plot_chart(curves, folder / "c.gif"), UsageError);
}

TEST(Chart, OnePointAndLevelCurvesHaveAxes) {
    const TemporaryFolder folder;
    for (const double value : {0.0, 1.0, -3e-12, 1e9}) {
        const std::vector<ChartCurve> curves{{"level", {{0, value}, {1, value}}}, {"point", {{0.5, value}}}};
        EXPECT_NO_THROW(plot_chart(curves, folder / "c.png", {.width_px = 100}));
    }
}

/// Returns rows of cells over a wall along the x axis from 0 to 1, each row a quarter higher than the one below.
Mesh rows_over_wall(bool quads) {
    constexpr std::uint32_t columns = 40, rows = 45;
    Mesh mesh;
    double y = 0, height = 1e-5;
    for (std::uint32_t row = 0; row <= rows; ++row, y += height, height *= 1.25)
        for (std::uint32_t i = 0; i <= columns; ++i) mesh.points.push_back({i / double(columns), y});
    const auto at = [](std::uint32_t row, std::uint32_t i) { return VertexId(row * (columns + 1) + i); };
    Marker wall{"wall", MarkerKind::wall, {}};
    for (std::uint32_t i = 0; i < columns; ++i) wall.edges.push_back({at(0, i), at(0, i + 1)});
    for (std::uint32_t row = 0; row < rows; ++row)
        for (std::uint32_t i = 0; i < columns; ++i) {
            const VertexId a = at(row, i), b = at(row, i + 1), c = at(row + 1, i + 1), d = at(row + 1, i);
            if (quads) {
                mesh.quads.push_back({{a, b, c, d}});
            } else {
                mesh.triangles.push_back({{a, b, c}});
                mesh.triangles.push_back({{a, c, d}});
            }
        }
    mesh.markers = {wall};
    return mesh;
}

/// Returns the mean brightness of each row of pixels of a picture, from 0 to 255, from its bottom up.
std::vector<double> brightness_of_rows(const std::filesystem::path& png) {
    const std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)> image{
        cairo_image_surface_create_from_png(png.c_str()), cairo_surface_destroy};
    const int width = cairo_image_surface_get_width(image.get()), height = cairo_image_surface_get_height(image.get());
    std::vector<double> rows;
    for (int y = height - 1; y >= 0; --y) {
        const unsigned char* row =
            cairo_image_surface_get_data(image.get()) + y * cairo_image_surface_get_stride(image.get());
        double sum = 0;
        for (int x = 0; x < width; ++x) sum += row[4 * x] + row[4 * x + 1] + row[4 * x + 2];
        rows.push_back(sum / (3.0 * width));
    }
    return rows;
}

TEST(Plot, CurvedCellsFollowTheirNodes) {
    const TemporaryFolder folder;
    // A square whose lower edge is an arc down to y = -0.5 reaches the lowest rows of this window, as it does not
    // without it.
    const Mesh mesh{.points = {{0, 0}, {1, 0}, {1, 1}, {0, 1}},
                    .quads = {{{VertexId{0u}, VertexId{1u}, VertexId{2u}, VertexId{3u}}}},
                    .markers = {{"wall", MarkerKind::wall, {{VertexId{0u}, VertexId{1u}}}}}};
    CurvedNodes nodes{.order = 2, .points = {{0.5, -0.5}, {1, 0.5}, {0.5, 1}, {0, 0.5}, {0.5, 0.25}}};
    for (std::uint32_t v = 4; v < 9; ++v) nodes.quad_nodes.push_back(VertexId{v});
    nodes.marker_nodes = {VertexId{4u}};
    const PlotOptions below{.window = PlotWindow{{0.45, 0.55, -0.55, -0.05}}, .width_px = 200};
    plot_mesh(mesh, folder / "straight.png", below);
    plot_mesh(mesh, nodes, folder / "curved.png", below);
    const std::vector<double> empty = brightness_of_rows(folder / "straight.png");
    const std::vector<double> filled = brightness_of_rows(folder / "curved.png");
    EXPECT_EQ(filled[5], empty[5]);      // y = -0.54, below the arc
    EXPECT_LT(filled[20], empty[20]);    // y = -0.5, the wall
    EXPECT_GT(filled[100], empty[100]);  // y = -0.3, within the white cell
    EXPECT_THROW(plot_mesh(mesh, nodes, folder / "curved.png", {.repeat = 2}), UsageError);
}

// Where edges merge into grey, it must be as dark as they are: it was paler by 22 of 255, and walls seemed to have a
// gap.
TEST(Plot, NoPaleStripLiesBesideAWall) {
    constexpr int width = 2000, wall_and_blending = 4, strip = 6;
    const TemporaryFolder folder;
    for (const bool quads : {true, false}) {
        plot_mesh(rows_over_wall(quads), folder / "wall.png",
                  {.window = PlotWindow{.box = {0.2, 0.8, 0, 0.2}}, .width_px = width});
        const std::vector<double> rows = brightness_of_rows(folder / "wall.png");
        const auto mean = [&](int from) {
            return std::accumulate(rows.begin() + from, rows.begin() + from + strip, 0.0) / strip;
        };
        const double beside = mean(wall_and_blending);
        for (int from = wall_and_blending; from < 60; ++from)
            EXPECT_LT(beside, mean(from) + 12) << quads << " " << from;
        EXPECT_LT(beside, 170) << quads;
        EXPECT_GT(mean(200), 200) << quads;
    }
}

TEST(Plot, RefusesFilesItCannotWrite) {
    const TemporaryFolder folder;
    const Mesh mesh = annulus();
    EXPECT_THROW(plot_mesh(mesh, folder / "none/m.png"), IoError);
    EXPECT_THROW(plot_mesh(mesh, folder / "m.gif"), UsageError);
    EXPECT_TRUE(folder.names().empty());
}

}  // namespace
}  // namespace lamina
