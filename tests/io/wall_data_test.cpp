// The table of the walls.
#include <gtest/gtest.h>

#include <cmath>

#include <lamina/io.hpp>

#include "support/sample_meshes.hpp"
#include "support/temporary_folder.hpp"
#include "support/wall_data.hpp"

namespace lamina {
namespace {

using test::annulus;
using test::TemporaryFolder;

TEST(WallData, OfACircle) {
    const TemporaryFolder folder;
    for (const bool quads : {false, true}) {
        const std::size_t n = 24;
        write_wall_data(annulus({.around = n, .quads_in_layer = quads}), folder / "w.csv");
        const auto rows = test::read_wall_rows(folder.read("w.csv"));
        ASSERT_EQ(rows.size(), n);
        const double edge = 2 * std::sin(M_PI / n), gap = 0.2 * std::cos(M_PI / n);
        for (std::size_t i = 0; i < n; ++i) {
            EXPECT_EQ(rows[i].marker, "wall");
            EXPECT_EQ(rows[i].vertex, i);
            EXPECT_NEAR(rows[i].arc_length, edge * static_cast<double>(i), 1e-14);
            EXPECT_NEAR(distance(rows[i].normal, rows[i].at), 0, 1e-14);  // the circle has radius 1
            EXPECT_NEAR(rows[i].first_height, gap, 1e-14);
        }
    }
}

}  // namespace
}  // namespace lamina
