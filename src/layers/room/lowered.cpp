// Columns that are lowered once cells have been seen: where the layer leaves no room for good triangles beyond it, and below
// cells with large angles.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "core/angles.hpp"
#include "core/box_tree.hpp"
#include "core/reproducible_math.hpp"
#include "layers/layer.hpp"
#include "layers/layered_rays.hpp"
#include "layers/stages.hpp"

namespace lamina::layers {

std::vector<std::size_t> shorten_rays(std::span<const Circle> places, Rays& rays) {
    constexpr double kept_share = 0.5;  // of the height
    std::vector<Box> boxes;
    boxes.reserve(places.size());
    for (const Circle& place : places) {
        const Point reach{place.radius, place.radius};
        boxes.push_back({place.middle - reach, place.middle + reach});
    }
    const core::BoxTree tree(std::move(boxes));
    const LayeredRays layered = layered_rays(rays);
    std::vector<std::size_t> ends(places.size(), 0), shortened;
    for (std::size_t i = 0; i < rays.set.lines.size(); ++i) {
        if (rays.counts[i] == 0) continue;
        const Point tip = layered.tip(i);
        Box at_tip;
        at_tip.include(tip);
        bool near = false;
        tree.overlaps(at_tip, [&](std::size_t k) {
            if (distance(places[k].middle, tip) > places[k].radius) return;
            near = true;
            ++ends[k];
        });
        if (near) shortened.push_back(i);
    }
    if (shortened.empty()) return ends;
    for (const std::size_t i : shortened)
        rays.limits[i] = std::min(rays.limits[i], kept_share * rays.heights.of(i)[rays.counts[i]]);
    // A wake without layers on either side would be no part of the layer.
    for (std::size_t i = 0; i < rays.limits.size(); ++i)
        if (rays.set.lines[i].place == RayPlace::wake) rays.limits[i] = std::max(rays.limits[i], rays.heights.of(i)[1]);
    fit_and_count_layers(rays);
    return ends;
}

// Cells with large angles, and columns that end below them. Such cells stand where the border divides the tops of flat
// cells, where rows rise steeply towards a wider column, and in clefts of ice.

namespace {

/// Returns whether the angle at `corner` exceeds an obtuse one with this cosine.
bool exceeds(double cosine, Point before, Point corner, Point after) {
    const Point u = before - corner, v = after - corner;
    const double d = dot(u, v);
    return d < 0 && d * d > cosine * cosine * squared_length(u) * squared_length(v);
}

/// Adds the cells of one kind.
template <class Cell>
void add_obtuse(const Layer& layer, std::span<const Cell> cells, std::span<const std::uint16_t> layers,
                std::span<const std::uint32_t> columns, double cosine, std::vector<ObtuseCell>& found) {
    for (std::size_t i = 0; i < cells.size(); ++i) {
        const auto& v = cells[i].v;
        const auto at = [&](std::size_t k) { return layer.points[v[k % std::size(v)].index()]; };
        for (std::size_t k = 0; k < std::size(v); ++k) {
            if (!exceeds(cosine, at(k), at(k + 1), at(k + 2))) continue;
            found.push_back({columns[i], layers[i]});
            break;
        }
    }
}

/// Returns, for each column, whether one of its rays is so near to the walls on both sides that no cell of the column can do
/// without such an angle: it is the one ray of a concave corner whose sides meet at twice what is left to 180 degrees, or less.
std::vector<char> columns_of_sharp_corners(const Layer& layer, double cosine) {
    std::vector<char> result;
    for (const std::vector<Ray>& rays : layer.rays) {
        const std::size_t n = rays.size();
        const auto origin = [&](std::size_t i) { return layer.points[rays[i % n].origin.index()]; };
        const auto is_near = [&](std::size_t ray, Point edge) {
            return dot(rays[ray].direction, edge) > -cosine * length(edge);
        };
        std::vector<char> sharp(n);
        for (std::size_t i = 0; i < n; ++i)
            sharp[i] = is_near(i, origin(i + 1) - origin(i)) && is_near(i, origin(i + n - 1) - origin(i));
        for (std::size_t i = 0; i < n; ++i) result.push_back(sharp[i] || sharp[(i + 1) % n]);
    }
    return result;
}

}  // namespace

std::vector<ObtuseCell> obtuse_cells(const Layer& layer, const LayerCells& cells, double max_angle_deg) {
    std::vector<ObtuseCell> found;
    const double cosine = core::cos_reproducible(core::radians(max_angle_deg));
    if (!cells.triangle_column.empty())
        add_obtuse<Triangle>(layer, cells.triangles, cells.triangle_layer, cells.triangle_column, cosine, found);
    if (!cells.quad_column.empty())
        add_obtuse<Quad>(layer, cells.quads, cells.quad_layer, cells.quad_column, cosine, found);
    if (found.empty()) return found;
    const std::vector<char> excused = columns_of_sharp_corners(layer, cosine);
    std::erase_if(found,
                  [&](const ObtuseCell& cell) { return cell.column == LayerCells::no_column || excused[cell.column]; });
    return found;
}

bool end_columns_below(std::span<const ObtuseCell> cells, Rays& rays) {
    const std::vector<std::size_t> next = rays.set.following();
    std::vector<std::size_t> in_domain;  // columns are counted there alone
    for (std::size_t e = 0; e < rays.set.elements(); ++e)
        for (std::size_t i = rays.set.begin[e]; i < rays.domain_end(e); ++i) in_domain.push_back(i);
    bool changed = false;
    for (const ObtuseCell& cell : cells) {
        if (cell.layer < 2) continue;
        const std::size_t first = in_domain[cell.column];
        for (const std::size_t ray : {first, next[first]}) {
            if (rays.counts[ray] < cell.layer) continue;
            rays.limits[ray] = std::min(rays.limits[ray], rays.heights.of(ray)[cell.layer - 1u]);
            changed = true;
        }
    }
    if (!changed) return false;
    fit_and_count_layers(rays);
    return true;
}

}  // namespace lamina::layers
