// Numbers of layers on columns that are narrower than their last layer is high, and how they lead over to wide ones.
#include "layers/narrow_columns.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <cstdlib>
#include <vector>

#include <lamina/layers.hpp>

#include "layers/isotropy.hpp"
#include "support/layers.hpp"

namespace lamina {
namespace {

constexpr double height_of_last = 1e-3;
constexpr std::uint32_t wanted = 35, least = 28, most = 45;

/// Returns the numbers of layers on these columns, of which each may have the same numbers under a level front. The last
/// layers of fewer are higher, those of more lower.
std::vector<std::uint32_t> numbers_on(const std::vector<double>& widths) {
    const layers::ColumnEnd end{0.02, height_of_last, wanted, {least, most}, 1.4 * height_of_last, 0.7 * height_of_last,
                                false};
    std::vector<std::uint32_t> counts(widths.size(), wanted);
    layers::keep_counts_on_narrow_columns(test::rays_in_a_row(widths),
                                          std::vector<layers::ColumnEnd>(widths.size(), end), counts);
    return counts;
}

TEST(NarrowColumns, HaveMoreLayersThanWideOnes) {
    const std::vector<double> widths = test::widths_with_narrow_middle(4e-3, 1e-4, 60);
    const std::vector<std::uint32_t> counts = numbers_on(widths);
    EXPECT_EQ(counts.front(), wanted);
    EXPECT_EQ(counts.back(), wanted);
    EXPECT_GE(counts[counts.size() / 2], wanted + 2) << "last layers are ten times as high as the columns are wide";
    for (std::size_t i = 0; i + 1 < counts.size(); ++i) {
        EXPECT_LE(counts[i], most);
        EXPECT_GE(counts[i], wanted);
        if (counts[i] == counts[i + 1]) continue;
        EXPECT_EQ(std::abs(int(counts[i]) - int(counts[i + 1])), 1);
        EXPECT_GT(widths[i], 0.5 * height_of_last) << "rows are sheared where numbers change on narrow columns";
    }
}

TEST(NarrowColumns, KeepTheirNumbersWhereLastLayersAreLittleHigherThanWide) {
    for (const std::uint32_t n : numbers_on(test::widths_with_narrow_middle(4e-3, 0.6 * height_of_last, 60)))
        EXPECT_EQ(n, wanted);
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
        const std::vector<double> spacings = layers::largest_spacings(test::rays_in_a_row(widths), front, 1e-6);
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
