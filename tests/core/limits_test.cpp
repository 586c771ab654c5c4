// Estimates of runs, and limits on them.
#include <gtest/gtest.h>

#include <string>

#include <lamina/limits.hpp>

#include "core/limits.hpp"

namespace lamina::test {
namespace {

constexpr WorkCost plain_cost{1000, 10, 1e-6};

TEST(Limits, MemoryIsReadAndPrinted) {
    EXPECT_EQ(core::parse_memory("1000000"), 1'000'000u);
    EXPECT_EQ(core::parse_memory("500M"), std::size_t{500} << 20);
    EXPECT_EQ(core::parse_memory("2G"), std::size_t{2} << 30);
    EXPECT_EQ(core::parse_memory("1.5GiB"), std::size_t{3} << 29);
    EXPECT_EQ(core::parse_memory("64kb"), std::size_t{64} << 10);
    for (const char* text : {"", "G", "-1G", "1X", "1GG", "nan", "1 G", "0", "1e400", "99999999T"})
        EXPECT_THROW(core::parse_memory(text), UsageError) << text;
    for (const std::size_t bytes : {std::size_t{1}, std::size_t{1000}, std::size_t{3} << 20, std::size_t{5} << 40})
        EXPECT_EQ(core::parse_memory(core::memory_text(bytes)), bytes);
    EXPECT_EQ(core::memory_text(std::size_t{3} << 29), "1536M");
}

TEST(Limits, EstimatesGrowWithTheTriangles) {
    const RunEstimate one = estimate_run(2e6, plain_cost, 1);
    EXPECT_EQ(one.memory_bytes, 1000 + 10 * 2e6);
    EXPECT_EQ(one.seconds, 2);
    EXPECT_LT(estimate_run(2e6, plain_cost, 2).seconds, 1.5);
    EXPECT_EQ(estimate_text(one), "about 2.0 million triangles, 20 MiB of memory and 2.0 s");
    EXPECT_EQ(estimate_text(estimate_run(3.7e9, plain_cost, 1)),
              "about 3.7 billion triangles, 34 GiB of memory and 62 min");
}

TEST(Limits, RunsBeyondThemAreRefusedWithTheEstimate) {
    const RunEstimate estimate = estimate_run(2e6, plain_cost, 1);
    EXPECT_NO_THROW(require_within({}, estimate, "far_size", "0.1"));
    EXPECT_NO_THROW(require_within({2'000'000, 30'000'000}, estimate, "far_size", "0.1"));
    const auto expect_refused = [&](const WorkLimits& limits, const RunEstimate& run, const std::string& said) {
        try {
            require_within(limits, run, "far_size", "0.1");
            ADD_FAILURE() << said;
        } catch (const LimitError& error) {
            EXPECT_EQ(error.option(), "far_size");
            EXPECT_EQ(error.estimate().triangles, run.triangles);
            EXPECT_NE(error.reason().find("0.1 asks for about "), std::string::npos) << error.what();
            EXPECT_NE(error.reason().find(said), std::string::npos) << error.what();
        }
    };
    expect_refused({1'000'000, {}}, estimate, "1000000 triangles are allowed (--max-triangles)");
    expect_refused({{}, std::size_t{1} << 20}, estimate, "1 MiB of memory are allowed (--max-memory)");
    expect_refused({}, estimate_run(1e10, plain_cost, 1), "can be numbered");
    expect_refused({}, estimate_run(1e300, plain_cost, 1), "1.0e+300 triangles");
}

TEST(Limits, AllowedTrianglesSuitAllLimits) {
    EXPECT_EQ(allowed_triangles({}, plain_cost), core::max_numbered_triangles);
    EXPECT_EQ(allowed_triangles({500, {}}, plain_cost), 500);
    EXPECT_EQ(allowed_triangles({500, 2000}, plain_cost), 100);
    EXPECT_EQ(allowed_triangles({{}, 10}, plain_cost), 0);
}

}  // namespace
}  // namespace lamina::test
