// InOrder: values are taken in the order of their places, whatever threads put them, and none after a failure.
#include <gtest/gtest.h>

#include <stdexcept>
#include <vector>

#include "core/in_order.hpp"
#include "core/parallel.hpp"

namespace lamina {
namespace {

/// Calls put(place, place) for all places below n on several threads, in an order far from ascending.
void put_all(core::InOrder<std::size_t>& in_order, std::size_t n, std::size_t step) {
    with_threads(4, [&] {
        core::parallel_for(n, 1, [&](std::size_t i, std::size_t) {
            const std::size_t place = i * step % n;
            in_order.put(place, place);
        });
    });
}

TEST(InOrder, TakesValuesInTheOrderOfTheirPlaces) {
    constexpr std::size_t n = 1009;  // prime, so that every step visits all places
    for (const std::size_t step : {1u, 2u, 500u, 1008u}) {
        std::vector<std::size_t> taken;
        core::InOrder<std::size_t> in_order([&](std::size_t value) { taken.push_back(value); });
        put_all(in_order, n, step);
        ASSERT_EQ(taken.size(), n);
        for (std::size_t i = 0; i < n; ++i) EXPECT_EQ(taken[i], i);
    }
}

TEST(InOrder, TakesNothingAfterAFailure) {
    std::vector<std::size_t> taken;
    core::InOrder<std::size_t> in_order([&](std::size_t value) {
        taken.push_back(value);
        if (value == 5) throw std::runtime_error("five");
    });
    EXPECT_THROW(put_all(in_order, 1009, 1), std::runtime_error);
    in_order.put(2000, 2000);
    EXPECT_EQ(taken, (std::vector<std::size_t>{0, 1, 2, 3, 4, 5}));
}

}  // namespace
}  // namespace lamina
