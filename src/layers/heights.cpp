// Heights of layers on rays, by the growth law, up to the thickness or up to isotropy.
#include "layers/heights.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <lamina/error.hpp>

#include "layers/fit_heights.hpp"
#include "layers/growth_laws.hpp"
#include "layers/isotropy.hpp"
#include "layers/least_heights.hpp"
#include "layers/mechanisms.hpp"
#include "layers/narrow_columns.hpp"
#include "layers/neighbours.hpp"

namespace lamina::layers {

namespace {

/// Largest number of layers up to isotropy; a growth that needs more is refused as a mistake.
constexpr std::uint32_t max_automatic_layers = 1000;
/// Largest rise of the front that slants add, per unit of distance along it.
constexpr double max_rise_of_slants = 0.35;

/// Removes the layers above `thickness`. A slack of rounding keeps all n layers of a thickness that is exactly their
/// height.
void cut_at_thickness(double thickness, std::vector<double>& heights) {
    heights.erase(std::upper_bound(heights.begin(), heights.end(), thickness * (1 + 1e-12)), heights.end());
}

std::uint32_t layer_count(const std::vector<double>& heights) { return static_cast<std::uint32_t>(heights.size() - 1); }

/// Returns the heights up to the first one above the front: those of the law times the opening, with spacings of at
/// most max_spacing.
std::vector<double> heights_up_to(double front, double opening, double max_spacing, std::span<const double> of_law) {
    std::size_t n = 1;
    for (double height = 0; n < of_law.size() && height <= front; ++n)
        height += std::min(opening * (of_law[n] - of_law[n - 1]), max_spacing);
    std::vector<double> heights(of_law.begin(), of_law.begin() + static_cast<std::ptrdiff_t>(n));
    open_heights(opening, heights);
    limit_spacings(max_spacing, heights);
    return heights;
}

/// Returns, for each ray, the factor from heights above the wall's edges beside it to heights along it. Rays out of a
/// corner would otherwise make the cells beside it too low:
///
///       |   /           h / cos(45) along the ray is h above both walls
///     h |..o
///       | /:
///       |/_:____
std::vector<double> slants_of(const RaySet& set) {
    constexpr double negligible = 1e-3;  // rays share their heights where it makes no difference
    const RayNeighbours neighbours(set);
    std::vector<double> result(set.lines.size(), 1.0);
    for (std::size_t i = 0; i < result.size(); ++i) {
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
        if (edges * (1 - negligible) > sum) result[i] = edges / std::max(sum, edges / max_slant);
    }
    fill_fans(set, result);
    return result;
}

/// Lowers the front where slants, which it is multiplied by, would make it rise steeply. First heights need the slants of
/// rays as they are, and where the wall turns inwards below rays that lean to one side, slants jump, and rows with them:
///
///                      .______                 .______
///       --..__         |           --..__    .-`
///             ``--..__ |                 ``.`             last row: as slants are, and lowered
///                     `|
///
///       --..__                     --..__
///             ``--..______               ``--..______     wall, the outside above; all rays lean to the right
///
/// No column ends below its first layer.
void level_slants(const RaySet& set, std::span<const double> slants, double first_height, std::vector<double>& front) {
    std::vector<double> level(slants.begin(), slants.end());
    lower_to_neighbours(set, level, [&](std::size_t from, std::size_t to) {
        const RayLine &a = set.lines[from], &b = set.lines[to];
        const double height = std::max(front[from], front[to]);
        const Point apart = b.origin - a.origin + height * (b.direction - a.direction);
        return height > 0 ? level[from] + max_rise_of_slants * length(apart) / height : HUGE_VAL;
    });
    for (std::size_t i = 0; i < front.size(); ++i)
        if (level[i] < slants[i])
            front[i] =
                std::max(front[i] * (level[i] / slants[i]), std::min(front[i], set.lines[i].opening * first_height));
}

/// Returns columns that end where their ray reaches isotropy, or, where there are any, at the least heights. Whole
/// layers would make the front a staircase, so columns are stretched to end at its height.
LayerHeights heights_up_to_isotropy(const RaySet& set, std::span<const double> slants, double ray_growth,
                                    const std::vector<double>& unstretched, const LayerGrowth& growth) {
    const std::vector<double> least = growth.least_heights.empty() ? std::vector<double>() : least_heights(set);
    std::vector<double> front = heights_of_isotropy(set, unstretched, least, growth.fineness);
    if (!least.empty() && uses("level_slants")) level_slants(set, slants, unstretched[1], front);
    const std::vector<double> max_spacings = least.empty()
                                                 ? std::vector<double>(front.size(), HUGE_VAL)
                                                 : largest_spacings(set, front, unstretched[1], growth.fineness);
    constexpr double fronts = 2;  // so far: narrow columns may keep more layers than their own
    std::vector<std::vector<double>> heights;
    heights.reserve(front.size());
    for (std::size_t i = 0; i < front.size(); ++i)
        heights.push_back(heights_up_to(fronts * front[i], set.lines[i].opening, max_spacings[i], unstretched));
    std::vector<std::uint32_t> layers;
    layers.reserve(front.size());
    for (std::size_t i = 0; i < front.size(); ++i)
        layers.push_back(set.lines[i].place == RayPlace::wake_end ? 0 : layers_up_to(front[i], heights[i]).layers);
    if (std::any_of(layers.begin(), layers.end(), [](auto n) { return n >= max_automatic_layers; }))
        throw OptionError("layers", fmt::format("more than {} layers up to isotropy: give a larger growth, a thickness "
                                                "or their number",
                                                max_automatic_layers));
    limit_count_differences(set, layers);
    if (!least.empty()) {
        std::vector<ColumnEnd> ends;
        ends.reserve(front.size());
        for (std::size_t i = 0; i < front.size(); ++i) {
            const std::uint32_t n = layers[i];
            const LayerRange range = layer_range(front[i], heights[i], n);
            ends.push_back({slants[i] * front[i], n > 0 ? slants[i] * (heights[i][n] - heights[i][n - 1]) : 0.0, n,
                            range, slants[i] * stretched_last_spacing(front[i], heights[i], range.least),
                            slants[i] * stretched_last_spacing(front[i], heights[i], range.most), false});
        }
        keep_counts_on_narrow_columns(set, ends, layers);
        limit_count_differences(set, layers);
    }
    std::vector<double> table;
    std::vector<HeightColumn> columns;
    columns.reserve(layers.size());
    for (std::size_t i = 0; i < layers.size(); ++i) {
        const Stretch stretch = stretch_of_layers(front[i], heights[i], layers[i]);
        columns.push_back({table.size(), layers[i], ray_growth, stretch, 1, max_spacings[i], set.lines[i].opening});
        table.insert(table.end(), heights[i].begin(), heights[i].begin() + layers[i] + 1);
        stretch_heights(stretch, std::span(table).subspan(columns.back().first));
    }
    return LayerHeights(std::move(table), std::move(columns));
}

/// Returns columns of which each has its own growth and its own part of the table.
LayerHeights heights_by_spacing(const RaySet& set, const LayerGrowth& growth, const GrowthLawEntry& law) {
    const std::vector<double> ray_growths = law.by_spacing->on_rays(set, growth);
    std::vector<double> table;
    std::vector<HeightColumn> columns;
    columns.reserve(ray_growths.size());
    for (double ray_growth : ray_growths) {
        std::vector<double> heights = law.heights(growth.first_height, ray_growth, *growth.layers);
        if (growth.thickness) cut_at_thickness(*growth.thickness, heights);
        columns.push_back({table.size(), layer_count(heights), ray_growth});
        table.insert(table.end(), heights.begin(), heights.end());
    }
    return LayerHeights(std::move(table), std::move(columns));
}

/// Makes heights above the wall's edges heights along the rays.
LayerHeights slanted(std::span<const double> slants, const LayerHeights& heights) {
    return changed_columns(
        heights, slants.size(), [&](std::size_t ray) { return slants[ray] != 1; },
        [&](std::size_t ray, HeightColumn& column, std::span<double> along) {
            column.slant = slants[ray];
            for (double& height : along) height *= column.slant;
        });
}

/// Returns heights of which those on each ray are multiplied by its opening.
LayerHeights opened(const RaySet& set, const LayerHeights& heights) {
    return changed_columns(
        heights, set.lines.size(), [&](std::size_t ray) { return set.lines[ray].opening != 1; },
        [&](std::size_t ray, HeightColumn& column, std::span<double> own) {
            column.opening = set.lines[ray].opening;
            open_heights(column.opening, own);
        });
}

/// Returns the heights above the wall, of which heights along the rays are these slants times as much.
LayerHeights upright_heights(const RaySet& set, std::span<const double> slants, const LayerGrowth& growth) {
    const GrowthLawEntry& law = growth_law_entry(growth.law);
    if (law.by_spacing) return opened(set, heights_by_spacing(set, growth, law));
    const double ray_growth = law.ray_growth(growth);
    std::vector<double> table =
        law.heights(growth.first_height, ray_growth, growth.layers.value_or(max_automatic_layers));
    if (growth.thickness && !law.fills_thickness) cut_at_thickness(*growth.thickness, table);
    if (!growth.layers) return heights_up_to_isotropy(set, slants, ray_growth, table, growth);
    const HeightColumn all{0, layer_count(table), ray_growth};
    return opened(set, LayerHeights(std::move(table), std::vector<HeightColumn>(set.lines.size(), all)));
}

}  // namespace

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

LayerHeights make_heights(const RaySet& set, const LayerGrowth& growth) {
    std::vector<double> table;
    std::vector<HeightColumn> columns;
    columns.reserve(set.lines.size());
    for (std::size_t e = 0; e < set.elements(); ++e) {
        const auto lines = set.lines.begin();
        const RaySet own{
            {lines + static_cast<std::ptrdiff_t>(set.begin[e]), lines + static_cast<std::ptrdiff_t>(set.begin[e + 1])},
            {0, set.begin[e + 1] - set.begin[e]}};
        const std::vector<double> slants = uses("slants") ? slants_of(own) : std::vector<double>(own.lines.size(), 1.0);
        const LayerHeights heights = slanted(slants, upright_heights(own, slants, growth_on_element(growth, e)));
        for (std::size_t i = 0; i < own.lines.size(); ++i) {
            columns.push_back(heights.column(i));
            columns.back().first += table.size();
        }
        table.insert(table.end(), heights.table().begin(), heights.table().end());
    }
    return LayerHeights(std::move(table), std::move(columns));
}

}  // namespace lamina::layers

namespace lamina {

double LayerHeights::max_height() const {
    double highest = 0;
    for (std::size_t i = 0; i < columns_.size(); ++i) highest = std::max(highest, full_height(i));
    return highest;
}

}  // namespace lamina
