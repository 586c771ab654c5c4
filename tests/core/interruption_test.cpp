// Work that is no longer wanted ends on all threads, and leaves nothing behind.
#include <lamina/interruption.hpp>

#include <atomic>
#include <chrono>
#include <stdexcept>
#include <thread>

#include <gtest/gtest.h>

#include <lamina/threads.hpp>

#include "core/interruption_point.hpp"
#include "core/parallel.hpp"

namespace lamina {
namespace {

using namespace std::chrono_literals;

TEST(Interruption, NobodyAsksWithoutIt) {
    core::check_interruption();
    EXPECT_EQ(core::current_interruption, nullptr);
}

TEST(Interruption, EndsALoopOnAllThreads) {
    for (const unsigned threads : {1u, 2u, 5u}) {
        std::atomic<std::size_t> blocks = 0;
        std::atomic<bool> unwanted = false;
        const auto work = [&] {
            with_threads(threads, [&] {
                core::parallel_for(1'000'000, 1, [&](std::size_t, std::size_t) {
                    if (++blocks == 20) unwanted = true;
                    std::this_thread::sleep_for(1ms);
                });
            });
        };
        EXPECT_THROW(with_interruption([&] { return unwanted.load(); }, work), Interrupted);
        // 20 ms between questions on the first thread.
        EXPECT_LT(blocks, 20'000u);
        EXPECT_EQ(core::current_interruption, nullptr);
    }
}

TEST(Interruption, EndsTheWorkOfOtherThreads) {
    std::atomic<bool> unwanted = false;
    bool ended = false;
    const auto look_until_it_ends = [] {
        for (;;) {
            core::check_interruption();
            std::this_thread::sleep_for(1ms);
        }
    };
    const auto work = [&] {
        std::thread other([&, interruption = core::current_interruption] {
            const core::InterruptionScope scope(interruption);
            unwanted = true;
            EXPECT_THROW(look_until_it_ends(), Interrupted);
            ended = true;
        });
        EXPECT_THROW(look_until_it_ends(), Interrupted);
        other.join();
    };
    with_interruption([&] { return unwanted.load(); }, work);
    EXPECT_TRUE(ended);
}

TEST(Interruption, AsksTheCallingThreadAloneAndSeldom) {
    const std::thread::id caller = std::this_thread::get_id();
    int questions = 0;
    const auto start = std::chrono::steady_clock::now();
    with_interruption(
        [&] {
            EXPECT_EQ(std::this_thread::get_id(), caller);
            ++questions;
            return false;
        },
        [&] {
            with_threads(3, [&] {
                core::parallel_invoke([&] { core::parallel_for(100'000, 1, [](std::size_t, std::size_t) {}); },
                                      [&] { core::parallel_for(100'000, 1, [](std::size_t, std::size_t) {}); });
            });
        });
    const auto elapsed = std::chrono::steady_clock::now() - start;
    EXPECT_GE(questions, 1);
    EXPECT_LE(questions, 2 + elapsed / 20ms);
}

TEST(Interruption, LetsOtherExceptionsPass) {
    EXPECT_THROW(with_interruption([] { return false; }, [] { throw std::logic_error("other"); }), std::logic_error);
    EXPECT_THROW(with_interruption([]() -> bool { throw std::logic_error("asked"); },
                                   [] { core::parallel_for(1, 1, [](std::size_t, std::size_t) {}); }),
                 std::logic_error);
    EXPECT_EQ(core::current_interruption, nullptr);
}

TEST(Interruption, Nests) {
    // The inner question counts inside; outside, the outer one does.
    const auto look = [] { core::check_interruption(); };
    EXPECT_NO_THROW(with_interruption([] { return true; }, [&] { with_interruption([] { return false; }, look); }));
    EXPECT_THROW(with_interruption([] { return false; }, [&] { with_interruption([] { return true; }, look); }),
                 Interrupted);
    EXPECT_THROW(with_interruption([] { return true; }, look), Interrupted);
}

}  // namespace
}  // namespace lamina
