// Meshes for which the flow decides: the first height, the thickness of the layer, the walls' spacing and the wakes.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <lamina/error.hpp>

#include "core/reproducible_math.hpp"
#include "core/segments.hpp"
#include "flow/boundary_layer.hpp"
#include "flow/potential.hpp"
#include "layers/stages.hpp"
#include "pipeline/cases.hpp"
#include "pipeline/flow_guidance.hpp"

namespace lamina::test {
namespace {

using shapes::Outline;

CaseOptions guided_options(double reynolds, double alpha_deg) {
    CaseOptions options;
    options.conditions = {.alpha_deg = alpha_deg, .reynolds = reynolds};
    options.layer.first_height = YPlus{1};
    options.layer.layers.reset();
    options.far_field.size = 10;
    options.use_flow = true;
    return options;
}

Geometry two_elements() {
    return shapes::geometry({naca("2412", 160), shapes::moved(naca("0012", 120), -0.4, 0.3, {0.98, -0.03})});
}

/// The thickness of the boundary layer at the point of the flow nearest to a point of the wall; 0 where it has left it.
double thickness_near(const ElementFlow& element, Point p) {
    double nearest = HUGE_VAL, thickness = 0;
    for (const auto* side : {&element.upper, &element.lower})
        for (const FlowPoint& point : *side)
            if (const double away = distance(point.at, p); away < nearest) {
                nearest = away;
                thickness = point.state == BoundaryLayerState::separated ? 0 : point.thickness;
            }
    return thickness;
}

TEST(FlowGuidance, LayersAreThickerThanBoundaryLayersAtAnyReynoldsNumber) {
    for (const double reynolds : {1e5, 1e6, 1e7, 1e8}) {
        for (const double alpha_deg : {0.0, 5.0, 10.0}) {
            SCOPED_TRACE(testing::Message() << "Re " << reynolds << ", alpha " << alpha_deg);
            const CaseOptions options = guided_options(reynolds, alpha_deg);
            const Geometry geometry = prepare_surfaces(shapes::geometry({naca("0012", 400)}));
            const Flow flow = solve_flow(geometry, options.conditions);
            ASSERT_FALSE(flow.estimated);
            LayerGrowth growth =
                layer_growth(options.layer, reference_conditions(options.conditions, Box{{0, 0}, {1, 0}}));
            growth.least_heights = pipeline::heights_of_flow(flow);
            const layers::Rays rays = layers::grow_rays(geometry, options.layer, growth);
            for (std::size_t i = 0; i < rays.set.lines.size(); ++i) {
                const Point origin = rays.set.lines[i].origin;
                const double height = rays.heights.of(i)[rays.counts[i]];
                // Both sides meet at the trailing edge.
                if (origin.x < 0.999) {
                    EXPECT_GE(height, std::min(1.3 * thickness_near(flow.elements[0], origin), 0.079)) << origin.x;
                }
            }
            for (const std::string& finding : check_layer(layers::close_border(rays), options.layer))
                ADD_FAILURE() << finding;
        }
    }
}

TEST(FlowGuidance, FirstHeightsHaveTheYPlusOfTheLargestSkinFrictionOnTheirElement) {
    const Flow flow = solve_flow(two_elements(), {.alpha_deg = 4, .reynolds = 3e6});
    const std::vector<double> heights = pipeline::first_heights_of_flow(flow, 2, 3e6),
                              halves = pipeline::first_heights_of_flow(flow, 1, 3e6);
    ASSERT_EQ(heights.size(), 2u);
    const double viscosity = flow.chord / 3e6;
    for (std::size_t e = 0; e < 2; ++e) {
        double friction = 0;
        for (const auto* side : {&flow.elements[e].upper, &flow.elements[e].lower})
            for (const FlowPoint& point : *side) friction = std::max(friction, point.skin_friction);
        EXPECT_NEAR(heights[e] * std::sqrt(friction / 2) / viscosity, 2, 1e-12);
        EXPECT_NEAR(halves[e] / heights[e], 0.5, 1e-12);
    }
    EXPECT_GT(std::abs(heights[1] / heights[0] - 1), 0.05);
}

/// In front of a flap the flow is fast at the base of the main element, and friction is largest where it turns round
/// it.
TEST(FlowGuidance, FirstHeightsKnowTheFrictionAtCornersOfBases) {
    ElementFlow element;
    element.upper = {{.at = {0.5, 0.1}, .skin_friction = 0.01}, {.at = {1, 0.01}, .skin_friction = 0.002}};
    element.lower = {{.at = {0.5, -0.1}, .skin_friction = 0.005}, {.at = {1, 0}, .skin_friction = 0.005}};
    Flow flow;
    flow.elements = {element};
    EXPECT_NEAR(pipeline::first_heights_of_flow(flow, 1, 1e6).front(), 1e-6 / std::sqrt(0.5 * 0.016), 1e-15);
    flow.elements[0].lower.back().at = flow.elements[0].upper.back().at;  // no base
    EXPECT_NEAR(pipeline::first_heights_of_flow(flow, 1, 1e6).front(), 1e-6 / std::sqrt(0.5 * 0.01), 1e-15);
}

/// The panels of a permuted geometry stand in another order in the system of equations, so that its solution differs in
/// the last digits.
TEST(FlowGuidance, FirstHeightsGoWithTheirElements) {
    const Geometry geometry = two_elements();
    Geometry permuted = geometry;
    std::swap(permuted.elements[0], permuted.elements[1]);
    const FlowConditions conditions{.alpha_deg = 4, .reynolds = 3e6};
    const std::vector<double> heights = pipeline::first_heights_of_flow(solve_flow(geometry, conditions), 1, 3e6),
                              others = pipeline::first_heights_of_flow(solve_flow(permuted, conditions), 1, 3e6);
    EXPECT_NEAR(others[0] / heights[1], 1, 1e-9);
    EXPECT_NEAR(others[1] / heights[0], 1, 1e-9);
}

/// Two sections of which each is the mirror image of the other have the same flow at zero incidence.
TEST(FlowGuidance, IdenticalElementsHaveIdenticalFirstHeights) {
    const Geometry geometry = shapes::geometry(
        {shapes::moved(naca("0012", 120), 0, 1, {0, 0.3}), shapes::moved(naca("0012", 120), 0, 1, {})});
    const Flow flow = solve_flow(geometry, {.reynolds = 3e6});
    const std::vector<double> heights = pipeline::first_heights_of_flow(flow, 1, 3e6);
    EXPECT_NEAR(heights[0] / heights[1], 1, 1e-9);
}

TEST(FlowGuidance, WarningsSayAtWhichOfSeveralAngles) {
    FlowConditions conditions{.alpha_deg = 20, .reynolds = 1e6};
    const Geometry geometry = shapes::geometry({naca("0012", 120)});
    const ReferenceConditions reference = reference_conditions(conditions, Box{{0, 0}, {1, 0}});
    const auto messages = [&] {
        std::vector<std::string> said;
        layers::LayerGrowth growth;
        const auto guidance = pipeline::guide_by_flow(geometry, {}, conditions, {.enabled = false}, reference, growth);
        for (const Warning& warning : guidance.flow->warnings) said.push_back(warning.message);
        return said;
    };
    ASSERT_EQ(messages().size(), 1u);
    EXPECT_FALSE(messages().front().starts_with("at "));
    conditions.alphas = ValueRange{18, 22, 2};
    const std::vector<std::string> said = messages();
    ASSERT_EQ(said.size(), 3u);
    for (std::size_t i = 0; i < said.size(); ++i)
        EXPECT_TRUE(said[i].starts_with("at " + std::to_string(18 + 2 * i) + " degrees: ")) << said[i];
}

TEST(FlowGuidance, FirstCellsHaveTheHeightsOfTheirElements) {
    const CaseOptions options = guided_options(3e6, 6);
    const MeshResult result = generate_mesh(two_elements(), options);
    ASSERT_EQ(result.first_heights.size(), 2u);
    ASSERT_EQ(result.check.walls.first_heights.size(), 2u);
    EXPECT_GT(std::abs(result.first_heights[1] / result.first_heights[0] - 1), 0.05);
    for (std::size_t e = 0; e < 2; ++e) {
        const FirstHeights& measured = result.check.walls.first_heights[e];
        EXPECT_EQ(measured.marker, result.geometry.elements[e].name);
        EXPECT_NEAR(measured.median / result.first_heights[e], 1, 1e-3);
        EXPECT_GT(measured.share_of_kept, 0.98);
    }
}

/// The ray of the trailing edge leans, between the wall and the wake.
TEST(FlowGuidance, FirstHeightsHoldAtTrailingEdgesBeforeWakes) {
    CaseOptions options = guided_options(1e5, 0);
    options.layer.wake_layers = true;
    for (const char* const section : {"naca:0015:100", "naca:4415:100"}) {
        const MeshResult result = generate_mesh(std::vector<std::string>{section}, options);
        EXPECT_EQ(result.check.walls.share_of_kept_heights, 1) << section;
    }
}

TEST(FlowGuidance, AGivenFirstHeightHoldsForAllElements) {
    CaseOptions options = guided_options(3e6, 6);
    options.layer.first_height = 2e-5;
    const MeshResult result = generate_mesh(two_elements(), options);
    EXPECT_EQ(result.first_heights, (std::vector<double>(2, 2e-5 * result.conditions.chord)));
    for (const FirstHeights& measured : result.check.walls.first_heights)
        EXPECT_NEAR(measured.median / result.first_heights[0], 1, 1e-3);
}

/// The thickness must exceed the first height on each element, not only on the one with the smallest.
TEST(FlowGuidance, RefusesAThicknessBelowTheFirstHeightOfAnyElement) {
    const Geometry geometry = two_elements();
    CaseOptions options = guided_options(3e6, 6);
    const std::vector<double> heights =
        pipeline::first_heights_of_flow(solve_flow(geometry, options.conditions), 1, 3e6);
    const auto [least, most] = std::minmax_element(heights.begin(), heights.end());
    options.layer.thickness = input_units(0.5 * (*least + *most));
    EXPECT_THROW(generate_mesh(geometry, options), OptionError);
}

// Potential flow turns round the tip of a sheet with a peak that grows without bound as panels get shorter.
TEST(FlowGuidance, PeaksAtTheTipsOfSheetsAskForNoSpacing) {
    const Geometry sail = make_geometry({}, {.sheets = {{"sail", {{0, 0}, {0.3, 0.06}, {0.6, 0.07}, {1, 0}}}}});
    Flow flow = solve_flow(sail, {.alpha_deg = 10, .reynolds = 1e6});
    ASSERT_EQ(flow.elements[0].sharp_nose, (Point{0, 0}));
    const auto edges_asked_for = [](const Flow& of) {
        double edges = 0;
        for (const geometry::WallSpacing& wall : pipeline::spacings_of_flow(of, {}))
            if (wall.spacing > 0) edges += distance(wall.a, wall.b) / wall.spacing;
        return edges;
    };
    const double with_nose = edges_asked_for(flow);
    flow.elements[0].sharp_nose.reset();
    EXPECT_LT(with_nose, 0.9 * edges_asked_for(flow));
}

std::vector<SizeSource> sources_of(const std::vector<pipeline::WakeSource>& chain) {
    std::vector<SizeSource> sources;
    for (const pipeline::WakeSource& part : chain) sources.push_back(part.source);
    return sources;
}

/// The chords of streamlines have the direction of the flow in their middles: that of potential flow at the trailing
/// edge, and that of a flow with 0.8 of its lift from 0.15 chords behind it.
void expect_to_follow_flow(const std::vector<pipeline::WakeSource>& chain, const Flow& flow, const Flow& weaker) {
    for (std::size_t i = 0; i < chain.size(); ++i) {
        const SizeSource& part = chain[i].source;
        if (i > 0) {
            EXPECT_EQ(part.a, chain[i - 1].source.b);
            EXPECT_GE(part.size, chain[i - 1].source.size);
            const double step = chain[i].begins - chain[i - 1].begins;
            EXPECT_NEAR(step, distance(chain[i - 1].source.a, part.a), 0.02 * step);
        }
        if (i == 0) continue;  // it begins with the step off the trailing edge
        const Point middle = midpoint(part.a, part.b), along = unit(part.b - part.a);
        const double with = dot(along, unit(flow_velocity(flow, middle))),
                     less = dot(along, unit(flow_velocity(weaker, middle)));
        const bool is_behind = chain[i].begins > 0.15 * flow.chord;
        EXPECT_GT(is_behind ? less : std::max(with, less), is_behind ? 0.999 : 0.99) << middle.x << ' ' << middle.y;
    }
}

TEST(FlowGuidance, WakesFollowStreamlinesFromTrailingEdges) {
    const Geometry geometry = two_elements();
    const Flow flow = solve_flow(geometry, {.alpha_deg = 6, .reynolds = 3e6});
    const Flow weaker = flow::with_share_of_lift(flow, 0.8);
    const std::vector<pipeline::ElementWake> wakes = pipeline::wakes_of_flow(flow);
    ASSERT_EQ(wakes.size(), 2u);
    for (std::size_t e = 0; e < 2; ++e) {
        const ElementFlow& element = flow.elements[e];
        for (const auto* chain : {&wakes[e].outer, &wakes[e].inner}) {
            ASSERT_FALSE(chain->empty());
            EXPECT_LT(distance(chain->front().source.a, midpoint(element.upper.back().at, element.lower.back().at)),
                      1e-12);
            expect_to_follow_flow(*chain, flow, weaker);
        }
        EXPECT_TRUE(wakes[e].mixing.empty());
        EXPECT_GT(distance(wakes[e].line.front(), wakes[e].line.back()), 1.5 * flow.chord);
        EXPECT_LT(wakes[e].inner.front().source.size, wakes[e].outer.front().source.size);
        EXPECT_LE(wakes[e].inner.back().source.size, wakes[e].outer.back().source.size);
    }
}

/// The lift of viscous flow is not known before the mesh. Streamlines for 0.75 and 0.85 of that of potential flow lie
/// in the wake.
TEST(FlowGuidance, WakesHoldStreamlinesOfSeveralLifts) {
    const Flow flow =
        solve_flow(shapes::geometry({naca("4412", 160, TrailingEdge::blunt)}), {.alpha_deg = 10, .reynolds = 3e6});
    const std::vector<SizeSource> wake = sources_of(pipeline::wakes_of_flow(flow).front().outer);
    const ElementFlow& element = flow.elements.front();
    for (const double share : {0.75, 0.85}) {
        const Flow weaker = flow::with_share_of_lift(flow, share);
        for (const Point p : streamline(weaker, midpoint(element.upper.back().at, element.lower.back().at), 1.9)) {
            const bool is_inside = std::any_of(wake.begin(), wake.end(),
                                               [&](const SizeSource& part) { return distance_to(part, p) == 0; });
            EXPECT_TRUE(is_inside) << share << ": " << p.x << ' ' << p.y;
        }
    }
}

/// Returns the width of the fluid at rest in a separated layer.
double at_rest(const FlowPoint& end) {
    return end.state == BoundaryLayerState::separated ? std::max(end.displacement - 2.4 * end.momentum, 0.0) : 0;
}

/// Returns how far behind all trailing edges a place of a wake is, at most.
double behind_all(const Flow& flow, const pipeline::ElementWake& wake, double begins) {
    const Point stream{std::cos(flow.alpha_deg * core::pi / 180), std::sin(flow.alpha_deg * core::pi / 180)};
    double before = HUGE_VAL;  // from the trailing edge to behind the last one
    for (const ElementFlow& element : flow.elements)
        before = std::min(before, dot(wake.line.front() - element.upper.back().at, stream));
    double length = 0;
    for (std::size_t i = 1; i < wake.line.size() && dot(wake.line[i - 1] - wake.line[0], stream) < -before; ++i)
        length += distance(wake.line[i - 1], wake.line[i]);
    return begins - length;
}

/// Sizes on a wake are a tenth of its width, and far behind all elements grow as the distance. The width is that of a
/// plane wake, whose square grows linearly from the trailing edge on, and that of the fluid at rest, over which mixing
/// layers spread. The inner wake widens linearly, as much as a mixing layer where much fluid is at rest.
TEST(FlowGuidance, SizesOfWakesFollowTheLawsOfTheirWidths) {
    bool some_attached = false, some_separated = false;
    for (const double alpha_deg : {0.0, 6.0, 15.0}) {
        const Flow flow = solve_flow(two_elements(), {.alpha_deg = alpha_deg, .reynolds = 3e6});
        const std::vector<pipeline::ElementWake> wakes = pipeline::wakes_of_flow(flow),
                                                 fine = pipeline::wakes_of_flow(flow, 2);
        for (std::size_t e = 0; e < 2; ++e) {
            const FlowPoint &above = flow.elements[e].upper.back(), &below = flow.elements[e].lower.back();
            const double at_edge = above.momentum + below.momentum, rest = at_rest(above) + at_rest(below),
                         momentum = std::min(above.momentum, flow::momentum_far_behind(flow.elements[e].upper)) +
                                    std::min(below.momentum, flow::momentum_far_behind(flow.elements[e].lower)),
                         start = above.thickness + below.thickness + distance(above.at, below.at);
            const auto expect_size = [&](const pipeline::WakeSource& part, double width) {
                const double far = 0.0135 / 0.86 * behind_all(flow, wakes[e], part.begins);
                EXPECT_NEAR(part.source.size, std::max(0.1 * width, far), 0.006 * part.source.size);
            };
            for (const pipeline::WakeSource& part : wakes[e].outer) {
                const double plane = std::sqrt(start * start + 1.61 * 1.61 * momentum * part.begins);
                expect_size(part, plane + std::min(0.11 * part.begins, rest));
            }
            const double first = 10 * wakes[e].inner.front().source.size;
            EXPECT_NEAR(first, 4 * at_edge, 1e-9 * flow.chord);
            const pipeline::WakeSource& second = wakes[e].inner[1];
            const double growth = (10 * second.source.size - first) / second.begins;
            if (rest == 0) {
                EXPECT_NEAR(growth, 0.06, 1e-9);
                some_attached = true;
            } else if (rest > 2.4 * at_edge) {
                EXPECT_NEAR(growth, 0.11, 1e-9);
                some_separated = true;
            } else {
                EXPECT_GT(growth, 0.06);
                EXPECT_LT(growth, 0.11 + 1e-9);
            }
            for (const pipeline::WakeSource& part : wakes[e].inner) expect_size(part, first + growth * part.begins);
            EXPECT_EQ(2 * fine[e].outer.front().source.size, wakes[e].outer.front().source.size);
        }
    }
    EXPECT_TRUE(some_attached);
    EXPECT_TRUE(some_separated);
}

/// Returns the number of triangles that a segment meets.
std::size_t triangles_on(const Mesh& mesh, Point a, Point b) {
    return static_cast<std::size_t>(
        std::count_if(mesh.triangles.begin(), mesh.triangles.end(), [&](const Triangle& triangle) {
            for (std::size_t k = 0; k < 3; ++k)
                if (core::segments_meet(a, b, mesh.points[triangle.v[k].index()],
                                        mesh.points[triangle.v[(k + 1) % 3].index()]))
                    return true;
            return false;
        }));
}

/// A line across the wake meets at least ten triangles up to three chords behind the trailing edge, six up to ten and
/// four up to twenty, as a mean over a tenth of the way.
TEST(FlowGuidance, TrianglesResolveWakesFarBehind) {
    const Geometry geometry = shapes::geometry({naca("2412", 160)});
    for (const double reynolds : {1e6, 6e6}) {
        CaseOptions options = guided_options(reynolds, 4);
        options.far_field.size = 50;
        const MeshResult result = generate_mesh(geometry, options);
        const pipeline::ElementWake wake = pipeline::wakes_of_flow(*result.flow).front();
        const ElementFlow& element = result.flow->elements.front();
        const double momentum = 0.5 * flow_forces(*result.flow).drag;
        constexpr int lines = 10;
        for (const auto& [behind, least] :
             {std::pair{0.5, 10}, {1.0, 10}, {2.0, 10}, {3.0, 10}, {5.0, 6}, {10.0, 6}, {19.9, 4}}) {
            std::size_t triangles = 0;
            for (int k = 0; k < lines; ++k) {
                const double from = behind * (1 - 0.01 * k);
                const auto part = std::find_if(wake.outer.rbegin(), wake.outer.rend(),
                                               [&](const auto& source) { return source.begins <= from; });
                const double width = flow::wake_thickness(element.upper.back().thickness,
                                                          element.lower.back().thickness, momentum, from);
                const Point along = unit(part->source.b - part->source.a),
                            middle = part->source.a + (from - part->begins) * along,
                            half = 0.5 * width * perpendicular(along);
                triangles += triangles_on(result.mesh, middle - half, middle + half);
            }
            EXPECT_GE(triangles, static_cast<std::size_t>(least * lines)) << reynolds << ' ' << behind;
        }
    }
}

TEST(FlowGuidance, WakesScaleWithTheGeometry) {
    const Geometry geometry = shapes::geometry({shapes::section(0.18, 0.06, 80)});
    const Flow flow = solve_flow(geometry, {.alpha_deg = 4, .reynolds = 3e6}),
               large = solve_flow(shapes::geometry({shapes::moved(shapes::section(0.18, 0.06, 80), 0, 4, {})}),
                                  {.alpha_deg = 4, .reynolds = 3e6});
    const pipeline::ElementWake one = pipeline::wakes_of_flow(flow)[0], other = pipeline::wakes_of_flow(large)[0];
    for (const auto chain :
         {&pipeline::ElementWake::outer, &pipeline::ElementWake::inner, &pipeline::ElementWake::mixing}) {
        ASSERT_FALSE((one.*chain).empty());
        ASSERT_EQ((one.*chain).size(), (other.*chain).size());
        for (std::size_t i = 0; i < (one.*chain).size(); ++i) {
            EXPECT_EQ(4 * (one.*chain)[i].source.size, (other.*chain)[i].source.size);
            EXPECT_EQ(4 * (one.*chain)[i].source.radius, (other.*chain)[i].source.radius);
            EXPECT_EQ(4 * (one.*chain)[i].source.b, (other.*chain)[i].source.b);
        }
    }
}

/// Behind a wide base, mixing layers begin at both corners, as thin as the boundary layers there, and meet in the
/// middle, where the inner wake begins. Meshes have such edges.
TEST(FlowGuidance, MixingLayersBeginAtTheCornersOfWideBases) {
    for (const double base : {0.06, 0.1}) {
        SCOPED_TRACE(base);
        const Geometry geometry = shapes::geometry({shapes::section(0.18, base, 80)});
        const CaseOptions options = guided_options(3e6, 2);
        const Flow flow = solve_flow(geometry, options.conditions);
        ASSERT_FALSE(flow.estimated);
        const FlowPoint &above = flow.elements[0].upper.back(), &below = flow.elements[0].lower.back();
        const pipeline::ElementWake wake = pipeline::wakes_of_flow(flow)[0];
        EXPECT_GT(wake.wake.first_width, base);
        ASSERT_FALSE(wake.inner.empty());
        EXPECT_NEAR(wake.inner.front().begins, base * 0.5 / 0.11, 1e-2 * base);
        const auto second = std::find_if(wake.mixing.begin() + 1, wake.mixing.end(),
                                         [](const pipeline::WakeSource& part) { return part.begins == 0; });
        ASSERT_NE(second, wake.mixing.end());
        EXPECT_EQ(wake.mixing.front().source.a, above.at);
        EXPECT_EQ(second->source.a, below.at);
        for (const auto& last : {second - 1, wake.mixing.end() - 1}) {
            EXPECT_LT(distance(last->source.b, wake.inner.front().source.a), 2 * last->source.size);
            EXPECT_LE(last->source.size, wake.inner.front().source.size);
        }
        for (auto part = wake.mixing.begin(); part != wake.mixing.end(); ++part) {
            const double momentum = part < second ? above.momentum : below.momentum;
            EXPECT_NEAR(10 * part->source.size, 4 * momentum + 0.11 * part->begins, 1e-9);
        }
        const MeshResult result = generate_mesh(geometry, options);
        EXPECT_TRUE(result.check.valid());
        // Triangles at the mixing layers are as small as asked for.
        for (const Triangle& triangle : result.mesh.triangles) {
            const Point a = result.mesh.points[triangle.v[0].index()], b = result.mesh.points[triangle.v[1].index()],
                        c = result.mesh.points[triangle.v[2].index()];
            const Point middle = (1.0 / 3) * (a + b + c);
            for (const pipeline::WakeSource& part : wake.mixing)
                if (distance_to(part.source, middle) == 0) {
                    EXPECT_LT(0.5 * std::abs(cross(b - a, c - a)), 0.8 * part.source.size * part.source.size);
                }
        }
    }
}

/// Layers go on behind sharp and blunt trailing edges, whatever the cells are, and no marker but those of walls and far
/// field comes of it.
TEST(FlowGuidance, LayersGoOnAlongWakes) {
    for (const LayerTopology topology : {LayerTopology::layered, LayerTopology::quads, LayerTopology::delaunay}) {
        SCOPED_TRACE(static_cast<int>(topology));
        CaseOptions options = guided_options(3e6, 6);
        options.layer.topology = topology;
        options.layer.wake_layers = true;
        const Geometry geometry = shapes::geometry({naca("2412", 160), naca("0012", 120, TrailingEdge::blunt)});
        Geometry apart = geometry;
        apart.elements[1].points = shapes::moved(geometry.elements[1].points, -0.3, 0.4, {0.98, -0.03});
        const MeshResult result = generate_mesh(apart, options);
        EXPECT_TRUE(result.check.valid());
        EXPECT_FALSE(result.layer_grid_refused);
        ASSERT_EQ(result.mesh.markers.size(), 3u);
        ASSERT_EQ(result.decisions.wakes.size(), 2u);
        EXPECT_GT(result.decisions.wakes[1].with_layers, 1.5);
        for (std::size_t e = 0; e < 2; ++e) {
            std::size_t on_wall = 0;
            for (const Segment& edge : result.mesh.markers[e].edges)
                on_wall += std::any_of(apart.elements[e].points.begin(), apart.elements[e].points.end(),
                                       [&](Point p) { return distance(p, result.mesh.points[edge.a.index()]) < 0.05; });
            EXPECT_EQ(on_wall, result.mesh.markers[e].edges.size());
        }
        options.threads = 3;
        EXPECT_TRUE(generate_mesh(apart, options).mesh.points == result.mesh.points);
    }
}

/// The length of the longest edge at the corners of the base of the first element, in first heights of that element.
double longest_edge_at_base(const Geometry& given, const CaseOptions& options) {
    const MeshResult result = generate_mesh(given, options);
    const Element& element = result.geometry.elements.front();
    const auto& points = element.points;
    const Base& base = element.features.base.value();
    double longest = 0;
    for (const std::size_t corner : {base.first, base.last})
        for (const std::size_t next : {corner + 1, corner + points.size() - 1})
            longest = std::max(longest, distance(points[corner], points[next % points.size()]));
    return longest / result.first_heights.front();
}

/// Flow accelerates round the corners of bases, above all where it is fast: in front of a flap.
TEST(FlowGuidance, EdgesAtBasesAreShort) {
    const shapes::Outline blunt = naca("4412", 160, TrailingEdge::blunt);
    const Geometry alone = shapes::geometry({blunt}),
                   with_flap = shapes::geometry({blunt, shapes::moved(naca("0012", 120), -0.4, 0.3, {0.99, -0.03})});
    const CaseOptions options = guided_options(3e6, 6);
    const double speed = solve_flow(with_flap, options.conditions).elements.front().upper.back().speed;
    ASSERT_GT(speed, 1);
    EXPECT_LE(longest_edge_at_base(alone, options), 1.1 * 60);
    EXPECT_LE(longest_edge_at_base(with_flap, options), 1.1 * 60 / speed);
}

TEST(FlowGuidance, TheResultSaysWhatTheFlowDecided) {
    const CaseOptions options = guided_options(3e6, 6);
    const MeshResult result = generate_mesh(two_elements(), options);
    ASSERT_TRUE(result.flow.has_value());
    const auto wakes = pipeline::wakes_of_flow(*result.flow);
    ASSERT_EQ(result.decisions.wakes.size(), 2u);
    for (std::size_t e = 0; e < 2; ++e) {
        const FlowWake& wake = result.decisions.wakes[e];
        const ElementFlow& element = result.flow->elements[e];
        EXPECT_EQ(wake.element, element.name);
        // The streamline is a little longer than its chords, and the straight line between its ends shorter.
        EXPECT_LE(wake.length, 20 * result.conditions.chord * (1 + 1e-9));
        EXPECT_GE(wake.length, distance(wakes[e].line.front(), wakes[e].line.back()));
        EXPECT_EQ(wake.with_layers, 0);
        EXPECT_NEAR(wake.first_width, element.upper.back().thickness + element.lower.back().thickness,
                    0.2 * wake.first_width);
        EXPECT_GT(wake.last_width, wake.first_width);
    }
    double highest = 0;
    for (const WallHeight& height : pipeline::heights_of_flow(*result.flow)) highest = std::max(highest, height.height);
    EXPECT_EQ(result.decisions.least_thickness, highest);
    for (const FlowSpacing& spacing : result.decisions.spacings) {
        const auto e = std::find_if(result.geometry.elements.begin(), result.geometry.elements.end(),
                                    [&](const Element& element) { return element.name == spacing.element; });
        ASSERT_NE(e, result.geometry.elements.end());
        double shortest = HUGE_VAL;
        for (std::size_t i = 0; i < e->points.size(); ++i)
            shortest = std::min(shortest, distance(e->points[i], e->points[(i + 1) % e->points.size()]));
        EXPECT_LE(shortest, 1.01 * spacing.smallest);
    }

    CaseOptions kept = options;
    kept.surface.treatment = SurfaceTreatment::keep;
    kept.layer.layers = 20;
    const FlowDecisions decisions = generate_mesh(two_elements(), kept).decisions;
    EXPECT_TRUE(decisions.spacings.empty());
    EXPECT_EQ(decisions.least_thickness, 0);
}

/// Walls are finer where the pressure changes quickly, and as fine as before elsewhere.
TEST(FlowGuidance, WallsResolveSuctionPeaks) {
    const Geometry given = read_geometry(std::vector<std::string>{"naca:0012"});
    CaseOptions options = guided_options(6e6, 10);
    const auto longest_edge = [&](const Box& box) {
        double longest = 0;
        for (const Element& element : generate_mesh(given, options).geometry.elements)
            for (std::size_t i = 0; i < element.points.size(); ++i) {
                const Point a = element.points[i], b = element.points[(i + 1) % element.points.size()];
                if (box.contains(a)) longest = std::max(longest, distance(a, b));
            }
        return longest;
    };
    const Box peak{{-0.001, -0.01}, {0.01, 0.02}}, middle{{0.4, -0.1}, {0.6, 0.1}};
    const double at_peak = longest_edge(peak), in_the_middle = longest_edge(middle);
    options.use_flow = false;
    EXPECT_LT(at_peak, 0.8 * longest_edge(peak));
    EXPECT_NEAR(in_the_middle, longest_edge(middle), 0.05 * in_the_middle);
}

/// Returns the number of edges on each side of a polygon whose corners are vertices of an outline.
std::vector<std::size_t> edges_of_sides(const Outline& polygon, const Outline& outline) {
    std::vector<std::size_t> corners, edges;
    for (const Point corner : polygon)
        corners.push_back(
            static_cast<std::size_t>(std::find(outline.begin(), outline.end(), corner) - outline.begin()));
    for (std::size_t k = 0; k < corners.size(); ++k)
        edges.push_back((corners[(k + 1) % corners.size()] + outline.size() - corners[k]) % outline.size());
    return edges;
}

/// Potential flow is infinitely fast round corners, where real flow leaves the wall. Sides of a snowflake had 17 to 139
/// edges for it, and the mesh 3.7 times the triangles of one without a flow.
TEST(FlowGuidance, CornersOfBluffBodiesDoNotCountAsSuctionPeaks) {
    const Outline sides = shapes::snowflake(2);
    for (const double max_spacing : {0.02, 0.005})
        for (const double alpha_deg : {0.0, 7.0}) {
            SCOPED_TRACE(testing::Message() << max_spacing << ", alpha " << alpha_deg);
            CaseOptions options = guided_options(1e6, alpha_deg);
            options.surface.max_spacing = max_spacing;
            const MeshResult with = generate_mesh(shapes::geometry({sides}), options);
            expect_sound(with, options);
            ASSERT_FALSE(with.flow->estimated);
            options.use_flow = false;
            const Outline outline = with.geometry.elements[0].points;
            const std::vector<std::size_t>
                edges = edges_of_sides(sides, outline),
                least = edges_of_sides(sides,
                                       generate_mesh(shapes::geometry({sides}), options).geometry.elements[0].points);
            for (std::size_t k = 0; k < sides.size(); ++k) {
                // The first height differs, and so do the leans and the fans at the corners.
                EXPECT_GE(static_cast<double>(edges[k]), 0.6 * static_cast<double>(least[k])) << k;
                EXPECT_LE(static_cast<double>(edges[k]), 2.5 * static_cast<double>(least[k])) << k;
            }
            for (std::size_t i = 0; i < outline.size(); ++i)
                EXPECT_LE(distance(outline[i], outline[(i + 1) % outline.size()]), 2 * max_spacing * (1 + 1e-9));
        }
}

TEST(FlowGuidance, MeshesAreValidAndTheSameOnAnyNumberOfThreads) {
    for (const Geometry& geometry : {shapes::geometry({naca("4412", 160, TrailingEdge::blunt)}), two_elements()}) {
        CaseOptions options = guided_options(3e6, 6);
        options.threads = 1;
        const MeshResult one = generate_mesh(geometry, options);
        options.threads = 8;
        const MeshResult eight = generate_mesh(geometry, options);
        EXPECT_EQ(mesh_hash(one.mesh), mesh_hash(eight.mesh));
        EXPECT_EQ(one.check.isotropic.unexcused(), 0u);
        ASSERT_TRUE(one.flow.has_value());
        EXPECT_FALSE(one.flow->estimated);
    }
}

TEST(FlowGuidance, WakeLayersNeedTheFlowAndLayersUpToIsotropy) {
    CaseOptions options = guided_options(3e6, 4);
    options.layer.wake_layers = true;
    EXPECT_NO_THROW(validate(options));
    CaseOptions without_flow = options, fixed = options;
    without_flow.use_flow = false;
    EXPECT_THROW(validate(without_flow), OptionError);
    fixed.layer.layers = 30;
    EXPECT_THROW(validate(fixed), OptionError);
}

TEST(FlowGuidance, NeedsAReynoldsNumber) {
    CaseOptions options;
    options.use_flow = true;
    EXPECT_THROW(generate_mesh(shapes::geometry({naca("0012")}), options), OptionError);
}

}  // namespace
}  // namespace lamina::test
