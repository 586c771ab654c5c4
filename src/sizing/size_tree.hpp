// The quadtree on which a size field is sampled.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <lamina/sizing.hpp>

namespace lamina::sizing {

/// Points are looked up by keys: fixed-point coordinates of key_bits bits within the root's square.
inline constexpr int key_bits = 52;
/// A slot of the root has the side 2^root_shift in units of keys.
inline constexpr int root_shift = key_bits - 2;

/// A wide node is two levels of the quadtree: 4 x 4 slots, one cache line. A slot leads to the next wide node, to a
/// leaf of a quarter of the node's side, or to a leaf of half its side, which fills four slots.
using Slots = std::array<std::uint32_t, 16>;

/// The parts of a slot's entry: whether it leads to a leaf, whether that leaf fills four slots, and the index of the
/// leaf. An entry that leads to a node is the index of the node.
inline constexpr std::uint32_t leaf_bit = 1u << 31;
inline constexpr std::uint32_t half_bit = 1u << 30;
inline constexpr std::uint32_t index_mask = half_bit - 1;

/// The field at the lower left, lower right, upper left and upper right corner, in units of the root's side.
using Leaf = std::array<float, 4>;

/// A tree, or a part of one: the entries of its nodes lead to its own nodes and leaves. The first node is the root.
struct SizeTree {
    std::vector<Slots> nodes;
    std::vector<Leaf> leaves;

    /// Appends another part and returns the index of its root.
    std::uint32_t append(const SizeTree& other);
};

/// Samples min(max_size, min over sources (size + gradation x distance)) on the square with this lower left corner and
/// side, so finely that bilinear interpolation in every leaf is within SizeField::relative_error of it. The tree does
/// not depend on the order of the sources nor on the number of threads.
SizeTree build_size_tree(std::span<const SizeSource> sources, const SizeFieldOptions& options, Point lower,
                         double side);

}  // namespace lamina::sizing
