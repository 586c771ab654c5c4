// Plates for the rays, and the border of the domain.
#include "pipeline/outer_walls.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <lamina/error.hpp>

#include "core/reproducible_math.hpp"
#include "decoupling/separators.hpp"
#include "geometry/symmetry.hpp"
#include "layers/growth.hpp"
#include "pipeline/internal_lines.hpp"

namespace lamina::pipeline {

namespace {

/// Returns the first height of the layers on a wall.
double first_height_of(const std::optional<OuterLayers>& layers, const char* option,
                       const ReferenceConditions& conditions, const layers::LayerGrowth& growth) {
    if (!layers) return growth.first_height;
    if (const auto* height = std::get_if<Length>(&*layers)) return in_units(*height, conditions.chord);
    if (!conditions.reynolds) throw OptionError(option, "a y+ needs reynolds, or velocity and viscosity");
    return layers::first_height_for(std::get<YPlus>(*layers).y_plus, *conditions.reynolds, conditions.chord);
}

/// Returns how thick layers on walls of the domain may be: so many times as thick as the turbulent boundary layer of a
/// flat plate as long as the domain at its end, 0.37 x Re_x^(-1/5) (H. Schlichting, Boundary-Layer Theory, 21.1). None
/// is thicker there.
double thickest_layer_of_domain(double length, const ReferenceConditions& conditions) {
    constexpr double reynolds_if_unknown = 1e6, boundary_layers = 2;
    const double reynolds = conditions.reynolds.value_or(reynolds_if_unknown) * length / conditions.chord;
    return boundary_layers * 0.37 * length / core::pow_reproducible(reynolds, 0.2);
}

/// Returns the plate that a wall is for the rays. Its hidden part goes on beyond both sides of the domain, far enough
/// for columns of layers at the sides not to feel its corners, and back below:
///
///     :     the domain     :
///     :                    :
///     |_|_|___|____|___|_|_|_|      <- the wall, and columns beyond the side
///     |_|_|___|____|___|_|_|_|      <- the hidden side of the plate
layers::OuterWall plate(const OuterWallFacts& wall, std::vector<double> x, bool is_below) {
    constexpr std::size_t columns_beyond = 8;
    const std::size_t n = x.size();
    const double first_step = x[1] - x[0], last_step = x[n - 1] - x[n - 2];
    const double depth = (is_below ? -1 : 1) * std::min(std::abs(first_step), std::abs(last_step));
    layers::OuterWall outer{{}, n, wall.first_height, wall.thickest};
    std::vector<double> hidden;  // from the end of the wall beyond both sides to its beginning
    for (std::size_t i = 1; i <= columns_beyond; ++i) hidden.push_back(x[n - 1] + static_cast<double>(i) * last_step);
    for (const double at : x) outer.points.push_back({at, wall.y});
    for (const double at : hidden) outer.points.push_back({at, wall.y});
    for (std::size_t i = hidden.size(); i-- > 0;) outer.points.push_back({hidden[i], wall.y + depth});
    for (std::size_t i = n; i-- > 0;) outer.points.push_back({x[i], wall.y + depth});
    for (std::size_t i = 1; i <= columns_beyond; ++i)
        outer.points.push_back({x[0] - static_cast<double>(i) * first_step, wall.y + depth});
    for (std::size_t i = columns_beyond; i > 0; --i)
        outer.points.push_back({x[0] - static_cast<double>(i) * first_step, wall.y});
    return outer;
}

}  // namespace

std::vector<OuterWallFacts> outer_wall_facts(const decoupling::FarField& far_field, const FarFieldOptions& options,
                                             const Geometry& geometry, const LayerOptions& layer,
                                             const ReferenceConditions& conditions, const layers::LayerGrowth& growth) {
    std::vector<OuterWallFacts> walls;
    const double thickest = thickest_layer_of_domain(far_field.box().width(), conditions);
    const auto add = [&](const char* name, double y, const char* option, OuterWallKind kind,
                         const std::optional<OuterLayers>& layers, const char* of_layers) {
        const bool has_layers = layer.enabled && kind != OuterWallKind::slip;
        walls.push_back(
            {name, y, kind, has_layers ? first_height_of(layers, of_layers, conditions, growth) : 0, thickest, option});
        if (has_layers) layers::layer_growth(layer, conditions, {walls.back().first_height});  // throws
    };
    if (options.ground)
        add("ground", far_field.floor, "ground", options.ground_wall, options.ground_layers, "ground_layers");
    else if (options.tunnel && !options.symmetry)
        add("floor", far_field.floor, "tunnel", options.tunnel_walls, options.tunnel_layers, "tunnel_layers");
    else if (options.symmetry && !geometry::is_cut(geometry))
        add(symmetry_name(options), far_field.floor, "symmetry", OuterWallKind::slip, {}, "");
    if (options.tunnel)
        add("ceiling", far_field.ceiling, "tunnel", options.tunnel_walls, options.tunnel_layers, "tunnel_layers");
    return walls;
}

std::vector<layers::OuterWall> divide_outer_walls(std::span<const OuterWallFacts> walls,
                                                  const decoupling::FarField& far_field, const SizeField& size,
                                                  const LineGraph& lines) {
    const Box domain = far_field.box();
    std::vector<layers::OuterWall> divided;
    for (const OuterWallFacts& wall : walls) {
        // A body lies on the left of its outline.
        const bool is_below = wall.y == far_field.floor;
        const double begin = is_below ? domain.upper.x : domain.lower.x,
                     end = is_below ? domain.lower.x : domain.upper.x;
        std::vector<double> ends = feet_on_border(lines, wall.y);
        if (is_below) std::reverse(ends.begin(), ends.end());
        ends.push_back(end);
        const std::size_t least = ends.size() > 1 ? 1 : decoupling::min_segments_of_side;
        std::vector<double> x{begin};
        for (const double next : ends) {
            for (const Point p : decoupling::divide_separator({x.back(), wall.y}, {next, wall.y}, size, least))
                x.push_back(p.x);
            x.push_back(next);
        }
        divided.push_back(plate(wall, std::move(x), is_below));
    }
    return divided;
}

const char* symmetry_name(const FarFieldOptions& options) { return options.axisymmetric ? "axis" : "symmetry"; }

namespace {

/// Closes the border of a domain whose line of symmetry cuts bodies, with the ceiling of a tunnel if there is one:
///
///      ______________________________________
///     |                  ____                |
///     |                /      \              |
///     |________________|      |______________|     <- the line, between the ends of the bodies' layers
///                      first body
///
/// The border begins at the lower right corner and runs clockwise.
void close_half(const layers::Layer& layer, const decoupling::FarField& far_field, const SizeField& size,
                const LineGraph& lines, RegionBorders& result) {
    const auto [lower_left, lower_right, upper_right, upper_left] = far_field.box().corners();
    const auto x_of = [&](VertexId v) { return layer.points[v.index()].x; };
    std::vector<std::vector<VertexId>> bodies, others;  // from the right to the left
    const std::size_t elements = layer.borders.size() - layer.outer_walls;
    for (std::size_t e = 0; e < elements; ++e) (layer.is_open(e) ? bodies : others).push_back(layer.borders[e]);
    std::sort(bodies.begin(), bodies.end(),
              [&](const auto& a, const auto& b) { return x_of(a.front()) > x_of(b.front()); });
    std::vector<VertexId> loop;
    std::vector<Segment>* edges = &result.symmetry;
    const auto add_vertex = [&](VertexId v) {
        if (!loop.empty()) edges->push_back({v, loop.back()});
        loop.push_back(v);
    };
    const auto add_point = [&](Point p) {
        result.points.push_back(p);
        add_vertex(VertexId(result.points.size() - 1));
    };
    const auto add_border = [&](const std::vector<VertexId>& border) {
        add_vertex(border.front());
        loop.insert(loop.end(), border.begin() + 1, border.end());
    };
    // Adds the points between the last one and this one.
    const auto divide_up_to = [&](Point end) {
        const Point begin = result.points[loop.back().index()];
        for (const Point p : decoupling::divide_separator(begin, end, size, 1))
            add_point({p.x, begin.y == end.y ? begin.y : p.y});
    };
    std::vector<double> feet = feet_on_border(lines, far_field.floor);
    const auto divide_line_up_to = [&](Point end) {
        for (; !feet.empty() && feet.back() > end.x; feet.pop_back()) {
            const Point foot{feet.back(), far_field.floor};
            divide_up_to(foot);
            add_point(foot);
        }
        divide_up_to(end);
    };
    add_point(lower_right);
    for (const std::vector<VertexId>& body : bodies) {
        divide_line_up_to(layer.points[body.front().index()]);
        add_border(body);
    }
    divide_line_up_to(lower_left);
    add_point(lower_left);
    edges = &result.far_field;
    if (layer.outer_walls > 0) {
        const std::vector<VertexId>& ceiling = layer.borders.back();
        divide_up_to(layer.points[ceiling.front().index()]);
        add_border(ceiling);
    } else {
        for (const Point corner : {upper_left, upper_right}) {
            divide_up_to(corner);
            add_point(corner);
        }
    }
    divide_up_to(lower_right);
    edges->push_back({loop.front(), loop.back()});
    result.symmetry.insert(result.symmetry.end(), layer.edges.symmetry.begin(), layer.edges.symmetry.end());
    others.push_back(std::move(loop));
    result.borders = std::move(others);
}

}  // namespace

RegionBorders close_domain(const layers::Layer& layer, const decoupling::FarField& far_field, const SizeField& size,
                           const LineGraph& lines) {
    RegionBorders result{layer.points, layer.borders, layer.edges.sides, {}, {}};
    bool is_cut = false;  // else a line of symmetry is an outer wall itself
    for (std::size_t e = 0; e < layer.borders.size(); ++e) is_cut |= layer.is_open(e) && !layer.is_outer(e);
    if (is_cut) close_half(layer, far_field, size, lines, result);
    if (is_cut || layer.outer_walls == 0) return result;
    const std::span<const std::vector<VertexId>> walls = std::span(layer.borders).last(layer.outer_walls);
    result.borders.resize(layer.borders.size() - walls.size());
    std::vector<VertexId> loop;
    const auto add_point = [&](Point p) {
        result.points.push_back(p);
        loop.push_back(VertexId(result.points.size() - 1));
    };
    // Each side begins at the end of a wall, and the next wall begins at its end.
    const auto [lower_left, lower_right, upper_right, upper_left] = far_field.box().corners();
    for (std::size_t k = 0; k < walls.size(); ++k) {
        const std::vector<VertexId>& next = walls[(k + 1) % walls.size()];
        loop.insert(loop.end(), walls[k].begin(), walls[k].end());
        const std::size_t first = loop.size() - 1;
        std::vector<Point> corners{layer.points[walls[k].back().index()]};
        if (walls.size() == 1) corners.insert(corners.end(), {upper_left, upper_right});
        corners.push_back(layer.points[next.front().index()]);
        for (std::size_t i = 0; i + 1 < corners.size(); ++i) {
            if (i > 0) add_point(corners[i]);
            for (const Point p :
                 decoupling::divide_separator(corners[i], corners[i + 1], size, decoupling::min_segments_of_side))
                add_point(p);
        }
        for (std::size_t i = first; i < loop.size(); ++i)
            result.far_field.push_back({i + 1 < loop.size() ? loop[i + 1] : next.front(), loop[i]});
    }
    result.borders.push_back(std::move(loop));
    return result;
}

}  // namespace lamina::pipeline
