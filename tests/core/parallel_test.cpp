// Parallel loops visit every block once, keep results in order, and fail in a way that does not depend on timing.
#include "core/parallel.hpp"

#include <atomic>
#include <chrono>
#include <functional>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "core/busy_times.hpp"

namespace lamina {
namespace {

TEST(ParallelFor, VisitsEveryIndexOnce) {
    for (const unsigned threads : {1u, 2u, 5u})
        for (const std::size_t n :
             {std::size_t{0}, std::size_t{1}, std::size_t{99}, std::size_t{100}, std::size_t{101}}) {
            std::vector<std::atomic<int>> visits(n);
            with_threads(threads, [&] {
                core::parallel_for(n, 10, [&](std::size_t begin, std::size_t end) {
                    EXPECT_EQ(begin % 10, 0u);
                    EXPECT_LE(end - begin, 10u);
                    EXPECT_LT(core::thread_index(), threads);
                    for (std::size_t i = begin; i < end; ++i) ++visits[i];
                });
            });
            for (const auto& count : visits) EXPECT_EQ(count, 1);
        }
}

TEST(ParallelFor, Nests) {
    std::atomic<int> calls = 0;
    with_threads(4, [&] {
        core::parallel_for(8, 1, [&](std::size_t, std::size_t) {
            core::parallel_for(8, 1, [&](std::size_t, std::size_t) { ++calls; });
        });
    });
    EXPECT_EQ(calls, 64);
}

TEST(ParallelFor, ThrowsTheFailureOfTheLowestBlock) {
    for (int repeat = 0; repeat < 50; ++repeat)
        for (const unsigned threads : {1u, 4u}) {
            std::string caught;
            try {
                with_threads(threads, [&] {
                    core::parallel_for(1000, 1, [&](std::size_t i, std::size_t) {
                        if (i % 100 == 17) throw std::runtime_error(std::to_string(i));
                    });
                });
            } catch (const std::runtime_error& error) {
                caught = error.what();
            }
            EXPECT_EQ(caught, "17");
        }
}

TEST(ParallelInvoke, RunsBothAndNests) {
    for (const unsigned threads : {1u, 4u})
        with_threads(threads, [&] {
            std::atomic<int> leaves = 0;
            const std::function<void(int)> divide = [&](int depth) {
                if (depth == 0) {
                    ++leaves;
                } else {
                    core::parallel_invoke([&] { divide(depth - 1); }, [&] { divide(depth - 1); });
                }
            };
            divide(10);
            EXPECT_EQ(leaves, 1024);
        });
}

TEST(ParallelInvoke, RethrowsTheFailureOfTheFirstTask) {
    for (int repeat = 0; repeat < 50; ++repeat)
        for (const unsigned threads : {1u, 4u}) {
            std::string caught;
            bool both = false;
            try {
                with_threads(threads, [&] {
                    core::parallel_invoke([] { throw std::runtime_error("f"); },
                                          [&] {
                                              both = true;
                                              throw std::runtime_error("g");
                                          });
                });
            } catch (const std::runtime_error& error) {
                caught = error.what();
            }
            EXPECT_EQ(caught, "f");
            EXPECT_TRUE(both);
        }
}

TEST(ParallelBlocks, ComeInOrder) {
    with_threads(4, [&] {
        const auto first = core::parallel_blocks(1000, 7, [](std::size_t begin, std::size_t) { return begin; });
        ASSERT_EQ(first.size(), 143u);
        for (std::size_t b = 0; b < first.size(); ++b) EXPECT_EQ(first[b], 7 * b);
    });
}

TEST(BusyTimes, WorkWithinWorkCountsOnce) {
    const auto wait = [](int milliseconds) { std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds)); };
    with_threads(1, [&] {
        core::BusyTimes times;
        const auto begun = std::chrono::steady_clock::now();
        {
            const core::BusyTimes::Scope outer(&times, 0);
            wait(2);
            {
                const core::BusyTimes::Scope inner(&times, 1);
                wait(20);
            }
            wait(2);
        }
        const double elapsed = std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
        ASSERT_EQ(times.threads(), 1u);
        EXPECT_GE(times.seconds(0, 0), 0.004);
        EXPECT_GE(times.seconds(0, 1), 0.02);
        EXPECT_EQ(times.seconds(0, 2), 0);
        EXPECT_LE(times.seconds(0, 0) + times.seconds(0, 1), elapsed);
        const core::BusyTimes::Scope measures_nothing(nullptr, 1);
    });
}

TEST(WithThreads, SetsTheirNumber) {
    for (const unsigned threads : {1u, 3u, 7u}) with_threads(threads, [&] { EXPECT_EQ(thread_count(), threads); });
    with_threads(0, [&] { EXPECT_GE(thread_count(), 1u); });
}

}  // namespace
}  // namespace lamina
