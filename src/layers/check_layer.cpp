// The promises of layers.hpp, checked one by one and independently of how the layer was made.
#include <algorithm>
#include <cmath>
#include <string>

#include <fmt/format.h>

#include <lamina/layers.hpp>

#include "core/box_tree.hpp"
#include "core/reproducible_math.hpp"
#include "core/segments.hpp"
#include "layers/fit_heights.hpp"
#include "layers/growth_laws.hpp"

namespace lamina::layers {

namespace {

constexpr std::size_t most_findings = 20;

/// One directed edge of a wall or border.
struct LoopEdge {
    VertexId a, b;
    std::size_t body;
};

class Validator {
public:
    Validator(const Layer& layer, const LayerOptions& options, const BorderOptions& border)
        : layer_(layer),
          options_(options),
          border_options_(border),
          walls_(edges_of(layer.walls)),
          borders_(edges_of(layer.borders)),
          wall_tree_(tree_of(walls_)),
          border_tree_(tree_of(borders_)) {}

    std::vector<std::string> run() {
        check_points();
        check_loops("wall", layer_.walls, walls_, wall_tree_);
        check_loops("border", layer_.borders, borders_, border_tree_);
        check_borders_against_walls();
        check_rays();
        check_cells();
        check_places();
        check_ratio();
        return std::move(findings_);
    }

private:
    const Layer& layer_;
    const LayerOptions& options_;
    const BorderOptions& border_options_;
    std::vector<LoopEdge> walls_, borders_;
    core::BoxTree wall_tree_, border_tree_;
    std::vector<std::string> findings_;

    Point at(VertexId v) const { return layer_.points[v.index()]; }
    void find(const std::string& what, Point where) {
        if (findings_.size() < most_findings)
            findings_.push_back(fmt::format("{} at ({}, {})", what, where.x, where.y));
    }

    std::vector<LoopEdge> edges_of(const std::vector<std::vector<VertexId>>& loops) const {
        std::vector<LoopEdge> edges;
        for (std::size_t e = 0; e < loops.size(); ++e)
            for (std::size_t k = 0; k < loops[e].size(); ++k)
                edges.push_back({loops[e][k], loops[e][(k + 1) % loops[e].size()], e});
        return edges;
    }
    core::BoxTree tree_of(const std::vector<LoopEdge>& edges) const {
        std::vector<Box> boxes;
        for (const LoopEdge& edge : edges) boxes.push_back(core::bounding_box(at(edge.a), at(edge.b)));
        return core::BoxTree(std::move(boxes));
    }

    void check_points() {
        if (layer_.layer_of_point.size() != layer_.points.size()) find("layer_of_point has the wrong size", {});
        std::vector<Point> sorted = layer_.points;
        std::sort(sorted.begin(), sorted.end(), lexicographically_less);
        for (std::size_t i = 0; i < sorted.size(); ++i) {
            if (!in_exact_range(sorted[i])) find("point outside the exact range", sorted[i]);
            if (i > 0 && sorted[i] == sorted[i - 1]) find("two points in one place", sorted[i]);
        }
    }

    /// Simple, counter-clockwise, disjoint from the others.
    void check_loops(const char* name, const std::vector<std::vector<VertexId>>& loops,
                     const std::vector<LoopEdge>& edges, const core::BoxTree& tree) {
        for (const std::vector<VertexId>& loop : loops) {
            double area = 0;
            for (std::size_t k = 0; k < loop.size(); ++k)
                area += cross(at(loop[k]) - at(loop[0]), at(loop[(k + 1) % loop.size()]) - at(loop[0]));
            if (loop.size() < 3 || !(area > 0)) find(fmt::format("{} is not counter-clockwise", name), at(loop[0]));
        }
        for (std::size_t i = 0; i < edges.size(); ++i) {
            const auto [a, b, body] = edges[i];
            tree.overlaps(core::bounding_box(at(a), at(b)), [&, a = a, b = b](std::size_t j) {
                if (j <= i) return;
                const auto [c, d, other] = edges[j];
                const bool follows = b == c, precedes = a == d;
                if (follows && precedes) {
                    find(fmt::format("{} runs to and fro", name), at(a));
                } else if (follows || precedes) {
                    const Point apex = follows ? at(b) : at(a), p = follows ? at(a) : at(b),
                                q = follows ? at(d) : at(c);
                    if (core::segments_fold(apex, p, q)) find(fmt::format("{} folds back", name), apex);
                } else if (core::segments_meet(at(a), at(b), at(c), at(d))) {
                    find(fmt::format("{} edges meet", name), at(a));
                }
            });
        }
    }

    void check_borders_against_walls() {
        for (const auto& [a, b, body] : borders_) {
            wall_tree_.overlaps(core::bounding_box(at(a), at(b)), [&, a = a, b = b](std::size_t j) {
                const auto [c, d, other] = walls_[j];
                if (a == c && b == d) return;
                const bool at_a = a == c || a == d, at_b = b == c || b == d;
                if (!at_a && !at_b) {
                    if (core::segments_meet(at(a), at(b), at(c), at(d))) find("border meets wall", at(a));
                } else if (at_a && at_b) {
                    find("border runs along a wall the wrong way", at(a));
                } else {
                    const VertexId apex = at_a ? a : b;
                    if (core::segments_fold(at(apex), at(at_a ? b : a), at(apex == c ? d : c)))
                        find("border overlaps a wall", at(apex));
                }
            });
        }
    }

    void check_rays() {
        const double widest = core::radians(options_.max_ray_angle_deg) + 1e-9;
        for (std::size_t e = 0; e < layer_.rays.size(); ++e) {
            const std::vector<Ray>& rays = layer_.rays[e];
            std::size_t on_wall = 0;
            for (std::size_t i = 0; i < rays.size(); ++i) {
                const Ray &ray = rays[i], &next = rays[(i + 1) % rays.size()];
                const Point origin = at(ray.origin);
                while (on_wall < layer_.walls[e].size() && layer_.walls[e][on_wall] != ray.origin) ++on_wall;
                if (on_wall == layer_.walls[e].size()) find("rays are not in the order of the wall", origin);
                if (std::abs(length(ray.direction) - 1) > 1e-12) find("direction is no unit vector", origin);
                if (ray.layers > ray.requested) find("ray has more layers than requested", origin);
                if (ray.layers > next.layers + 1 || next.layers > ray.layers + 1)
                    find("neighbouring rays differ by more than one layer", origin);
                const double angle =
                    core::atan2_reproducible(cross(ray.direction, next.direction), dot(ray.direction, next.direction));
                if (std::abs(angle) > widest)
                    find(fmt::format("{} degrees between rays", core::degrees(angle)), origin);
                check_heights(ray);
            }
        }
    }

    void check_heights(const Ray& ray) {
        const Point origin = at(ray.origin);
        const double rounding = 4e-16 * (std::abs(origin.x) + std::abs(origin.y));
        const GrowthLawEntry& law = growth_law_entry(options_.growth_law);
        if (law.by_spacing ? ray.growth < law.by_spacing->min_growth || ray.growth > law.by_spacing->max_growth
                           : ray.growth != law.ray_growth(layer_.growth))
            find("ray grows at a rate of its own", origin);
        std::vector<double> heights = law.heights(layer_.growth.first_height, ray.growth, ray.layers);
        stretch_heights(ray.stretch, heights);
        if (ray.stretch != 1 && std::isinf(ray.height_limit)) find("ray is stretched without a limit", origin);
        if (!(ray.stretch <= max_stretch && ray.stretch * max_stretch >= 1 - 1e-12))
            find(fmt::format("ray is stretched by {}", ray.stretch), origin);
        for (std::uint32_t n = 0; n < ray.layers; ++n) {
            const double height = heights[n + 1];
            const Point p = layer_.points[ray.first_point + n];
            if (distance(p, origin + height * ray.direction) > 1e-11 * height + rounding)
                find(fmt::format("layer {} is not at its height", n + 1), p);
            if (layer_.layer_of_point[ray.first_point + n] != n + 1) find("layer_of_point is wrong", p);
        }
        if (heights[ray.layers] > ray.height_limit * (1 + 1e-12)) find("ray is longer than its limit", origin);
    }

    Point on_ray(const Ray& ray, std::uint32_t n) const {
        return n == 0 ? at(ray.origin) : layer_.points[ray.first_point + n - 1];
    }

    /// Every quadrilateral between neighbouring rays is convex, every triangle of a fan or step is positive.
    void check_cells() {
        for (const std::vector<Ray>& rays : layer_.rays) {
            for (std::size_t i = 0; i < rays.size(); ++i) {
                const Ray &ray = rays[i], &next = rays[(i + 1) % rays.size()];
                const std::uint32_t common = std::min(ray.layers, next.layers);
                for (std::uint32_t n = 1; n <= common; ++n) {
                    const Point a = on_ray(ray, n - 1), b = on_ray(ray, n), c = on_ray(next, n),
                                d = on_ray(next, n - 1);
                    bool sound = orient2d(a, b, c) > 0 && orient2d(b, c, d) > 0;
                    if (!(a == d)) sound = sound && orient2d(c, d, a) > 0 && orient2d(d, a, b) > 0;
                    if (!sound) find(fmt::format("crossed cell of layer {}", n), a);
                }
                if (ray.layers == next.layers) continue;
                const Point a = on_ray(ray, common), d = on_ray(next, common);
                const Point top = on_ray(ray.layers > common ? ray : next, common + 1);
                if (!(a == d) && orient2d(a, top, d) <= 0) find("crossed cell at a step", a);
            }
        }
    }

    /// How often the upward vertical from p crosses edges of `body` and of others; on_edge where p lies on one.
    struct Crossings {
        std::size_t own = 0, others = 0;
        bool on_edge = false;
    };
    Crossings crossings(Point p, std::size_t body, const std::vector<LoopEdge>& edges,
                        const core::BoxTree& tree) const {
        Crossings result;
        tree.overlaps({p, {p.x, HUGE_VAL}}, [&](std::size_t i) {
            Point a = at(edges[i].a), b = at(edges[i].b);
            if (b.x < a.x) std::swap(a, b);
            const double side = orient2d(a, b, p);
            if (side == 0 && core::bounding_box(a, b).contains(p)) result.on_edge = true;
            if ((a.x <= p.x) == (b.x <= p.x) || side >= 0) return;
            ++(edges[i].body == body ? result.own : result.others);
        });
        return result;
    }

    /// Every ray point and border point outside all walls; every point below the border strictly inside its own.
    void check_places() {
        std::vector<std::size_t> body(layer_.points.size(), 0);
        std::vector<char> on_border(layer_.points.size(), 0);
        for (std::size_t e = 0; e < layer_.rays.size(); ++e)
            for (const Ray& ray : layer_.rays[e])
                for (std::uint32_t n = 0; n < ray.layers; ++n) body[ray.first_point + n] = e;
        for (std::size_t e = 0; e < layer_.walls.size(); ++e)
            for (VertexId v : layer_.walls[e]) body[v.index()] = e;
        for (std::size_t e = 0; e < layer_.borders.size(); ++e) {
            for (VertexId v : layer_.borders[e]) {
                body[v.index()] = e;
                on_border[v.index()] = 1;
            }
        }
        for (std::size_t i = 0; i < layer_.points.size(); ++i) {
            const Point p = layer_.points[i];
            if (i >= layer_.wall_points) {
                const Crossings in = crossings(p, body[i], walls_, wall_tree_);
                if (in.on_edge || in.own % 2 != 0 || in.others % 2 != 0) find("point not outside the walls", p);
            }
            const Crossings in = crossings(p, body[i], borders_, border_tree_);
            if (in.others % 2 != 0) find("point inside another body's border", p);
            if (on_border[i]) continue;
            if (in.on_edge || in.own % 2 == 0) find("point not inside its border", p);
        }
    }

    void check_ratio() {
        const double limit = border_options_.max_ratio * (1 + 1e-6);
        for (const std::vector<VertexId>& border : layer_.borders) {
            for (std::size_t k = 0; k < border.size(); ++k) {
                const Point a = at(border[k]), b = at(border[(k + 1) % border.size()]),
                            c = at(border[(k + 2) % border.size()]);
                const double ratio = distance(a, b) / distance(b, c);
                if (!(ratio <= limit && limit * ratio >= 1))
                    find(fmt::format("adjacent border edges in the ratio {}", ratio), b);
            }
        }
    }
};

}  // namespace

}  // namespace lamina::layers

namespace lamina {

using namespace layers;

std::vector<std::string> check_layer(const Layer& layer, const LayerOptions& options, const BorderOptions& border) {
    return Validator(layer, options, border).run();
}

}  // namespace lamina
