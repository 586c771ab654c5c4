// check_simple() against a plain test of all pairs of edges.
#include <cmath>
#include <random>
#include <utility>

#include <gtest/gtest.h>

#include <lamina/geometry.hpp>
#include <lamina/predicates.hpp>

#include "support/shapes.hpp"

namespace lamina {
namespace {

bool accepted(const Geometry& geometry) {
    try {
        check_simple(geometry);
        return true;
    } catch (const InputError&) {
        return false;
    }
}
bool accepted(const shapes::Outline& outline) { return accepted(shapes::geometry({outline})); }

int sign(double v) { return (v > 0) - (v < 0); }

/// Returns whether the closed segments ab and cd have a point in common.
bool meet(Point a, Point b, Point c, Point d) {
    const int oa = sign(orient2d(c, d, a)), ob = sign(orient2d(c, d, b)), oc = sign(orient2d(a, b, c)),
              od = sign(orient2d(a, b, d));
    Box ab, cd;
    ab.include(a), ab.include(b), cd.include(c), cd.include(d);
    if (oa == 0 && ob == 0) return ab.overlaps(cd);
    return oa * ob <= 0 && oc * od <= 0;
}

bool is_simple_by_brute_force(const shapes::Outline& p) {
    const std::size_t n = p.size();
    double doubled_area = 0;
    for (std::size_t i = 0; i < n; ++i) {
        const Point a = p[i], b = p[(i + 1) % n];
        if (a == b) return false;
        doubled_area += cross(a, b);
        for (std::size_t j = i + 1; j < n; ++j) {
            const Point c = p[j], d = p[(j + 1) % n];
            if (j == i + 1 || (j + 1) % n == i) {
                const Point middle = j == i + 1 ? b : a, e = j == i + 1 ? a : b, f = j == i + 1 ? d : c;
                if (orient2d(e, middle, f) == 0 && dot(e - middle, f - middle) > 0) return false;
            } else if (meet(a, b, c, d)) {
                return false;
            }
        }
    }
    return doubled_area > 0;
}

TEST(CheckSimple, AgreesWithAllPairsOnRandomPolygons) {
    std::mt19937 random(11);
    std::size_t simple = 0, cases = 0;
    for (int grid : {4, 6, 1000}) {
        for (int i = 0; i < 20000; ++i, ++cases) {
            shapes::Outline p(3 + random() % 6);
            for (Point& q : p)
                q = {static_cast<double>(random() % static_cast<unsigned>(grid)),
                     static_cast<double>(random() % static_cast<unsigned>(grid))};
            const bool expected = is_simple_by_brute_force(p);
            simple += expected;
            ASSERT_EQ(accepted(p), expected) << "case " << cases;
        }
    }
    EXPECT_GT(simple, cases / 50);
}

TEST(CheckSimple, AcceptsSimpleShapesAtAnyAngle) {
    std::mt19937 random(12);
    for (const shapes::Outline& p :
         {shapes::circle(1, 500), shapes::joukowski(0.1, 0.1, 300), shapes::l_shape(), shapes::c_shape(0.1),
          shapes::comb(20, 0.01), shapes::star(300, 0.1, random), shapes::plate(0.02, 20)}) {
        for (double angle : {0.0, 0.4, 1.5707963267948966, 2.5}) {
            const shapes::Outline image = shapes::moved(p, angle, 3, {5, 7});
            EXPECT_TRUE(accepted(image));
            EXPECT_FALSE(accepted(shapes::Outline(image.rbegin(), image.rend()))) << "clockwise";
        }
    }
}

TEST(CheckSimple, FindsOneBadEdgeAmongMany) {
    shapes::Outline p = shapes::joukowski(0.1, 0.05, 2000);
    ASSERT_TRUE(accepted(p));
    // One point of the upper surface is moved below the lower surface.
    p[400].y -= 1;
    EXPECT_FALSE(accepted(p));
}

TEST(CheckSimple, IsQuickForMillionsOfPoints) { EXPECT_TRUE(accepted(shapes::ellipse(1, 0.01, 1'000'000))); }

TEST(CheckSimple, IsExact) {
    // A vertex lies one unit in the last place above, on, or below the opposite edge y = x.
    for (const auto& [y, expected] :
         {std::pair{std::nextafter(0.5, 1.0), true}, {0.5, false}, {std::nextafter(0.5, 0.0), false}})
        EXPECT_EQ(accepted(shapes::polygon({{0, 0}, {1, 1}, {0.75, 2}, {0.5, y}, {0.25, 2}})), expected) << y;
}

TEST(CheckSimple, SeveralBodies) {
    const shapes::Outline a = shapes::box(), b = shapes::moved(shapes::box(), 0, 1, {1.5, 0});
    EXPECT_TRUE(accepted(shapes::geometry({a, b})));
    EXPECT_FALSE(accepted(shapes::geometry({a, a})));
    EXPECT_FALSE(accepted(shapes::geometry({a, shapes::moved(a, 0, 1, {1, 0})}))) << "a common edge";
    EXPECT_FALSE(accepted(shapes::geometry({a, shapes::moved(a, 0, 1, {1, 1})}))) << "a common corner";
    EXPECT_FALSE(accepted(shapes::geometry({a, shapes::moved(a, 0, 0.5, {0.25, 0.25})}))) << "inside";
    EXPECT_FALSE(accepted(shapes::geometry({a, shapes::moved(a, 0, 1, {0.5, 0.5})}))) << "crossing";
    // The second body lies in the cove of the first, outside of it.
    EXPECT_TRUE(accepted(shapes::geometry({shapes::c_shape(0.1), shapes::moved(a, 0, 0.5, {0.7, 0.7})})));
}

TEST(CheckSimple, RefusesPointsThatAreNoOutline) {
    EXPECT_TRUE(accepted(Geometry{}));
    EXPECT_FALSE(accepted(shapes::polygon({})));
    EXPECT_FALSE(accepted(shapes::polygon({{0, 0}, {1, 0}})));
    EXPECT_FALSE(accepted(shapes::polygon({{0, 0}, {1, 0}, {1, 0}, {0, 1}})));
    EXPECT_FALSE(accepted(shapes::polygon({{0, 0}, {1, 0}, {HUGE_VAL, 1}})));
    EXPECT_FALSE(accepted(shapes::polygon({{0, 0}, {1, 0}, {NAN, 1}})));
}

}  // namespace
}  // namespace lamina
