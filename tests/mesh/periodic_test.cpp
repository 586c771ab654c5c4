// Periodic borders: what the check finds, and copies that are joined.
#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include <lamina/error.hpp>
#include <lamina/mesh.hpp>

#include "mesh/periodic.hpp"

namespace lamina {
namespace {

/// Returns a square of two triangles whose borders below and above are periodic.
Mesh square() {
    Mesh mesh{.points = {{0, 0.25}, {1, 0}, {1, 1}, {0, 1.25}}};
    const auto v = [](std::size_t i) { return VertexId(i); };
    mesh.triangles = {{{v(0), v(1), v(2)}}, {{v(0), v(2), v(3)}}};
    mesh.markers = {{"inlet", MarkerKind::far_field, {{v(3), v(0)}}},
                    {"outlet", MarkerKind::far_field, {{v(1), v(2)}}},
                    {"upper", MarkerKind::periodic, {{v(2), v(3)}}},
                    {"lower", MarkerKind::periodic, {{v(0), v(1)}}}};
    return mesh;
}

TEST(Periodic, FindsTwins) {
    const Mesh mesh = square();
    const auto [pair, mismatch] = mesh::find_periodic_pair(mesh.points, mesh.markers);
    ASSERT_TRUE(pair && !mismatch);
    EXPECT_EQ(std::pair(pair->first, pair->second), std::pair(std::size_t{3}, std::size_t{2}));
    EXPECT_EQ(pair->translation, (Point{0, 1}));
    ASSERT_EQ(pair->vertices.size(), 2u);
    EXPECT_EQ(pair->vertices.front(), std::pair(VertexId(0u), VertexId(3u)));
    EXPECT_TRUE(check_mesh(mesh).valid());
}

TEST(Periodic, CheckFindsOneUnitInTheLastPlace) {
    Mesh mesh = square();
    mesh.points[2].y = std::nextafter(1.0, 2.0);
    const MeshCheck check = check_mesh(mesh);
    ASSERT_EQ(check.defect_count, 1u);
    EXPECT_NE(check.defects.front().description.find("no exact copies"), std::string::npos);
    mesh.markers[2].kind = MarkerKind::other;
    EXPECT_NE(check_mesh(mesh).defects.front().description.find("in place of two"), std::string::npos);
}

TEST(Periodic, CopiesAreJoined) {
    for (const std::size_t copies : {1, 2, 3, 5}) {
        const Mesh joined = mesh::joined_copies(square(), copies);
        const MeshCheck check = check_mesh(joined);
        EXPECT_TRUE(check.valid());
        EXPECT_EQ(check.area, static_cast<double>(copies));
        EXPECT_EQ(joined.points.size(), 2 * copies + 2);
    }
    Mesh other = square();
    for (Marker& marker : other.markers) marker.kind = MarkerKind::far_field;
    EXPECT_THROW(mesh::joined_copies(other, 2), UsageError);
}

}  // namespace
}  // namespace lamina
