// Numbers of layers on columns that are narrower than their last layer is high, and how they lead over to wide ones.
#include <gtest/gtest.h>

#include <vector>

#include <lamina/layers.hpp>

#include "layers/isotropy.hpp"

namespace lamina {
namespace {

/// Returns rays in a row below a wall, so far apart.
RaySet rays_apart(const std::vector<double>& widths) {
    RaySet set;
    double x = 0;
    for (const double width : widths) {
        set.lines.push_back({{x, 0}, {0, -1}});
        x += width;
    }
    set.begin.push_back(widths.size());
    return set;
}

/// One narrow column asks for low cells. On wide ones beside it numbers of layers fall by one from ray to ray, also where
/// the front rises, so that layers would be the more the higher it is.
TEST(NarrowColumns, LowCellsDoNotSpreadUnderFrontsThatRise) {
    for (const double rise : {1.0, 1.04, 1.08}) {
        SCOPED_TRACE(rise);
        std::vector<double> widths(41, 0.01), front(41);
        widths[0] = 1e-5;
        front[0] = 0.02;
        // The front rises from the narrow column at the beginning on both sides, up to the middle of the row.
        for (std::size_t i = 1; i <= 20; ++i) front[i] = front[41 - i] = rise * front[i - 1];
        const std::vector<double> spacings = layers::largest_spacings(rays_apart(widths), front, 1e-6);
        for (std::size_t i = 2; i <= 20; ++i) {
            const double number = front[i] / spacings[i], before = front[i - 1] / spacings[i - 1];
            EXPECT_LE(number, before * (1 + 1e-12)) << i;
            if (1.5 * spacings[i - 1] < widths[i]) {
                EXPECT_LE(number, before - 0.95) << i;
            }
        }
        EXPECT_GE(spacings[20], widths[20] * (1 - 1e-12)) << "as high as wide after twenty columns";
    }
}

}  // namespace
}  // namespace lamina
