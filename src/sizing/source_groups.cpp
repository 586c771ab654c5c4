// Groups are halved at the median along their longer side. What is equal there is told apart by everything else that
// sources have, so that either half is one and the same set whatever the order in which sources are given.
#include "sizing/source_groups.hpp"

#include <tuple>

#include "core/parallel.hpp"

namespace lamina::sizing {

namespace {

struct ByPlace {
    bool by_x;

    static double across(const SizeSource& s) { return s.a.x + s.b.x; }
    static double up(const SizeSource& s) { return s.a.y + s.b.y; }
    static auto all(const SizeSource& s) {
        return std::tuple(across(s), up(s), s.a.x, s.a.y, s.b.x, s.b.y, s.size, s.radius, s.shape);
    }
    bool operator()(const SizeSource& s, const SizeSource& t) const {
        const double at_s = by_x ? across(s) : up(s), at_t = by_x ? across(t) : up(t);
        return at_s != at_t ? at_s < at_t : all(s) < all(t);
    }
};

/// Makes the group number `index` of sources, and those below it:
///
///     index   index + 1 ... | index + 2 half ...      n sources make 2 n - 1 groups
///     group   left half     | right half
void make_groups(std::span<SizeSource> sources, std::uint32_t index, std::uint32_t first_cone, SourceTree& tree) {
    SourceGroup& group = tree.groups[index];
    for (const SizeSource& s : sources) {
        const Box box = bounding_box(s);
        group.box.include(box.lower);
        group.box.include(box.upper);
        group.smallest = std::min(group.smallest, s.size);
    }
    if (sources.size() == 1) {
        group.cone = first_cone;
        tree.cones[first_cone] = make_cone(sources[0]);
        return;
    }
    const std::size_t half = sources.size() / 2;
    std::nth_element(sources.begin(), sources.begin() + static_cast<std::ptrdiff_t>(half), sources.end(),
                     ByPlace{group.box.width() >= group.box.height()});
    group.right = index + 2 * static_cast<std::uint32_t>(half);
    const auto left_half = [&] { make_groups(sources.first(half), index + 1, first_cone, tree); };
    const auto right_half = [&] {
        make_groups(sources.subspan(half), group.right, first_cone + static_cast<std::uint32_t>(half), tree);
    };
    constexpr std::size_t worth_a_task = 4096;
    if (sources.size() > worth_a_task) {
        core::parallel_invoke(left_half, right_half);
    } else {
        left_half();
        right_half();
    }
}

}  // namespace

bool Cone::covers(const Box& box) const {
    if (radius == 0 && shape == SizeSource::Shape::segment) return false;
    const std::array<Point, 4> corners = box.corners();
    return std::all_of(corners.begin(), corners.end(), [&](Point p) { return distance_to(p) == 0; });
}

Cone make_cone(const SizeSource& s) {
    const Point along = s.b - s.a;
    const double squared = squared_length(along);
    return {s.a, along, squared > 0 ? 1.0 / squared : 0.0, s.radius, s.shape};
}

SourceTree group_sources(std::span<const SizeSource> sources) {
    SourceTree tree;
    if (sources.empty()) return tree;
    std::vector<SizeSource> sorted(sources.begin(), sources.end());
    tree.groups.resize(2 * sorted.size() - 1);
    tree.cones.resize(sorted.size());
    make_groups(sorted, 0, 0, tree);
    return tree;
}

}  // namespace lamina::sizing

namespace lamina {

using namespace sizing;

double distance_to(const SizeSource& source, Point p) { return make_cone(source).distance_to(p); }

Box bounding_box(const SizeSource& source) {
    Box box;
    box.include(source.a);
    box.include(source.b);
    const Point swell{source.radius, source.radius};
    return {box.lower - swell, box.upper + swell};
}

}  // namespace lamina
