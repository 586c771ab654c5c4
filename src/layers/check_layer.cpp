// The promises of layer.hpp, checked one by one and independently of how the layer was made.
#include <algorithm>
#include <cmath>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <lamina/error.hpp>
#include <lamina/geometry.hpp>
#include <lamina/layers.hpp>

#include "core/angles.hpp"
#include "geometry/inside.hpp"
#include "layers/growth_laws.hpp"
#include "layers/layer.hpp"
#include "layers/stages.hpp"

namespace lamina::layers {

namespace {

constexpr std::size_t max_findings = 20;
/// Where a column is stretched to end at the front, growths differ from those of the law by this factor at most.
constexpr double max_change_of_growth = 3;

class LayerChecker {
public:
    LayerChecker(const Layer& layer, const LayerOptions& options, const BorderOptions& border_options)
        : layer_(layer), options_(options), border_options_(border_options) {}

    std::vector<std::string> run() && {
        check_points();
        check_loops("wall", layer_.walls);
        check_loops("border", layer_.borders);
        check_rays();
        check_cells();
        for (std::size_t e = 0; e < layer_.borders.size(); ++e) check_outlines(e);
        check_ratio();
        return std::move(findings_);
    }

private:
    const Layer& layer_;
    const LayerOptions& options_;
    const BorderOptions& border_options_;
    std::vector<std::string> findings_;

    Point at(VertexId v) const { return layer_.points[v.index()]; }
    void report(const std::string& defect, Point where) {
        if (findings_.size() < max_findings)
            findings_.push_back(fmt::format("{} at ({}, {})", defect, where.x, where.y));
    }

    /// Checks that all points are distinct and in the exact range.
    void check_points() {
        if (layer_.layer_of_point.size() != layer_.points.size()) report("layer_of_point has the wrong size", {});
        std::vector<Point> sorted = layer_.points;
        std::sort(sorted.begin(), sorted.end(), lexicographically_less);
        for (std::size_t i = 0; i < sorted.size(); ++i) {
            if (!in_exact_range(sorted[i])) report("point outside the exact range", sorted[i]);
            if (i > 0 && sorted[i] == sorted[i - 1]) report("two points in one place", sorted[i]);
        }
    }

    /// Checks that loops are counter-clockwise, simple and disjoint.
    void check_loops(const char* name, std::span<const std::vector<VertexId>> loops) {
        Geometry geometry;
        for (const std::vector<VertexId>& loop : loops) geometry.elements.emplace_back().points = places_of(loop);
        try {
            check_simple(geometry);
        } catch (const InputError& error) {
            report(fmt::format("{}: {}", name, error.what()), at(loops.front().front()));
        }
    }

    std::vector<Point> places_of(std::span<const VertexId> vertices) const {
        std::vector<Point> places;
        for (const VertexId v : vertices) places.push_back(at(v));
        return places;
    }

    /// Returns whether a ray of an element and the next one diverge by this angle at most, or converge.
    bool is_ray_angle_allowed(double angle, std::size_t element) const {
        constexpr double rounding = 1e-9;
        if (options_.equal_fans) return true;
        const bool jagged = element < layer_.jagged.size() && layer_.jagged[element];
        const double allowed_deg = std::max(options_.max_ray_angle_deg, jagged ? max_jagged_ray_angle_deg : 0);
        return angle <= core::radians(allowed_deg) + rounding;
    }

    /// Checks that rays stand in the order of the wall, and that neighbours differ by one layer and diverge by the
    /// largest ray angle at most.
    void check_rays() {
        for (std::size_t e = 0; e < layer_.rays.size(); ++e) {
            const std::vector<Ray>& rays = layer_.rays[e];
            const LayerGrowth growth = growth_on_element(layer_.growth, e);
            std::size_t on_wall = 0;
            for (std::size_t i = 0; i < rays.size(); ++i) {
                const Ray &ray = rays[i], &next = rays[(i + 1) % rays.size()];
                // The last ray before the wake of a sharp trailing edge stands where the wall begins.
                const bool closes = next.place == RayPlace::wake && ray.origin == layer_.walls[e].front();
                if (ray.place == RayPlace::wall && !closes)
                    while (on_wall < layer_.walls[e].size() && layer_.walls[e][on_wall] != ray.origin) ++on_wall;
                if (on_wall == layer_.walls[e].size()) report("rays are not in the order of the wall", at(ray.origin));
                check_against_next(ray, next, e);
                check_heights(ray, growth);
            }
        }
    }

    /// Checks a ray of an element, and that the next one is like it.
    void check_against_next(const Ray& ray, const Ray& next, std::size_t element) {
        const Point origin = at(ray.origin);
        if (std::abs(length(ray.direction) - 1) > 1e-12) report("direction is no unit vector", origin);
        if (ray.layers > ray.requested) report("ray has more layers than requested", origin);
        if (ray.layers > next.layers + 1 || next.layers > ray.layers + 1)
            report("neighbouring rays differ by more than one layer", origin);
        const double angle = core::angle_between(ray.direction, next.direction);
        const bool ends_wake = ray.place == RayPlace::wake_end || next.place == RayPlace::wake_end;
        if (!is_ray_angle_allowed(angle, element) && !ends_wake)
            report(fmt::format("{} degrees between rays", core::degrees(angle)), origin);
    }

    /// Returns the range of the ratio of a spacing to the one below, over that of the law.
    static std::pair<double, double> allowed_change(bool is_whole, bool is_upper, double growth_of_law) {
        if (is_whole) return {1, 1};
        if (is_upper) return {1 / max_change_of_growth, max_change_of_growth};
        return {std::min(1.0, 1 / growth_of_law), 1};
    }

    /// Checks that the points of a ray lie on it, below its limit, and that its spacings grow as the law says: exactly
    /// where it has all layers of a requested number, up to the middle one also where the column goes on beyond
    /// isotropy with spacings of one height, and above it with a stretch. `growth` is that on its element.
    void check_heights(const Ray& ray, const LayerGrowth& growth) {
        const Point origin = at(ray.origin);
        const GrowthLawEntry& law = growth_law_entry(options_.growth_law);
        if (law.by_spacing ? ray.growth < law.by_spacing->min_growth || ray.growth > law.by_spacing->max_growth
                           : ray.growth != law.ray_growth(growth))
            report("ray has not the growth of its law", origin);
        if (ray.layers == 0) return;
        const std::vector<double> of_law = law.heights(growth.first_height, ray.growth, ray.layers);
        const double rounding = 4e-16 * (std::abs(origin.x) + std::abs(origin.y));
        const bool is_whole = growth.layers && std::isinf(ray.height_limit);
        const Point first = at(ray.vertex(1)) - origin;
        // Rays bend to one side, by less from layer to layer.
        const double side = cross(first, ray.direction) > 0 ? -1 : 1;
        double height = 0, spacing = 0, shift = 0, slope = HUGE_VAL;
        for (std::uint32_t n = 1; n <= ray.layers; ++n) {
            const Point p = at(ray.vertex(n));
            if (layer_.layer_of_point[ray.vertex(n).index()] != n) report("layer_of_point is wrong", p);
            const auto [height_here, shift_here] = height_and_shift(p - origin, first, ray.direction);
            const double height_below = std::exchange(height, height_here);
            const double spacing_below = std::exchange(spacing, height - height_below);
            const double rise = side * (shift_here - std::exchange(shift, shift_here)) / spacing;
            const double tolerance = 1e-11 + 2 * rounding / spacing;
            if (!(rise >= -tolerance && rise <= slope + tolerance))
                report(fmt::format("layer {} is not on its ray", n), p);
            slope = rise;
            if (n <= 2) continue;  // all layers of a sharp corner's ray lie higher by one distance
            const double growth_of_law = (of_law[n] - of_law[n - 1]) / (of_law[n - 1] - of_law[n - 2]);
            const double change = spacing / spacing_below / growth_of_law;
            const double slack = 1e-9 + 8 * rounding / spacing_below;
            const auto [least, most] = allowed_change(is_whole, n > ray.layers / 2, growth_of_law);
            if (!(change >= least - slack && change <= most + slack))
                report(fmt::format("the spacing of layer {} grows {} times as the law says", n, change), p);
        }
        const double above_first = height - height_and_shift(first, first, ray.direction).first;
        if (above_first > ray.height_limit * (1 + 1e-12) + rounding) report("ray is longer than its limit", origin);
    }

    /// Splits a vector from a ray's origin into its height along the ray and a part at right angles to the way to the
    /// first layer, by which the ray is shifted there.
    static std::pair<double, double> height_and_shift(Point vector, Point first, Point direction) {
        const Point across = perpendicular(first);
        const double height = dot(vector, first) / dot(direction, first);
        return {height, dot(vector - height * direction, across) / length(first)};
    }

    void check_cells() {
        for (const std::vector<Ray>& rays : layer_.rays)
            for (std::size_t i = 0; i < rays.size(); ++i) check_cells_between(rays[i], rays[(i + 1) % rays.size()]);
    }

    /// Checks that each quadrilateral between two neighbouring rays is convex, and that each triangle in a fan or at a
    /// step is positive.
    void check_cells_between(const Ray& ray, const Ray& next) {
        const std::uint32_t common = std::min(ray.layers, next.layers);
        for (std::uint32_t n = 1; n <= common; ++n) {
            const Point a = at(ray.vertex(n - 1)), b = at(ray.vertex(n)), c = at(next.vertex(n)),
                        d = at(next.vertex(n - 1));
            bool sound = orient2d(a, b, c) > 0 && orient2d(b, c, d) > 0;
            if (!(a == d)) sound = sound && orient2d(c, d, a) > 0 && orient2d(d, a, b) > 0;
            if (!sound) report(fmt::format("crossed cell of layer {}", n), a);
        }
        if (ray.layers == next.layers) return;
        const Point a = at(ray.vertex(common)), d = at(next.vertex(common));
        const Point top = at((ray.layers > common ? ray : next).vertex(common + 1));
        if (!(a == d) && orient2d(a, top, d) <= 0) report("crossed cell at a step", a);
    }

    // Cells between rays, and the polygons beside them that have no rays, are positive. Where their outlines together
    // are the border less the wall, each point is in as many of them as the border winds round it more often than the
    // wall does. Both do once at most, as they are simple and disjoint: no two overlap, and none leaves the space
    // between.

    /// How often edges are passed from their smaller vertex to the larger one, less the times in the other direction.
    using EdgeSum = std::map<std::pair<VertexId, VertexId>, int>;

    /// Adds a chain of edges to a sum, so many times.
    static void add_edges(std::span<const VertexId> chain, int times, EdgeSum& sum) {
        for (std::size_t k = 0; k + 1 < chain.size(); ++k)
            sum[std::minmax(chain[k], chain[k + 1])] += chain[k] < chain[k + 1] ? times : -times;
    }
    static void add_loop(std::vector<VertexId> loop, int times, EdgeSum& sum) {
        loop.push_back(loop.front());
        add_edges(loop, times, sum);
    }

    /// Checks that the polygons of an element lie side by side, between its border above and its wall below.
    void check_outlines(std::size_t e) {
        EdgeSum below;
        add_loop(layer_.walls[e], -1, below);
        if (layer_.rays[e].empty()) add_loop(layer_.borders[e], 1, below);
        check_border(e, below);
        for (const LayerCore& core : layer_.cores)
            if (core.element == e) add_loop(checked_outline(core), -1, below);
        for (const auto& [edge, times] : below)
            if (times != 0) report("an edge has cells on one side alone", at(edge.first));
    }

    /// Checks that the border visits the tips of the rays in their order, but for those inside closed clefts, and adds
    /// the lower ends of the columns to `below`.
    void check_border(std::size_t e, EdgeSum& below) {
        const std::vector<Ray>& rays = layer_.rays[e];
        const std::vector<VertexId>& border = layer_.borders[e];
        if (rays.empty()) return;
        std::size_t place = std::find(border.begin(), border.end(), rays[0].tip()) - border.begin(), passed = 0;
        std::vector<VertexId> chain;  // of the border, from one tip to the next
        const auto pass_to = [&](VertexId tip) {
            for (chain = {border[place % border.size()]}; chain.back() != tip && passed < border.size(); ++passed)
                chain.push_back(border[++place % border.size()]);
            return chain.back() == tip;
        };
        for (std::size_t i = 0; i < rays.size(); ++i) {
            const Ray& ray = rays[i];
            const auto cleft = std::find_if(layer_.clefts.begin(), layer_.clefts.end(), [&](const LayerCleft& c) {
                return c.element == e && c.first <= i && i < c.last;
            });
            const bool is_inside = cleft != layer_.clefts.end();
            if (is_inside && i == cleft->first) {
                if (!pass_to(rays[cleft->last].tip()) || chain != cleft->outer_edge)
                    return report("border does not close a cleft", at(ray.tip()));
                check_cleft(*cleft);
            }
            const Ray& next = rays[(i + 1) % rays.size()];
            if (is_inside)
                chain = {ray.tip(), next.tip()};
            else if (!pass_to(next.tip()))
                return report("border does not visit the tips in their order", at(next.tip()));
            check_column(ray, next, chain, below);
        }
        if (passed != border.size()) report("border visits more than the tips", at(border[place % border.size()]));
    }

    /// Checks that the topmost cell between two rays, whose lower corner sees the whole chain from tip to tip, is
    /// positive, and so is the corner of the wall below. Adds the lower end of the column to `below`.
    void check_column(const Ray& ray, const Ray& next, std::span<const VertexId> top, EdgeSum& below) {
        if (ray.layers == 0 && next.layers == 0) return add_edges(top, 1, below);
        const Ray& longer = ray.layers >= next.layers ? ray : next;
        const VertexId seen_from = longer.vertex(longer.layers - 1);
        const bool is_ray = ray.origin == next.origin && std::min(ray.layers, next.layers) == 0;  // no cell
        for (std::size_t k = 0; !is_ray && k + 1 < top.size(); ++k)
            if (!(orient2d(at(top[k]), at(top[k + 1]), at(seen_from)) > 0))
                report("border is not above the cells", at(top[k]));
        std::vector<VertexId> wall{ray.origin};
        wall.insert(wall.end(), ray.corner_after.begin(), ray.corner_after.end());
        if (next.origin != ray.origin) wall.push_back(next.origin);
        add_edges(wall, 1, below);
        if (wall.size() < 3) return;
        std::reverse(wall.begin(), wall.end());
        check_loops("corner without a ray", std::span(&wall, 1));
    }

    /// Checks the polygon between the fronts on both sides of a cleft.
    void check_cleft(const LayerCleft& cleft) {
        std::vector<VertexId> outline = cleft.outer_edge;
        for (std::size_t i = cleft.last; --i > cleft.first;) {
            const VertexId tip = layer_.rays[cleft.element][i].tip();
            if (tip != outline.back() && tip != outline.front()) outline.push_back(tip);
        }
        check_loops("cleft", std::span(&outline, 1));
    }

    /// Checks the polygon behind a base, and that the points of its chains are inside. Returns its outline.
    std::vector<VertexId> checked_outline(const LayerCore& core) {
        std::vector<VertexId> outline(core.chains.front().rbegin(), core.chains.front().rend()), left;
        for (const std::size_t station : core.stations) {
            const std::vector<VertexId>& chain = core.chains[station];
            outline.push_back(chain.front());
            if (chain.size() > 1) left.push_back(chain.back());
        }
        outline.insert(outline.end(), left.rbegin(), left.rend());
        check_loops("space behind a base", std::span(&outline, 1));
        const std::vector<Point> places = places_of(outline);
        for (std::size_t c = 1; c < core.chains.size(); ++c)
            for (std::size_t i = 1; i + 1 < core.chains[c].size(); ++i)
                if (const Point p = at(core.chains[c][i]); !geometry::contains(places, p))
                    report("point outside the space behind its base", p);
        return outline;
    }

    /// Checks that adjacent border edges keep BorderOptions::max_ratio.
    void check_ratio() {
        const double limit = border_options_.max_ratio * (1 + 1e-6);
        for (const std::vector<VertexId>& border : layer_.borders) {
            for (std::size_t k = 0; k < border.size(); ++k) {
                const Point a = at(border[k]), b = at(border[(k + 1) % border.size()]),
                            c = at(border[(k + 2) % border.size()]);
                const double ratio = distance(a, b) / distance(b, c);
                if (!(ratio <= limit && limit * ratio >= 1))
                    report(fmt::format("adjacent border edges in the ratio {}", ratio), b);
            }
        }
    }
};

}  // namespace

std::vector<std::string> check_layer(const Layer& layer, const LayerOptions& options, const BorderOptions& border) {
    return LayerChecker(layer, options, border).run();
}

}  // namespace lamina::layers
