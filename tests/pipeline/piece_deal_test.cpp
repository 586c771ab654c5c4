// deal_pieces(): every piece is made once, the kept ones where they are kept, and no process is bound to more than its
// share of the others.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <vector>

#include "core/random.hpp"
#include "pipeline/sharing/piece_deal.hpp"

namespace lamina::test {
namespace {

TEST(PieceDeal, GivesEachPieceToOneProcessOrToAll) {
    core::Random random(7);
    for (const unsigned processes : {1u, 2u, 5u, 40u}) {
        SCOPED_TRACE(processes);
        std::vector<decoupling::EstimatedBorder> borders(100);
        double work = 0;
        for (decoupling::EstimatedBorder& border : borders) {
            border.work = 1000 + static_cast<float>(random.below(50'000));
            border.process = static_cast<unsigned>(random.below(processes));
            border.kept = random.below(4) == 0;
            if (!border.kept) work += border.work;
        }
        std::vector<int> times(borders.size(), 0);
        const std::vector<int> once(borders.size(), 1);
        const std::vector<std::size_t> shared = pipeline::deal_pieces(borders, 0, processes).shared;
        EXPECT_EQ(shared.empty(), processes == 1);
        for (const std::size_t piece : shared) {
            EXPECT_FALSE(borders[piece].kept);
            ++times[piece];
        }
        const auto is_larger = [&](std::size_t a, std::size_t b) { return borders[a].work > borders[b].work; };
        for (unsigned process = 0; process < processes; ++process) {
            const pipeline::PieceDeal deal = pipeline::deal_pieces(borders, process, processes);
            EXPECT_EQ(deal.shared, shared);
            double own_work = 0;
            for (const std::size_t piece : deal.own) {
                EXPECT_EQ(borders[piece].process, process);
                if (!borders[piece].kept) own_work += borders[piece].work;
                ++times[piece];
            }
            EXPECT_LE(own_work, work / processes * (1 + 1e-12));
            EXPECT_TRUE(std::is_sorted(deal.own.begin(), deal.own.end(), is_larger));
            EXPECT_TRUE(std::is_sorted(deal.shared.begin(), deal.shared.end(), is_larger));
        }
        EXPECT_EQ(times, once);
    }
}

}  // namespace
}  // namespace lamina::test
