// The three topologies of the layer: they join the same points to different cells, and the rest of the mesh is equal.
#include <gtest/gtest.h>

#include "pipeline/cases.hpp"

namespace lamina::test {
namespace {

using shapes::Outline;

constexpr LayerTopology topologies[] = {LayerTopology::delaunay, LayerTopology::layered, LayerTopology::quads};

CaseOptions options_with(LayerTopology topology) {
    CaseOptions options = thesis_options();
    options.far_field.size = 10;
    options.layer.topology = topology;
    return options;
}

std::vector<Triangle> isotropic_triangles(const Mesh& mesh) {
    std::vector<Triangle> triangles;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
        if (mesh.region[t] == Region::isotropic) triangles.push_back(mesh.triangles[t]);
    return triangles;
}

void expect_equal_outside_the_layer(std::initializer_list<Outline> bodies) {
    const MeshResult delaunay = mesh_of(bodies, options_with(LayerTopology::delaunay));
    for (LayerTopology topology : topologies) {
        SCOPED_TRACE(static_cast<int>(topology));
        const CaseOptions options = options_with(topology);
        const MeshResult result = mesh_of(bodies, options);
        expect_sound(result, options);
        const Mesh& mesh = result.mesh;
        EXPECT_EQ(mesh.points, delaunay.mesh.points);
        EXPECT_EQ(mesh.constraints, delaunay.mesh.constraints);
        for (std::size_t m = 0; m < mesh.markers.size(); ++m)
            EXPECT_EQ(mesh.markers[m].edges, delaunay.mesh.markers[m].edges);
        EXPECT_EQ(isotropic_triangles(mesh), isotropic_triangles(delaunay.mesh));
        EXPECT_EQ(result.check.interior_edges, delaunay.check.interior_edges);
        EXPECT_EQ(result.check.layer.cells + result.check.isotropic.cells, mesh.triangles.size() + mesh.quads.size());
        if (topology != LayerTopology::delaunay) {
            EXPECT_EQ(result.check.edges_without_first_layer, 0u);
        }
        // A quad takes the place of two triangles.
        EXPECT_EQ(mesh.triangles.size() + 2 * mesh.quads.size(), delaunay.mesh.triangles.size());
        EXPECT_EQ(mesh.quads.empty(), topology != LayerTopology::quads);
        EXPECT_EQ(mesh_hash(mesh) == mesh_hash(delaunay.mesh), topology == LayerTopology::delaunay);
    }
}

TEST(Topology, SharpAndBluntSections) {
    expect_equal_outside_the_layer({naca("0012")});
    expect_equal_outside_the_layer({naca("4412", 101, TrailingEdge::blunt)});
}

TEST(Topology, SlotsAndCoves) {
    expect_equal_outside_the_layer({naca("0012"), shapes::moved(naca("0012", 80), -0.4, 0.3, {0.98, -0.02})});
    expect_equal_outside_the_layer({shapes::refined(shapes::c_shape(0.05), 40)});
}

TEST(Topology, ThreadsDoNotMatter) {
    for (LayerTopology topology : topologies) {
        CaseOptions options = options_with(topology);
        std::string hash;
        for (unsigned threads : {1u, 2u, 4u}) {
            options.threads = threads;
            const std::string found = mesh_hash(mesh_of({naca("23012", 300)}, options).mesh);
            EXPECT_TRUE(hash.empty() || hash == found) << threads;
            hash = found;
        }
    }
}

}  // namespace
}  // namespace lamina::test
