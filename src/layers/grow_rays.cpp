// Stage "grow rays": directions, heights, limits and numbers of layers. Source: J. K. Pardue, thesis (2015), chapter 3.
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include <lamina/layers.hpp>

#include "core/angles.hpp"
#include "core/bounding_box.hpp"
#include "geometry/row.hpp"
#include "geometry/symmetry.hpp"
#include "layers/directions/corners.hpp"
#include "layers/directions/rays.hpp"
#include "layers/heights/heights.hpp"
#include "layers/layer.hpp"
#include "layers/layered_rays.hpp"
#include "layers/mechanisms.hpp"
#include "layers/parameters.hpp"
#include "layers/room/truncation.hpp"
#include "layers/stages.hpp"
#include "layers/wake/wake_outline.hpp"

namespace lamina::layers {

namespace {

/// Layers may be at most this many times as thick as the configuration is wide; more is taken for a mistyped option.
constexpr double max_relative_thickness = 1e4;
/// Heights must exceed this many units of rounding of the coordinates, or points on the rays would not be distinct.
constexpr double min_roundings = 64;

/// Throws OptionError for heights below the resolution of the coordinates and for layers much thicker than the box of
/// the configuration.
void require_sensible_scale(const Box& box, const LayerGrowth& growth, std::span<const double> asked) {
    const double extent = core::longer_side(box);
    const double max_coordinate =
        std::max({std::abs(box.lower.x), std::abs(box.lower.y), std::abs(box.upper.x), std::abs(box.upper.y)});
    double least = growth.first_heights.empty() ? growth.first_height : HUGE_VAL;
    for (const double height : growth.first_heights)
        if (height > 0) least = std::min(least, height);  // the others are walls without layers
    if (!(least > min_roundings * std::numeric_limits<double>::epsilon() * max_coordinate))
        throw OptionError("first_height", fmt::format("{} is below the resolution of coordinates as large as {}", least,
                                                      max_coordinate));
    const double thickness = *std::max_element(asked.begin(), asked.end());
    if (!(thickness <= max_relative_thickness * extent))
        throw OptionError("layers",
                          fmt::format("the requested layers are {:.3g} thick, {:.3g} times the extent of the input",
                                      thickness, thickness / extent));
}

/// Returns the height of all layers at each vertex of an outline: the largest of its rays.
std::vector<double> heights_at_vertices(std::span<const RayVertex> outline, std::span<const RayLine> rays,
                                        const LayerGrowth& growth) {
    RaySet set{{rays.begin(), rays.end()}, {0, rays.size()}};
    set_slants(set);
    const std::vector<double> asked = asked_heights(set, growth);
    std::vector<double> result(outline.size(), 0.0);
    std::size_t vertex = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        if (vertex + 1 < outline.size() && rays[i].origin == outline[vertex + 1].at) ++vertex;
        if (rays[i].origin == outline[vertex].at) result[vertex] = std::max(result[vertex], asked[i]);
    }
    return result;
}

/// Returns the feet of lines at this vertex of a wall.
std::span<const LineFoot> feet_at(Point vertex, std::span<const LineFoot> feet) {
    const auto is_there = [&](const LineFoot& foot) { return foot.at == vertex; };
    const auto first = std::find_if(feet.begin(), feet.end(), is_there);
    return {first, std::find_if_not(first, feet.end(), is_there)};
}

/// Adds the rays of an outer wall or of an obstacle, as a closed outline: normals of its straight parts, and bisectors
/// at its corners, of which those of outer walls are beyond the domain. Rays at feet run along their lines.
void add_outline(const std::vector<Point>& p, std::span<const LineFoot> feet, double max_angle, RaySet& set) {
    for (std::size_t i = 0; i < p.size(); ++i) {
        const Point before = unit(p[i] - p[i > 0 ? i - 1 : p.size() - 1]);
        const Point after = unit(p[i + 1 < p.size() ? i + 1 : 0] - p[i]);
        const bool is_end = before == -after;  // of a line without thickness
        const Point normal = is_end ? before : -perpendicular(unit(before + after));
        if (const std::span<const LineFoot> here = feet_at(p[i], feet); !here.empty())
            add_rays_along_lines(p[i], normal, here, max_angle, set.lines);
        else
            set.lines.push_back({p[i], normal});
    }
    set.begin.push_back(set.lines.size());
}

/// Returns the image of a ray in a line of symmetry. `before` is the ray before it, behind which the corner of the wall
/// is that is behind the image.
RayLine image_of_ray(const RayLine& ray, const RayLine& before, double y) {
    RayLine image = ray;
    image.origin = geometry::image_of(ray.origin, y);
    image.direction.y = -ray.direction.y;
    image.corner_after.assign(before.corner_after.rbegin(), before.corner_after.rend());
    for (Point& p : image.corner_after) p = geometry::image_of(p, y);
    return image;
}

/// Returns a ray that lies in the line of symmetry, forwards or backwards.
RayLine ray_in_line(RayLine ray, double direction) {
    ray.direction = {direction, 0};
    ray.corner_after.clear();
    ray.on_symmetry = true;
    ray.line_room = 0;
    return ray;
}

/// Makes the rays of a body with a line of symmetry images of each other. Those that stand where the line meets the
/// body, the first one and the last one above, lie in the line. Rays of a wake along the line come first, from its end
/// on. Returns how many rays are not below it.
std::size_t mirror_rays(const Element& element, double y, std::vector<RayLine>& rays) {
    constexpr double rounding = 1e-6;  // a ray of a fan that rises less lies in the line
    const Point tail = element.points.front();
    // The last rays are those of the wake, out to its end and back on its left, which is above.
    std::vector<RayLine> above(
        std::find_if(rays.begin(), rays.end(), [](const RayLine& ray) { return ray.place == RayPlace::wake_end; }),
        rays.end());
    const bool has_wake = !above.empty();
    if (has_wake) above.front().direction = {1, 0};
    std::size_t first = 0;  // behind those of the tail's vertex above the wake
    while (rays[first].origin == tail) ++first;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const RayLine& ray = rays[i];
        if (ray.place != RayPlace::wall || ray.origin.y < y) continue;
        if (has_wake && ray.origin == tail) {
            if (i < first) above.push_back(ray);
            continue;
        }
        if (ray.origin.y > y) {
            above.push_back(ray);
            continue;
        }
        const bool is_first = above.empty() || above.back().origin != ray.origin;
        const bool in_fan = rays[(i + 1) % rays.size()].origin == ray.origin || !is_first ||
                            rays[(i + rays.size() - 1) % rays.size()].origin == ray.origin;
        const bool is_tail = ray.origin == tail;
        if (is_tail && is_first) above.push_back(ray_in_line(ray, 1));
        if (in_fan && ray.direction.y > rounding)
            above.push_back(ray);
        else if (!is_tail && !above.back().on_symmetry)
            above.push_back(ray_in_line(ray, -1));
    }
    const std::size_t shown = above.size();
    above.back().corner_after = image_of_ray(above.back(), above[shown - 2], y).corner_after;
    for (std::size_t i = shown - 1; i-- > 1;) above.push_back(image_of_ray(above[i], above[i - 1], y));
    rays = std::move(above);
    return shown;
}

/// The walls that rays grow from.
struct Walls {
    const Geometry& geometry;
    std::span<const OuterWall> outer;
    const Obstacles& obstacles;
    const PlaceOnWall& place;

    /// Returns the numbers of the elements that have images: below a line of symmetry all others than those that it
    /// cuts, unless it cuts none; in a row all, again and again.
    std::vector<std::size_t> with_images() const {
        std::vector<std::size_t> result;
        if (geometry.pitch) {
            const std::size_t n = geometry.elements.size(), copies = geometry::shifts_in_row(geometry).size();
            for (std::size_t k = 0; k < copies * n; ++k) result.push_back(k % n);
            return result;
        }
        for (std::size_t e = 0; e < geometry.elements.size(); ++e)
            if (!geometry.elements[e].is_mirrored) result.push_back(e);
        return result.size() < geometry.elements.size() ? result : std::vector<std::size_t>{};
    }
};

/// Adds the images of bodies in a line of symmetry, or their copies in a row, and obstacles.
void add_images(const Walls& walls, RaySet& set) {
    const std::size_t n = set.lines.size(), elements = set.begin.size();
    for (const double shift : geometry::shifts_in_row(walls.geometry)) {
        for (std::size_t i = 0; i < n; ++i) {
            RayLine copy = set.lines[i];
            copy.origin = geometry::moved(copy.origin, shift);
            copy.corner_after = geometry::moved(std::move(copy.corner_after), shift);
            set.lines.push_back(std::move(copy));
        }
        for (std::size_t e = 1; e < elements; ++e) set.begin.push_back(set.lines.size() - n + set.begin[e]);
    }
    const std::vector<std::size_t> mirrored = walls.geometry.pitch ? std::vector<std::size_t>{} : walls.with_images();
    for (const std::size_t e : mirrored) {
        const std::size_t begin = set.begin[e], end = set.begin[e + 1];
        for (std::size_t i = end; i-- > begin;)
            set.lines.push_back(
                image_of_ray(set.lines[i], set.lines[i > begin ? i - 1 : end - 1], *walls.geometry.symmetry));
        set.begin.push_back(set.lines.size());
    }
    for (const std::vector<Point>& outline : walls.obstacles.outlines) add_outline(outline, {}, 0, set);
}

/// Returns the rays of these walls. `shown` becomes the number of those in the domain, for each body.
RaySet rays_of(const Walls& walls, std::span<const DividedWake> wakes, const LayerOptions& options,
               const LayerGrowth& growth, std::vector<std::size_t>& shown) {
    const Geometry& geometry = walls.geometry;
    RaySet set;
    for (std::size_t e = 0; e < geometry.elements.size(); ++e) {
        const Element& element = geometry.elements[e];
        const auto wake =
            std::find_if(wakes.begin(), wakes.end(), [&](const DividedWake& w) { return w.element == e; });
        std::vector<RayVertex> outline = outline_with_wake(element.points, wake == wakes.end() ? nullptr : &*wake);
        const OutlineKind kind = outline_kind(element);
        const LayerGrowth own = growth_on_element(growth, e);
        for (RayVertex& vertex : outline)
            if (vertex.place == RayPlace::wall) vertex.feet = feet_at(vertex.at, walls.obstacles.feet);
        if (!options.equal_fans && !element.is_mirrored) leave_out_sharp_corners(own.first_height, outline);
        set_first_heights(first_heights_on_wall(own, 0, element.points), element.points, own.first_height, outline);
        set_least_heights(own.least_heights, outline);
        const std::vector<RayLine> upright = make_rays(outline, kind, options, own, {}, walls.place);
        std::vector<RayLine> rays =
            make_rays(outline, kind, options, own, heights_at_vertices(outline, upright, own), walls.place);
        shown.push_back(element.is_mirrored ? mirror_rays(element, *geometry.symmetry, rays) : rays.size());
        set.lines.insert(set.lines.end(), rays.begin(), rays.end());
        set.begin.push_back(set.lines.size());
    }
    for (const OuterWall& wall : walls.outer) {
        const std::size_t first = set.lines.size();
        const std::span<const LineFoot> feet(walls.obstacles.feet);
        add_outline(wall.points, wall.first_height > 0 ? feet : feet.first(0), core::radians(options.max_ray_angle_deg),
                    set);
        for (std::size_t i = first; i < set.lines.size(); ++i) set.lines[i].most_height = wall.thickest;
    }
    add_images(walls, set);
    return set;
}

/// Makes the first layers of these rays on walls lower: share(ray) says how high they become, of what they are. Returns
/// whether there were any.
template <class Share>
bool lower_first_layers(Rays& rays, Share share) {
    bool changed = false;
    for (std::size_t i = 0; i < rays.set.lines.size(); ++i) {
        RayLine& ray = rays.set.lines[i];
        if (ray.place != RayPlace::wall) continue;
        const double lower = ray.opening * share(i);
        if (!(lower < ray.opening) || lower < least_opening) continue;
        ray.opening = lower;
        changed = true;
    }
    if (changed) rays.asked = asked_heights(rays.set, rays.growth);
    return changed;
}

/// First layers whose fronts meet are made lower by this factor, at once or round by round.
constexpr double share_where_fronts_meet = 0.5;

/// Gives rays without room for a first layer a lower one, and first layers the room that they may take.
///
///     _______________     Below an opposite wall first layers of both sides would overlap all along the slot, which only
///      ^ ^ ^ ^ ^ ^ ^      shows at its ends, where their fronts cross. They take half of the room that they may take beside
///     _|_|_|_|_|_|_|_     a ray that crosses theirs.
///
void fit_first_layers(Rays& rays) {
    constexpr double below_limit = 0.999;  // so that rounding does not take the layer away
    const std::vector<double> first = first_heights_along(rays.set, rays.growth);
    const std::vector<double> walls = wall_limits(rays.set, first);
    std::vector<double> room(first.size());
    for (std::size_t i = 0; i < room.size(); ++i)
        room[i] = (first[i] > walls[i] ? share_where_fronts_meet : 1) * first_layer_room * rays.front[i];
    lower_first_layers(rays, [&](std::size_t i) { return room[i] < first[i] ? below_limit * room[i] / first[i] : 1; });
    for (std::size_t i = 0; i < first.size(); ++i)
        rays.limits[i] = std::max(rays.limits[i], std::min(first[i], room[i]));
}

/// Counts the layers. Where fronts meet, rays that are left without any get first layers half as high, so that no wall
/// is bare: a safety net for slots narrower than first layers, which FirstHeights.AreLowerInSlotsWithoutRoom holds.
void count_layers_on_all_rays(Rays& rays) {
    constexpr int max_rounds = 6;
    for (int round = 0;; ++round) {
        shift_rays_of_corners(rays.growth, rays.set);
        fit_and_count_layers(rays);
        if (round == max_rounds || !uses("lower_first")) return;
        const auto share = [&](std::size_t i) {
            return rays.counts[i] == 0 && rays.asked[i] > 0 && rays.limits[i] > 0 ? share_where_fronts_meet : 1;
        };
        if (!lower_first_layers(rays, share)) return;
    }
}

/// Returns the number behind the last ray in the domain, for each element. `shown` has the numbers of rays of bodies.
std::vector<std::size_t> domain_ends(const RaySet& set, std::span<const std::size_t> shown,
                                     std::span<const OuterWall> outer) {
    std::vector<std::size_t> ends(set.begin.begin(), set.begin.end() - 1);
    for (std::size_t e = 0; e < shown.size(); ++e) ends[e] += shown[e];
    for (std::size_t k = 0; k < outer.size(); ++k) {
        std::size_t& end = ends[shown.size() + k];  // a vertex has a ray for each of its lines
        while (set.lines[end].origin != outer[k].points[outer[k].in_domain]) ++end;
    }
    return ends;
}

/// Grows the rays of these walls and wakes.
void grow_from(const Walls& walls, std::span<const DividedWake> wakes, const LayerOptions& options, Rays& rays) {
    std::vector<std::size_t> shown;
    rays.set = rays_of(walls, wakes, options, rays.growth, shown);
    rays.domain_ends = domain_ends(rays.set, shown, walls.outer);
    measure_room(rays, walls.obstacles);
    Box box = bounding_box(walls.geometry);
    for (const OuterWall& wall : walls.outer)
        for (const Point p : wall.points) box.include(p);
    require_sensible_scale(box, rays.growth, rays.asked);
    if (uses("fit_first")) fit_first_layers(rays);
    count_layers_on_all_rays(rays);
}

/// Returns the heights that rays without wakes need: the least heights, or all that they have.
std::vector<double> needed_heights(const Rays& walls) {
    const bool all = walls.growth.least_heights.empty();
    std::vector<double> needed = least_heights(walls.set);
    for (std::size_t i = 0; i < needed.size(); ++i) needed[i] = std::min(all ? HUGE_VAL : needed[i], walls.front[i]);
    return needed;
}

/// Grows the rays anew with wakes where there is room for them.
void add_wakes(const Walls& walls, const LayerOptions& options, Rays& rays) {
    const Geometry& geometry = walls.geometry;
    constexpr int max_rounds = 8;
    std::vector<double> ends(rays.growth.wakes.size(), HUGE_VAL);
    keep_wakes_clear(rays.set, needed_heights(rays), divide_wakes(geometry, rays.growth, ends), ends);
    std::vector<DividedWake> wakes;
    for (int round = 0;; ++round) {
        if (round == max_rounds) std::fill(ends.begin(), ends.end(), 0.0);
        wakes = divide_wakes(geometry, rays.growth, ends);
        grow_from(walls, wakes, options, rays);
        if (!shorten_bare_wakes(rays.set, rays.counts, wakes, ends)) break;
    }
    for (const DividedWake& wake : wakes) {
        rays.wake_lengths[wake.element] = wake.distances.back();
        if (wake.core.chains.empty()) continue;
        rays.cores.push_back(wake.core);
        if (geometry.elements[wake.element].is_mirrored) keep_left_half(*geometry.symmetry, rays.cores.back());
    }
}

/// Returns one ray without a direction for each wall vertex: the rays where the layer is disabled.
RaySet bare_walls(const Walls& walls, std::vector<std::size_t>& shown) {
    RaySet set;
    const auto add = [&](const std::vector<Point>& points) {
        for (Point p : points) set.lines.push_back({p, {}});
        set.begin.push_back(set.lines.size());
    };
    for (const Element& element : walls.geometry.elements) {
        add(element.points);
        const std::size_t n = element.points.size();
        shown.push_back(element.is_mirrored ? n / 2 + 1 : n);
    }
    for (const OuterWall& wall : walls.outer) add(wall.points);
    add_images(walls, set);
    return set;
}

}  // namespace

Rays grow_rays(const Geometry& geometry, const LayerOptions& options, const LayerGrowth& growth,
               std::span<const OuterWall> outer_walls, const Obstacles& obstacles, const PlaceOnWall& place_on_wall) {
    validate(options);
    const Walls walls{geometry, outer_walls, obstacles, place_on_wall};
    const std::vector<std::size_t> with_images = walls.with_images();
    const std::size_t images = with_images.size() + obstacles.outlines.size();
    const std::size_t elements = geometry.elements.size() + outer_walls.size() + images;
    Rays rays;
    rays.place_on_wall = walls.place;
    rays.outer_walls = outer_walls.size();
    rays.images = images;
    rays.copies = geometry::shifts_in_row(geometry).size();
    rays.enabled = options.enabled;
    rays.wake_lengths.assign(elements, 0.0);
    rays.resampled.reserve(geometry.elements.size());
    for (const Element& element : geometry.elements) {
        rays.resampled.push_back(element.resampled);
        rays.jagged.push_back(outline_kind(element) == OutlineKind::jagged);
    }
    rays.resampled.resize(elements - images, true);
    rays.jagged.resize(elements - images, false);
    for (const std::size_t e : with_images) {
        rays.resampled.push_back(rays.resampled[e]);
        rays.jagged.push_back(rays.jagged[e]);
    }
    rays.resampled.resize(elements, false);
    rays.jagged.resize(elements, false);
    if (!options.enabled) {
        std::vector<std::size_t> shown;
        rays.set = bare_walls(walls, shown);
        rays.domain_ends = domain_ends(rays.set, shown, outer_walls);
        rays.counts.assign(rays.set.lines.size(), 0);
        rays.heights = LayerHeights({0.0}, std::vector<HeightColumn>(rays.set.lines.size()));
        return rays;
    }
    if (!growth.first_heights.empty() && growth.first_heights.size() != geometry.elements.size())
        throw OptionError("first_height", "needs one entry per element where elements have their own");
    rays.topology = options.topology;
    rays.growth = growth;
    if (!outer_walls.empty() || images > 0) {
        std::vector<double>& heights = rays.growth.first_heights;
        heights.resize(geometry.elements.size(), growth.first_height);
        for (const OuterWall& wall : outer_walls) heights.push_back(wall.first_height);
        for (const std::size_t e : with_images) heights.push_back(double(heights[e]));
        heights.resize(elements, 0);
    }
    if (rays.copies > 0)
        for (std::size_t k = 0; k < with_images.size(); ++k)
            for (const WallHeight& least : growth.least_heights)
                if (least.element == with_images[k])
                    rays.growth.least_heights.push_back({elements - images + k, least.at, least.height});
    grow_from(walls, {}, options, rays);
    if (options.wake_layers && !growth.layers && !growth.wakes.empty()) add_wakes(walls, options, rays);
    return rays;
}

}  // namespace lamina::layers
