// The stages one by one against generate_mesh(), and the mesh against cells that the test puts together by itself.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <lamina/layers.hpp>
#include <lamina/pipeline.hpp>
#include "decoupling/far_field.hpp"
#include "decoupling/subdomain.hpp"
#include "layers/layer.hpp"
#include "pipeline/assemble.hpp"
#include "pipeline/cases.hpp"
#include "pipeline/derived_options.hpp"
#include "sizing/requests.hpp"
#include "surface/spacing_limits.hpp"

namespace lamina::test {
namespace {

using namespace decoupling;
using namespace layers;
using namespace pipeline;

/// What the stages before assemble() make of a section whose points are kept.
struct Stages {
    Geometry geometry;
    Layer layer;
    LayerCells cells;
    Decoupling decoupling;
    std::vector<Refinement> refinements;
};

Stages run_stages(const std::string& input, const CaseOptions& options) {
    Stages stages;
    const LayerGrowth growth = layer_growth(options.layer, {});
    stages.geometry =
        surface::prepare_within(read_geometry(std::vector<std::string>{input}), options.surface,
                                spacing_limits(options.layer, growth, wall_gradation(options.sizing, 1), 1), {});
    const FarField far_field = place_far_field(bounding_box(stages.geometry), 1, options.far_field);
    stages.layer =
        make_layer(stages.geometry, options.layer, growth, border_options(options.sizing, options.refine, 1, {}));
    const SizeField size = sizing::make_size_field(border_loops(stages.layer), {}, options.sizing, 1, far_field.box());
    stages.decoupling = decouple({stages.layer.points, stages.layer.borders, size, far_field, options.decoupling});
    stages.cells = fill_layer(stages.layer, options.layer.topology);
    stages.refinements = refine(stages.decoupling.subdomains);
    return stages;
}

/// Appends so many cells of one kind to the marks of a mesh.
void mark(std::size_t cells, Region region, std::size_t piece, Mesh& mesh) {
    mesh.region.insert(mesh.region.end(), cells, region);
    mesh.piece.insert(mesh.piece.end(), cells, static_cast<std::uint32_t>(piece));
}

/// Joins the cells one by one, in the order that the description of assemble() has.
Mesh joined(const Stages& stages) {
    Mesh mesh;
    const LayerCells& cells = stages.cells;
    mesh.points = stages.decoupling.points;
    mesh.triangles = cells.triangles;
    mesh.layer = cells.triangle_layer;
    for (std::size_t piece = 0; piece < cells.pieces(); ++piece)
        mark(cells.first_triangle[piece + 1] - cells.first_triangle[piece], Region::layer, piece, mesh);
    for (std::size_t i = 0; i < stages.refinements.size(); ++i) {
        const Refinement& refinement = stages.refinements[i];
        std::vector<VertexId> ids = stages.decoupling.subdomains[i].global;
        for (const Point p : refinement.steiner_points) {
            ids.emplace_back(mesh.points.size());
            mesh.points.push_back(p);
        }
        for (const Triangle& t : refinement.triangles)
            mesh.triangles.push_back({{ids[t.v[0].index()], ids[t.v[1].index()], ids[t.v[2].index()]}});
        mesh.layer.insert(mesh.layer.end(), refinement.triangles.size(), 0);
        mark(refinement.triangles.size(), Region::isotropic, cells.pieces() + i, mesh);
    }
    mesh.quads = cells.quads;
    mesh.layer.insert(mesh.layer.end(), cells.quad_layer.begin(), cells.quad_layer.end());
    mark(cells.quads.size(), Region::layer, 0, mesh);
    return mesh;
}

void expect_same_arrays(const Mesh& made, const Mesh& expected) {
    EXPECT_TRUE(made.points == expected.points);
    EXPECT_TRUE(made.triangles == expected.triangles);
    ASSERT_EQ(made.quads.size(), expected.quads.size());
    for (std::size_t q = 0; q < made.quads.size(); ++q)
        EXPECT_TRUE(std::ranges::equal(made.quads[q].v, expected.quads[q].v)) << q;
    EXPECT_TRUE(made.layer == expected.layer);
    EXPECT_TRUE(made.region == expected.region);
    EXPECT_TRUE(made.piece == expected.piece);
}

TEST(Assemble, StagesOneByOneMakeTheMeshOfTheWholeRun) {
    for (const LayerTopology topology : {LayerTopology::layered, LayerTopology::quads, LayerTopology::delaunay})
        for (const double pieces_target : {250.0, 50'000.0}) {
            SCOPED_TRACE(testing::Message() << "topology " << int(topology) << ", pieces of " << pieces_target);
            CaseOptions options = quick_options(6);
            options.layer.topology = topology;
            options.decoupling.pieces_target = pieces_target;
            Stages stages = run_stages("naca:4412:60", options);
            if (pieces_target < 1000) {
                EXPECT_GT(stages.refinements.size(), 16u);  // more than may wait for the layer on two threads
            }
            const Mesh expected = joined(stages);
            for (const unsigned threads : {1u, 2u, 5u}) {
                options.threads = threads;
                expect_same_arrays(generate_mesh({"naca:4412:60"}, options).mesh, expected);
            }
            const Mesh assembled = assemble(stages.geometry, stages.layer, stages.cells, std::move(stages.decoupling),
                                            std::move(stages.refinements));
            expect_same_arrays(assembled, expected);
            EXPECT_TRUE(check_mesh(assembled).valid());
        }
}

}  // namespace
}  // namespace lamina::test
