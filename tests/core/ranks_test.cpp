// Ranks that join what they have: the same on any number of them, and what becomes of failures.
#include <gtest/gtest.h>

#include <atomic>
#include <cstddef>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include <lamina/error.hpp>

#include "support/thread_ranks.hpp"

namespace lamina::test {
namespace {

std::string concatenated(std::string_view one, std::string_view other) { return std::string(one) + std::string(other); }

TEST(Ranks, JoinTheirBytesInTheirOrder) {
    for (const unsigned n : {1u, 2u, 3u, 4u, 5u, 7u, 8u}) {
        SCOPED_TRACE(n);
        std::vector<std::size_t> joins(n);
        const std::string failure = run_ranks(n, [&](core::ConnectedRanks& ranks) {
            const std::string own(1, static_cast<char>('a' + ranks.rank()));
            for (int repeat = 0; repeat < 20; ++repeat) {
                const std::string all = ranks.reduce(own, [&](std::string_view one, std::string_view other) {
                    ++joins[ranks.rank()];
                    return concatenated(one, other);
                });
                EXPECT_EQ(all, ranks.rank() == 0 ? std::string("abcdefgh").substr(0, n) : "");
            }
        });
        EXPECT_EQ(failure, "");
        std::size_t sum = 0;
        for (const std::size_t of_rank : joins) {
            EXPECT_LE(of_rank, 20u * 3u);
            sum += of_rank;
        }
        EXPECT_EQ(sum, 20u * (n - 1));
    }
}

// The first ranks tell each other something several times in a row, while others do something else.
TEST(Ranks, TellSomeOthers) {
    for (const unsigned n : {1u, 2u, 5u, 8u})
        for (unsigned members = 1; members <= n; ++members) {
            SCOPED_TRACE(testing::Message() << members << " of " << n);
            const std::string failure = run_ranks(n, [&](core::ConnectedRanks& ranks) {
                for (int repeat = 0; ranks.rank() < members && repeat < 20; ++repeat) {
                    std::vector<std::string> expected;
                    for (unsigned rank = 0; rank < members; ++rank)
                        expected.push_back(std::to_string(repeat) + std::string(rank, 'x'));
                    EXPECT_EQ(ranks.all_gather_among(members, expected[ranks.rank()]), expected);
                }
                EXPECT_EQ(ranks.all_gather("").size(), n);
            });
            EXPECT_EQ(failure, "");
        }
}

// All ranks get the bytes of all, however late one of them has told its own, and whether they look for them or wait.
// What they do next together is not disturbed.
TEST(Ranks, TellAllWhileTheyGoOn) {
    for (const unsigned n : {1u, 2u, 9u, 10u, 75u})
        for (const unsigned late : {0u, n / 2, n - 1}) {
            SCOPED_TRACE(testing::Message() << late << " of " << n);
            std::atomic<unsigned> others = 0;
            const std::string failure = run_ranks(n, [&](core::ConnectedRanks& ranks) {
                for (int repeat = 0; repeat < 3; ++repeat) {
                    std::vector<std::string> expected;
                    for (unsigned rank = 0; rank < n; ++rank)
                        expected.push_back(std::to_string(repeat) + std::string(rank, 'x'));
                    if (ranks.rank() == late)
                        while (others < (n - 1) * (static_cast<unsigned>(repeat) + 1)) std::this_thread::yield();
                    const auto pending = ranks.start_all_gather(expected[ranks.rank()]);
                    if (ranks.rank() != late) {
                        EXPECT_FALSE(pending->is_there());
                        ++others;
                    }
                    while (ranks.rank() % 2 == 0 && !pending->is_there()) std::this_thread::yield();
                    EXPECT_EQ(pending->take(), expected);
                }
                EXPECT_EQ(ranks.all_gather("").size(), n);
            });
            EXPECT_EQ(failure, "");
        }
}

// A rank that does not take what it is told passes it on still.
TEST(Ranks, PassOnWhatTheyDoNotNeed) {
    EXPECT_EQ(run_ranks(12,
                        [](core::ConnectedRanks& ranks) {
                            const auto pending = ranks.start_all_gather("bytes");
                            if (ranks.rank() == 1) throw MeshError("has no need of it");
                            EXPECT_EQ(pending->take().size(), 12u);
                        }),
              "has no need of it");
}

TEST(Ranks, EndTogetherWhereOneCannotJoin) {
    for (const unsigned failing : {0u, 2u}) {
        const std::string failure = run_ranks(4, [&](core::ConnectedRanks& ranks) {
            ranks.reduce("bytes", [&](std::string_view one, std::string_view other) {
                if (ranks.rank() == failing) throw MeshError("cannot be joined");
                return concatenated(one, other);
            });
            ranks.agree();
        });
        EXPECT_NE(failure.find("cannot be joined"), std::string::npos) << failure;
        EXPECT_EQ(failure.find("differently"), std::string::npos) << failure;
    }
}

}  // namespace
}  // namespace lamina::test
