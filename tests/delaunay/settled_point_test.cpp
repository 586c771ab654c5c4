// Places of new vertices that rounding errors do not change.
#include "delaunay/triangulate/settled_point.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include <lamina/predicates.hpp>

#include "core/random.hpp"

namespace lamina::delaunay {
namespace {

TEST(SettledPoint, IsNearAndTheSameAfterRoundingErrors) {
    core::Random random(62);
    int changed = 0;
    for (int i = 0; i < 10'000; ++i) {
        const double h = std::exp2(random.real(-20, 5));
        const Point p{random.real(-100, 100), random.real(-100, 100)};
        const Point settled = settled_point(p, h);
        ASSERT_LE(distance(settled, p), 0.003 * h);
        changed += !(settled_point(p + 1e-9 * h * Point{1, -1}, h) == settled);
    }
    EXPECT_LT(changed, 10) << "one in a hundred thousand coordinates is expected";
}

/// The corners of a square lie on a circle; where they are settled to, they do not.
TEST(SettledPoint, LeavesFewPointsOnOneCircle) {
    core::Random random(300);
    int on_circle = 0;
    for (int i = 0; i < 1000; ++i) {
        const Point at{random.real(-1, 1), random.real(-1, 1)}, side{0.1, 0}, up{0, 0.1};
        const Point a = settled_point(at, 0.1), b = settled_point(at + side, 0.1),
                    c = settled_point(at + side + up, 0.1), d = settled_point(at + up, 0.1);
        on_circle += incircle(a, b, c, d) == 0;
    }
    EXPECT_LE(on_circle, 2);
}

TEST(SettledPoint, ScalesExactlyWithPowersOfTwo) {
    core::Random random(256);
    for (int i = 0; i < 1000; ++i) {
        const Point p{random.real(-10, 10), random.real(-10, 10)};
        const double h = random.real(0.01, 1);
        ASSERT_EQ(settled_point(0.25 * p, 0.25 * h), 0.25 * settled_point(p, h));
    }
}

}  // namespace
}  // namespace lamina::delaunay
