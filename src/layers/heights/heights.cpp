// Heights of layers on rays: what is asked for, by the growth law, up to the thickness or up to isotropy, and columns
// that end at the front.
#include "layers/heights/heights.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

#include <fmt/format.h>

#include <lamina/error.hpp>

#include "core/parallel.hpp"
#include "layers/growth_laws.hpp"
#include "layers/heights/isotropy.hpp"
#include "layers/heights/numbers.hpp"
#include "layers/heights/stretch.hpp"
#include "layers/layered_rays.hpp"
#include "layers/mechanisms.hpp"
#include "layers/stages.hpp"

namespace lamina::layers {

namespace {

/// The vertices of an outline on the wall, and those on the wake behind it.
struct OutlineParts {
    std::span<RayVertex> on_wall, on_wake;
};

OutlineParts parts_of_outline(std::span<RayVertex> outline) {
    const auto wake = std::find_if(outline.begin(), outline.end(),
                                   [](const RayVertex& vertex) { return vertex.place != RayPlace::wall; });
    const auto count = static_cast<std::size_t>(wake - outline.begin());
    return {outline.first(count), outline.subspan(count)};
}

}  // namespace

double height_at(Point p, std::span<const WallHeight> chain) {
    double nearest = HUGE_VAL, height = 0;
    for (std::size_t k = 0; k < chain.size(); ++k) {
        const WallHeight &a = chain[k], &b = chain[k + 1 < chain.size() ? k + 1 : 0];
        const Point edge = b.at - a.at;
        const double square = squared_length(edge);
        const double share = square > 0 ? std::clamp(dot(p - a.at, edge) / square, 0.0, 1.0) : 0;
        const double away = squared_length(p - (a.at + share * edge));
        if (!(away < nearest)) continue;
        nearest = away;
        height = a.height + share * (b.height - a.height);
    }
    return height;
}

std::vector<double> first_heights_on_wall(const LayerGrowth& growth, std::size_t element, std::span<const Point> wall) {
    std::vector<WallHeight> chain;
    for (const WallHeight& height : growth.wall_first_heights)
        if (height.element == element) chain.push_back(height);
    std::vector<double> heights(chain.empty() ? 0 : wall.size());
    core::parallel_for(heights.size(), 64, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) heights[i] = height_at(wall[i], chain);
    });
    lower_round(std::span(heights), [&](std::size_t from, std::size_t) { return alike * heights[from]; });
    return heights;
}

void set_first_heights(std::span<const double> heights, std::span<const Point> wall, double first_height,
                       std::span<RayVertex> outline) {
    if (heights.empty()) return;
    const auto [on_wall, on_wake] = parts_of_outline(outline);
    std::size_t k = 0;
    for (RayVertex& vertex : on_wall) {
        while (wall[k] != vertex.at) k = (k + 1) % wall.size();  // the outline leaves vertices of the wall out
        vertex.opening = heights[k] / first_height;
    }
    // A wake begins between the last vertex of the wall and the first one.
    for (RayVertex& vertex : on_wake) vertex.opening *= std::min(on_wall.front().opening, on_wall.back().opening);
}

void set_least_heights(std::span<const WallHeight> chain, std::span<RayVertex> outline) {
    const auto [on_wall, on_wake] = parts_of_outline(outline);
    core::parallel_for(on_wall.size(), 64, [&, on_wall = on_wall](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) on_wall[i].least_height = height_at(on_wall[i].at, chain);
    });
    // At a trailing edge heights of both sides stand at one point. Before a wake it has a vertex for either side.
    if (on_wake.empty()) return;
    on_wall.front().least_height = on_wall[1].least_height;
    on_wall.back().least_height = on_wall[on_wall.size() - 2].least_height;
}

std::vector<double> least_heights(const RaySet& set) {
    std::vector<double> least(set.lines.size());
    for (std::size_t i = 0; i < least.size(); ++i) least[i] = set.lines[i].least_height;
    const RayNeighbours neighbours(set);
    const auto same_origin = [&](std::size_t a, std::size_t b) { return set.lines[a].origin == set.lines[b].origin; };
    std::vector<double> with_fans = least;
    for (std::size_t i = 0; i < least.size(); ++i) {
        const std::size_t before = neighbours.previous[i], after = neighbours.next[i];
        const bool fan_before = same_origin(before, i), fan_after = same_origin(i, after);
        if (fan_after && !fan_before) with_fans[i] = least[before];
        if (fan_before && !fan_after) with_fans[i] = least[after];
    }
    fill_fans(set, with_fans);
    return with_fans;
}

namespace {

/// Largest number of layers up to isotropy; a growth that needs more is refused as a mistake.
constexpr std::uint32_t max_automatic_layers = 1000;

[[noreturn]] void throw_too_many_layers() {
    throw OptionError("layers", fmt::format("more than {} layers up to isotropy: give a larger growth, a thickness or "
                                            "their number",
                                            max_automatic_layers));
}

std::uint32_t layer_count(std::span<const double> heights) { return static_cast<std::uint32_t>(heights.size() - 1); }

/// Removes the layers above `thickness`. A slack of rounding keeps all n layers of a thickness that is exactly their
/// height.
void cut_at_thickness(double thickness, std::vector<double>& heights) {
    heights.erase(std::upper_bound(heights.begin(), heights.end(), thickness * (1 + 1e-12)), heights.end());
}

/// Returns the rays of an element alone.
RaySet rays_of_element(const RaySet& set, std::size_t element) {
    const auto line = [&](std::size_t i) { return set.lines.begin() + static_cast<std::ptrdiff_t>(i); };
    const std::size_t begin = set.begin[element], end = set.begin[element + 1];
    return {{line(begin), line(end)}, {0, end - begin}};
}

/// Returns whether rays have first heights of their own.
bool has_openings(const RaySet& set) {
    return std::any_of(set.lines.begin(), set.lines.end(), [](const RayLine& ray) { return ray.opening != 1; });
}

/// The heights that the growth law gives above a wall, one table for all rays of an element or one for each. Those of a
/// ray are multiplied by its opening.
class LawHeights {
public:
    LawHeights(const RaySet& set, const LayerGrowth& growth) {
        const GrowthLawEntry& law = growth_law_entry(growth.law);
        // A thickness is the same for all rays, and no multiple of their first heights.
        if (growth.thickness && growth.layers && !law.by_spacing && has_openings(set)) {
            make_tables(set, growth, law);
            return;
        }
        growths_ = law.by_spacing ? law.by_spacing->on_rays(set, growth) : std::vector{law.ray_growth(growth)};
        for (const double ray_growth : growths_) {
            std::vector<double>& table = tables_.emplace_back(
                law.heights(growth.first_height, ray_growth, growth.layers.value_or(max_automatic_layers)));
            if (growth.thickness && !law.fills_thickness) cut_at_thickness(*growth.thickness, table);
        }
    }

    /// Returns Ray::growth.
    double growth(std::size_t ray) const { return growths_.size() > 1 ? growths_[ray] : growths_[0]; }
    /// Returns the heights, beginning with 0 for the wall.
    std::span<const double> of(std::size_t ray) const { return tables_.size() > 1 ? tables_[ray] : tables_[0]; }

private:
    /// Makes the tables of a law that ends at a thickness, ray by ray.
    void make_tables(const RaySet& set, const LayerGrowth& growth, const GrowthLawEntry& law) {
        for (const RayLine& ray : set.lines) {
            LayerGrowth own = growth;
            own.first_height *= ray.opening;
            growths_.push_back(law.ray_growth(own));
            std::vector<double>& table =
                tables_.emplace_back(law.heights(own.first_height, growths_.back(), *growth.layers));
            if (!law.fills_thickness) cut_at_thickness(*growth.thickness, table);
            for (double& height : table) height /= ray.opening;
        }
    }

    std::vector<double> growths_;
    std::vector<std::vector<double>> tables_;
};

/// Returns the asked heights on one element.
std::vector<double> asked_on_element(const RaySet& own, const LayerGrowth& growth) {
    if (growth.first_height == 0) return std::vector<double>(own.lines.size(), 0.0);
    const LawHeights law(own, growth);
    std::vector<double> asked(own.lines.size());
    if (growth.layers) {
        for (std::size_t i = 0; i < asked.size(); ++i)
            asked[i] = own.lines[i].slant * own.lines[i].opening * law.of(i).back();
        return asked;
    }
    asked = heights_of_isotropy(own, law.of(0), least_heights(own));
    for (std::size_t i = 0; i < asked.size(); ++i) {
        if (!growth.thickness && asked[i] >= own.lines[i].opening * law.of(i).back()) throw_too_many_layers();
        asked[i] = std::min({asked[i], growth.thickness.value_or(HUGE_VAL), own.lines[i].most_height});
        asked[i] *= own.lines[i].slant;
    }
    bound_slopes(own, asked);
    for (std::size_t i = 0; i < asked.size(); ++i)
        if (own.lines[i].place != RayPlace::wake_end)
            asked[i] = std::max(asked[i], first_height_along(own.lines[i], growth.first_height));
    return asked;
}

/// The columns of one element while they are made.
class ElementColumns {
public:
    /// asked, front: of the rays of this element.
    ElementColumns(RaySet rays, LayerGrowth growth, std::span<const double> asked, std::span<const double> front)
        : rays_(std::move(rays)), growth_(std::move(growth)), asked_(asked), front_(front), law_(rays_, growth_) {
        make_unstretched();
        choose_numbers();
        if (!growth_.layers &&
            std::any_of(layers_.begin(), layers_.end(), [](std::uint32_t n) { return n >= max_automatic_layers; }))
            throw_too_many_layers();
    }

    /// Stretches the columns to the front and appends them.
    void append_to(std::vector<double>& table, std::vector<HeightColumn>& columns) && {
        const std::vector<std::uint32_t> asked_layers = count_asked_layers();
        for (std::size_t i = 0; i < layers_.size(); ++i) {
            const bool whole = keeps_law(i) && layers_[i] == layer_count(heights_[i]);
            const Stretch stretch = whole ? Stretch{} : stretch_of_layers(front_[i], heights_[i], layers_[i]);
            heights_[i].resize(layers_[i] + std::size_t{1});
            stretch_heights(stretch, heights_[i]);
            if (!whole) heights_[i].back() = std::min(heights_[i].back(), front_[i]);
            columns.push_back({table.size(), layers_[i], asked_layers[i], is_cut(i), law_.growth(i), stretch});
            table.insert(table.end(), heights_[i].begin(), heights_[i].end());
        }
    }

private:
    RaySet rays_;
    LayerGrowth growth_;
    std::span<const double> asked_, front_;
    LawHeights law_;
    std::vector<double> max_spacings_;
    std::vector<std::vector<double>> heights_;  ///< as the law makes them, beyond the front
    std::vector<std::uint32_t> layers_;

    bool is_cut(std::size_t ray) const { return front_[ray] < asked_[ray]; }
    /// Returns whether a column keeps a requested number of layers, which nothing cuts short.
    bool keeps_law(std::size_t ray) const { return growth_.layers && !is_cut(ray); }

    /// Returns the largest spacings on the way to these ends.
    std::vector<double> spacings_up_to(std::span<const double> ends) const {
        if (growth_.least_heights.empty()) return std::vector<double>(ends.size(), HUGE_VAL);
        return largest_spacings(rays_, ends, first_heights_along(rays_, growth_), growth_.fineness);
    }

    /// Returns the heights on a ray up to the first one above `end`.
    std::vector<double> heights_beyond(double end, std::size_t ray, double max_spacing) const {
        const double scale = rays_.lines[ray].slant * rays_.lines[ray].opening;
        const std::span<const double> of_law = law_.of(ray);
        std::vector<double> heights{0.0};
        for (std::size_t n = 1; n < of_law.size() && heights.back() <= end; ++n)
            heights.push_back(heights.back() + std::min(scale * (of_law[n] - of_law[n - 1]), max_spacing));
        return heights;
    }

    void make_unstretched() {
        constexpr double fronts = 2;  // layers that do not fit may be made to fit by a stretch
        max_spacings_ = spacings_up_to(front_);
        heights_.resize(front_.size());
        core::parallel_for(front_.size(), 256, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i)
                heights_[i] = heights_beyond(std::max(fronts * front_[i], asked_[i]), i, max_spacings_[i]);
        });
    }

    ColumnEnd end_of(std::size_t ray) const {
        const double front = front_[ray];
        const std::span<const double> heights = heights_[ray];
        const std::uint32_t n = keeps_law(ray) ? layer_count(heights) : layers_up_to(front, heights);
        const LayerRange range = keeps_law(ray) ? LayerRange{n, n} : layer_range(front, heights, n);
        return {front, stretched_last_spacing(front, heights, n), n, range};
    }

    void choose_numbers() {
        std::vector<ColumnEnd> ends(front_.size());
        core::parallel_for(ends.size(), 256, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) ends[i] = end_of(i);
        });
        layers_ = cheapest_numbers(rays_, ends);
        limit_count_differences(rays_, layers_);
    }

    /// Returns the numbers of layers up to the asked heights: those made where nothing cuts them short.
    std::vector<std::uint32_t> count_asked_layers() const {
        std::vector<std::uint32_t> counts(layers_);
        if (growth_.layers) {
            for (std::size_t i = 0; i < counts.size(); ++i) counts[i] = layer_count(heights_[i]);
        } else if (!std::equal(front_.begin(), front_.end(), asked_.begin())) {
            const std::vector<double> spacings = spacings_up_to(asked_);
            for (std::size_t i = 0; i < counts.size(); ++i)
                if (is_cut(i))
                    counts[i] = std::max(counts[i], layers_up_to(asked_[i], heights_beyond(asked_[i], i, spacings[i])));
        }
        return counts;
    }
};

}  // namespace

// The factor from heights above the wall's edges beside a ray to heights along it. Rays out of a corner would otherwise
// make the cells beside it too low:
//
//       |   /           h / cos(45) along the ray is h above both walls
//     h |..o
//       | /:
//       |/_:____
void set_slants(RaySet& set) {
    constexpr double negligible = 1e-3;  // rays share their heights where it makes no difference
    if (!uses("slants")) return;
    const RayNeighbours neighbours(set);
    std::vector<double> slants(set.lines.size(), 1.0);
    for (std::size_t i = 0; i < slants.size(); ++i) {
        const RayLine& ray = set.lines[i];
        const auto [before, after] =
            wall_neighbours(set.lines[neighbours.previous[i]], ray, set.lines[neighbours.next[i]]);
        double sum = 0, edges = 0;
        const auto add_edge = [&](Point a, Point b) {
            if (a == b) return;
            sum += dot(ray.direction, -perpendicular(unit(b - a)));
            ++edges;
        };
        add_edge(before, ray.origin);
        add_edge(ray.origin, after);
        if (edges * (1 - negligible) <= sum) continue;
        slants[i] = edges / (ray.line_room > 0 ? sum : std::max(sum, edges / max_slant));
    }
    fill_fans(set, slants);
    for (std::size_t i = 0; i < slants.size(); ++i) set.lines[i].slant = slants[i];
}

std::vector<double> first_heights_along(const RaySet& set, const LayerGrowth& growth) {
    std::vector<double> heights;
    heights.reserve(set.lines.size());
    for (std::size_t e = 0; e < set.elements(); ++e)
        for (std::size_t i = set.begin[e]; i < set.begin[e + 1]; ++i)
            heights.push_back(first_height_along(set.lines[i], growth.first_height_on(e)));
    return heights;
}

std::vector<double> asked_heights(const RaySet& set, const LayerGrowth& growth) {
    std::vector<double> asked;
    asked.reserve(set.lines.size());
    for (std::size_t e = 0; e < set.elements(); ++e) {
        const std::vector<double> own = asked_on_element(rays_of_element(set, e), growth_on_element(growth, e));
        asked.insert(asked.end(), own.begin(), own.end());
    }
    return asked;
}

LayerHeights columns_up_to(const RaySet& set, const LayerGrowth& growth, std::span<const double> asked,
                           std::span<const double> front) {
    std::vector<double> table;
    std::vector<HeightColumn> columns;
    columns.reserve(set.lines.size());
    for (std::size_t e = 0; e < set.elements(); ++e) {
        const std::size_t begin = set.begin[e], count = set.begin[e + 1] - begin;
        if (growth.first_height_on(e) == 0) {
            columns.resize(begin + count, {.first = table.size()});
            table.push_back(0);
            continue;
        }
        ElementColumns(rays_of_element(set, e), growth_on_element(growth, e), asked.subspan(begin, count),
                       front.subspan(begin, count))
            .append_to(table, columns);
    }
    return LayerHeights(std::move(table), std::move(columns));
}

}  // namespace lamina::layers
