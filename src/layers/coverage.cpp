// What became of the layers asked for, everywhere and where nothing stands in their way.
#include "layers/coverage.hpp"

#include <algorithm>

#include "core/box_tree.hpp"
#include "core/parallel.hpp"
#include "core/segments.hpp"

namespace lamina::layers {

namespace {

/// Walls that come nearer to the middle of the circle than this share of its radius lie in it. The wall at the ray's
/// own origin does not, though its edges dip into the circle where the wall is concave there.
constexpr double inner_share = 0.95;

/// True of each ray whose circle of open_space full heights across, touching the wall at the ray's origin, holds no
/// wall. The largest empty circle is a measure of free space that knows slots, corners and tight curvature alike.
std::vector<char> open_rays(const RaySet& set, const LayerHeights& heights, std::span<const std::size_t> next) {
    std::vector<Box> boxes;
    for (std::size_t i = 0; i < set.lines.size(); ++i)
        boxes.push_back(core::bounding_box(set.lines[i].origin, set.lines[next[i]].origin));
    const core::BoxTree walls(std::move(boxes));
    const auto no_values = walls.group_minima(std::vector<double>(set.lines.size(), 0.0));
    std::vector<char> open(set.lines.size());
    core::parallel_for(set.lines.size(), 512, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const double radius = 0.5 * open_space * heights.full_height(i), inner = inner_share * radius;
            const Point middle = set.lines[i].origin + radius * set.lines[i].direction;
            const double nearest = walls.minimum(middle, 1, inner, no_values, [&](std::size_t j) {
                return core::distance_to_segment(middle, set.lines[j].origin, set.lines[next[j]].origin);
            });
            open[i] = nearest >= inner;
        }
    });
    return open;
}

void add_cells(std::uint32_t requested, std::uint32_t made, LayerCoverage& coverage) {
    coverage.requested_cells += requested;
    coverage.made_cells += made;
}

void add_ray(bool complete, LayerCoverage& coverage) {
    ++coverage.rays;
    coverage.incomplete_rays += !complete;
}

}  // namespace

std::vector<ElementCoverage> layer_coverage(const RaySet& set, const LayerHeights& heights,
                                            std::span<const std::uint32_t> counts) {
    const std::vector<std::size_t> next = set.following();
    const std::vector<char> open = open_rays(set, heights, next);
    std::vector<ElementCoverage> coverage(set.elements());
    for (std::size_t e = 0; e < set.elements(); ++e) {
        auto& [everywhere, in_the_open] = coverage[e];
        for (std::size_t i = set.begin[e]; i < set.begin[e + 1]; ++i) {
            const std::uint32_t asked = heights.column(i).layers, asked_next = heights.column(next[i]).layers;
            const std::uint32_t requested = std::min(asked, asked_next), made = std::min(counts[i], counts[next[i]]);
            add_ray(counts[i] == asked, everywhere);
            add_cells(requested, made, everywhere);
            if (open[i]) add_ray(counts[i] == asked, in_the_open);
            if (open[i] && open[next[i]]) add_cells(requested, made, in_the_open);
        }
    }
    return coverage;
}

}  // namespace lamina::layers

namespace lamina {

using namespace layers;

ElementCoverage& ElementCoverage::operator+=(const ElementCoverage& other) {
    const auto add = [](LayerCoverage& to, const LayerCoverage& from) {
        to.rays += from.rays;
        to.incomplete_rays += from.incomplete_rays;
        to.requested_cells += from.requested_cells;
        to.made_cells += from.made_cells;
    };
    add(all, other.all);
    add(open, other.open);
    return *this;
}

}  // namespace lamina
