// A radix sort on all threads.
#pragma once

#include <cstdint>
#include <vector>

namespace lamina::delaunay {

/// Sorts different items, where those that agree in the bits from `first_bit` up to `end_bit` ascend already. The bits
/// from `end_bit` up are 0. Precondition: there are 11 bits to sort by, at least.
void sort_by_bits(std::vector<std::uint64_t>& items, unsigned first_bit, unsigned end_bit);

}  // namespace lamina::delaunay
