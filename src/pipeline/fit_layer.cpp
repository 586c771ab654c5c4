#include "pipeline/fit_layer.hpp"

#include <algorithm>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <lamina/error.hpp>

#include "decoupling/far_field.hpp"
#include "geometry/row.hpp"
#include "geometry/symmetry.hpp"
#include "layers/mechanisms.hpp"
#include "layers/parameters.hpp"
#include "layers/stages.hpp"
#include "pipeline/derived_options.hpp"
#include "pipeline/row_border.hpp"
#include "pipeline/wake_sizes.hpp"
#include "sizing/requests.hpp"

namespace lamina::pipeline {

namespace {

/// Throws OptionError where the bodies fit into the far field, but not with their layers: the heights are wrong then,
/// rather than the far field.
void require_room_for_layers(const Geometry& geometry, const std::vector<std::vector<Point>>& fronts,
                             const decoupling::FarField& far_field, const LayerOptions& options,
                             const layers::LayerGrowth& growth) {
    const Box bodies = bounding_box(geometry), domain = far_field.box();
    Box with_layers = bodies;
    for (std::size_t e = 0; e < geometry.elements.size(); ++e)
        for (const Point p : fronts[e]) with_layers.include(p);
    if (!decoupling::leaves_room(far_field, bodies) || decoupling::leaves_room(far_field, with_layers)) return;
    const bool by_y_plus = std::holds_alternative<YPlus>(options.first_height);
    const double thickness = std::max({bodies.lower.x - with_layers.lower.x, bodies.lower.y - with_layers.lower.y,
                                       with_layers.upper.x - bodies.upper.x, with_layers.upper.y - bodies.upper.y});
    const double distance = std::min({bodies.lower.x - domain.lower.x, bodies.lower.y - domain.lower.y,
                                      domain.upper.x - bodies.upper.x, domain.upper.y - bodies.upper.y});
    throw OptionError(
        by_y_plus ? "y_plus" : "first_height",
        fmt::format("a first height of {:.4g}{} {} a layer that is {:.4g} thick, but the far field is "
                    "only {:.4g} away: lower the first height, {}the growth ({:.4g}), or set a thickness",
                    largest_first_height(growth), growth.layers ? fmt::format(" and {} layers", *growth.layers) : "",
                    growth.layers ? "make" : "makes", thickness, distance,
                    growth.layers ? "the number of layers or " : "", growth.growth));
}

/// Returns circles round the triangles with an angle below the bound that no sharp corner excuses. They hold the ends
/// of the rays beside.
std::vector<layers::Circle> circles_round_unexcused(std::span<const mesh::NarrowTriangle> narrow) {
    constexpr double reach = 1.5;  // in longest edges
    std::vector<layers::Circle> circles;
    for (const mesh::NarrowTriangle& triangle : narrow) {
        const auto [a, b, c] = triangle.corners;
        circles.push_back(
            {(1.0 / 3) * (a + b + c), reach * std::max({distance(a, b), distance(b, c), distance(c, a)})});
    }
    return circles;
}

/// The sizes by which walls of the domain are divided: those of the bodies' walls and of the sources, which grow as the
/// spacing of walls may, up to a largest one.
struct OuterWallSizes {
    const SizingOptions& options;
    double gradation;
    std::vector<SizeSource> finer{};  ///< where they become finer than bodies ask for

    SizeField field(const Geometry& geometry, const ReferenceConditions& conditions, const Box& domain,
                    double largest) const {
        const sizing::SizedBodies bodies = sized_bodies(geometry, conditions);
        std::vector<SizeSource> sources =
            sizing::gather_size_requests(options, bodies, bodies.walls, domain).at_borders;
        sources.insert(sources.end(), finer.begin(), finer.end());
        SizingOptions sizing = options;
        sizing.background.reset();
        sizing.gradation = gradation;
        if (std::isfinite(largest) && (!sizing.far_size || in_units(*sizing.far_size, conditions.chord) > largest))
            sizing.far_size = Length{largest, LengthUnit::input};
        return sizing::make_size_field(bodies.walls, sources, sizing, conditions.chord, domain);
    }
};

/// Returns how long edges of outer walls may be, so that the last cells of layers that end at their largest thickness
/// are not far wider than high.
double largest_outer_edge(std::span<const OuterWallFacts> walls, const LayerRequest& layer) {
    constexpr double edge_over_thickness = 0.75;
    double largest = HUGE_VAL;
    for (const OuterWallFacts& wall : walls)
        if (wall.first_height > 0 && !layer.options.layers)
            largest = std::min(largest, edge_over_thickness * wall.thickest / layer.growth.fineness);
    return largest;
}

/// Makes rays on walls, within their far field. `ends`: LineGraph::ends of coarser walls.
FittedLayer grow_within(const DomainRequest& domain, const LayerRequest& layer, const OuterWallSizes& sizes,
                        surface::PreparedSurfaces prepared, const ReferenceConditions& conditions,
                        std::span<const EndsOnWalls> ends) {
    const layers::LayerGrowth& growth = layer.growth;
    Geometry geometry = std::move(prepared.geometry);
    const auto curves = std::make_shared<const surface::WallCurves>(std::move(prepared.curves));
    decoupling::FarField far_field =
        decoupling::place_far_field(bounding_box(geometry), conditions.chord, domain.far_field);
    std::vector<OuterWallFacts> outer_walls =
        outer_wall_facts(far_field, domain.far_field, geometry, layer.options, conditions, growth);
    LineGraph lines = arrange_lines(domain.lines, far_field, geometry, ends);
    std::vector<layers::OuterWall> divided;
    if (!outer_walls.empty())
        divided = divide_outer_walls(
            outer_walls, far_field,
            sizes.field(geometry, conditions, far_field.box(), largest_outer_edge(outer_walls, layer)), lines);
    layers::PlaceOnWall on_curve;
    if (!curves->edges().empty())
        on_curve = [curves](Point from, Point to, double share) { return curves->place(from, to, share); };
    const auto grow_past_lines = [&](const AtEnds& at_feet) {
        return layers::grow_rays(geometry, layer.options, growth, divided,
                                 obstacles_of(lines, growth.first_height, at_feet,
                                              geometry::is_cut(geometry) ? geometry.symmetry : std::nullopt,
                                              geometry::shifts_in_row(geometry)),
                                 on_curve);
    };
    // Above the layer at their feet, which is known once rays have grown, lines are in the way.
    AtEnds at_feet(lines.pieces.size());
    if (layer.options.enabled && !lines.pieces.empty())
        at_feet = heights_at_feet(lines, grow_past_lines(room_at_feet(lines)));
    layers::Rays rays = grow_past_lines(at_feet);
    if (layer.options.enabled && !geometry.pitch)
        require_room_for_layers(geometry, layers::fronts(rays), far_field, layer.options, growth);
    std::vector<double> front = rays.front;
    return {.geometry = std::move(geometry),
            .conditions = conditions,
            .far_field = std::move(far_field),
            .outer_walls = std::move(outer_walls),
            .rays = std::move(rays),
            .lines = std::move(lines),
            .curves = curves,
            .first_front = std::move(front)};
}

bool same_points(const Geometry& a, const Geometry& b) {
    return std::equal(a.elements.begin(), a.elements.end(), b.elements.begin(), b.elements.end(),
                      [](const Element& first, const Element& second) { return first.points == second.points; });
}

/// Returns sizes for the borders of bodies above a line of symmetry that cuts others: edges are no longer than the gap
/// below them, which ends at the line.
std::vector<SizeSource> gaps_above_symmetry(const FittedLayer& fitted, std::span<const std::vector<Point>> fronts) {
    constexpr double edge_over_gap = 0.8;
    std::vector<SizeSource> sources;
    if (!geometry::is_cut(fitted.geometry)) return sources;
    for (std::size_t e = 0; e < fitted.geometry.elements.size(); ++e) {
        if (fitted.geometry.elements[e].is_mirrored) continue;
        const std::vector<Point>& front = fronts[e];
        for (std::size_t i = 0; i < front.size(); ++i) {
            const Point a = front[i], b = front[(i + 1) % front.size()];
            const double size = edge_over_gap * (std::min(a.y, b.y) - fitted.far_field.floor);
            if (!(size > 0))
                throw MeshError(
                    fmt::format("the layer of {} reaches the line of symmetry: raise it, or lower --first-height",
                                fitted.geometry.elements[e].name),
                    a);
            if (size < distance(a, b)) sources.push_back({.a = a, .b = b, .size = size});
        }
    }
    return sources;
}

/// Returns the fronts of the bodies in the domain.
std::vector<std::vector<Point>> fronts_in_domain(const layers::Rays& rays, const Geometry& geometry) {
    std::vector<std::vector<Point>> fronts = layers::fronts(rays);
    fronts.resize(geometry.elements.size());
    return fronts;
}

/// Draws the border of a row, and repeats the requests of sizes along it.
void request_in_row(std::vector<std::vector<Point>> fronts, FittedLayer& fitted) {
    RowBorder border = border_below(std::move(fronts), ends_of_pieces(fitted.lines), fitted.far_field);
    fitted.below = std::move(border.curve);
    std::vector<SizeSource>&at_borders = fitted.requests.at_borders, &sources = fitted.requests.sources;
    sources.insert(sources.end(), border.sources.begin(), border.sources.end());
    at_borders = repeated_in_row(std::move(at_borders), fitted.far_field);
    sources = repeated_in_row(std::move(sources), fitted.far_field);
}

/// Requests the sizes that the options, the fronts of the rays and the wakes behind their layers ask for. Where a
/// background mesh decides on sizes, wakes request them of borders alone.
void request_sizes(FittedLayer& fitted) {
    const layers::Rays& rays = fitted.rays;
    const std::vector<ElementWake>& wakes = fitted.sizes.wakes;
    SizingOptions options = fitted.sizes.options;
    std::vector<SizeSource> along_wakes;
    for (std::size_t e = 0; e < wakes.size(); ++e) {
        const std::size_t first = along_wakes.size();
        for (const auto* sources : {&wakes[e].outer, &wakes[e].inner, &wakes[e].mixing})
            for (const WakeSource& wake : *sources)
                if (wake.begins >= rays.wake_lengths[e]) along_wakes.push_back(wake.source);
        // Shear layers that leave the wall ahead of the trailing edge make the wall below them finer in place of this.
        if (!wakes[e].wake.separated)
            fit_wake_to_layer(rays, e, sizing::border_gradation(sizing::field_gradation(options)),
                              std::span(along_wakes).subspan(first));
    }
    const bool decided = decides_on_sizes(options);
    const std::vector<SizeSource> between_lines = sizes_between(fitted.lines, geometry::shifts_in_row(fitted.geometry));
    options.sources.insert(options.sources.end(), between_lines.begin(), between_lines.end());
    if (!decided) options.sources.insert(options.sources.end(), along_wakes.begin(), along_wakes.end());
    std::vector<SizeSource>& at_borders = fitted.requests.at_borders;
    const std::vector<std::vector<Point>> fronts = layers::fronts(rays);
    fitted.requests = sizing::gather_size_requests(options, sized_bodies(fitted.geometry, fitted.conditions), fronts,
                                                   fitted.far_field.box());
    const std::vector<SizeSource> above_symmetry = gaps_above_symmetry(fitted, fronts);
    at_borders.insert(at_borders.end(), above_symmetry.begin(), above_symmetry.end());
    if (decided) at_borders.insert(at_borders.end(), along_wakes.begin(), along_wakes.end());
    at_borders.insert(at_borders.end(), fitted.short_edges.begin(), fitted.short_edges.end());
    if (fitted.geometry.pitch) request_in_row(fronts_in_domain(rays, fitted.geometry), fitted);
}

/// Counts the rays whose front is lower than it was at first, and finds the one that lost most of its height.
void count_thinned(FittedLayer& fitted) {
    fitted.thinned_rays = 0;
    double least_share = 1;
    for (std::size_t i = 0; i < fitted.first_front.size(); ++i) {
        const double before = fitted.first_front[i];
        if (fitted.rays.front[i] >= before) continue;
        ++fitted.thinned_rays;
        if (fitted.rays.front[i] >= least_share * before) continue;
        least_share = fitted.rays.front[i] / before;
        fitted.thinned_at = fitted.rays.set.lines[i].origin;
    }
}

/// Returns whether all rays have all layers that were requested.
bool all_layers_fit(const layers::Rays& rays) {
    for (std::size_t i = 0; i < rays.counts.size(); ++i)
        if (rays.counts[i] < rays.heights.column(i).asked_layers) return false;
    return true;
}

/// Prepares the walls anew, with a finer spacing where the layer's border would be divided: rows of cells would end in
/// fans below division points (docs/decisions/0009). `grow` makes rays on walls. Finer walls ask for finer ones beside
/// them, which three rounds of halving reach.
void refine_walls_below_borders(double least_gradation, PreparedWalls& walls,
                                const std::function<FittedLayer(surface::PreparedSurfaces)>& grow,
                                std::vector<SizeSource>& on_outer_walls, FittedLayer& fitted) {
    constexpr int max_rounds = 3;
    for (int round = 0; round < max_rounds; ++round) {
        layers::BorderOptions border = border_with_sources(fitted.sizes.border, fitted.requests.at_borders);
        border.gradation = std::max(border.gradation, least_gradation);
        const std::vector<geometry::WallSpacing> finer = layers::wall_spacings(fitted.rays, border);
        if (finer.empty()) return;
        const std::size_t sources = on_outer_walls.size();
        for (const geometry::WallSpacing& wall : finer) {
            if (wall.element < fitted.geometry.elements.size())
                walls.limits.walls.push_back(wall);
            else if (fitted.outer_walls[wall.element - fitted.geometry.elements.size()].first_height > 0)
                on_outer_walls.push_back({.a = wall.a, .b = wall.b, .size = wall.spacing});
        }
        surface::PreparedSurfaces prepared =
            surface::prepare_with_curves(walls.given, walls.options, walls.limits, fitted.conditions.chord);
        // The rest are stretches that keep their given points.
        if (same_points(prepared.geometry, fitted.geometry) && on_outer_walls.size() == sources) return;
        fitted = grow(std::move(prepared));
    }
}

/// Shortens rays so that columns end below cells above `above` layers with an angle above 150 degrees, for as long as
/// there are fewer and fewer of them. `obtuse_cells_of` finds them. What ends below one cell can leave others, which go
/// in the next of seven rounds; three without gain end the search. Returns whether it changed the rays.
bool end_columns_below_obtuse_cells(
    std::uint16_t above, const std::function<std::vector<layers::ObtuseCell>(const layers::Rays&)>& obtuse_cells_of,
    std::vector<layers::ObtuseCell>& fewest, layers::Rays& best) {
    constexpr int max_rounds = 7, max_rounds_without_gain = 3;
    layers::Rays rays = best;
    std::vector<layers::ObtuseCell> obtuse = fewest;
    bool is_changed = false;
    for (int round = 0, without_gain = 0; round < max_rounds && without_gain < max_rounds_without_gain; ++round) {
        std::erase_if(obtuse, [&](const layers::ObtuseCell& cell) { return cell.layer <= above; });
        if (!layers::end_columns_below(obtuse, rays)) break;
        obtuse = obtuse_cells_of(rays);
        ++without_gain;
        if (obtuse.size() >= fewest.size()) continue;
        fewest = obtuse;
        best = rays;
        is_changed = true;
        without_gain = 0;
    }
    return is_changed;
}

/// Ends columns below cells with an angle above 150 degrees, first below those far from the wall. First layers stay
/// (docs/layer.md). Returns whether it changed any.
bool end_obtuse_columns(LayerTopology topology, const DecompositionOptions& decomposition, FittedLayer& fitted) {
    // Cells far from the wall go first: what ends below cells in a cleft can be worse than these, and would hide the
    // gain.
    constexpr std::uint16_t far_from_wall = 10, above_first = 1;
    const auto obtuse_cells_of = [&](const layers::Rays& rays) {
        const layers::Layer layer =
            layers::close_border(rays, border_with_sources(fitted.sizes.border, fitted.requests.at_borders));
        return layers::obtuse_cells(layer, fill_layer(layer, topology, decomposition), layers::largest_layer_angle_deg);
    };
    std::vector<layers::ObtuseCell> fewest = obtuse_cells_of(fitted.rays);
    bool is_changed = false;
    for (const std::uint16_t above : {far_from_wall, above_first})
        if (end_columns_below_obtuse_cells(above, obtuse_cells_of, fewest, fitted.rays)) is_changed = true;
    return is_changed;
}

}  // namespace

PreparedWalls prepare_walls(const Geometry& given, const SurfaceOptions& options, surface::SpacingLimits limits,
                            double chord) {
    PreparedWalls walls{given, options, std::move(limits)};
    walls.prepared = surface::prepare_with_curves(given, options, walls.limits, chord);
    return walls;
}

FittedLayer fit_layer(PreparedWalls walls, const LayerRequest& layer, const DomainRequest& domain,
                      const OuterSizes& sizes, const ReferenceConditions& conditions) {
    const LayerOptions& options = layer.options;
    OuterWallSizes on_outer_walls{sizes.options, walls.limits.gradation};
    std::vector<EndsOnWalls> ends;
    const auto grow = [&](surface::PreparedSurfaces prepared) {
        FittedLayer fitted = grow_within(domain, layer, on_outer_walls, std::move(prepared), conditions, ends);
        ends = fitted.lines.ends;
        fitted.sizes = sizes;
        request_sizes(fitted);
        return fitted;
    };
    FittedLayer fitted = grow(std::move(walls.prepared));
    if (options.enabled && layers::uses("refine_walls"))
        refine_walls_below_borders(min_wall_gradation / layer.growth.fineness, walls, grow, on_outer_walls.finer,
                                   fitted);
    // Where all layers are made, nothing is in their way; equal numbers of layers are a promise.
    if (options.enabled && !options.equal_fans && !all_layers_fit(fitted.rays) && layers::uses("end_obtuse") &&
        end_obtuse_columns(options.topology, layer.decomposition, fitted)) {
        count_thinned(fitted);
        request_sizes(fitted);
    }
    return fitted;
}

layers::Layer close_border(const FittedLayer& fitted) {
    return layers::close_border(fitted.rays, border_with_sources(fitted.sizes.border, fitted.requests.at_borders));
}

bool make_room_at_narrow_triangles(std::span<const mesh::NarrowTriangle> narrow, bool thin, FittedLayer& fitted) {
    // Where no layer is thinned, the borders' edges become this share of the circles' radii.
    constexpr double edge_share = 0.3;
    if (!fitted.rays.enabled || narrow.empty() || !layers::uses("make_room")) return false;
    const std::vector<layers::Circle> places = circles_round_unexcused(narrow);
    std::vector<std::size_t> ends(places.size(), 0);
    if (thin) ends = layers::shorten_rays(places, fitted.rays);
    for (std::size_t k = 0; k < places.size(); ++k) {
        const Point at = places[k].middle;
        if (ends[k] == 0) fitted.short_edges.push_back({.a = at, .b = at, .size = edge_share * places[k].radius});
    }
    count_thinned(fitted);
    request_sizes(fitted);
    return true;
}

}  // namespace lamina::pipeline
