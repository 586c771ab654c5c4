// Levels that fit the size that most triangles have: there a lattice has the fewest triangles.
#include "delaunay/lattice_levels.hpp"

#include <algorithm>

namespace lamina::delaunay {

std::vector<double> level_edges(double low, double high, std::vector<SizeBin> bins) {
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
    double first_size = commonest;
    while (first_size > low) first_size /= level_ratio;
    std::vector<double> edges{lattice_share * first_size};
    while (edges.back() <= lattice_share * high) edges.push_back(edges.back() * level_ratio);
    return edges;
}

int level_of(double size, const std::vector<double>& edges) {
    return static_cast<int>(std::upper_bound(edges.begin(), edges.end(), lattice_share * size) - edges.begin()) - 1;
}

}  // namespace lamina::delaunay
