// Stage "close the border": the fronts are divided, and all points of the layer placed. Source: J. K. Pardue, thesis
// (2015), chapter 3.
#include <algorithm>
#include <utility>

#include <lamina/layers.hpp>

#include "core/parallel.hpp"
#include "layers/coverage.hpp"
#include "layers/divide_borders.hpp"
#include "layers/front.hpp"
#include "layers/layered_rays.hpp"
#include "layers/rays.hpp"

namespace lamina::layers {

namespace {

using FrontCorners = std::vector<std::vector<FrontCorner>>;

BorderDivision divide_fronts(const LayeredRays& rays, const FrontCorners& corners, const BorderOptions& options,
                             std::span<const double> ray_factors) {
    std::vector<std::vector<Point>> borders(corners.size()), walls(corners.size());
    std::vector<std::vector<double>> factors(corners.size());
    for (std::size_t e = 0; e < corners.size(); ++e) {
        for (const FrontCorner& corner : corners[e]) {
            borders[e].push_back(rays.tip(corner.ray));
            factors[e].push_back(ray_factors.empty() ? 0 : ray_factors[corner.ray]);
        }
        for (std::size_t i = rays.set.begin[e]; i < rays.set.begin[e + 1]; ++i)
            if (const Point origin = rays.set.lines[i].origin; walls[e].empty() || walls[e].back() != origin)
                walls[e].push_back(origin);
    }
    return divide_borders(borders, walls, options, factors);
}

/// Returns the rays, and more where the front between two tips wants to be divided: rows of cells then go on to the
/// wall instead of fanning out below the division points. Only round resampled elements.
DividedRays rays_at_divisions(const Rays& rays, const BorderOptions& options) {
    const LayeredRays layered{rays.set, rays.fitted, rays.counts};
    const FrontCorners corners = front_corners(layered);
    const BorderDivision division = divide_fronts(layered, corners, options, {});
    // New edges would ask for their own length, which is less than the target, and their neighbours for less still.
    std::vector<std::vector<double>> shares(rays.set.lines.size()), factors(rays.set.lines.size());
    for (std::size_t e = 0; e < corners.size(); ++e)
        for (std::size_t k = 0; k < corners[e].size(); ++k) {
            const auto [ray, layers] = corners[e][k];
            const FrontCorner& after = corners[e][(k + 1) % corners[e].size()];
            if (!rays.resampled[e] || layers == 0 || after.layers == 0) continue;
            const Point from = layered.tip(ray);
            const double length = distance(from, layered.tip(after.ray));
            for (Point p : division.points[e][k]) shares[ray].push_back(distance(from, p) / length);
            factors[ray] = division.target_factors[e][k];
        }
    return insert_rays(rays.set, shares, factors);
}

/// Places walls, ray points and borders, in this order.
class LayerBuilder {
public:
    explicit LayerBuilder(const Rays& rays)
        : rays_(rays), set_(rays.set), wall_of_ray_(set_.lines.size()), first_point_(set_.lines.size()) {}

    Layer build(const FrontCorners& corners, const BorderDivision& division) {
        place_walls(corners, division);
        place_ray_points();
        place_borders(corners, division);
        describe_rays();
        return std::move(layer_);
    }

private:
    const Rays& rays_;
    const RaySet& set_;
    std::vector<VertexId> wall_of_ray_;
    std::vector<std::size_t> first_point_;
    std::vector<std::vector<VertexId>> wall_divisions_;  ///< by ray: vertices added to the wall edge behind it
    Layer layer_;

    VertexId add_point(Point p, std::uint32_t layer) {
        layer_.points.push_back(p);
        layer_.layer_of_point.push_back(static_cast<std::uint16_t>(layer));
        return VertexId(layer_.points.size() - 1);
    }

    /// Where the border runs along the wall, its division divides the wall.
    void place_walls(const FrontCorners& corners, const BorderDivision& division) {
        wall_divisions_.resize(set_.lines.size());
        layer_.walls.resize(set_.elements());
        for (std::size_t e = 0; e < set_.elements(); ++e) {
            std::vector<VertexId>& wall = layer_.walls[e];
            std::size_t k = 0;  // the next corner of the front
            for (std::size_t i = set_.begin[e]; i < set_.begin[e + 1]; ++i) {
                const Point origin = set_.lines[i].origin;
                if (i == set_.begin[e] || origin != set_.lines[i - 1].origin) wall.push_back(add_point(origin, 0));
                wall_of_ray_[i] = wall.back();
                if (k == corners[e].size() || corners[e][k].ray != i) continue;
                const FrontCorner& after = corners[e][(k + 1) % corners[e].size()];
                if (rays_.counts[i] == 0 && after.layers == 0) {
                    for (Point p : division.points[e][k]) {
                        wall.push_back(add_point(p, 0));
                        wall_divisions_[i].push_back(wall.back());
                    }
                }
                ++k;
            }
        }
        layer_.wall_points = layer_.points.size();
    }

    void place_ray_points() {
        std::size_t total = layer_.points.size();
        for (std::size_t i = 0; i < set_.lines.size(); ++i) {
            first_point_[i] = total;
            total += rays_.counts[i];
        }
        layer_.points.resize(total);
        layer_.layer_of_point.resize(total);
        core::parallel_for(set_.lines.size(), 4096, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                const RayLine& line = set_.lines[i];
                const std::span<const double> heights = rays_.fitted.of(i);
                for (std::uint32_t n = 1; n <= rays_.counts[i]; ++n) {
                    layer_.points[first_point_[i] + n - 1] = line.origin + heights[n] * line.direction;
                    layer_.layer_of_point[first_point_[i] + n - 1] = static_cast<std::uint16_t>(n);
                }
            }
        });
    }

    void place_borders(const FrontCorners& corners, const BorderDivision& division) {
        layer_.borders.resize(set_.elements());
        for (std::size_t e = 0; e < set_.elements(); ++e) {
            std::vector<VertexId>& border = layer_.borders[e];
            for (std::size_t k = 0; k < corners[e].size(); ++k) {
                const auto [ray, layers] = corners[e][k];
                const std::uint32_t after = corners[e][(k + 1) % corners[e].size()].layers;
                border.push_back(layers == 0 ? wall_of_ray_[ray] : VertexId(first_point_[ray] + layers - 1));
                if (layers == 0 && after == 0) {
                    border.insert(border.end(), wall_divisions_[ray].begin(), wall_divisions_[ray].end());
                } else {
                    for (Point p : division.points[e][k]) border.push_back(add_point(p, std::min(layers, after)));
                }
            }
        }
    }

    /// Records the rays and what became of them; none without layers.
    void describe_rays() {
        layer_.rays.resize(set_.elements());
        if (!rays_.enabled) return;
        for (std::size_t e = 0; e < set_.elements(); ++e) {
            for (std::size_t i = set_.begin[e]; i < set_.begin[e + 1]; ++i) {
                const std::span<const double> heights = rays_.fitted.of(i);
                const auto [first, requested, growth, stretch] = rays_.fitted.column(i);
                const std::uint32_t count = rays_.counts[i];
                // A ray that was lowered for its neighbours' sake ends below the layer it did not get.
                const double limit =
                    count < requested ? std::min(rays_.limits[i], heights[count + 1]) : rays_.limits[i];
                layer_.rays[e].push_back({wall_of_ray_[i], set_.lines[i].direction, count, requested, growth,
                                          first_point_[i], limit, stretch});
            }
        }
    }
};

}  // namespace

}  // namespace lamina::layers

namespace lamina {

using namespace layers;

LayerEdges layer_edges(const Layer& layer) {
    LayerEdges result;
    std::vector<Segment> wall_edges, border_edges;  // both counter-clockwise
    for (const auto& wall : layer.walls) {
        auto& clockwise = result.walls.emplace_back();
        for (std::size_t i = 0; i < wall.size(); ++i) {
            const VertexId a = wall[i], b = wall[i + 1 < wall.size() ? i + 1 : 0];
            wall_edges.push_back({a, b});
            clockwise.push_back({b, a});
        }
    }
    for (const auto& border : layer.borders)
        for (std::size_t i = 0; i < border.size(); ++i)
            border_edges.push_back({border[i], border[i + 1 < border.size() ? i + 1 : 0]});

    std::sort(wall_edges.begin(), wall_edges.end());
    std::sort(border_edges.begin(), border_edges.end());
    for (const Segment& e : border_edges) {
        if (std::binary_search(wall_edges.begin(), wall_edges.end(), e)) continue;
        result.region.push_back(e);
        result.interfaces.push_back({std::min(e.a, e.b), std::max(e.a, e.b)});
    }
    for (const Segment& e : wall_edges)
        if (!std::binary_search(border_edges.begin(), border_edges.end(), e)) result.region.push_back({e.b, e.a});
    std::sort(result.interfaces.begin(), result.interfaces.end());
    return result;
}

Layer close_border(Rays rays, const BorderOptions& options) {
    validate(options);
    std::vector<double> factors;
    if (rays.enabled && options.ray_gradation) {
        BorderOptions of_rays = options;
        of_rays.gradation = *options.ray_gradation;
        DividedRays more = rays_at_divisions(rays, of_rays);
        if (take_rays(std::move(more.set), rays)) {
            factors = std::move(more.factors);
            count_layers(rays);
        }
    }
    const LayeredRays layered{rays.set, rays.fitted, rays.counts};
    const FrontCorners corners = front_corners(layered);
    Layer layer = LayerBuilder(rays).build(corners, divide_fronts(layered, corners, options, factors));
    if (rays.enabled) layer.coverage = layer_coverage(rays.set, rays.heights, rays.counts);
    layer.growth = rays.growth;
    layer.edges = layer_edges(layer);
    return layer;
}

std::vector<std::vector<Point>> border_loops(const Layer& layer) {
    std::vector<std::vector<Point>> loops;
    for (const auto& border : layer.borders) {
        std::vector<Point>& loop = loops.emplace_back();
        for (VertexId v : border) loop.push_back(layer.points[v.index()]);
    }
    return loops;
}

}  // namespace lamina
