// The quadtree that a size field is sampled on; internal to sizing.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <lamina/sizing.hpp>

namespace lamina::sizing {

/// Points are looked up by fixed-point coordinates of key_bits bits within the root's square.
inline constexpr int key_bits = 52;
inline constexpr int root_shift = key_bits - 2;

/// A wide node is two levels of the quadtree: 4 x 4 slots, one cache line. A slot holds the next wide node, or a leaf
/// of a quarter of the node's side, or a leaf of half its side, which fills four slots.
using Slots = std::array<std::uint32_t, 16>;
inline constexpr std::uint32_t leaf_bit = 1u << 31;
inline constexpr std::uint32_t half_bit = 1u << 30;
inline constexpr std::uint32_t index_mask = half_bit - 1;

/// h at lower left, lower right, upper left, upper right, in units of the root's side.
using Leaf = std::array<float, 4>;

/// A tree, or a part of one: entries of nodes lead to nodes and leaves of the same part. The first node is the root.
struct SizeTree {
    std::vector<Slots> nodes;
    std::vector<Leaf> leaves;

    /// Puts another part behind this one and returns the place of its root.
    std::uint32_t append(const SizeTree& other);
};

/// Samples min(max_size, min over sources (size + gradation x distance)) on a square with this lower left corner and
/// side, so finely that bilinear interpolation in every leaf is within SizeField::relative_error of it.
SizeTree build_size_tree(std::span<const SizeSource> sources, const SizeFieldOptions& options, Point lower,
                         double side);

}  // namespace lamina::sizing
