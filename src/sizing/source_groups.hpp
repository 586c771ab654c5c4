// Sources of the size field, grouped by place.
#pragma once

#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include <lamina/sizing.hpp>

#include "core/bounding_box.hpp"
#include "sizing/shapes.hpp"

namespace lamina::sizing {

/// A node of a binary tree of sources: a group of several sources, or a single one.
struct SourceGroup {
    Box box;
    double min_size = HUGE_VAL;  ///< of the sources in the group
    std::uint32_t right = 0;     ///< the right child; the left child follows its parent
    std::uint32_t shape = 0;     ///< of a single source: its index in SourceTree::shapes

    bool is_single() const { return right == 0; }
    /// Returns the longer side of the box.
    double extent() const { return core::longer_side(box); }
};

/// A binary tree of groups of sources. The first group is the root.
struct SourceTree {
    std::vector<SourceGroup> groups;
    std::vector<SourceShape> shapes;
};

/// Groups sources. The tree depends on the set of sources alone, neither on their order nor on the number of threads.
/// O(n log n).
SourceTree group_sources(std::span<const SizeSource> sources);

}  // namespace lamina::sizing
