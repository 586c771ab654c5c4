// Layers up to isotropy hand over to triangles of about their own size.
#include <algorithm>
#include <map>

#include "pipeline/cases.hpp"

namespace lamina::test {
namespace {

CaseOptions automatic(double growth) {
    CaseOptions options;
    options.layer.first_height = 1e-5;
    options.layer.growth = growth;
    options.layer.layers.reset();
    options.far_field.size = 10;
    return options;
}

/// Layer over isotropic area, edge by edge, sorted.
std::vector<double> area_ratios(const Mesh& mesh) {
    struct Side {
        bool layer;
        double area;
    };
    std::map<Segment, Side> sides;
    std::vector<double> ratios;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const VertexId* v = mesh.triangles[t].v;
        const Point a = mesh.points[v[0].index()], b = mesh.points[v[1].index()], c = mesh.points[v[2].index()];
        const Side here{mesh.region[t] == Region::layer, 0.5 * cross(b - a, c - a)};
        for (int i = 0; i < 3; ++i) {
            const VertexId p = v[i], q = v[(i + 1) % 3];
            const auto [there, first] = sides.emplace(Segment{std::min(p, q), std::max(p, q)}, here);
            if (first || there->second.layer == here.layer) continue;
            ratios.push_back(here.layer ? here.area / there->second.area : there->second.area / here.area);
        }
    }
    std::sort(ratios.begin(), ratios.end());
    return ratios;
}

/// The figures asked of every smooth section, and those of the check itself.
void expect_hand_over(std::initializer_list<shapes::Outline> bodies, const CaseOptions& options) {
    const MeshResult result = mesh_of(bodies, options);
    expect_sound(result, options);
    const std::vector<double> ratios = area_ratios(result.mesh);
    const TransitionSummary& summary = result.check.transition;
    ASSERT_GT(ratios.size(), 50u);
    ASSERT_EQ(summary.edges, ratios.size());
    const auto percentile = [&](std::size_t percent) { return ratios[(ratios.size() - 1) * percent / 100]; };
    EXPECT_NEAR(summary.p01_area_ratio / percentile(1), 1, 1e-9);
    EXPECT_NEAR(summary.median_area_ratio / percentile(50), 1, 1e-9);
    EXPECT_NEAR(summary.p99_area_ratio / percentile(99), 1, 1e-9);
    EXPECT_GT(percentile(50), 0.4);
    EXPECT_LT(percentile(50), 2.5);
    EXPECT_GT(percentile(1), 0.15);
    EXPECT_LT(percentile(99), 6);
}

TEST(HandOver, SymmetricCamberedBluntAndCoarseSections) {
    for (const double growth : {1.1, 1.2, 1.3}) {
        SCOPED_TRACE(growth);
        expect_hand_over({naca("0012", 200)}, automatic(growth));
        expect_hand_over({naca("4415", 120)}, automatic(growth));
        expect_hand_over({naca("2412", 141, TrailingEdge::blunt)}, automatic(growth));
        expect_hand_over({naca("23012", 60)}, automatic(growth));
        expect_hand_over({shapes::joukowski(0.1, 0.1, 160)}, automatic(growth));
    }
}

TEST(HandOver, TwoElements) {
    const shapes::Outline flap = shapes::moved(naca("2412", 120), -0.5, 0.3, {1.005, -0.03});
    expect_hand_over({naca("4412", 160), flap}, automatic(1.2));
}

}  // namespace
}  // namespace lamina::test
