// Groups are halved at the median along their longer side. Sources that are equal there are told apart by all their
// other members, so that both halves are the same sets whatever the order of the sources.
#include "sizing/source_groups.hpp"

#include <algorithm>
#include <tuple>

#include "core/parallel.hpp"

namespace lamina::sizing {

namespace {

/// Orders sources by the middle of their shapes: by its x or its y first, then by everything.
struct ByMiddle {
    bool by_x;

    static double doubled_x(const SizeSource& s) { return s.a.x + s.b.x; }
    static double doubled_y(const SizeSource& s) { return s.a.y + s.b.y; }
    static auto all_members(const SizeSource& s) {
        return std::tuple(doubled_x(s), doubled_y(s), s.a.x, s.a.y, s.b.x, s.b.y, s.size, s.radius, s.shape);
    }
    bool operator()(const SizeSource& s, const SizeSource& t) const {
        const double at_s = by_x ? doubled_x(s) : doubled_y(s), at_t = by_x ? doubled_x(t) : doubled_y(t);
        return at_s != at_t ? at_s < at_t : all_members(s) < all_members(t);
    }
};

/// Makes the group with the number `index` and all groups below it. Its shapes begin at `first_shape`.
///
///     index   index + 1 ... | index + 2 half ...      n sources make 2 n - 1 groups
///     group   left half     | right half
void make_groups(std::span<SizeSource> sources, std::uint32_t index, std::uint32_t first_shape, SourceTree& tree) {
    SourceGroup& group = tree.groups[index];
    for (const SizeSource& s : sources) {
        const Box box = bounding_box(s);
        group.box.include(box.lower);
        group.box.include(box.upper);
        group.min_size = std::min(group.min_size, s.size);
    }
    if (sources.size() == 1) {
        group.shape = first_shape;
        tree.shapes[first_shape] = prepare_shape(sources[0]);
        return;
    }
    const std::size_t half = sources.size() / 2;
    std::nth_element(sources.begin(), sources.begin() + static_cast<std::ptrdiff_t>(half), sources.end(),
                     ByMiddle{group.box.width() >= group.box.height()});
    group.right = index + 2 * static_cast<std::uint32_t>(half);
    const auto left_half = [&] { make_groups(sources.first(half), index + 1, first_shape, tree); };
    const auto right_half = [&] {
        make_groups(sources.subspan(half), group.right, first_shape + static_cast<std::uint32_t>(half), tree);
    };
    constexpr std::size_t min_parallel_size = 4096;
    if (sources.size() > min_parallel_size) {
        core::parallel_invoke(left_half, right_half);
    } else {
        left_half();
        right_half();
    }
}

}  // namespace

SourceTree group_sources(std::span<const SizeSource> sources) {
    SourceTree tree;
    if (sources.empty()) return tree;
    std::vector<SizeSource> sorted(sources.begin(), sources.end());
    tree.groups.resize(2 * sorted.size() - 1);
    tree.shapes.resize(sorted.size());
    make_groups(sorted, 0, 0, tree);
    return tree;
}

}  // namespace lamina::sizing
