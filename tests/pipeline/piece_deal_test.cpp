// deal_pieces(): every piece that is not made yet is made once, and no process is bound to more than its share.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <vector>

#include "core/random.hpp"
#include "pipeline/piece_deal.hpp"

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
            border.made = random.below(4) == 0;
            if (!border.made) work += border.work;
        }
        std::vector<int> times, once;
        for (const decoupling::EstimatedBorder& border : borders) once.push_back(!border.made);
        times.resize(borders.size(), 0);
        const std::vector<std::size_t> shared = pipeline::deal_pieces(borders, 0, processes).shared;
        EXPECT_EQ(shared.empty(), processes == 1);
        for (const std::size_t piece : shared) ++times[piece];
        const auto is_larger = [&](std::size_t a, std::size_t b) { return borders[a].work > borders[b].work; };
        for (unsigned process = 0; process < processes; ++process) {
            const pipeline::PieceDeal deal = pipeline::deal_pieces(borders, process, processes);
            EXPECT_EQ(deal.shared, shared);
            double own_work = 0;
            for (const std::size_t piece : deal.own) {
                EXPECT_EQ(borders[piece].process, process);
                own_work += borders[piece].work;
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
