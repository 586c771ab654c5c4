// Heights of layers on rays: what is asked for, by the growth law, up to the thickness or up to isotropy, and columns that
// end at the front.
#include "layers/heights.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

#include <fmt/format.h>

#include <lamina/error.hpp>

#include "core/parallel.hpp"
#include "layers/growth_laws.hpp"
#include "layers/isotropy.hpp"
#include "layers/least_heights.hpp"
#include "layers/mechanisms.hpp"
#include "layers/neighbours.hpp"
#include "layers/numbers.hpp"
#include "layers/stretch.hpp"

namespace lamina::layers {

namespace {

/// Largest number of layers up to isotropy; a growth that needs more is refused as a mistake.
constexpr std::uint32_t max_automatic_layers = 1000;

[[noreturn]] void throw_too_many_layers() {
    throw OptionError("layers", fmt::format("more than {} layers up to isotropy: give a larger growth, a thickness or "
                                            "their number",
                                            max_automatic_layers));
}

std::uint32_t layer_count(std::span<const double> heights) { return static_cast<std::uint32_t>(heights.size() - 1); }

/// Removes the layers above `thickness`. A slack of rounding keeps all n layers of a thickness that is exactly their
/// height.
void cut_at_thickness(double thickness, std::vector<double>& heights) {
    heights.erase(std::upper_bound(heights.begin(), heights.end(), thickness * (1 + 1e-12)), heights.end());
}

/// Returns the rays of an element alone.
RaySet rays_of_element(const RaySet& set, std::size_t element) {
    const auto line = [&](std::size_t i) { return set.lines.begin() + static_cast<std::ptrdiff_t>(i); };
    const std::size_t begin = set.begin[element], end = set.begin[element + 1];
    return {{line(begin), line(end)}, {0, end - begin}};
}

/// The heights that the growth law gives above a wall, one table for all rays of an element or one for each.
class LawHeights {
public:
    LawHeights(const RaySet& set, const LayerGrowth& growth) {
        const GrowthLawEntry& law = growth_law_entry(growth.law);
        growths_ = law.by_spacing ? law.by_spacing->on_rays(set, growth) : std::vector{law.ray_growth(growth)};
        for (const double ray_growth : growths_) {
            std::vector<double>& table = tables_.emplace_back(
                law.heights(growth.first_height, ray_growth, growth.layers.value_or(max_automatic_layers)));
            if (growth.thickness && !law.fills_thickness) cut_at_thickness(*growth.thickness, table);
        }
    }

    /// Returns Ray::growth.
    double growth(std::size_t ray) const { return growths_.size() > 1 ? growths_[ray] : growths_[0]; }
    /// Returns the heights, beginning with 0 for the wall.
    std::span<const double> of(std::size_t ray) const { return tables_.size() > 1 ? tables_[ray] : tables_[0]; }

private:
    std::vector<double> growths_;
    std::vector<std::vector<double>> tables_;
};

/// Returns the asked heights on one element.
std::vector<double> asked_on_element(const RaySet& own, const LayerGrowth& growth) {
    const LawHeights law(own, growth);
    std::vector<double> asked(own.lines.size());
    if (growth.layers) {
        for (std::size_t i = 0; i < asked.size(); ++i)
            asked[i] = own.lines[i].slant * own.lines[i].opening * law.of(i).back();
        return asked;
    }
    const std::vector<double> least = growth.least_heights.empty() ? std::vector<double>() : least_heights(own);
    asked = heights_of_isotropy(own, law.of(0), least, growth.fineness);
    for (std::size_t i = 0; i < asked.size(); ++i) {
        if (!growth.thickness && asked[i] >= own.lines[i].opening * law.of(i).back()) throw_too_many_layers();
        asked[i] *= own.lines[i].slant;
    }
    bound_slopes(own, asked);
    for (std::size_t i = 0; i < asked.size(); ++i)
        if (own.lines[i].place != RayPlace::wake_end)
            asked[i] = std::max(asked[i], first_height_along(own.lines[i], growth.first_height));
    return asked;
}

/// Returns the heights of a column up to the first one above `end`: `scale` times those of the law, with spacings of at
/// most max_spacing.
std::vector<double> heights_beyond(double end, double scale, double max_spacing, std::span<const double> of_law) {
    std::vector<double> heights{0.0};
    for (std::size_t n = 1; n < of_law.size() && heights.back() <= end; ++n)
        heights.push_back(heights.back() + std::min(scale * (of_law[n] - of_law[n - 1]), max_spacing));
    return heights;
}

/// Returns the end of a column whose layers end at `front`, where they could end higher. heights: those of unstretched
/// layers. A `fixed` number of layers that nothing cuts short stays.
ColumnEnd end_of_column(double front, double asked, bool fixed, std::span<const double> heights) {
    const bool stays = fixed && front == asked;
    const std::uint32_t n = stays ? layer_count(heights) : layers_up_to(front, heights).layers;
    const LayerRange range = stays ? LayerRange{n, n} : layer_range(front, heights, n);
    const double last_spacing = stretched_last_spacing(front, heights, n);
    return {front,
            last_spacing,
            n,
            range,
            range.least < n ? stretched_last_spacing(front, heights, range.least) : last_spacing,
            range.most > n ? stretched_last_spacing(front, heights, range.most) : last_spacing};
}

/// Returns the largest spacings on the rays of an element, along them.
std::vector<double> spacings_on_element(const RaySet& own, const LayerGrowth& growth, std::span<const double> front) {
    if (growth.least_heights.empty()) return std::vector<double>(front.size(), HUGE_VAL);
    return largest_spacings(own, front, first_heights_along(own, growth), growth.fineness);
}

/// Appends the columns of one element.
void add_columns(const RaySet& own, const LayerGrowth& growth, std::span<const double> asked,
                 std::span<const double> front, std::vector<double>& table, std::vector<HeightColumn>& columns) {
    const std::size_t n = own.lines.size();
    const LawHeights law(own, growth);
    const std::vector<double> max_spacings = spacings_on_element(own, growth, front);
    // One layer more than fits may be made to fit by its stretch.
    constexpr double fronts = 2;
    std::vector<std::vector<double>> heights(n);
    std::vector<std::uint32_t> layers(n);
    std::vector<ColumnEnd> ends(n);
    core::parallel_for(n, 256, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const double scale = own.lines[i].slant * own.lines[i].opening;
            const double beyond = growth.layers ? HUGE_VAL : fronts * front[i];
            heights[i] = heights_beyond(beyond, scale, max_spacings[i], law.of(i));
            ends[i] = end_of_column(front[i], asked[i], growth.layers.has_value(), heights[i]);
            layers[i] = ends[i].wanted;
        }
    });
    if (uses("numbers")) layers = cheapest_numbers(own, ends);
    limit_count_differences(own, layers);
    for (std::size_t i = 0; i < n; ++i) {
        if (!growth.layers && layers[i] >= max_automatic_layers) throw_too_many_layers();
        const bool cut = front[i] < asked[i], whole = growth.layers && !cut && layers[i] == layer_count(heights[i]);
        const Stretch stretch = whole ? Stretch{} : stretch_of_layers(front[i], heights[i], layers[i]);
        heights[i].resize(layers[i] + std::size_t{1});
        stretch_heights(stretch, heights[i]);
        columns.push_back({table.size(), layers[i], law.growth(i), stretch, max_spacings[i], cut});
        table.insert(table.end(), heights[i].begin(), heights[i].end());
    }
}

}  // namespace

// The factor from heights above the wall's edges beside a ray to heights along it. Rays out of a corner would otherwise make
// the cells beside it too low:
//
//       |   /           h / cos(45) along the ray is h above both walls
//     h |..o
//       | /:
//       |/_:____
void set_slants(RaySet& set) {
    constexpr double negligible = 1e-3;  // rays share their heights where it makes no difference
    if (!uses("slants")) return;
    const RayNeighbours neighbours(set);
    std::vector<double> slants(set.lines.size(), 1.0);
    for (std::size_t i = 0; i < slants.size(); ++i) {
        const RayLine& ray = set.lines[i];
        const auto [before, after] =
            wall_neighbours(set.lines[neighbours.previous[i]], ray, set.lines[neighbours.next[i]]);
        double sum = 0, edges = 0;
        const auto add_edge = [&](Point a, Point b) {
            if (a == b) return;
            sum += dot(ray.direction, -perpendicular(unit(b - a)));
            ++edges;
        };
        add_edge(before, ray.origin);
        add_edge(ray.origin, after);
        if (edges * (1 - negligible) > sum) slants[i] = edges / std::max(sum, edges / max_slant);
    }
    fill_fans(set, slants);
    for (std::size_t i = 0; i < slants.size(); ++i) set.lines[i].slant = slants[i];
}

std::vector<double> first_heights_along(const RaySet& set, const LayerGrowth& growth) {
    std::vector<double> heights;
    heights.reserve(set.lines.size());
    for (std::size_t e = 0; e < set.elements(); ++e)
        for (std::size_t i = set.begin[e]; i < set.begin[e + 1]; ++i)
            heights.push_back(first_height_along(set.lines[i], growth.first_height_on(e)));
    return heights;
}

double expected_height(const LayerGrowth& growth, double spacing) {
    const GrowthLawEntry& law = growth_law_entry(growth.law);
    const auto layers = growth.layers.value_or(max_automatic_layers);
    const double ray_growth = law.by_spacing ? law.by_spacing->expected(growth, spacing) : law.ray_growth(growth);
    const std::vector<double> heights = law.heights(growth.first_height, ray_growth, layers);
    std::size_t n = heights.size() - 1;
    if (!growth.layers)
        for (n = 1; n < layers && heights[n] - heights[n - 1] < spacing;) ++n;
    return std::min(heights[n], growth.thickness.value_or(HUGE_VAL));
}

std::vector<double> asked_heights(const RaySet& set, const LayerGrowth& growth) {
    std::vector<double> asked;
    asked.reserve(set.lines.size());
    for (std::size_t e = 0; e < set.elements(); ++e) {
        const std::vector<double> own = asked_on_element(rays_of_element(set, e), growth_on_element(growth, e));
        asked.insert(asked.end(), own.begin(), own.end());
    }
    return asked;
}

std::vector<std::uint32_t> asked_layers(const RaySet& set, const LayerGrowth& growth, std::span<const double> asked) {
    std::vector<std::uint32_t> layers;
    layers.reserve(asked.size());
    for (std::size_t e = 0; e < set.elements(); ++e) {
        const RaySet own = rays_of_element(set, e);
        const LayerGrowth own_growth = growth_on_element(growth, e);
        const LawHeights law(own, own_growth);
        const std::span<const double> own_asked = asked.subspan(set.begin[e], own.lines.size());
        const std::vector<double> max_spacings = spacings_on_element(own, own_growth, own_asked);
        for (std::size_t i = 0; i < own.lines.size(); ++i) {
            const double scale = own.lines[i].slant * own.lines[i].opening;
            const std::vector<double> heights = heights_beyond(own_asked[i], scale, max_spacings[i], law.of(i));
            layers.push_back(growth.layers ? layer_count(law.of(i)) : layers_up_to(own_asked[i], heights).layers);
        }
    }
    return layers;
}

LayerHeights columns_up_to(const RaySet& set, const LayerGrowth& growth, std::span<const double> asked,
                           std::span<const double> front) {
    std::vector<double> table;
    std::vector<HeightColumn> columns;
    columns.reserve(set.lines.size());
    for (std::size_t e = 0; e < set.elements(); ++e) {
        const std::size_t begin = set.begin[e], count = set.begin[e + 1] - begin;
        add_columns(rays_of_element(set, e), growth_on_element(growth, e), asked.subspan(begin, count),
                    front.subspan(begin, count), table, columns);
    }
    return LayerHeights(std::move(table), std::move(columns));
}

}  // namespace lamina::layers
