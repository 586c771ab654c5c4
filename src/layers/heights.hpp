// How high the layers asked for lie on each ray; internal to the layer stage.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <lamina/layers.hpp>

#include "layers/rays.hpp"

namespace lamina {

/// The layers asked for on one ray: a part of the table of heights.
struct Stack {
    std::size_t first = 0;     ///< where its heights begin in the table
    std::uint32_t layers = 0;  ///< asked for
    double growth = 0;         ///< as Ray::growth
    double stretch = 1;        ///< as Ray::stretch
};

/// Heights of the layers asked for, ray by ray. Rays of one law and growth share the same part of the table.
class Heights {
public:
    Heights(std::vector<double> table, std::vector<Stack> stacks)
        : table_(std::move(table)), stacks_(std::move(stacks)) {}

    const Stack& stack(std::size_t ray) const { return stacks_[ray]; }
    /// of(ray)[n] is the height of layer n, of(ray)[0] = 0, of(ray).back() that of the last layer asked for.
    std::span<const double> of(std::size_t ray) const {
        const Stack& stack = stacks_[ray];
        return {table_.data() + stack.first, stack.layers + std::size_t{1}};
    }
    double full(std::size_t ray) const { return of(ray).back(); }
    double tallest() const;
    /// Of all stacks.
    const std::vector<double>& table() const { return table_; }

private:
    std::vector<double> table_;
    std::vector<Stack> stacks_;
};

/// Heights of layers 0 ... `layers`.
std::vector<double> heights_by_law(GrowthLaw law, double first_height, double growth, std::uint32_t layers);

/// Ray::growth of all rays, but for the adaptive law. Precondition: check_growth().
double common_growth(const LayerOptions& options);

/// Throws UsageError where the options of growth make no sense, alone or together.
void check_growth(const LayerOptions& options);

/// Height of the layers asked for on a wall of evenly spaced points; for laws that go by the spacing, about.
double expected_height(const LayerOptions& options, double spacing);

Heights make_heights(const RaySet& set, const LayerOptions& options);

/// Multiplies the n-th spacing, n >= 0, by stretch^n. heights[0] = 0 is the wall.
void stretch_heights(double stretch, std::span<double> heights);

/// The same stacks, stretched on rays whose limit is below the height of all their layers, so that a layer ends at the
/// limit; next to it below where that would take more than largest_stretch.
Heights fit_heights(const Heights& heights, std::span<const double> limits);

}  // namespace lamina
