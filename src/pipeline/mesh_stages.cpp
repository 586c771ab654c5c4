#include "pipeline/mesh_stages.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include <lamina/error.hpp>
#include <lamina/threads.hpp>

#include "decoupling/far_field.hpp"
#include "layers/heights/heights.hpp"
#include "pipeline/assemble.hpp"
#include "pipeline/close_sheets.hpp"
#include "pipeline/mesh_limits.hpp"
#include "pipeline/row_border.hpp"
#include "pipeline/warnings.hpp"
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

SizeField sizes_beyond(const FittedLayer& fitted, const layers::Layer& layer, const SizingOptions& options) {
    return sizing::make_size_field(repeated_in_row(border_loops(layer), fitted.far_field), fitted.requests.sources,
                                   options, fitted.conditions.chord, fitted.far_field.box());
}

/// Adds the markers of outer walls and of a line of symmetry that cuts bodies, or those of a row of blades.
void add_borders_of_domain(const FittedLayer& fitted, const layers::Layer& layer, const RegionBorders& region,
                           const FarFieldOptions& options, std::vector<Marker>& markers) {
    if (!region.row.empty()) return add_row(region.row, markers);
    const std::vector<Segment>& symmetry = region.symmetry;
    add_outer_walls(fitted.outer_walls, std::span(layer.edges.walls).last(layer.outer_walls), markers);
    if (!symmetry.empty()) {
        const OuterWallFacts line{symmetry_name(options), fitted.far_field.floor, OuterWallKind::slip, 0, "symmetry"};
        add_outer_walls({&line, 1}, {&symmetry, 1}, markers);
    }
}

/// Returns all markers of the mesh. The far field is divided into inlet and outlet if the options ask for it.
std::vector<Marker> markers_of_mesh(const FittedLayer& fitted, const layers::Layer& layer, const RegionBorders& region,
                                    const CaseOptions& options, const DecoupledBorders& borders, MeshDriver& driver) {
    std::vector<Segment> far_field = region.far_field;
    far_field.insert(far_field.end(), borders.far_field.begin(), borders.far_field.end());
    std::vector<Marker> markers = make_markers(fitted.geometry, layer, std::move(far_field), options.assemble);
    add_borders_of_domain(fitted, layer, region, options.far_field, markers);
    if (region.row.empty() && (options.inlet_outlet || options.far_field.tunnel)) {
        driver.place_far_field();
        split_far_field(borders.points, markers, fitted.conditions.alpha_deg);
    }
    add_line_markers(fitted.lines, options.lines, borders.inner_edges, markers);
    return markers;
}

/// Doubles the vertices of two-sided lines, closes sheets, and checks the mesh as a whole: pieces know no lines, and sheets
/// with a gap. Beside lines the summary of walls stays that of the pieces, since those with two sides have no layers.
void complete_walls_without_thickness(std::span<const InternalLine> lines, double min_angle_deg, MadeMesh& made) {
    MeshResult& result = made.result;
    split_two_sided(lines, result.mesh, made.constraints);
    result.mesh.constraints = made.constraints;
    close_sheets(result);
    WallSummary walls = std::move(result.check.walls);
    result.check = check_mesh(result.mesh, {.min_angle_deg = min_angle_deg,
                                            .first_heights = first_heights_of_markers(result, result.mesh.markers)});
    if (!lines.empty()) result.check.walls = std::move(walls);
    require_valid(result.check);
}

/// Returns what the check of the pieces has to know of the layer.
MeshCheckOptions options_of_check(const FittedLayer& fitted, const layers::Layer& layer, double min_angle_deg,
                                  const MeshResult& result, std::span<const Marker> markers) {
    return {.min_angle_deg = min_angle_deg,
            .first_heights = first_heights_of_markers(result, markers),
            .first_height_at = first_heights_at_vertices(fitted, layer)};
}

/// Ends the check of the pieces. Throws where the mesh is not valid.
void finish_check(mesh::PiecewiseCheck& check, const MadePieces& pieces, std::span<const Marker> markers,
                  MadeMesh& made) {
    made.result.check = check.finish(markers, made.constraints, pieces.first_triangle);
    require_valid(made.result.check);
    made.narrow = check.unexcused();
}

/// Gives what is left of the pieces, beside the mesh, to who asked for it.
void hand_over(MadePieces& pieces, MadeMesh& made) {
    made.counts = pieces.counts;
    made.hash = std::move(pieces.hash);
    made.sink = std::move(pieces.sink);
    made.parts = std::move(pieces.parts);
}

}  // namespace

OutlinedMesh outline_mesh(const FittedLayer& fitted, const CaseOptions& options, StageClock& clock,
                          MeshResult& result) {
    layers::Layer layer = close_border(fitted);
    summarize_layer(fitted, layer, options.layer, result);
    if (options.surface.treatment == SurfaceTreatment::keep)
        note_added_points(layer, options.layer.max_ray_angle_deg, result.geometry.elements);
    clock.end(&StageSeconds::layers);

    clock.begin("sizing");
    SizeField size = sizes_beyond(fitted, layer, options.sizing);
    RegionBorders region = fitted.far_field.pitch > 0 ? close_row(layer, fitted.below, fitted.far_field, size)
                                                      : close_domain(layer, fitted.far_field, size, fitted.lines);
    decoupling::InnerLines lines = inner_lines(fitted.lines, options.lines, region);
    return {std::move(layer), std::move(size), std::move(region), std::move(lines)};
}

decoupling::OuterRegion OutlinedMesh::outer(const FittedLayer& fitted, const DecouplingOptions& options) const {
    return {region.points, region.borders, size, fitted.far_field, options, lines};
}

MadeMesh make_mesh(const FittedLayer& fitted, const CaseOptions& options, MeshDriver& driver, StageClock& clock) {
    const WorkBudget budget{options.limits, driver.cost()};
    MadeMesh made;
    MeshResult& result = made.result;
    const OutlinedMesh outlined = outline_mesh(fitted, options, clock, result);
    const layers::Layer& layer = outlined.layer;
    const RegionBorders& region = outlined.region;
    const decoupling::OuterRegion outer = outlined.outer(fitted, options.decoupling);
    made.constraints = layer.edges.interfaces;
    std::optional<RunEstimate> estimate;
    driver.lead([&] {
        estimate =
            estimate_within_limits(options.refine, options.order, options.sizing.gradation, layer, outer, budget);
        result.estimate = *estimate;
    });
    clock.end(&StageSeconds::sizing);

    clock.begin("decoupling", estimate);
    const DecoupledBorders borders =
        driver.decouple(outer, refine_within(options.refine, fitted.conditions.chord, budget),
                        triangles_beyond_layer(result.estimate, layer));
    std::vector<Marker> markers = markers_of_mesh(fitted, layer, region, options, borders, driver);
    clock.end(&StageSeconds::decoupling);

    clock.begin("layer triangulation, refinement and check of pieces");
    mesh::PiecewiseCheck check(borders.points,
                               options_of_check(fitted, layer, options.refine.min_angle_deg, result, markers),
                               driver.matched_elsewhere(region.points.size()));
    core::BusyTimes times;
    MadePieces pieces =
        driver.make({layer, options.layer.topology, options.decomposition, markers, check, times, clock});
    result.threads = thread_count();
    result.thread_seconds = clock.end_shared(times);

    clock.begin("check");
    driver.lead([&] { finish_check(check, pieces, markers, made); });
    driver.tell_narrow(made.narrow);
    clock.end(&StageSeconds::check);

    clock.begin("assembly");
    require_made_within(budget, pieces.counts);
    result.mesh = std::move(pieces.mesh);
    result.mesh.markers = std::move(markers);
    summarize_cells(layer, pieces.cells, result);
    if (!options.lines.empty() || has_sheets(result.geometry))
        complete_walls_without_thickness(options.lines, options.refine.min_angle_deg, made);
    summarize_refinement(pieces.summary, result);
    const WorstPlaces places{check.widest().middle, check.narrowest().middle, pieces.summary.oversized.middle,
                             made.narrow};
    driver.lead([&] { result.warnings = find_warnings(result, options, places, pieces.layer); });
    driver.keep_parts(pieces);
    hand_over(pieces, made);
    clock.end(&StageSeconds::assembly);
    return made;
}

}  // namespace lamina::pipeline
