// Patches: changes of their connectivity, and how they settle.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include <lamina/delaunay.hpp>

#include "core/predicates.hpp"
#include "delaunay/refine/patch.hpp"
#include "delaunay/triangulate/link_triangles.hpp"
#include "support/point_sets.hpp"

namespace lamina::test {
namespace {

using namespace delaunay;

/// Returns the Delaunay triangulation of these points as a patch, whose hull is fixed.
Patch patch_of(const std::vector<Point>& points) {
    Patch patch;
    patch.points = points;
    patch.is_fixed.assign(points.size(), 0);
    patch.degrees.assign(points.size(), 0);
    patch.tris = link_triangles(triangulate(points).triangles, {});
    patch.core = static_cast<Index>(patch.tris.size());
    for (const Tri& t : patch.tris)
        for (unsigned e = 0; e < 3; ++e) {
            ++patch.degrees[t.v[e]];
            if (t.n[e].is_border()) patch.is_fixed[t.v[next(e)]] = patch.is_fixed[t.v[previous(e)]] = 1;
        }
    return patch;
}

double area_of(const Patch& patch) {
    double area = 0;
    for (Index t = 0; t < patch.tris.size(); ++t) {
        if (patch.is_removed(t)) continue;
        const Point a = patch.points[patch.tris[t].v[0]];
        area += 0.5 * cross(patch.points[patch.tris[t].v[1]] - a, patch.points[patch.tris[t].v[2]] - a);
    }
    return area;
}

int defects_of(const Patch& patch) {
    int sum = 0;
    for (Index v = 0; v < patch.points.size(); ++v) {
        const int defect = static_cast<int>(patch.degrees[v]) - 6;
        if (!patch.is_fixed[v]) sum += defect * defect;
    }
    return sum;
}

std::size_t count_triangles(const Patch& patch) {
    std::size_t count = 0;
    for (Index t = 0; t < patch.tris.size(); ++t) count += !patch.is_removed(t);
    return count;
}

/// Checks links, degrees and orientations.
void expect_consistent(const Patch& patch) {
    std::vector<unsigned> degrees(patch.points.size(), 0);
    for (Index t = 0; t < patch.tris.size(); ++t) {
        if (patch.is_removed(t)) continue;
        const Tri& tri = patch.tris[t];
        EXPECT_GT(core::inline_orient2d(patch.points[tri.v[0]], patch.points[tri.v[1]], patch.points[tri.v[2]]), 0);
        for (unsigned e = 0; e < 3; ++e) {
            ++degrees[tri.v[e]];
            const Link across = tri.n[e];
            if (across.is_border()) continue;
            ASSERT_FALSE(patch.is_removed(across.triangle()));
            const Tri& other = patch.tris[across.triangle()];
            EXPECT_EQ(other.n[across.edge()], Link(t, e, across.is_constrained()));
            EXPECT_EQ(other.v[next(across.edge())], tri.v[previous(e)]);
            EXPECT_EQ(other.v[previous(across.edge())], tri.v[next(e)]);
        }
    }
    EXPECT_EQ(degrees, patch.degrees);
}

void expect_delaunay(const Patch& patch) {
    for (Index t = 0; t < patch.tris.size(); ++t) {
        const Tri& tri = patch.tris[t];
        for (const Link across : tri.n) {
            if (across.is_constrained()) continue;
            const Index d = patch.tris[across.triangle()].v[across.edge()];
            EXPECT_LE(core::inline_incircle_perturbed(patch.points[tri.v[0]], patch.points[tri.v[1]],
                                                      patch.points[tri.v[2]], patch.points[d]),
                      0);
        }
    }
}

TEST(Patch, ChangesKeepItConsistent) {
    PatchSettler settler;
    std::size_t counts[3] = {0, 0, 0};
    for (std::uint64_t seed = 1; seed <= 8; ++seed) {
        SCOPED_TRACE(seed);
        const Patch patch = patch_of(random_points(60, seed));
        expect_consistent(patch);
        for (const Change& change : find_changes(patch)) {
            SCOPED_TRACE(testing::Message() << int(change.kind) << ' ' << change.t << ' ' << change.e);
            Patch changed = patch;
            if (!apply(changed, change)) continue;
            ++counts[static_cast<std::size_t>(change.kind)];
            expect_consistent(changed);
            EXPECT_LE(change.defect_change, 0);
            EXPECT_EQ(defects_of(changed), defects_of(patch) + change.defect_change);
            const int more = change.kind == Change::Kind::flip ? 0 : change.kind == Change::Kind::merge ? -2 : 2;
            EXPECT_EQ(int(count_triangles(changed)), int(count_triangles(patch)) + more);
            EXPECT_NEAR(area_of(changed), area_of(patch), 1e-12);
            const double cost = cost_of(changed);
            EXPECT_LT(settler.settle(changed, HUGE_VAL), cost);
            expect_consistent(changed);
            expect_delaunay(changed);
        }
    }
    for (const std::size_t count : counts) EXPECT_GT(count, 100u);
}

TEST(Patch, SettlesIntoARegularLattice) {
    // A hexagon of a lattice whose inner vertices were moved. Rows are as high as a number with few digits, so that the
    // vertices on each side of the hexagon lie exactly on a line.
    const double row = std::ldexp(std::round(std::ldexp(std::sqrt(0.75), 40)), -40);
    std::vector<Point> lattice;
    for (int j = -4; j <= 4; ++j)
        for (int i = -4; i <= 4; ++i)
            if (std::abs(i + j) <= 4) lattice.push_back({i + 0.5 * j, row * j});
    std::vector<Point> moved = lattice;
    Random random(1);
    const Patch regular = patch_of(lattice);
    for (std::size_t v = 0; v < moved.size(); ++v)
        if (!regular.is_fixed[v]) moved[v] = moved[v] + Point{random.real(-0.2, 0.2), random.real(-0.2, 0.2)};
    Patch patch = patch_of(moved);
    PatchSettler settler;
    double cost = settler.settle(patch, HUGE_VAL);
    for (int i = 0; i < 10; ++i) cost = settler.settle(patch, HUGE_VAL);
    EXPECT_NEAR(cost, PatchSettler::vertex_cost * double(lattice.size()), 1e-9);
    for (std::size_t v = 0; v < lattice.size(); ++v) EXPECT_LT(distance(patch.points[v], lattice[v]), 1e-5);
}

}  // namespace
}  // namespace lamina::test
