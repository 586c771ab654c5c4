// Columns beside corners are often narrower than their last layers are high. Where the number of layers changes there,
// the rows above are shifted by up to a layer from one ray to the next, and the cells are sheared:
//
//     |   |              |   |
//     |   |__            |___|         Left: five layers beside four that end at the same height. Right: four, a little
//     |  /|  |           |   |         higher, on both rays. The number changes where columns are wide.
//     |_/ |__|           |___|
//     |  /|  |           |   |
//     |_/_|__|           |___|
//
// Each ray has a range of numbers with which a stretch can keep the front where it is. A string that is pulled taut
// through these ranges changes as little as possible, and evenly where it must:
//
//            _ _                    I   range of a ray between narrow columns
//      o-o--'I I`-o-o--o            o   number on a ray between wide columns
//            I I
//
// Lengths along the string are squares of widths of columns over the heights of their last layers, so that it changes
// most where columns are widest. The numbers are its values, rounded.
//
// A column whose rays lean counts as narrower, since its cells are sheared already (docs/decisions/0055).
#include "layers/narrow_columns.hpp"

#include <algorithm>
#include <cmath>

#include "layers/neighbours.hpp"

namespace lamina::layers {

namespace {

/// A column is narrow where its front is shorter than this share of the last layer's height. Where something cuts
/// layers short, it counts as shorter where rays lean. Elsewhere numbers stay as the front asks, since the more layers are
/// stretched, the more the last ones differ in height from the cells beyond.
constexpr double narrow_share = 0.8;
/// A column has this length at least, so that the string goes forward.
constexpr double least_length = 1e-6;
/// A column counts as this many heights wide at most, as columns without layers do, so that sums of lengths are exact
/// enough for short ones.
constexpr double most_width = 10;

/// A place that the string goes through.
struct Gate {
    double along;  ///< length of the columns before
    double least, most;
};

/// Returns the heights at which a string that is pulled taut goes through the gates, of which the first and the last are
/// points.
std::vector<double> pull_taut(std::span<const Gate> gates) {
    std::vector<double> string(gates.size());
    std::size_t apex = 0;
    string[0] = gates[0].least;
    while (apex + 1 < gates.size()) {
        // The lines from the apex through all gates so far have slopes between those to two corners.
        std::size_t low = apex + 1, high = low, bend = 0;
        const auto slope_to = [&](std::size_t i, double height) {
            return (height - string[apex]) / (gates[i].along - gates[apex].along);
        };
        double steepest = HUGE_VAL, flattest = -HUGE_VAL;
        bool bends_up = false;
        for (std::size_t i = apex + 1; i < gates.size() && bend == 0; ++i) {
            const double to_least = slope_to(i, gates[i].least), to_most = slope_to(i, gates[i].most);
            if (to_least > steepest) {
                bend = high;
                bends_up = true;
            } else if (to_most < flattest) {
                bend = low;
            } else {
                if (to_least >= flattest) low = i, flattest = to_least;
                if (to_most <= steepest) high = i, steepest = to_most;
            }
        }
        if (bend == 0) bend = gates.size() - 1;
        const double height = bends_up ? gates[bend].most : gates[bend].least;
        const double slope = slope_to(bend, height);
        for (std::size_t i = apex + 1; i < bend; ++i)
            string[i] = string[apex] + slope * (gates[i].along - gates[apex].along);
        string[bend] = height;
        apex = bend;
    }
    return string;
}

/// Returns the nearest whole number, and the lower one of two. The slack makes halves that are not exact go down, too,
/// so that mirrored input gives mirrored numbers.
std::uint32_t rounded(double value) {
    constexpr double slack = 1e-6;
    return static_cast<std::uint32_t>(std::ceil(value - 0.5 - slack));
}

}  // namespace

void keep_counts_on_narrow_columns(const RaySet& set, std::span<const ColumnEnd> ends,
                                   std::vector<std::uint32_t>& counts) {
    const RayNeighbours rays(set);
    /// Returns the width of the column between two neighbours, in heights of its last layer.
    const auto width = [&](std::size_t i, std::size_t j) {
        const RayLine &a = set.lines[i], &b = set.lines[j];
        const double height = std::min(ends[i].height, ends[j].height);
        const double apart = length(b.origin - a.origin + height * (b.direction - a.direction));
        const double spacing = std::max(ends[i].last_spacing, ends[j].last_spacing);
        return apart < most_width * spacing ? apart / spacing : most_width;
    };
    const auto width_left = [&](std::size_t i, std::size_t j) {
        const double lean = std::abs(tangent_of_lean(set.lines[i], set.lines[j]));
        return width(i, j) * max_row_slope(lean);
    };
    const auto is_free = [&](std::size_t i) {
        const auto measure = [&](std::size_t a, std::size_t b) { return ends[i].cut ? width_left(a, b) : width(a, b); };
        return measure(rays.previous[i], i) < narrow_share || measure(i, rays.next[i]) < narrow_share;
    };
    for (std::size_t e = 0; e < set.elements(); ++e) {
        std::size_t first = set.begin[e];
        while (first + 1 < set.begin[e + 1] && is_free(first)) ++first;
        std::vector<Gate> gates;
        double along = 0;
        std::size_t i = first;
        do {
            const bool held = i == first || !is_free(i);
            const LayerRange range = held ? LayerRange{counts[i], counts[i]} : ends[i].layers;
            gates.push_back({along, double(range.least), double(range.most)});
            const double step = width_left(i, rays.next[i]);
            along += std::max(step * step, least_length);
            i = rays.next[i];
        } while (i != first);
        gates.push_back({along, gates[0].least, gates[0].most});
        const std::vector<double> string = pull_taut(gates);
        for (std::size_t k = 0; k + 1 < gates.size(); ++k, i = rays.next[i]) counts[i] = rounded(string[k]);
    }
}

}  // namespace lamina::layers
