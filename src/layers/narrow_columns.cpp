// Columns beside corners are often narrower than their last layers are high. Where the number of layers changes there,
// the rows above are shifted by up to a layer from one ray to the next, and the cells are sheared:
//
//     |   |              |   |
//     |   |__            |___|         Left: five layers beside four that end at the same height. Right: four, a little
//     |  /|  |           |   |         higher, on both rays. The number changes where columns are wide.
//     |_/ |__|           |___|
//     |  /|  |           |   |
//     |_/_|__|           |___|
#include "layers/narrow_columns.hpp"

#include <algorithm>

#include "layers/neighbours.hpp"

namespace lamina::layers {

namespace {

/// A column is narrow where its front is shorter than this share of the last layer's height.
constexpr double narrow_share = 0.8;
/// A number of layers changes by this many at most, and by one in so many layers: what max_stretch makes up for.
constexpr std::uint32_t max_change = 2, layers_per_change = 14;

/// Returns the numbers that result when each is kept from one ray to the next across narrow columns for as long as
/// possible.
std::vector<std::uint32_t> kept_along(const std::vector<std::size_t>& next, const RaySet& set,
                                      std::span<const ColumnEnd> ends, std::span<const std::uint32_t> wanted) {
    const auto is_narrow = [&](std::size_t i, std::size_t j) {
        const RayLine &a = set.lines[i], &b = set.lines[j];
        const double height = std::min(ends[i].height, ends[j].height);
        const double width = length(b.origin - a.origin + height * (b.direction - a.direction));
        return width < narrow_share * std::max(ends[i].last_spacing, ends[j].last_spacing);
    };
    std::vector<std::uint32_t> kept(wanted.begin(), wanted.end());
    for (std::size_t e = 0; e < set.elements(); ++e) {
        std::size_t i = set.begin[e];
        // The second round carries the end of the first one over to its start.
        for (std::size_t k = 0; k < 2 * (set.begin[e + 1] - set.begin[e]); ++k, i = next[i]) {
            const std::size_t j = next[i];
            if (!is_narrow(i, j)) continue;
            const std::uint32_t change = std::min(max_change, wanted[j] / layers_per_change);
            kept[j] = std::min(std::clamp(kept[i], wanted[j] - change, wanted[j] + change), ends[j].max_layers);
        }
    }
    return kept;
}

}  // namespace

void keep_counts_on_narrow_columns(const RaySet& set, std::span<const ColumnEnd> ends,
                                   std::vector<std::uint32_t>& counts) {
    // Both directions count alike, so that mirrored input gives mirrored layers.
    const RayNeighbours rays(set);
    const std::vector<std::uint32_t> ahead = kept_along(rays.next, set, ends, counts),
                                     back = kept_along(rays.previous, set, ends, counts);
    for (std::size_t i = 0; i < counts.size(); ++i) counts[i] = std::min(ahead[i], back[i]);
}

}  // namespace lamina::layers
