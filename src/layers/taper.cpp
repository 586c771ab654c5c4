// Columns at sharp edges and bases are narrow up to the front, where triangles begin that are as small as columns are
// wide. Numbers of layers change little there (numbers.cpp), so that last layers are higher than columns are
// wide. They are made lower at the expense of those in the middle of the column:
//
//      |___|        |___|  <- front, as before
//      |   |        |___|
//      |   |        |   |
//      |___|        |___|      Left: layers of equal heights. Right: the last one has half of its height, and those
//      |   |        |   |      in the middle are a sixth higher. The number of layers is the same, and so is the front.
//      |   |        |   |
//      |___|        |   |
//      |   |        |___|
//
// A point at the distance x below the front, in lengths of the part that changes, comes to the distance
// x (s + (1 - s) f(x)) with f(x) = x (2 - x), whose slope is s at the front and 1 at the end of the part, so that nothing
// jumps there. A last layer of the height x becomes s + (1 - s) f(x) times as high. Where columns are far wider than their
// last layers are high, s is above 1. docs/layer.md.
#include "layers/taper.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "core/predicates.hpp"
#include "layers/layered_rays.hpp"
#include "layers/mechanisms.hpp"
#include "layers/neighbours.hpp"

namespace lamina::layers {

namespace {

/// Last layers become this many times as high as if their cells had the area of squares on the front's edges: half of
/// such a cell has the area of the triangle beyond. They become the second number times as high at least, for 0.6 times
/// the area.
constexpr double wanted_tallness = 0.91, least_tallness = 0.54;
/// Rays lean along the front's edges by so much at most, as the sine between them; farther ones count as if they did.
/// Columns of quadrilaterals count as upright.
constexpr double least_sine = 0.1, sine_of_upright = 1;
/// Where numbers of layers change, fronts rise by up to a quarter of the width of a column. If last layers become this
/// many times as high as wide, the ends of the column differ by less than a third of a cell. But those of narrow
/// columns near them become no higher for it than the second number of times.
constexpr double even_tallness = 0.86, most_tallness = 1.2;
/// The heights of so many last layers change.
constexpr double tapered_layers = 30;
/// Where neighbours are not tapered alike, rows rise by this much per unit of distance at most. Points move by up to 4
/// / 27 of the part that changes, if the slope at the front is 0.
constexpr double most_rise = 0.25, most_moved = 4.0 / 27;
/// A last layer higher than this share of the part that changes stays as it is: fewer than three layers have no room for
/// others.
constexpr double highest_last = 0.37;

/// Returns the first layer from which on heights change.
std::size_t first_tapered(std::span<const double> heights) {
    const std::size_t n = heights.size() - 1, half = std::max<std::size_t>(n / 2, 1);
    const double begin = heights[n] - tapered_layers * (heights[n] - heights[n - 1]);
    const auto above = std::upper_bound(heights.begin() + static_cast<std::ptrdiff_t>(half), heights.end(), begin);
    return std::max(half, static_cast<std::size_t>(above - heights.begin()) - 1);
}

/// Returns what a last layer of this height, as a share of the part that changes, becomes times as high if the slope at the
/// front is 0. Columns are tapered no further: with a smaller slope the layer below would be more than three times as high.
double taper_of_flat_end(double last) { return last * (2 - last); }

/// How far the column of a ray should be tapered, and how far it may be.
struct TaperBounds {
    double part = 0;                 ///< length of the part of the column that changes
    double wanted = 1;               ///< taper with which the last layer is as high as wanted
    double least = 0;                ///< taper below which it would be too low
    double most = HUGE_VAL;          ///< taper above which it would be too high for the triangles beyond
    double lowest = 1, highest = 1;  ///< what the column has room for, whatever its neighbours want
};

/// Returns the height along a ray up to which a layer with this edge at its end has the area of a square on the edge. It
/// is the length of the edge, and more where the ray leans:
///
///        ._______.
///       /       /      edge * edge = height * (distance of the edge's other end from the ray)
///      /_______/
double height_of_square(Point edge, Point direction, double lowest_sine) {
    const double width = length(edge);
    const double across = std::max(std::abs(cross(edge, direction)), lowest_sine * width);
    return across > 0 ? width * width / across : 0;
}

/// Returns the bounds for a ray between these two others.
TaperBounds taper_bounds(const LayeredRays& rays, std::size_t before, std::size_t ray, std::size_t after, bool quads) {
    const std::uint32_t n = rays.counts[ray], least_beside = std::min(rays.counts[before], rays.counts[after]);
    if (n < 2 || least_beside == 0) return {};
    const std::span<const double> heights = rays.heights.of(ray).first(n + std::size_t{1});
    const double last = rays.last_spacing(ray);
    const Point tip = rays.tip(ray), direction = rays.set.lines[ray].direction;
    const double sine = quads ? sine_of_upright : least_sine;
    const double square = std::sqrt(height_of_square(rays.tip(before) - tip, direction, sine) *
                                    height_of_square(rays.tip(after) - tip, direction, sine));
    const bool changes = rays.counts[before] != n || rays.counts[after] != n;
    const double part = heights[n] - heights[first_tapered(heights)];
    if (last > highest_last * part) return {};
    const double lowest = std::max(taper_of_flat_end(last / part), least_taper);
    return {.part = part,
            .wanted = std::clamp(wanted_tallness * square / last, lowest, 1.0),
            .least = std::min((changes && !quads ? even_tallness : least_tallness) * square / last, most_taper),
            .most = most_tallness * square / last,
            .lowest = lowest,
            .highest = most_taper};
}

/// Returns the taper of each ray. quads: whether cells are quadrilaterals.
std::vector<double> tapers(const LayeredRays& rays, bool quads) {
    const RayNeighbours neighbours(rays.set);
    std::vector<TaperBounds> bounds;
    std::vector<double> wanted, most, least;  // the latter negative, so that lowering it raises the bound
    for (std::size_t i = 0; i < rays.counts.size(); ++i) {
        bounds.push_back(taper_bounds(rays, neighbours.previous[i], i, neighbours.next[i], quads));
        wanted.push_back(bounds.back().wanted);
        most.push_back(bounds.back().most);
        least.push_back(-bounds.back().least);
    }
    // All lead over to the neighbours, so that no taper jumps where one of them gives way to another.
    for (std::vector<double>* values : {&wanted, &most, &least})
        lower_to_neighbours(rays.set, *values, [&](std::size_t from, std::size_t to) {
            const double part = std::max(bounds[from].part, bounds[to].part);
            if (!(part > 0)) return HUGE_VAL;
            return (*values)[from] + most_rise * distance(rays.tip(from), rays.tip(to)) / (most_moved * part);
        });
    for (std::size_t i = 0; i < wanted.size(); ++i) {
        // Low cells of wide columns may not make cells of narrow ones too high.
        const double lowest = std::min(-least[i], most[i]);
        wanted[i] = std::clamp(std::max(wanted[i], lowest), bounds[i].lowest, bounds[i].highest);
    }
    return wanted;
}

/// Returns heights of which each column is tapered up to its number of layers.
LayerHeights tapered_heights(const LayerHeights& heights, std::span<const std::uint32_t> counts,
                             std::span<const double> tapers) {
    std::vector<double> table = heights.table();
    std::vector<HeightColumn> columns;
    columns.reserve(tapers.size());
    for (std::size_t ray = 0; ray < tapers.size(); ++ray) {
        HeightColumn& column = columns.emplace_back(heights.column(ray));
        column.taper = tapers[ray];
        taper_heights(column.taper, std::span(table).subspan(column.first, counts[ray] + std::size_t{1}));
    }
    return LayerHeights(std::move(table), std::move(columns));
}

/// Returns whether a cell between two rays is crossed.
bool has_crossed_cell(const LayeredRays& rays, std::size_t i, std::size_t j) {
    const std::uint32_t common = std::min(rays.counts[i], rays.counts[j]);
    for (std::uint32_t n = 2; n <= common; ++n) {
        const Point a = rays.point(i, n - 1), b = rays.point(i, n), c = rays.point(j, n), d = rays.point(j, n - 1);
        if (!core::is_convex(a, b, c, d)) return true;
    }
    if (common == 0 || rays.counts[i] == rays.counts[j]) return false;
    const Point top = rays.point(rays.counts[i] > common ? i : j, common + 1);
    return !(core::inline_orient2d(rays.point(i, common), top, rays.point(j, common)) > 0);
}

/// Leaves the columns on both sides of crossed cells as they were: rows rise most where a column is narrower than at the
/// front. Columns without tapers have no such cells. Returns whether there were any.
bool leave_crossed_columns(const LayeredRays& rays, std::vector<double>& tapers) {
    const std::vector<std::size_t> next = rays.set.following();
    std::vector<std::size_t> crossed;
    for (std::size_t i = 0; i < next.size(); ++i)
        if ((tapers[i] != 1 || tapers[next[i]] != 1) && has_crossed_cell(rays, i, next[i])) crossed.push_back(i);
    for (const std::size_t i : crossed) tapers[i] = tapers[next[i]] = 1;
    return !crossed.empty();
}

}  // namespace

void taper_heights(double taper, std::span<double> heights) {
    if (taper == 1 || heights.size() < 3) return;
    const std::size_t first = first_tapered(heights);
    const double end = heights.back(), part = end - heights[first];
    const double flat = taper_of_flat_end((end - heights[heights.size() - 2]) / part);
    const double slope = (taper - flat) / (1 - flat);
    for (std::size_t k = first + 1; k + 1 < heights.size(); ++k) {
        const double x = (end - heights[k]) / part;
        heights[k] = end - part * x * (slope + (1 - slope) * x * (2 - x));
    }
}

void taper_columns(Rays& rays) {
    if (rays.growth.layers || !uses("taper")) return;
    const LayerHeights untapered = rays.heights;
    std::vector<double> wanted = tapers(layered_rays(rays), rays.topology == LayerTopology::quads);
    do {
        rays.heights = tapered_heights(untapered, rays.counts, wanted);
    } while (leave_crossed_columns(layered_rays(rays), wanted));
}

}  // namespace lamina::layers
