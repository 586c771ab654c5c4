// Rays, heights, counts, points, border. Source: J. K. Pardue, thesis (2015), chapter 3.
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include <fmt/format.h>

#include <lamina/error.hpp>
#include <lamina/layers.hpp>

#include "core/parallel.hpp"
#include "layers/border.hpp"
#include "layers/coverage.hpp"
#include "layers/front.hpp"
#include "layers/rays.hpp"

namespace lamina {
namespace {

/// A layer this many times as thick as the configuration is wide is a slip of the pen.
constexpr double thickest_layer = 1e4;
/// Heights below this many units of rounding of the coordinates cannot be represented.
constexpr double least_roundings = 64;
/// Rays added where counts of layers change find limits of their own, which may ask for more: once more at most.
constexpr int rounds_of_steps = 2;

void require(bool condition, const std::string& message) {
    if (!condition) throw UsageError(message);
}

void check_options(const LayerOptions& o) {
    require(o.border_ratio > 1 && std::isfinite(o.border_ratio),
            fmt::format("border ratio must be greater than 1, not {}", o.border_ratio));
    require(o.longest_border_edge > 0,
            fmt::format("longest border edge must be greater than 0, not {}", o.longest_border_edge));
    require(o.border_gradation > 0 && std::isfinite(o.border_gradation),
            fmt::format("border gradation must be greater than 0, not {}", o.border_gradation));
    if (!o.enabled) return;
    require(o.max_ray_angle_deg >= 0.01 && o.max_ray_angle_deg <= 90,
            fmt::format("largest angle between rays must be from 0.01 to 90 degrees, not {}", o.max_ray_angle_deg));
    check_growth(o);
}

void check_scale(const Pslg& pslg, const LayerOptions& options, const Heights& heights) {
    Box box;
    for (const Element& element : pslg.elements)
        for (Point p : element.points) box.include(p);
    const double extent = std::max(box.width(), box.height());
    const double largest =
        std::max({std::abs(box.lower.x), std::abs(box.lower.y), std::abs(box.upper.x), std::abs(box.upper.y)});
    require(options.first_height > least_roundings * std::numeric_limits<double>::epsilon() * largest,
            fmt::format("first height {} is below the resolution of coordinates as large as {}", options.first_height,
                        largest));
    const double thickness = heights.tallest();
    require(thickness <= thickest_layer * extent,
            fmt::format("the layers asked for are {:.3g} thick, {:.3g} times the extent of the input", thickness,
                        thickness / extent));
}

RaySet rays_of(const Pslg& pslg, const LayerOptions& options) {
    RaySet set;
    for (const Element& element : pslg.elements) {
        const std::vector<RayLine> rays = make_rays(element.points, options);
        set.rays.insert(set.rays.end(), rays.begin(), rays.end());
        set.begin.push_back(set.rays.size());
    }
    return set;
}

/// Origins without layers or directions: what is left of a body where no layer is wanted.
RaySet bare_walls(const Pslg& pslg) {
    RaySet set;
    for (const Element& element : pslg.elements) {
        for (Point p : element.points) set.rays.push_back({p, {}});
        set.begin.push_back(set.rays.size());
    }
    return set;
}

/// A corner of the border before it is graded.
struct BorderCorner {
    std::size_t ray;       ///< whose tip it is; the last of a fan without layers
    std::uint32_t layers;  ///< 0: it is the ray's origin
};

class Assembly {
public:
    Assembly(const RaySet& set, std::span<const std::uint32_t> counts, const Heights& heights)
        : set_(set), counts_(counts), heights_(heights), wall_of_ray_(set.rays.size()), first_point_(set.rays.size()) {}

    /// The rays, and more where the border between two tips wants to be divided: rows of cells then go on to the wall
    /// instead of fanning out below the division points. Only round resampled elements.
    RaySet with_rays_at_divisions(std::span<const Element> elements, const GradingOptions& grading) const {
        const std::vector<std::vector<BorderCorner>> corners = border_corners();
        const GradedBorders graded = divide_borders(corners, grading);
        // New edges would ask for their own length, which is less than the target, and their neighbours for less still.
        std::vector<std::vector<double>> shares(set_.rays.size()), asks(set_.rays.size());
        for (std::size_t e = 0; e < corners.size(); ++e)
            for (std::size_t k = 0; k < corners[e].size(); ++k) {
                const auto [ray, layers] = corners[e][k];
                const BorderCorner& after = corners[e][(k + 1) % corners[e].size()];
                if (!elements[e].resampled || layers == 0 || after.layers == 0) continue;
                const Point from = tip(ray);
                const double length = distance(from, tip(after.ray));
                for (Point p : graded.cuts[e][k]) shares[ray].push_back(distance(from, p) / length);
                asks[ray] = graded.asks[e][k];
            }
        return insert_rays(set_, shares, asks);
    }

    Layer build(const GradingOptions& grading, std::span<const double> limits) {
        const std::vector<std::vector<BorderCorner>> corners = border_corners();
        const auto cuts = divide_borders(corners, grading).cuts;
        place_walls(corners, cuts);
        place_ray_points();
        place_borders(corners, cuts);
        describe_rays(limits);
        return std::move(layer_);
    }

private:
    const RaySet& set_;
    std::span<const std::uint32_t> counts_;
    const Heights& heights_;
    std::vector<VertexId> wall_of_ray_;
    std::vector<std::size_t> first_point_;
    std::vector<std::vector<VertexId>> wall_cuts_;  ///< by ray: vertices added to the wall edge behind it
    Layer layer_;

    Point tip(std::size_t ray) const {
        const RayLine& line = set_.rays[ray];
        return counts_[ray] == 0 ? line.origin : line.origin + heights_.of(ray)[counts_[ray]] * line.direction;
    }

    std::vector<std::vector<BorderCorner>> border_corners() const {
        std::vector<std::vector<BorderCorner>> borders(set_.bodies());
        for (std::size_t e = 0; e < set_.bodies(); ++e) {
            const std::size_t begin = set_.begin[e], end = set_.begin[e + 1];
            for (std::size_t i = begin; i < end; ++i) {
                const std::size_t next = i + 1 < end ? i + 1 : begin;
                const bool same =
                    counts_[i] == 0 && counts_[next] == 0 && set_.rays[i].origin == set_.rays[next].origin;
                if (!same) borders[e].push_back({i, counts_[i]});
            }
        }
        return borders;
    }

    GradedBorders divide_borders(const std::vector<std::vector<BorderCorner>>& corners, GradingOptions grading) const {
        std::vector<std::vector<Point>> borders(corners.size());
        std::vector<std::vector<double>> asks(corners.size());
        for (std::size_t e = 0; e < corners.size(); ++e)
            for (const BorderCorner& corner : corners[e]) {
                borders[e].push_back(tip(corner.ray));
                asks[e].push_back(set_.border_asks.empty() ? 0 : set_.border_asks[corner.ray]);
            }
        std::vector<std::vector<Point>> walls(set_.bodies());
        for (std::size_t e = 0; e < set_.bodies(); ++e)
            for (std::size_t i = set_.begin[e]; i < set_.begin[e + 1]; ++i)
                if (walls[e].empty() || walls[e].back() != set_.rays[i].origin) walls[e].push_back(set_.rays[i].origin);
        grading.asks = asks;
        return grade_borders(borders, walls, grading);
    }

    VertexId add_point(Point p, std::uint32_t layer) {
        layer_.points.push_back(p);
        layer_.layer_of_point.push_back(static_cast<std::uint16_t>(layer));
        return VertexId(layer_.points.size() - 1);
    }

    /// Where the border runs along the wall, its division divides the wall.
    void place_walls(const std::vector<std::vector<BorderCorner>>& corners,
                     const std::vector<std::vector<std::vector<Point>>>& cuts) {
        wall_cuts_.resize(set_.rays.size());
        layer_.walls.resize(set_.bodies());
        for (std::size_t e = 0; e < set_.bodies(); ++e) {
            std::vector<VertexId>& wall = layer_.walls[e];
            std::size_t k = 0;  // the next border corner
            for (std::size_t i = set_.begin[e]; i < set_.begin[e + 1]; ++i) {
                const Point origin = set_.rays[i].origin;
                if (i == set_.begin[e] || origin != set_.rays[i - 1].origin) wall.push_back(add_point(origin, 0));
                wall_of_ray_[i] = wall.back();
                if (k == corners[e].size() || corners[e][k].ray != i) continue;
                const BorderCorner& after = corners[e][(k + 1) % corners[e].size()];
                if (counts_[i] == 0 && after.layers == 0) {
                    for (Point p : cuts[e][k]) {
                        wall.push_back(add_point(p, 0));
                        wall_cuts_[i].push_back(wall.back());
                    }
                }
                ++k;
            }
        }
        layer_.wall_points = layer_.points.size();
    }

    void place_ray_points() {
        std::size_t total = layer_.points.size();
        for (std::size_t i = 0; i < set_.rays.size(); ++i) {
            first_point_[i] = total;
            total += counts_[i];
        }
        layer_.points.resize(total);
        layer_.layer_of_point.resize(total);
        parallel_for(set_.rays.size(), 4096, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                const RayLine& line = set_.rays[i];
                const std::span<const double> heights = heights_.of(i);
                for (std::uint32_t n = 1; n <= counts_[i]; ++n) {
                    layer_.points[first_point_[i] + n - 1] = line.origin + heights[n] * line.direction;
                    layer_.layer_of_point[first_point_[i] + n - 1] = static_cast<std::uint16_t>(n);
                }
            }
        });
    }

    void place_borders(const std::vector<std::vector<BorderCorner>>& corners,
                       const std::vector<std::vector<std::vector<Point>>>& cuts) {
        layer_.borders.resize(set_.bodies());
        for (std::size_t e = 0; e < set_.bodies(); ++e) {
            std::vector<VertexId>& border = layer_.borders[e];
            for (std::size_t k = 0; k < corners[e].size(); ++k) {
                const auto [ray, layers] = corners[e][k];
                const std::uint32_t after = corners[e][(k + 1) % corners[e].size()].layers;
                border.push_back(layers == 0 ? wall_of_ray_[ray] : VertexId(first_point_[ray] + layers - 1));
                if (layers == 0 && after == 0) {
                    border.insert(border.end(), wall_cuts_[ray].begin(), wall_cuts_[ray].end());
                } else {
                    for (Point p : cuts[e][k]) border.push_back(add_point(p, std::min(layers, after)));
                }
            }
        }
    }

    /// Rays and what became of them; none without limits.
    void describe_rays(std::span<const double> limits) {
        layer_.rays.resize(set_.bodies());
        if (limits.empty()) return;
        for (std::size_t e = 0; e < set_.bodies(); ++e) {
            const std::size_t begin = set_.begin[e], end = set_.begin[e + 1];
            for (std::size_t i = begin; i < end; ++i) {
                const std::span<const double> heights = heights_.of(i);
                const auto [first, requested, growth, stretch] = heights_.stack(i);
                // A ray that was lowered for its neighbours' sake ends below the layer it did not get.
                const double limit = counts_[i] < requested ? std::min(limits[i], heights[counts_[i] + 1]) : limits[i];
                layer_.rays[e].push_back({wall_of_ray_[i], set_.rays[i].direction, counts_[i], requested, growth,
                                          first_point_[i], limit, stretch});
            }
        }
    }
};

}  // namespace

Layer make_layer(const Pslg& pslg, const LayerOptions& options) {
    check_options(options);
    const GradingOptions grading{options.border_ratio, options.border_gradation, options.longest_border_edge,
                                 options.border_sources};
    if (!options.enabled) {
        const RaySet walls = bare_walls(pslg);
        const std::vector<std::uint32_t> none(walls.rays.size(), 0);
        const Heights no_layers({0.0}, std::vector<Stack>(walls.rays.size()));
        return Assembly(walls, none, no_layers).build(grading, {});
    }
    RaySet set = rays_of(pslg, options);
    Heights heights = make_heights(set, options);
    check_scale(pslg, options, heights);
    std::vector<double> limits = height_limits(set, heights);
    const auto take = [&](RaySet more) {
        if (more.rays.size() == set.rays.size()) return false;
        set = std::move(more);
        heights = make_heights(set, options);
        limits = height_limits(set, heights);
        return true;
    };
    for (int round = 0; round < rounds_of_steps; ++round)
        if (!take(add_rays_at_steps(set, heights, limits))) break;
    Heights fitted = fit_heights(heights, limits);
    std::vector<std::uint32_t> counts = layer_counts(set, limits, fitted);

    if (options.ray_gradation) {
        GradingOptions of_rays = grading;
        of_rays.gradation = *options.ray_gradation;
        if (take(Assembly(set, counts, fitted).with_rays_at_divisions(pslg.elements, of_rays))) {
            fitted = fit_heights(heights, limits);
            counts = layer_counts(set, limits, fitted);
        }
    }
    Layer layer = Assembly(set, counts, fitted).build(grading, limits);
    layer.coverage = layer_coverage(set, heights, counts);
    return layer;
}

}  // namespace lamina
