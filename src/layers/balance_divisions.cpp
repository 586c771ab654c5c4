// The balance between the parts on both sides of each corner. Divided edges first give way to their neighbours; where
// that is not enough, the edge of the longer part gets one more.
#include "layers/balance_divisions.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace lamina::layers {

namespace {

void sort_without_duplicates(std::vector<std::size_t>& indices) {
    std::sort(indices.begin(), indices.end());
    indices.erase(std::unique(indices.begin(), indices.end()), indices.end());
}

/// Returns the factor for the targets at one end of a divided edge, given the length of the part at that end and of the
/// neighbour's part beyond. The factor takes the part halfway to the neighbour's length where the neighbour is divided
/// and gives way as well, and beyond the neighbour's length where it cannot. With
///
///     |-------- 1 --------|---- 0.61 ---|-- 0.39 --|-- 0.5 --|-- 0.5 --|
///
/// a whole edge meets edges that are divided in two at a ratio of 1.64 instead of 2.
double factor_towards(double own, double neighbour, bool neighbour_divided) {
    const double q = std::clamp(neighbour / own, 0.25, 4.0);
    return neighbour_divided ? std::sqrt(q) : q * std::sqrt(std::sqrt(q));
}

class Balance {
public:
    Balance(std::span<const PolygonEdge> edges, double max_ratio, std::vector<EdgeDivision>& divisions)
        : edges_(edges),
          limit_(max_ratio * (1 + 1e-9)),
          divisions_(divisions),
          unscaled_(edges.size()),
          scaled_(edges.size()) {}

    void run() {
        for (std::size_t i = 0; i < edges_.size(); ++i) measure(i);
        for (std::size_t i = 0; i < edges_.size(); ++i) scale_towards_neighbours(i);
        std::vector<std::size_t> active(edges_.size());  // edges whose corners are to be judged
        std::iota(active.begin(), active.end(), std::size_t{0});
        while (!active.empty()) {
            const std::vector<std::size_t> longer = edges_with_longer_parts(active);
            active.clear();
            for (std::size_t i : longer) {
                divisions_[i].add_part();
                measure(i);
                active.insert(active.end(), {edges_[i].previous, i, edges_[i].next});
            }
            sort_without_duplicates(active);
            for (std::size_t i : active) scale_towards_neighbours(i);
        }
    }

private:
    std::span<const PolygonEdge> edges_;
    double limit_;  ///< max_ratio with a slack for rounding
    std::vector<EdgeDivision>& divisions_;
    std::vector<EdgeDivision::EndParts> unscaled_, scaled_;  ///< per edge, with its targets as given and as scaled

    void measure(std::size_t i) {
        divisions_[i].scale_targets(1, 1);
        unscaled_[i] = divisions_[i].end_parts();
    }

    /// Scales the targets of a divided edge so that its parts approach those of the neighbours in length, as far as the
    /// ratio of the parts inside the edge allows.
    void scale_towards_neighbours(std::size_t i) {
        EdgeDivision& division = divisions_[i];
        const std::size_t before = edges_[i].previous, after = edges_[i].next;
        if (division.divided()) {
            double first = factor_towards(unscaled_[i].first, unscaled_[before].last, divisions_[before].divided());
            double last = factor_towards(unscaled_[i].last, unscaled_[after].first, divisions_[after].divided());
            division.scale_targets(first, last);
            for (int tries = 0; tries < 4 && division.max_ratio() > limit_; ++tries) {
                first = tries < 3 ? std::sqrt(first) : 1;
                last = tries < 3 ? std::sqrt(last) : 1;
                division.scale_targets(first, last);
            }
        }
        scaled_[i] = division.end_parts();
    }

    /// Returns the edges that have the longer part at a corner of these edges where the ratio is too large, unless they
    /// may get no more parts.
    std::vector<std::size_t> edges_with_longer_parts(std::span<const std::size_t> active) const {
        std::vector<std::size_t> longer;
        const auto compare = [&](std::size_t i, std::size_t j) {
            if (scaled_[i].last > limit_ * scaled_[j].first) longer.push_back(i);
            if (scaled_[j].first > limit_ * scaled_[i].last) longer.push_back(j);
        };
        for (std::size_t i : active) {
            compare(edges_[i].previous, i);
            compare(i, edges_[i].next);
        }
        sort_without_duplicates(longer);
        std::erase_if(longer, [&](std::size_t i) { return !divisions_[i].extensible(); });
        return longer;
    }
};

}  // namespace

void balance_divisions(std::span<const PolygonEdge> edges, double max_ratio, std::vector<EdgeDivision>& divisions) {
    Balance(edges, max_ratio, divisions).run();
}

}  // namespace lamina::layers
