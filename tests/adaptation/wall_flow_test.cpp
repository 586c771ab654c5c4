// What solutions say about the flow along walls: friction, boundary layers, and spacings, against flows given by
// formulas.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <vector>

#include <lamina/error.hpp>

#include "adaptation/fields.hpp"
#include "adaptation/wall_flow.hpp"
#include "adaptation/wall_sizes.hpp"
#include "core/segments.hpp"

namespace lamina::test {
namespace {

/// Length over which the flow below reaches 63 % of its speed: friction is 1 over it.
constexpr double scale = 0.002;

/// Flow along the nearest wall, towards larger x, of the speed 3 (1 - exp(-n / scale)).
class LayerFlow {
public:
    explicit LayerFlow(const Geometry& geometry) : geometry_(geometry) {}

    Point operator()(Point p) const {
        Point foot{}, along{1, 0};
        double away = HUGE_VAL;
        for (const Element& element : geometry_.elements)
            for (std::size_t i = 0; i < element.points.size(); ++i) {
                const Point a = element.points[i], b = element.points[(i + 1) % element.points.size()];
                const Point at = a + core::share_along(p, a, b) * (b - a);
                if (!(distance(p, at) < away)) continue;
                away = distance(p, at);
                foot = at;
                along = unit(b - a);
            }
        return 3 * (1 - std::exp(-away / scale)) * (along.x < 0 ? -along : along);
    }

private:
    const Geometry& geometry_;
};

/// Returns the mesh with the flow in the fields "U:x" and "U:y", after `first`.
Solution solution_with(const MeshResult& made, bool at_cells, std::vector<SolutionField> first = {}) {
    const LayerFlow flow(made.geometry);
    Solution solution{made.mesh, std::move(first)};
    for (const auto& [name, part] : {std::pair{"U:x", &Point::x}, std::pair{"U:y", &Point::y}}) {
        SolutionField field = field_of(
            made.mesh, [&, part = part](Point p) { return flow(p).*part; }, at_cells);
        field.name = name;
        solution.fields.push_back(std::move(field));
    }
    return solution;
}

MeshResult layered_mesh() { return generate_mesh(one_section(), near_options()); }

TEST(WallFlow, FrictionAndThicknessAreThoseOfTheFlow) {
    const MeshResult made = layered_mesh();
    constexpr double viscosity = 1e-6;
    for (const bool at_cells : {false, true}) {
        SCOPED_TRACE(at_cells);
        const auto walls = adaptation::find_wall_flow(solution_with(made, at_cells), {"U", viscosity});
        ASSERT_EQ(walls.size(), 1u);
        ASSERT_EQ(walls[0].size(), made.surface_vertices);
        for (const adaptation::WallFlowEdge& edge : walls[0]) {
            // Walls run counter-clockwise, against the flow above. The tip has a fan, and the stagnation point a jump.
            if (edge.at.x < 0.01 || edge.at.x > 0.98) continue;
            EXPECT_NEAR(edge.friction, (edge.at.y > 0 ? -1 : 1) / scale, 0.04 / scale) << edge.at.x;
            EXPECT_NEAR(edge.wall_unit, std::sqrt(viscosity * scale), 0.02 * std::sqrt(viscosity * scale));
            // n exp(-n) = 0.02 (1 - exp(-n)) has the solution 5.66. Where the wall bends, such a flow has vorticity
            // everywhere.
            if (edge.at.x > 0.3) {
                EXPECT_NEAR(edge.thickness, 5.66 * scale, 0.2 * 5.66 * scale) << edge.at.x;
            }
            EXPECT_NEAR(edge.layers, 20, 1);
        }
    }
}

TEST(WallFlow, FlowThatRunsBackEndsNoBoundaryLayer) {
    const MeshResult made = layered_mesh();
    Solution solution = solution_with(made, false);
    // Near the wall the flow runs back, up to half of the length.
    const std::vector<double> away = wall_distances(made.mesh);
    for (std::size_t v = 0; v < away.size(); ++v)
        for (SolutionField& field : solution.fields) field.values[v] *= std::tanh(away[v] / scale - 0.5);
    const auto walls = adaptation::find_wall_flow(solution, {"U", 1e-6});
    for (const adaptation::WallFlowEdge& edge : walls[0]) {
        if (edge.at.x <= 0.3 || edge.at.x >= 0.9) continue;
        EXPECT_NEAR(edge.thickness, 5.8 * scale, 1.2 * scale) << edge.at.x;
    }
}

/// In a lifting flow on a coarse mesh the end of the layer was missed above one edge, whose layers then reached 0.06
/// chords into the flow: 2.8 % of the drag of NACA 0012 at 10 degrees.
TEST(WallFlow, AnEdgeWithoutAnEndFollowsThoseBesideIt) {
    const MeshResult made = layered_mesh();
    const auto walls_before = adaptation::find_wall_flow(solution_with(made, true), {"U", 1e-6});
    const adaptation::WallFlow& before = walls_before[0];
    std::size_t disturbed = 0;
    while (before[disturbed].at.x > 0.5) ++disturbed;
    Solution solution = solution_with(made, true);
    // The speed goes on to grow beyond the layer, above this edge alone.
    for (std::size_t cell = 0; cell < made.mesh.triangles.size() + made.mesh.quads.size(); ++cell) {
        const Point from = cell_middle(made.mesh, cell) - before[disturbed].at;
        if (from.y * before[disturbed].at.y < 0 || std::abs(from.x) > 0.6 * before[disturbed].length) continue;
        for (SolutionField& field : solution.fields)
            field.values[cell] *= 1 + 0.5 * std::tanh(std::abs(from.y) / (20 * scale));
    }
    const auto walls = adaptation::find_wall_flow(solution, {"U", 1e-6});
    for (std::size_t i = disturbed - 6; i < disturbed + 7; ++i)
        EXPECT_NEAR(walls[0][i].thickness, before[i].thickness, 0.3 * before[i].thickness) << walls[0][i].at.x;
}

TEST(WallFlow, RefusesWhatSaysNothingAboutWalls) {
    const MeshResult made = layered_mesh();
    const Solution solution = solution_with(made, false);
    EXPECT_THROW(adaptation::find_wall_flow(solution, {"V", 1e-6}), OptionError);
    Solution far = solution;
    std::erase_if(far.mesh.markers, [](const Marker& marker) { return marker.kind == MarkerKind::far_field; });
    EXPECT_THROW(adaptation::find_wall_flow(far, {"U", 1e-6}), OptionError);
}

/// A shock beside a wall, where its field is 0, asks for the spacings of one with the same error at all heights.
TEST(WallFlow, FieldsAboveTheWallCount) {
    const MeshResult made = layered_mesh();
    constexpr double p = 2, thickness = 0.01;
    const adaptation::ErrorNorm norm(p);
    const auto step = [](Point at) { return std::tanh((at.x - 0.5) / 0.02); };
    const std::vector<double> away = wall_distances(made.mesh);
    SolutionField even = field_of(made.mesh, step), fading = even;
    for (std::size_t v = 0; v < away.size(); ++v) fading.values[v] *= std::min(away[v] / thickness, 1.0);
    const Solution solution = solution_with(made, false, {even, fading});
    const auto walls = adaptation::find_wall_flow(solution, {"U", 1e-6});
    const std::vector<double> of_even{1, 0}, of_fading{0, 1};
    const auto by_even = adaptation::wall_curvatures(solution, walls, of_even, norm),
               by_fading = adaptation::wall_curvatures(solution, walls, of_fading, norm);
    std::size_t compared = 0;
    for (std::size_t i = 0; i < walls[0].size(); ++i) {
        const adaptation::WallFlowEdge& edge = walls[0][i];
        if (std::abs(edge.at.x - 0.5) > 0.02) continue;
        // The integral of (n / thickness)^p over the column, by hand.
        const double ramp = std::min(edge.layer_height / thickness, 1.0), height = edge.layer_height / thickness;
        const double share = std::sqrt((ramp * ramp * ramp / 3 + height - ramp) / height);
        EXPECT_NEAR(by_fading[0][i], share * by_even[0][i], 0.1 * by_even[0][i]) << edge.at.x;
        ++compared;
    }
    EXPECT_GE(compared, 4u);
}

/// The next mesh has the y+ asked for, layers as thick as the boundary layer, and wall edges that are short where the
/// pressure bends.
TEST(WallFlow, TheNextMeshFollows) {
    const MeshResult made = layered_mesh();
    const auto bump = [](Point p) { return std::exp(-std::pow((p.x - 0.5) / 0.05, 2)); };
    const SolutionField pressure = field_of(made.mesh, bump);
    SolutionSizeOptions size_options;
    size_options.vertices = 25'000;
    size_options.walls = WallFlowOptions{"U", 1e-7};
    size_options.keep_borders = false;
    CaseOptions options = near_options();
    options.layer.layers.reset();
    options.layer.first_height = YPlus{2};
    options.conditions.reynolds = 1e7;
    const auto meshed = [&](const SizedMesh& sizes) {
        CaseOptions next = options;
        next.sizing.background = std::make_shared<const SizedMesh>(sizes);
        return generate_mesh(one_section(), next);
    };
    const SolutionSizes sizes =
        solution_sizes(solution_with(made, false, {pressure}), size_options,
                       [&](const SizedMesh& sized) { return meshed(sized).mesh.points.size(); });
    const MeshResult next = meshed(sizes.sizes);
    EXPECT_EQ(check_mesh(next.mesh).defect_count, 0u);
    EXPECT_EQ(next.check.walls.share_of_kept_heights, 1);
    const double wanted = 2 * std::sqrt(1e-7 * scale);
    const WallVertices walls = wall_vertices(next.mesh);
    double in_bump = 0, beside = 0;
    for (std::size_t i = 0; i + 1 < walls.vertex.size(); ++i) {
        const Point at = next.mesh.points[walls.vertex[i].index()];
        const double edge = walls.arc_length[i + 1] - walls.arc_length[i];
        if (at.x > 0.1 && at.x < 0.9) {
            EXPECT_NEAR(walls.first_height[i], wanted, 0.05 * wanted) << at.x;
        }
        if (std::abs(at.x - 0.5) < 0.05) in_bump = std::max(in_bump, edge);
        if (at.x > 0.75 && at.x < 0.85) beside = std::max(beside, edge);
    }
    EXPECT_LT(2 * in_bump, beside);
    EXPECT_GT(next.layer_coverage[0].all.made_cells, 0.99 * double(next.layer_coverage[0].all.requested_cells));
}

TEST(WallFlow, WallsWithoutLayersKeepTheirSpacings) {
    CaseOptions options = near_options();
    options.layer.enabled = false;
    const MeshResult made = generate_mesh(one_section(), options);
    const SolutionField pressure = field_of(made.mesh, [](Point p) { return p.x * p.x - p.y * p.y; });
    SolutionSizeOptions size_options;
    size_options.vertices = 2 * static_cast<double>(made.mesh.points.size());
    size_options.walls = WallFlowOptions{"U", 1e-6};
    const SolutionSizes sizes = solution_sizes(solution_with(made, false, {pressure}), size_options);
    ASSERT_EQ(sizes.sizes.walls.size(), 1u);
    const auto walls = adaptation::find_wall_flow(solution_with(made, false), {"U", 1e-6});
    for (std::size_t i = 0; i < walls[0].size(); ++i) EXPECT_EQ(sizes.sizes.walls[0].spacings[i], walls[0][i].length);
}

/// The walls of a solution above no-slip ground are two, and the body takes its own alone.
TEST(WallFlow, TheGroundAsksNothingOfTheBody) {
    CaseOptions options = near_options();
    options.far_field.ground = 0.4;
    options.far_field.ground_wall = OuterWallKind::no_slip;
    options.layer.layers.reset();
    options.layer.first_height = YPlus{1};
    options.conditions.reynolds = 1e6;
    options.sizing.background = [&] {
        SizedMesh sizes;
        const std::vector<Point> outline = one_section().elements[0].points;
        SizedWall body{outline, {}, {}, {}}, ground{{{-5, -0.46}, {-3, -0.46}, {5, -0.46}}, {}, {}, {}};
        for (auto& [wall, unit] : {std::pair<SizedWall*, double>{&body, 2e-5}, {&ground, 1e-7}}) {
            wall->spacings.assign(wall->points.size(), 0.02);
            wall->units.assign(wall->points.size(), unit);
            wall->thicknesses.assign(wall->points.size(), 0.01);
            sizes.walls.push_back(*wall);
        }
        sizes.points = {{-9, -9}, {9, -9}, {0, 9}};
        sizes.triangles = {{{VertexId{0u}, VertexId{1u}, VertexId{2u}}}};
        sizes.sizes = {5, 5, 5};
        return std::make_shared<const SizedMesh>(sizes);
    }();
    const MeshResult made = generate_mesh(one_section(), options);
    EXPECT_EQ(check_mesh(made.mesh).defect_count, 0u);
    EXPECT_NEAR(made.first_heights[0], 2e-5, 1e-9);
    EXPECT_EQ(made.check.walls.share_of_kept_heights, 1);
}

}  // namespace
}  // namespace lamina::test
