// Background meshes, whose sizes are linear in their triangles.
#include "sizing/background.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include <lamina/error.hpp>

#include "pipeline/cases.hpp"
#include "sizing/requests.hpp"

namespace lamina::test {
namespace {

SizedMesh rectangle(const Box& box, const std::array<double, 4>& sizes) {
    const auto v = [](std::size_t i) { return VertexId(i); };
    return {{box.lower, {box.upper.x, box.lower.y}, box.upper, {box.lower.x, box.upper.y}},
            {{{v(0), v(1), v(2)}}, {{v(0), v(2), v(3)}}},
            {sizes.begin(), sizes.end()}};
}

std::shared_ptr<const SizedMesh> shared(SizedMesh mesh) { return std::make_shared<const SizedMesh>(std::move(mesh)); }

/// A size that the background mesh requests at a point.
struct RequestedSize {
    Point at;
    double size;
};

/// Interpolates at the weighted mean of the corners of a triangle.
RequestedSize interpolated(const SizedMesh& mesh, const Triangle& t, const std::array<double, 3>& weights) {
    RequestedSize request{{0, 0}, 0};
    for (int k = 0; k < 3; ++k) {
        request.at = request.at + weights[k] * mesh.points[t.v[k].index()];
        request.size += weights[k] * mesh.sizes[t.v[k].index()];
    }
    return request;
}

TEST(Background, PointsAreWithinATenthOfTheInterpolation) {
    const double gradation = 0.1;
    const Box domain{{-10, -10}, {10, 10}};
    const std::array<std::array<double, 3>, 5> weights{
        {{1. / 3, 1. / 3, 1. / 3}, {0.5, 0.5, 0}, {0, 0.5, 0.5}, {0.1, 0.2, 0.7}, {0.9, 0.05, 0.05}}};
    for (const std::array<double, 4>& sizes :
         {std::array{0.05, 0.05, 0.05, 0.05}, std::array{0.01, 0.5, 0.1, 1.0}, std::array{3.0, 3.0, 0.02, 4.0}}) {
        const SizedMesh mesh = rectangle({{-1, -2}, {3, 1}}, sizes);
        const auto sources = sizing::background_sources(mesh, gradation, domain);
        EXPECT_GT(sources.size(), mesh.points.size());
        EXPECT_LT(sources.size(), 10000u);
        const SizeField field = size_field_of_mesh(mesh, {.gradation = gradation}, domain);
        for (const Triangle& t : mesh.triangles)
            for (const auto& w : weights) {
                const RequestedSize request = interpolated(mesh, t, w);
                double size = HUGE_VAL;
                for (const SizeSource& s : sources)
                    size = std::min(size, s.size + gradation * distance(s.a, request.at));
                EXPECT_LE(size, 1.1 * request.size);
                EXPECT_LE(field(request.at), (1 + SizeField::relative_error) * size);
            }
    }
}

TEST(Background, FineEnoughMeshesNeedNoMorePointsAndNoneOutsideTheDomain) {
    const Box domain{{-1, -1}, {1, 1}};
    EXPECT_EQ(sizing::background_sources(rectangle({{0, 0}, {1, 1}}, {1, 1, 1, 1}), 0.1, domain).size(), 4u);
    EXPECT_EQ(sizing::background_sources(rectangle({{2, 2}, {3, 3}}, {1e-9, 1e-9, 1e-9, 1e-9}), 0.1, domain).size(),
              4u);
    EXPECT_THROW(sizing::background_sources(rectangle({{0, 0}, {1, 1}}, {1e-9, 1e-9, 1e-9, 1e-9}), 0.1, domain),
                 UsageError);
    EXPECT_THROW(sizing::background_sources(rectangle({{0, 0}, {1, 1}}, {1, 1, 0, 1}), 0.1, domain), UsageError);
}

double mean_edge(const Mesh& mesh, const Triangle& t) {
    double sum = 0;
    for (int k = 0; k < 3; ++k) sum += distance(mesh.points[t.v[k].index()], mesh.points[t.v[(k + 1) % 3].index()]);
    return sum / 3;
}

TEST(Background, AUniformSizeFillsItsAreaAndNoMore) {
    CaseOptions options = quick_options(5);
    const double h = 0.02;
    options.sizing.background = shared(rectangle({{1.5, -0.5}, {2.5, 0.5}}, {h, h, h, h}));
    const MeshResult result = mesh_of({naca("0012")}, options);
    expect_sound(result, options);
    expect_nothing_left_over(result);
    double smallest = HUGE_VAL;
    for (const Triangle& t : result.mesh.triangles) {
        const Point p = result.mesh.points[t.v[0].index()];
        if (std::abs(p.x - 2) > 0.45 || std::abs(p.y) > 0.45) continue;
        EXPECT_LT(mean_edge(result.mesh, t), max_circle_ratio * (1 + SizeField::relative_error) * h);
        smallest = std::min(smallest, mean_edge(result.mesh, t));
    }
    EXPECT_GT(smallest, 0.3 * h);
}

TEST(Background, ClosesTheLoop) {
    CaseOptions options = quick_options(5);
    const MeshResult first = mesh_of({naca("2412")}, options);
    // The size is linear, so triangles of any size interpolate it exactly.
    const auto requested_size = [](Point p) { return 0.15 + 0.02 * p.x; };
    SizedMesh sizes{first.mesh.points, first.mesh.triangles, {}};
    for (Point p : sizes.points) sizes.sizes.push_back(requested_size(p));
    options.sizing.background = shared(sizes);
    const MeshResult second = mesh_of({naca("2412")}, options);
    expect_sound(second, options);
    expect_nothing_left_over(second);
    EXPECT_EQ(second.check.delaunay_violations, 0u);

    std::size_t follow = 0, all = 0;
    for (std::size_t i = 0; i < second.mesh.triangles.size(); ++i) {
        const Triangle& t = second.mesh.triangles[i];
        const Point p = second.mesh.points[t.v[0].index()];
        if (second.mesh.region[i] != Region::isotropic || std::abs(p.y) < 0.5 || std::abs(p.y) > 3) continue;
        const double h = requested_size(p), edge = mean_edge(second.mesh, t);
        EXPECT_LT(edge, 1.5 * h);
        if (std::abs(p.y) < 1.5) continue;  // the layer's border requests smaller sizes near the body
        ++all;
        follow += edge > 0.5 * h && edge < 2 * h;
    }
    EXPECT_GT(all, 2000u);
    EXPECT_GT(double(follow), 0.99 * double(all));
}

TEST(Background, DividesTheLayersBorder) {
    CaseOptions options = quick_options(5);
    const double h = 0.003;
    const Box box{{0.3, -0.1}, {0.6, 0.3}};
    options.sizing.background = shared(rectangle(box, {h, h, h, h}));
    const MeshResult result = mesh_of({naca("2412")}, options);
    expect_sound(result, options);
    expect_nothing_left_over(result);
    std::size_t inside = 0;
    for (const Segment& edge : result.mesh.constraints) {
        const Point a = result.mesh.points[edge.a.index()], b = result.mesh.points[edge.b.index()];
        if (!box.contains(midpoint(a, b))) continue;
        ++inside;
        EXPECT_LE(distance(a, b), 1.1 * 1.02 * sizing::frozen_share * h);
    }
    EXPECT_GT(inside, 150u);
}

TEST(Background, DoesNotDependOnThreads) {
    CaseOptions options = quick_options(5);
    options.sizing.background = shared(rectangle({{-1, -1}, {3, 1}}, {0.1, 0.02, 0.05, 0.2}));
    options.threads = 1;
    const MeshResult one = mesh_of({naca("0012")}, options);
    options.threads = 4;
    const MeshResult four = mesh_of({naca("0012")}, options);
    EXPECT_TRUE(one.mesh.points == four.mesh.points);
    EXPECT_TRUE(one.mesh.triangles == four.mesh.triangles);
}

}  // namespace
}  // namespace lamina::test
