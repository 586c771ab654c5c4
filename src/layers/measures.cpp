// What reports say of a layer: the share of the requested cells that was made, everywhere and where nothing is in their
// way, and how evenly columns end.
#include "layers/measures.hpp"
#include "layers/layer.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include <lamina/layers.hpp>

#include "core/box_tree.hpp"
#include "core/parallel.hpp"
#include "core/segments.hpp"
#include "layers/layered_rays.hpp"
#include "layers/parameters.hpp"
#include "layers/stages.hpp"

namespace lamina::layers {

namespace {

/// Returns, for each ray, whether it is in the open: whether the circle that touches the wall at its origin, open_space
/// full heights in diameter, holds no wall. An empty circle measures free space in slots, at corners and along tight
/// curvature alike.
std::vector<char> open_rays(const RaySet& set, std::span<const double> asked, std::span<const std::size_t> next) {
    std::vector<std::pair<Point, Point>> edges;
    std::vector<Box> boxes;
    for (std::size_t i = 0; i < set.lines.size(); ++i) {
        const RayLine &ray = set.lines[i], &after = set.lines[next[i]];
        if (ray.place != RayPlace::wall || after.place != RayPlace::wall) continue;
        edges.emplace_back(ray.origin, after.origin);
        boxes.push_back(core::bounding_box(ray.origin, after.origin));
    }
    const core::BoxTree walls(std::move(boxes));
    std::vector<char> open(set.lines.size());
    core::parallel_for(set.lines.size(), 512, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const double height = asked[i] / set.lines[i].slant;
            const double radius = 0.5 * open_space * height, inner = inner_share * radius;
            const Point middle = set.lines[i].origin + radius * set.lines[i].direction;
            const double nearest = walls.min_distance(middle, inner, [&](std::size_t j) {
                return core::distance_to_segment(middle, edges[j].first, edges[j].second);
            });
            open[i] = nearest >= inner;
        }
    });
    return open;
}

void add_cells(std::uint32_t requested, std::uint32_t made, LayerCoverage& coverage) {
    coverage.requested_cells += requested;
    coverage.made_cells += made;
}

void add_ray(bool complete, LayerCoverage& coverage) {
    ++coverage.rays;
    coverage.incomplete_rays += !complete;
}

}  // namespace

std::vector<ElementCoverage> layer_coverage(const Rays& rays) {
    const auto& [set, heights, counts] = layered_rays(rays);
    const std::vector<std::size_t> next = set.following();
    const std::vector<char> open = open_rays(set, rays.asked, next);
    std::vector<ElementCoverage> coverage(rays.shown());
    for (std::size_t e = 0; e < rays.shown(); ++e) {
        auto& [all, in_the_open, worst] = coverage[e];
        double most_missing = 0;
        for (std::size_t i = set.begin[e]; i < rays.domain_end(e); ++i) {
            if (set.lines[i].place != RayPlace::wall) continue;
            const std::uint32_t requested = heights.column(i).asked_layers;
            const bool is_last = rays.is_open(e) && i + 1 == rays.domain_end(e);
            const std::uint32_t requested_cells =
                is_last ? 0 : std::min(requested, heights.column(next[i]).asked_layers);
            const std::uint32_t made_cells = is_last ? 0 : std::min(counts[i], counts[next[i]]);
            add_ray(counts[i] == requested, all);
            add_cells(requested_cells, made_cells, all);
            if (open[i]) add_ray(counts[i] == requested, in_the_open);
            const double missing = 1 - double(counts[i]) / std::max(1.0, double(requested));
            if (open[i] && missing > most_missing) {
                most_missing = missing;
                worst = set.lines[i].origin;
            }
            if (open[i] && open[next[i]]) add_cells(requested_cells, made_cells, in_the_open);
        }
    }
    return coverage;
}

}  // namespace lamina::layers

namespace lamina {

using namespace layers;

ElementCoverage& ElementCoverage::operator+=(const ElementCoverage& other) {
    const auto add = [](LayerCoverage& to, const LayerCoverage& from) {
        to.rays += from.rays;
        to.incomplete_rays += from.incomplete_rays;
        to.requested_cells += from.requested_cells;
        to.made_cells += from.made_cells;
    };
    add(all, other.all);
    add(open, other.open);
    return *this;
}

}  // namespace lamina

// The steps in which the layer ends.
namespace lamina::layers {

namespace {

/// A column between two rays, whose heights are those above its edge of the wall, or along the rays of a fan.
class Column {
public:
    Column(const Layer& layer, const Ray& a, const Ray& b) : layer_(layer) {
        const Point edge = at(b.origin) - at(a.origin);
        if (a.origin != b.origin) normal_ = -perpendicular(unit(edge));
    }

    /// Returns the height of the top of layer n.
    double height(const Ray& ray, std::uint32_t n) const {
        const Point up = at(ray.vertex(n)) - at(ray.origin);
        return normal_ ? dot(up, *normal_) : length(up);
    }
    /// Returns the height of the last layer; 0 where there is none.
    double last_spacing(const Ray& ray) const {
        return ray.layers == 0 ? 0 : height(ray, ray.layers) - height(ray, ray.layers - 1);
    }

private:
    const Layer& layer_;
    std::optional<Point> normal_;

    Point at(VertexId v) const { return layer_.points[v.index()]; }
};

}  // namespace

BorderSteps border_steps(const Layer& layer) {
    BorderSteps steps;
    for (std::size_t e = 0; e < layer.rays.size(); ++e) {
        const std::vector<Ray>& rays = layer.rays[e];
        for (std::size_t i = 0; i + layer.is_open(e) < rays.size(); ++i) {
            const Ray &a = rays[i], &b = rays[i + 1 < rays.size() ? i + 1 : 0];
            if (a.requested == 0 && b.requested == 0) continue;
            ++steps.columns;
            steps.full_columns += a.layers == a.requested && b.layers == b.requested;
            if (a.layers == 0 && b.layers == 0) continue;
            const Column column(layer, a, b);
            const double step = std::abs(column.height(a, a.layers) - column.height(b, b.layers)) /
                                std::max(column.last_spacing(a), column.last_spacing(b));
            steps.uneven_columns += step > even_border_step;
            if (step <= steps.max_step) continue;
            steps.max_step = step;
            steps.max_step_at = layer.points[a.tip().index()];
        }
    }
    return steps;
}

}  // namespace lamina::layers
