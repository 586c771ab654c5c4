// Levels that fit the size that most triangles have: there a lattice has the fewest triangles.
#include "delaunay/refine/lattice_levels.hpp"

#include <algorithm>
#include <cmath>

#include <lamina/delaunay.hpp>

namespace lamina::delaunay {

LatticeLevels lattice_levels(double low, double high, double max_area_ratio, std::vector<SizeBin> bins) {
    constexpr double rounding = 1e-6;  // the size field holds numbers of single precision
    constexpr double alike = 1e-3;     // sizes that differ by less count as one size
    std::erase_if(bins, [](const SizeBin& bin) { return bin.high > (1 + alike) * bin.low; });
    std::sort(bins.begin(), bins.end(), [](const SizeBin& a, const SizeBin& b) {
        return a.low != b.low ? a.low < b.low : a.triangles < b.triangles;
    });
    double commonest = low, count_of_commonest = 0;
    for (std::size_t i = 0; i < bins.size();) {
        const double first = bins[i].low;
        double triangles = 0;
        for (; i < bins.size() && bins[i].low <= (1 + alike) * first; ++i) triangles += bins[i].triangles;
        if (triangles <= count_of_commonest) continue;
        count_of_commonest = triangles;
        commonest = (1 - rounding) * first;
    }
    LatticeLevels levels;
    const bool areas_are_bounded = max_area_ratio < max_circle_ratio * max_circle_ratio;
    double share_of_commonest = commonest_lattice_share;
    if (areas_are_bounded) levels.share = share_of_commonest = largest_area_share * std::sqrt(max_area_ratio);
    double first_size = low;
    if (count_of_commonest > 0) {
        first_size = commonest * (share_of_commonest / levels.share);
        while (first_size > low) first_size /= level_ratio;
    }
    levels.edges.push_back(levels.share * first_size);
    while (levels.edges.back() <= levels.share * high) levels.edges.push_back(levels.edges.back() * level_ratio);
    return levels;
}

int LatticeLevels::level_of(double size) const {
    return static_cast<int>(std::upper_bound(edges.begin(), edges.end(), share * size) - edges.begin()) - 1;
}

}  // namespace lamina::delaunay
