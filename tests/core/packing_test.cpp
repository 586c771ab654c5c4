// Values that go through bytes come back.
#include <gtest/gtest.h>

#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "core/difference_packing.hpp"
#include "core/packing.hpp"

namespace lamina::test {
namespace {

TEST(Packing, GivesCountsBack) {
    std::mt19937 random(5);
    for (int repeat = 0; repeat < 300; ++repeat) {
        std::vector<std::uint32_t> counts(random() % 50);
        for (std::uint32_t& count : counts)
            count = random() % 3 != 0 ? 0u : static_cast<std::uint32_t>(random() >> random() % 32);
        core::Packer packer;
        packer.put_counts(counts);
        packer.put_short(7);
        const std::string bytes = packer.take();
        core::Unpacker unpacker(bytes);
        const std::vector<std::uint32_t> back = unpacker.get_counts();
        while (!counts.empty() && counts.back() == 0) counts.pop_back();
        EXPECT_EQ(back, counts);
        EXPECT_EQ(unpacker.get_short(), 7u);
        EXPECT_TRUE(unpacker.at_end());
    }
}

TEST(Packing, TakesFewBytesForZeros) {
    std::vector<std::uint32_t> counts(1000, 0);
    counts[3] = counts[900] = 1;
    core::Packer packer;
    packer.put_counts(counts);
    EXPECT_LT(packer.take().size(), 12u);
}

TEST(Packing, GivesNumbersBackByTheirDifferences) {
    std::mt19937 random(6);
    for (int repeat = 0; repeat < 300; ++repeat) {
        std::vector<std::uint32_t> numbers(random() % 200);
        std::uint32_t last = 100;
        for (std::uint32_t& number : numbers)
            number = last =
                random() % 8 != 0 ? last + random() % 5 - 2 : static_cast<std::uint32_t>(random() >> random() % 32);
        core::DifferencePacker packer;
        for (const std::uint32_t number : numbers) packer.put(number);
        const std::string bytes = packer.take();
        core::DifferenceUnpacker unpacker(bytes);
        for (const std::uint32_t number : numbers) {
            EXPECT_FALSE(unpacker.at_end());
            EXPECT_EQ(unpacker.get(), number);
        }
        EXPECT_TRUE(unpacker.at_end());
    }
    core::DifferencePacker packer;
    for (int i = 0; i < 800; ++i) packer.put(7);
    EXPECT_LT(packer.take().size(), 102u);
}

}  // namespace
}  // namespace lamina::test
