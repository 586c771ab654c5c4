// Numbers of layers by a dynamic programme. Where the number of layers changes, the rows above are shifted by up to a
// layer from one ray to the next, and the cells are sheared, the more the narrower the column is:
//
//     |   |              |   |
//     |   |__            |___|         Left: five layers beside four that end at the same height. Right: four, a little
//     |  /|  |           |   |         higher, on both rays. The number changes where columns are wide.
//     |_/ |__|           |___|
//     |  /|  |           |   |
//     |_/_|__|           |___|
//
// Each ray has a range of numbers with which a stretch can keep the front where it is. Among all sequences of numbers
// in these ranges, the cheapest is taken. A change costs the fourth power of the tangent by which the rows that it
// shifts are off a right angle with the rays. So a change costs little where columns are wide, and where rays lean, it
// costs less in one direction than in the other (docs/layer.md):
//
//         / / / /             / / / /
//        /_/ / /             /_/_/ /      rays that lean to the right; rows that fall in this direction, and that rise
//       / /_/ /             / / /_/
//      / / / /_            / / / /
//
// Source: R. Bellman, Dynamic Programming (1957): the cheapest sequence, ray by ray.
#include "layers/heights/numbers.hpp"

#include <algorithm>
#include <cmath>

#include "layers/mechanisms.hpp"
#include "layers/parameters.hpp"
#include "layers/stages.hpp"

namespace lamina::layers {

namespace {

/// A row between two neighbouring rays.
struct ColumnRow {
    double width;  ///< across the rays
    double rise;   ///< along the rays, from the first to the second
};

/// Returns the row between the points of two rays at these heights.
ColumnRow row_between(const RayLine& a, double height_a, const RayLine& b, double height_b) {
    const Point row = b.origin + height_b * b.direction - (a.origin + height_a * a.direction);
    const Point along = unit(a.direction + b.direction);
    return {std::abs(cross(row, along)), dot(row, along)};
}

/// Returns the tangent by which a row is off a right angle with its rays, at most 8: sums of such tangents are exact
/// enough for small ones.
double tangent_of(const ColumnRow& row) {
    constexpr double most_tangent = 8;
    const double shift = std::abs(row.rise);
    return shift < most_tangent * row.width ? shift / row.width : most_tangent;
}

/// It costs this much for each layer. So of two sequences that cost the same otherwise, as in mirrored input, the one
/// with fewer layers is taken.
constexpr double cost_of_layer = 1e-6;

/// What a ray may have.
struct RayChoices {
    const ColumnEnd* end;
    ColumnRow row;  ///< of the front, from the ray before to this one
};

/// Returns what it costs that the number of layers changes from `before` to `n` on the column behind `ray_before`: the
/// topmost row that both rays share is one layer below the front on one of them.
double cost_of_change(const RayChoices& ray_before, const RayChoices& ray, std::uint32_t before, std::uint32_t n) {
    ColumnRow row = ray.row;
    row.rise += n > before ? -ray.end->last_spacing : ray_before.end->last_spacing;
    const double tangent = tangent_of(row), square = tangent * tangent;
    return square * square;
}

/// The cheapest ways to the numbers of the rays of one element.
class NumberSearch {
public:
    /// rays: the first one stands at the end again.
    explicit NumberSearch(std::span<const RayChoices> rays) : rays_(rays), ways_(rays.size()) {
        for (std::size_t k = 0; k < rays.size(); ++k) ways_[k].resize(range(k).most - range(k).least + std::size_t{1});
    }

    /// Returns the cheapest numbers: the sequence begins and ends with each number of the first ray in turn.
    std::vector<std::uint32_t> run() && {
        double least = HUGE_VAL;
        std::vector<std::uint32_t> best;
        for (std::uint32_t held = range(0).least; held <= range(0).most; ++held) {
            const double cost = cost_from(held);
            if (!best.empty() && !(cost < least)) continue;
            least = cost;
            best = numbers_to(held);
        }
        return best;
    }

private:
    /// The cheapest way to a number.
    struct Way {
        double cost;
        std::uint32_t before;
    };
    std::span<const RayChoices> rays_;
    std::vector<std::vector<Way>> ways_;  ///< by ray and number

    const LayerRange& range(std::size_t k) const { return rays_[k].end->layers; }
    Way& way(std::size_t k, std::uint32_t n) { return ways_[k][n - range(k).least]; }

    /// Finds the ways from this number of the first ray, and returns the cost of the one back to it. Numbers to which
    /// none leads cost infinitely much.
    double cost_from(std::uint32_t held) {
        for (Way& first : ways_[0]) first = {HUGE_VAL, held};
        way(0, held).cost = 0;
        for (std::size_t k = 1; k < rays_.size(); ++k)
            for (std::uint32_t n = range(k).least; n <= range(k).most; ++n) way(k, n) = cheapest_way(k, n);
        return way(rays_.size() - 1, held).cost;
    }

    /// Returns the cheapest way to number n of ray k: from the same number, the one below or the one above, or those
    /// nearest to them.
    Way cheapest_way(std::size_t k, std::uint32_t n) {
        const double off = double(n) - double(rays_[k].end->wanted);
        const double own = cost_of_distance * off * off + cost_of_layer * n;
        Way cheapest{HUGE_VAL, range(k - 1).least};
        for (const std::uint32_t nearest : {n, n - std::min(n, 1u), n + 1}) {
            const std::uint32_t before = std::clamp(nearest, range(k - 1).least, range(k - 1).most);
            const double change = std::abs(double(n) - double(before));
            const double of_change =
                change > 0 ? cost_of_change(rays_[k - 1], rays_[k], before, n) * change * change : 0;
            const double cost = way(k - 1, before).cost + (own + of_change);
            if (cost < cheapest.cost) cheapest = {cost, before};
        }
        return cheapest;
    }

    /// Returns the numbers on the way to this number of the last ray.
    std::vector<std::uint32_t> numbers_to(std::uint32_t held) const {
        std::vector<std::uint32_t> numbers(rays_.size(), held);
        for (std::size_t k = rays_.size() - 1; k > 0; --k)
            numbers[k - 1] = ways_[k][numbers[k] - range(k).least].before;
        return numbers;
    }
};

}  // namespace

std::vector<std::uint32_t> cheapest_numbers(const RaySet& set, std::span<const ColumnEnd> ends) {
    std::vector<std::uint32_t> numbers(ends.size());
    if (!uses("numbers")) {
        for (std::size_t i = 0; i < ends.size(); ++i) numbers[i] = ends[i].wanted;
        return numbers;
    }
    for (std::size_t e = 0; e < set.elements(); ++e) {
        const std::size_t begin = set.begin[e], n = set.begin[e + 1] - begin;
        std::vector<RayChoices> rays;
        rays.reserve(n + 1);
        for (std::size_t i = begin, before = begin + n - 1; i < begin + n; before = i++)
            rays.push_back(
                {&ends[i], row_between(set.lines[before], ends[before].height, set.lines[i], ends[i].height)});
        // The sequence closes at a ray with few numbers.
        const auto first = std::min_element(rays.begin(), rays.end(), [](const RayChoices& a, const RayChoices& b) {
            return a.end->layers.most - a.end->layers.least < b.end->layers.most - b.end->layers.least;
        });
        const auto offset = static_cast<std::size_t>(first - rays.begin());
        std::rotate(rays.begin(), first, rays.end());
        rays.push_back(rays.front());
        const std::vector<std::uint32_t> found = NumberSearch(rays).run();
        for (std::size_t k = 0; k < n; ++k) numbers[begin + (offset + k) % n] = found[k];
    }
    return numbers;
}

}  // namespace lamina::layers
