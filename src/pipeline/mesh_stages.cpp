#include "pipeline/mesh_stages.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include <lamina/error.hpp>

#include "layers/heights/heights.hpp"
#include "pipeline/assemble.hpp"
#include "pipeline/close_sheets.hpp"
#include "pipeline/row_border.hpp"
#include "sizing/requests.hpp"

namespace lamina::pipeline {

namespace {

void summarize_refinement(const PiecesSummary& pieces, MeshResult& result) {
    result.inviscid_pieces = pieces.pieces;
    result.refinement += pieces.stats;
    result.largest_inviscid_piece = pieces.largest;
    if (pieces.pieces > 0)
        result.estimates_within_15_percent =
            static_cast<double>(pieces.good_estimates) / static_cast<double>(pieces.pieces);
    result.mean_edge_over_size = pieces.mean_edge_over_size();
}

/// Records which column each cell of the layer belongs to, and where columns stand.
void record_columns(const layers::Layer& layer, const layers::LayerCells& cells, MeshResult& result) {
    if (cells.triangle_column.empty() && cells.quad_column.empty()) return;
    result.columns = cells.triangle_column;
    result.columns.insert(result.columns.end(), cells.quad_column.begin(), cells.quad_column.end());
    for (const std::vector<layers::Ray>& rays : layer.rays)
        for (const layers::Ray& ray : rays) result.column_origins.push_back(ray.origin);
}

void summarize_cells(const layers::Layer& layer, const layers::LayerCells& cells, MeshResult& result) {
    result.layer_pieces = cells.pieces();
    result.decomposition = cells.decomposition;
    result.layer_grid_refused = cells.grid_refused;
    record_columns(layer, cells, result);
}

/// Says for walls that are to keep the given points how many the mesh has beside them, and why.
void note_added_points(const layers::Layer& layer, double max_ray_angle_deg, std::vector<Element>& elements) {
    for (std::size_t e = 0; e < elements.size(); ++e) {
        Element& element = elements[e];
        if (element.is_mirrored) continue;
        const std::size_t given = element.points.size(), rays = layer.walls[e].size() - given,
                          divided = layer.edges.walls[e].size() - layer.walls[e].size();
        if (rays > 0)
            element.surface_notes.push_back(
                fmt::format("{} points added by refining rays, where the wall turns by more than {:g} degrees from one "
                            "point to the next (--max-ray-angle)",
                            rays, max_ray_angle_deg));
        if (divided > 0)
            element.surface_notes.push_back(
                fmt::format("{} points added on edges without layers, which are longer than the triangles there "
                            "(--gradation)",
                            divided));
        if (rays + divided == 0) element.surface_notes.emplace_back("no points added");
    }
}

/// Records what is known of a layer before it is filled.
void summarize_layer(const FittedLayer& fitted, const layers::Layer& layer, const LayerOptions& options,
                     MeshResult& result) {
    result.geometry = fitted.geometry;
    result.conditions = fitted.conditions;
    result.thinned_rays = fitted.thinned_rays;
    result.thinned_at = fitted.thinned_at;
    for (const auto& wall : layer.walls) result.surface_vertices += wall.size();
    result.layer_coverage = layer.coverage;
    if (!options.enabled) return;
    const std::size_t bodies = fitted.geometry.elements.size();
    for (std::size_t k = 0; k < fitted.outer_walls.size(); ++k)
        if (const OuterWallFacts& wall = fitted.outer_walls[k]; wall.first_height > 0)
            result.outer_walls.push_back({wall.name, wall.first_height, layer.coverage[bodies + k]});
    result.layer_coverage.resize(bodies);
    result.border_steps = border_steps(layer);
    for (std::size_t e = 0; e < bodies; ++e) result.first_heights.push_back(layer.growth.first_height_on(e));
    if (const auto* y_plus = std::get_if<YPlus>(&options.first_height)) result.y_plus = *y_plus;
}

void require_valid(const MeshCheck& check) {
    if (check.valid()) return;
    const MeshDefect& first = check.defects.front();
    throw MeshError(
        fmt::format("the mesh made is not valid: {} near ({}, {}){}", first.description, first.at.x, first.at.y,
                    check.defect_count > 1 ? fmt::format(", and {} more", check.defect_count - 1) : ""),
        first.at);
}

/// Returns the heights that first cells should have on each marker of the mesh. The marker of the base of an element
/// follows that of the element.
std::vector<double> first_heights_of_markers(const MeshResult& result, std::span<const Marker> markers) {
    std::vector<double> heights;
    if (result.first_heights.empty()) return heights;
    const std::vector<Element>& elements = result.geometry.elements;
    const auto has_marker = [](const Element& element, const std::string& name) {
        return element.parts.empty() ? element.name == name
                                     : std::any_of(element.parts.begin(), element.parts.end(),
                                                   [&](const WallPart& part) { return part.name == name; });
    };
    std::size_t current = 0;
    for (const Marker& marker : markers) {
        if (current + 1 < elements.size() && has_marker(elements[current + 1], marker.name)) ++current;
        heights.push_back(result.first_heights[current]);
        for (const OuterWallLayer& wall : result.outer_walls)
            if (wall.name == marker.name) heights.back() = wall.first_height;
    }
    return heights;
}

/// Returns the heights that first cells should have at each vertex of the walls, where they vary along them.
std::vector<double> first_heights_at_vertices(const FittedLayer& fitted, const layers::Layer& layer) {
    const layers::LayerGrowth& growth = layer.growth;
    std::vector<double> heights;
    if (growth.wall_first_heights.empty()) return heights;
    heights.resize(layer.wall_points);
    for (std::size_t e = 0; e < layer.walls.size(); ++e) {
        std::vector<layers::WallHeight> chain;
        if (e < fitted.geometry.elements.size()) {
            const std::vector<Point>& wall = fitted.geometry.elements[e].points;
            const std::vector<double> on_wall = layers::first_heights_on_wall(growth, e, wall);
            for (std::size_t i = 0; i < on_wall.size(); ++i) chain.push_back({e, wall[i], on_wall[i]});
        }
        for (const VertexId v : layer.walls[e])
            heights[v.index()] =
                chain.empty() ? growth.first_height_on(e) : layers::height_at(layer.points[v.index()], chain);
    }
    return heights;
}

SizeField sizes_beyond(const FittedLayer& fitted, const layers::Layer& layer) {
    return sizing::make_size_field(repeated_in_row(border_loops(layer), fitted.far_field), fitted.requests.sources,
                                   fitted.sizes.options, fitted.conditions.chord, fitted.far_field.box());
}

/// Adds the markers of outer walls and of a line of symmetry that cuts bodies, or those of a row of blades.
void add_borders_of_domain(const FittedLayer& fitted, const layers::Layer& layer, const RegionBorders& region,
                           const FarFieldOptions& options, std::vector<Marker>& markers) {
    if (!region.row.empty()) return add_row(region.row, markers);
    const std::vector<Segment>& symmetry = region.symmetry;
    add_outer_walls(fitted.outer_walls, std::span(layer.edges.walls).last(layer.outer_walls), markers);
    if (!symmetry.empty()) {
        const OuterWallFacts line{
            symmetry_name(options), fitted.far_field.floor, OuterWallKind::slip, 0, 0, "symmetry"};
        add_outer_walls({&line, 1}, {&symmetry, 1}, markers);
    }
}

}  // namespace

OutlinedMesh outline_mesh(const FittedLayer& fitted, const LayerOptions& layer_options, const SurfaceOptions& surface,
                          StageClock& clock, MeshResult& result) {
    layers::Layer layer = close_border(fitted);
    summarize_layer(fitted, layer, layer_options, result);
    if (surface.treatment == SurfaceTreatment::keep)
        note_added_points(layer, layer_options.max_ray_angle_deg, result.geometry.elements);
    clock.end(&StageSeconds::layers);

    clock.begin("sizing");
    SizeField size = sizes_beyond(fitted, layer);
    RegionBorders region = fitted.far_field.pitch > 0 ? close_row(layer, fitted.below, fitted.far_field, size)
                                                      : close_domain(layer, fitted.far_field, size, fitted.lines);
    FeetInLayer feet = feet_in_layer(fitted.lines, layer);
    decoupling::InnerLines lines = inner_lines(fitted.lines, feet, region);
    return {std::move(layer), std::move(size), std::move(region), std::move(feet), std::move(lines)};
}

decoupling::OuterRegion OutlinedMesh::outer(const FittedLayer& fitted, const DecouplingOptions& options) const {
    return {region.points, region.borders, size, fitted.far_field, options, lines};
}

std::vector<Marker> markers_of_mesh(const FittedLayer& fitted, const OutlinedMesh& outlined,
                                    const AssembleOptions& options, const FarFieldOptions& domain,
                                    const DecoupledBorders& borders, MeshDriver& driver) {
    const RegionBorders& region = outlined.region;
    std::vector<Segment> far_field = region.far_field;
    far_field.insert(far_field.end(), borders.far_field.begin(), borders.far_field.end());
    std::vector<Marker> markers = make_markers(fitted.geometry, outlined.layer, std::move(far_field), options);
    add_borders_of_domain(fitted, outlined.layer, region, domain, markers);
    if (region.row.empty() && (options.inlet_outlet || domain.tunnel)) {
        driver.place_far_field();
        split_far_field(borders.points, markers, fitted.conditions.alpha_deg);
    }
    add_line_markers(fitted.lines, outlined.feet, borders.inner_edges, markers);
    return markers;
}

MeshCheckOptions options_of_check(const FittedLayer& fitted, const layers::Layer& layer, double min_angle_deg,
                                  const MeshResult& result, std::span<const Marker> markers) {
    return {.min_angle_deg = min_angle_deg,
            .first_heights = first_heights_of_markers(result, markers),
            .first_height_at = first_heights_at_vertices(fitted, layer)};
}

void finish_check(mesh::PiecewiseCheck& check, const MadePieces& pieces, std::span<const Marker> markers,
                  MadeMesh& made) {
    made.result.check = check.finish(markers, made.constraints, pieces.first_triangle);
    require_valid(made.result.check);
    made.narrow = check.unexcused();
}

void take_cells(const layers::Layer& layer, MadePieces& pieces, MeshResult& result) {
    result.mesh = std::move(pieces.mesh);
    summarize_cells(layer, pieces.cells, result);
    summarize_refinement(pieces.summary, result);
}

void complete_walls_without_thickness(std::span<const InternalLine> lines, double min_angle_deg, MadeMesh& made) {
    MeshResult& result = made.result;
    if (lines.empty() && !has_sheets(result.geometry)) return;
    close_sheets(result);  // first: it wants one vertex on either side of a sheet
    split_two_sided(lines, result.mesh, made.constraints);
    result.mesh.constraints = made.constraints;
    WallSummary walls = std::move(result.check.walls);
    const std::size_t without_first_layer = result.check.edges_without_first_layer;
    result.check = check_mesh(result.mesh, {.min_angle_deg = min_angle_deg,
                                            .first_heights = first_heights_of_markers(result, result.mesh.markers)});
    if (!lines.empty()) {
        result.check.walls = std::move(walls);
        result.check.edges_without_first_layer = without_first_layer;
    }
    require_valid(result.check);
}

void hand_over(MadePieces& pieces, MadeMesh& made) {
    made.counts = pieces.counts;
    made.hash = std::move(pieces.hash);
    made.sink = std::move(pieces.sink);
    made.parts = std::move(pieces.parts);
}

}  // namespace lamina::pipeline
