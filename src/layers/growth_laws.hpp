// The growth laws, in one table. A further law gets an enumerator of GrowthLaw (layers.hpp), a function for its heights
// and a row of the table (growth.cpp). The option and its help, validation, heights and checks all read the table.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <lamina/layers.hpp>

#include "layers/growth.hpp"
#include "layers/stages.hpp"

namespace lamina::layers {

/// The part of a growth law that takes the growth of each ray from the distance to the neighbouring rays.
struct GrowthBySpacing {
    double min_growth, max_growth;  ///< bounds of Ray::growth
    /// Returns the growth of each ray.
    std::vector<double> (*on_rays)(const RaySet& set, const LayerGrowth& growth);
};

/// A row of the table: all that distinguishes one law from the others.
struct GrowthLawEntry {
    GrowthLaw law;
    const char* name;  ///< word of the option growth-law
    /// H(n), the height of the top of layer n, as help prints it. H is the first height, R the growth, N the number of
    /// layers and T the thickness.
    const char* formula;
    /// Returns H(0) = 0, H(1) ... H(layers) in units of the input.
    std::vector<double> (*heights)(double first_height, double growth, std::uint32_t layers);
    /// Returns Ray::growth, the `growth` of heights().
    double (*ray_growth)(const LayerGrowth& growth);
    /// Set where each ray has a growth of its own; ray_growth() is then that of a ray with LayerGrowth::growth.
    const GrowthBySpacing* by_spacing = nullptr;
    std::uint32_t min_layers = 0;  ///< the law needs a number of layers, and no fewer than this; 0: auto will do
    bool fills_thickness = false;  ///< the law needs a thickness, and its last layer ends there
};

/// Returns the table of the laws, in the order in which help lists them.
std::span<const GrowthLawEntry> growth_law_table();

/// Returns the row of a law. Throws OptionError for a value that is no law.
const GrowthLawEntry& growth_law_entry(GrowthLaw law);

}  // namespace lamina::layers
