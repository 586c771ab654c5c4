// The growth of layers: what the options of the layer (layers.hpp) and the flow ask of each element, as lengths.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include <lamina/conditions.hpp>
#include <lamina/export.hpp>
#include <lamina/layers.hpp>
#include <lamina/point.hpp>

namespace lamina::layers {

/// A height at a point of a wall.
struct WallHeight {
    std::size_t element;  ///< index in Geometry::elements
    Point at;             ///< on the wall, or near to it
    double height;        ///< above the wall, in units of the input
};

/// A point of a wake, and the heights that layers reach at least on both sides of it, in units of the input.
struct WakePoint {
    Point at;      ///< on the line of the wake
    double left;   ///< height on the left of the direction in which the line runs
    double right;  ///< height on its right
};

/// The line of a wake: points so close that it may be taken for straight between them, from the trailing edge of an
/// element on.
struct WakeLine {
    std::size_t element;            ///< index in Geometry::elements
    std::vector<WakePoint> points;  ///< two or more
};

/// The growth law and its numbers, with the first height as a length.
struct LayerGrowth {
    GrowthLaw law = GrowthLaw::geometric;   ///< LayerOptions::growth_law
    double first_height = 0;                ///< in units of the input; on elements without one of their own
    double growth = 1.2;                    ///< LayerOptions::growth
    std::optional<std::uint32_t> layers{};  ///< LayerOptions::layers
    std::optional<double> thickness{};      ///< LayerOptions::thickness, in units of the input
    /// One per element, in units of the input; empty: no element has its own. 0 on outer walls without layers.
    std::vector<double> first_heights{};
    /// First heights along the walls of elements that have any, in the order of the wall as a closed chain, linear in
    /// between; first_heights has the least one of each element then.
    std::vector<WallHeight> wall_first_heights{};
    /// Heights that columns up to isotropy reach at least, where there is room: those of the flow's boundary layers.
    /// Each element has none, or a closed chain of them in the order of its wall; they are linear in between.
    std::vector<WallHeight> least_heights{};
    /// Lines along which the layers of both sides go on behind a sharp trailing edge or a base, at most one per element
    /// (LayerOptions::wake_layers).
    std::vector<WakeLine> wakes{};
    /// CaseOptions::fineness: least heights are reached with so many times the usual number of layers.
    double fineness = 1;

    /// Returns the first height on an element.
    double first_height_on(std::size_t element) const {
        return first_heights.empty() ? first_height : first_heights[element];
    }
};

/// Returns the growth that the options request in these conditions, with LayerGrowth::first_heights if there are any.
/// Throws OptionError where a y+ is given without a Reynolds number, and where the heights contradict each other: a
/// thickness below a first height, or too small for the exponential law.
LAMINA_EXPORT LayerGrowth layer_growth(const LayerOptions& options, const ReferenceConditions& conditions,
                                       std::vector<double> first_heights = {});

/// Returns the largest first height on any element.
LAMINA_EXPORT double largest_first_height(const LayerGrowth& growth);

/// Returns the growth on one element as though it were alone: with its own first height and least heights, as element
/// 0. Functions of a growth that know no elements take this one.
LAMINA_EXPORT LayerGrowth growth_on_element(const LayerGrowth& growth, std::size_t element);

/// Returns the first height whose top lies at this y+ on a flat plate of length `chord` in turbulent flow:
///   y+ chord / (Re sqrt(cf / 2)),  cf = 0.026 / Re^(1/7),  Re = reynolds, based on the chord.
/// Throws OptionError for numbers that are not positive. Source: F. M. White, Fluid Mechanics, 5th ed. (2003), section
/// 7.4.
LAMINA_EXPORT double first_height_for(double y_plus, double reynolds, double chord);

/// Returns the height of the top of layer n above the wall; 0 for n = 0. For the adaptive law it is the height on a ray
/// whose ratio is growth.growth. Source: thesis 3.3, GrowthLaw.
LAMINA_EXPORT double layer_height(const LayerGrowth& growth, std::uint32_t n);

/// Returns the height of all requested layers where it is the same on every ray. Empty where the spacing of the rays
/// decides: for layers up to isotropy and for the adaptive law.
LAMINA_EXPORT std::optional<double> requested_height(const LayerGrowth& growth);

/// Returns the number of parts of each fan with LayerOptions::equal_fans: as many as half a turn needs for none to
/// exceed the largest angle between rays. Corners turn by less.
LAMINA_EXPORT std::uint32_t equal_fan_parts(const LayerOptions& options);

}  // namespace lamina::layers
