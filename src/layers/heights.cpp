// Growth laws. Sources: R. V. Garimella, M. S. Shephard, Boundary layer mesh generation for viscous flow simulations,
// Int. J. Numer. Meth. Engng 49 (2000); J. K. Pardue, thesis (2015), section 3.3.
#include "layers/heights.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include <lamina/error.hpp>

namespace lamina {
namespace {

void require(bool condition, const std::string& message) {
    if (!condition) throw UsageError(message);
}

/// Takes away the layers above `thickness`, with a slack of rounding: a thickness of exactly n layers gives n.
void cut(double thickness, std::vector<double>& heights) {
    heights.erase(std::upper_bound(heights.begin(), heights.end(), thickness * (1 + 1e-12)), heights.end());
}

}  // namespace

double Heights::tallest() const {
    double tallest = 0;
    for (std::size_t i = 0; i < stacks_.size(); ++i) tallest = std::max(tallest, full(i));
    return tallest;
}

void check_growth(const LayerOptions& o) {
    require(o.first_height > 0 && std::isfinite(o.first_height),
            fmt::format("first height must be greater than 0, not {}", o.first_height));
    require(o.growth > 1 && std::isfinite(o.growth),
            fmt::format("geometric growth must be greater than 1, not {}", o.growth));
    require(o.layers >= 1 && o.layers <= std::numeric_limits<std::uint16_t>::max(),
            fmt::format("layers must be from 1 to 65535, not {}", o.layers));
    if (o.thickness) {
        require(
            *o.thickness >= o.first_height && std::isfinite(*o.thickness),
            fmt::format("layer thickness {} must not be less than the first height {}", *o.thickness, o.first_height));
    }
}

std::vector<double> heights_by_law(GrowthLaw law, double first_height, double growth, std::uint32_t layers) {
    std::vector<double> heights{0.0};
    heights.reserve(layers + std::size_t{1});
    switch (law) {
        case GrowthLaw::geometric:
            for (double step = first_height; heights.size() <= layers; step *= growth)
                heights.push_back(heights.back() + step);
    }
    return heights;
}

Heights make_heights(const RaySet& set, const LayerOptions& options) {
    std::vector<double> table =
        heights_by_law(options.growth_law, options.first_height, options.growth, options.layers);
    if (options.thickness) cut(*options.thickness, table);
    const Stack all{0, static_cast<std::uint32_t>(table.size() - 1), options.growth};
    return Heights(std::move(table), std::vector<Stack>(set.rays.size(), all));
}

double layer_height(const LayerOptions& options, std::uint32_t n) {
    return heights_by_law(options.growth_law, options.first_height, options.growth, n).back();
}

}  // namespace lamina
