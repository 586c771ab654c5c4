// The hash of meshes.
#include <gtest/gtest.h>

#include <cmath>

#include <lamina/mesh.hpp>

#include "core/parallel.hpp"
#include "support/sample_meshes.hpp"

namespace lamina {
namespace {

using test::annulus;
using test::box_with_hole;
using test::shuffled;

TEST(MeshHash, IgnoresNumberingAndOrder) {
    for (const Mesh& mesh : {annulus(), annulus({.quads_in_layer = true}), box_with_hole()}) {
        const std::string hash = mesh_hash(mesh);
        EXPECT_EQ(hash.size(), 32u);
        EXPECT_EQ(hash.find_first_not_of("0123456789abcdef"), std::string::npos);
        for (unsigned seed = 1; seed < 6; ++seed) EXPECT_EQ(mesh_hash(shuffled(mesh, seed)), hash);
    }
}

TEST(MeshHash, IgnoresTheSignOfZeroAndThreads) {
    Mesh mesh = box_with_hole(41);
    const std::string hash = mesh_hash(mesh);
    for (Point& p : mesh.points)
        if (p.x == 0) p.x = -0.0;
    EXPECT_EQ(mesh_hash(mesh), hash);
    with_threads(4, [&] { EXPECT_EQ(mesh_hash(mesh), hash); });
}

TEST(MeshHash, SeesEveryChange) {
    const Mesh mesh = annulus({.quads_in_layer = true});
    const std::string hash = mesh_hash(mesh);
    for (std::size_t v = 0; v < mesh.points.size(); v += 7) {
        Mesh changed = mesh;
        changed.points[v].y = std::nextafter(changed.points[v].y, 10.0);
        EXPECT_NE(mesh_hash(changed), hash);
    }
    Mesh changed = mesh;
    changed.triangles.pop_back();
    EXPECT_NE(mesh_hash(changed), hash);
    changed = mesh;
    changed.markers[0].name = "wal1";
    EXPECT_NE(mesh_hash(changed), hash);
    changed = mesh;
    std::swap(changed.markers[0].edges[0].a, changed.markers[0].edges[0].b);
    EXPECT_NE(mesh_hash(changed), hash);
    changed = mesh;
    changed.markers[1].edges.pop_back();
    EXPECT_NE(mesh_hash(changed), hash);
    changed = mesh;  // the other diagonal of a trapezoid
    Triangle &s = changed.triangles[0], &t = changed.triangles[1];
    const VertexId a = s.v[0], b = s.v[1], c = s.v[2], d = t.v[2];
    s = {{a, b, d}};
    t = {{b, c, d}};
    EXPECT_NE(mesh_hash(changed), hash);
}

TEST(MeshHash, FollowsTheRecipe) {
    // An independent implementation computed these sums of MurmurHash3_x64_128 values by the recipe in hash.cpp.
    Mesh mesh;
    mesh.points = {{1, 0}, {0, 1}, {-0.0, 0}};
    mesh.triangles = {{{VertexId(0), VertexId(1), VertexId(2)}}};
    EXPECT_EQ(mesh_hash(mesh), "e33ac94210ad568fa1df536307e556e4");
    mesh.markers = {{"wall", MarkerKind::wall, {{VertexId(0), VertexId(1)}}},
                    {"a longer name than 16", MarkerKind::wall, {{VertexId(1), VertexId(2)}}}};
    EXPECT_EQ(mesh_hash(mesh), "b51213140849146b03f4765d7d1caf75");
}

}  // namespace
}  // namespace lamina
