// The heights of the requested layers on each ray.
#pragma once

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include <lamina/layers.hpp>

namespace lamina::layers {

/// Returns heights of which some columns are others: change(ray, column, heights) changes a column and its heights where
/// is_changed(ray), in a part of the table of its own.
template <class IsChanged, class Change>
LayerHeights changed_columns(const LayerHeights& heights, std::size_t rays, IsChanged is_changed, Change change) {
    std::vector<double> table = heights.table();
    std::vector<HeightColumn> columns;
    columns.reserve(rays);
    for (std::size_t i = 0; i < rays; ++i) {
        HeightColumn& column = columns.emplace_back(heights.column(i));
        if (!is_changed(i)) continue;
        column.first = table.size();
        const std::span<const double> before = heights.of(i);
        table.insert(table.end(), before.begin(), before.end());
        change(i, column, std::span(table).subspan(column.first));
    }
    return LayerHeights(std::move(table), std::move(columns));
}

/// Returns the height of all requested layers over a wall whose vertices lie `spacing` apart. It is an estimate where
/// the number of layers or the growth depends on the spacing.
double expected_height(const LayerGrowth& growth, double spacing);

/// Returns the heights of the requested layers on each ray. Throws OptionError where more than 1000 layers would be
/// needed up to isotropy.
LayerHeights make_heights(const RaySet& set, const LayerGrowth& growth);

}  // namespace lamina::layers
