// The bounds below separate good meshes from others, as measured on a collection of sections (docs/decisions/0020).
// Places are searched only where there is something to warn of.
#include "pipeline/warnings.hpp"
#include "core/marker_names.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "core/cell_shape.hpp"
#include "layers/growth_laws.hpp"
#include "layers/parameters.hpp"
#include "mesh/cell_middle.hpp"
#include "mesh/quality.hpp"
#include "mesh/walls.hpp"
#include "pipeline/area_jumps.hpp"
#include "pipeline/assemble.hpp"
#include "pipeline/reynolds_doubt.hpp"

namespace lamina::pipeline {

namespace {

using core::CellShape;

std::string place_text(Point p) { return fmt::format("({:.6g}, {:.6g})", p.x, p.y); }

std::string counted(std::size_t n, const std::string& singular, const std::string& plural) {
    return fmt::format("{} {}", n, n == 1 ? singular : plural);
}

// ---- search for places ----

std::size_t cell_count(const Mesh& mesh) { return mesh.triangles.size() + mesh.quads.size(); }

/// Returns the vertices of a cell.
std::span<const VertexId> corners_of(const Mesh& mesh, std::size_t cell) {
    if (cell < mesh.triangles.size()) return mesh.triangles[cell].v;
    return mesh.quads[cell - mesh.triangles.size()].v;
}

CellShape shape_of(const Mesh& mesh, std::size_t cell) {
    const auto corner = [&](std::size_t i) { return mesh.points[corners_of(mesh, cell)[i].index()]; };
    if (cell < mesh.triangles.size()) return core::measure_triangle(corner(0), corner(1), corner(2));
    return mesh::measure_quad(corner(0), corner(1), corner(2), corner(3));
}

/// Returns the middle of the cell of a region for which badness(cell) is largest; the first of several.
template <class Badness>
Point worst_place(const Mesh& mesh, Region region, Badness badness) {
    std::size_t worst = 0;
    double worst_badness = -HUGE_VAL;
    for (std::size_t cell = 0; cell < cell_count(mesh); ++cell) {
        if (mesh.region[cell] != region) continue;
        if (const double b = badness(cell); b > worst_badness) {
            worst = cell;
            worst_badness = b;
        }
    }
    return mesh::middle_of_cell(mesh, corners_of(mesh, worst));
}

/// Returns the place of the wall edge whose cell reaches to the highest layer.
Point highest_first_cell(const Mesh& mesh, std::span<const Marker> markers) {
    const std::vector<Segment> walls = mesh::sorted_wall_edges(markers);
    return worst_place(mesh, Region::layer, [&](std::size_t cell) {
        const auto corners = corners_of(mesh, cell);
        for (std::size_t i = 0; i < corners.size(); ++i)
            if (std::binary_search(walls.begin(), walls.end(), Segment{corners[i], corners[(i + 1) % corners.size()]}))
                return static_cast<double>(mesh.layer[cell]);
        return 0.0;
    });
}

// ---- the layer ----

void warn_of_first_layer(const MeshResult& result, const Mesh& layer, std::vector<Warning>& warnings) {
    const std::size_t lost = result.check.edges_without_first_layer;
    if (lost == 0) return;
    const Point at = highest_first_cell(layer, result.mesh.markers);
    warnings.push_back(
        {.code = WarningCode::first_layer_lost,
         .at = at,
         .number = static_cast<double>(lost),
         .unit = "wall edges",
         .message = fmt::format("the first height is lost on {} of {} (worst at {}): --layer-topology layered or quads "
                                "keeps it, and so do more surface points (--surface-points)",
                                lost, counted(result.surface_vertices, "wall edge", "wall edges"), place_text(at))});
}

void warn_of_bare_walls(const MeshResult& result, std::vector<Warning>& warnings) {
    const WallSummary& walls = result.check.walls;
    if (walls.bare_edges == 0) return;
    warnings.push_back(
        {.code = WarningCode::first_layer_lost,
         .at = walls.bare_at,
         .number = static_cast<double>(walls.bare_edges),
         .unit = "wall edges",
         .message = fmt::format("{} of {} have no layer, as at {}: the room between the walls is narrower "
                                "there than first layers are high (--first-height, --surface)",
                                walls.bare_edges, counted(walls.edges, "wall edge", "wall edges"),
                                place_text(walls.bare_at))});
}

void warn_of_first_heights(const MeshResult& result, std::vector<Warning>& warnings) {
    constexpr double largest_factor = 2;  // to either side: a y+ that is off by more is another model of the wall
    const WallSummary& walls = result.check.walls;
    const double worst = walls.worst_first_height;
    if (worst <= largest_factor && worst * largest_factor >= 1) return;
    const double off = std::round(static_cast<double>(walls.first_cells) * (1 - walls.share_of_kept_heights));
    warnings.push_back(
        {.code = WarningCode::first_layer_lost,
         .at = walls.worst_first_height_at,
         .number = off,
         .unit = "wall edges",
         .message = fmt::format("first cells on {:.0f} of {} are not of the height wanted, where there is no room for "
                                "it; the worst, at {}, has {:.3g} of it (--first-height, --surface)",
                                off, counted(walls.edges, "wall edge", "wall edges"),
                                place_text(walls.worst_first_height_at), worst)});
}

void warn_of_cut_rays(const MeshResult& result, std::vector<Warning>& warnings) {
    // Beside a slot or a cove some rays that count as open are cut, and lack few of their layers.
    constexpr double max_cut_share = 0.25, min_made_share = 0.95;
    for (std::size_t e = 0; e < result.layer_coverage.size(); ++e) {
        const ElementCoverage& coverage = result.layer_coverage[e];
        const std::size_t cut = coverage.open.incomplete_rays, rays = coverage.open.rays;
        const bool many_cut = static_cast<double>(cut) > max_cut_share * static_cast<double>(rays);
        const bool few_made = static_cast<double>(coverage.open.made_cells) <
                              min_made_share * static_cast<double>(coverage.open.requested_cells);
        if (!many_cut && !few_made) continue;
        const std::string& name = result.geometry.elements[e].name;
        warnings.push_back(
            {.code = WarningCode::rays_cut_in_the_open,
             .element = name,
             .at = coverage.worst_in_the_open,
             .number = static_cast<double>(cut),
             .unit = "rays",
             .message = fmt::format("{}: {} of {} rays in the open are cut short (worst at {}): the layers are thicker "
                                    "than the room round the wall (--layers, --thickness, --first-height)",
                                    name, cut, rays, place_text(coverage.worst_in_the_open))});
    }
}

void warn_of_thinned_layers(const MeshResult& result, std::vector<Warning>& warnings) {
    if (result.thinned_rays == 0) return;
    warnings.push_back(
        {.code = WarningCode::layers_thinned,
         .at = result.thinned_at,
         .number = static_cast<double>(result.thinned_rays),
         .unit = "rays",
         .message = fmt::format("the layers on {} are thinner than there is room for (most at {}), since angles beyond "
                                "or within them would be too small or too large otherwise (--layers, --thickness, "
                                "--surface)",
                                counted(result.thinned_rays, "ray", "rays"), place_text(result.thinned_at))});
}

/// Returns what makes the last cells of the layer higher or lower, as they fit the triangles beyond.
std::string better_layers(const LayerOptions& options, bool are_too_low) {
    const std::string amount = are_too_low ? "more" : "fewer";
    if (options.thickness && are_too_low) return "a larger --thickness";
    if (!options.layers) return fmt::format("a {} --growth", are_too_low ? "larger" : "smaller");
    const bool needs_number = layers::growth_law_entry(options.growth_law).min_layers > 0;
    return needs_number ? amount + " --layers" : "--layers auto, or " + amount + " layers,";
}

void warn_of_transition(const MeshResult& result, const LayerOptions& options, std::vector<Warning>& warnings) {
    // Solvers lose an order of accuracy where a cell is twice as high as the one before.
    constexpr double min_ratio = 0.1, max_ratio = 5, max_height_ratio = 2;
    const TransitionSummary& transition = result.check.transition;
    if (transition.edges == 0) return;
    const auto warn = [&](double number, const std::string& unit, const std::string& what, bool are_too_low) {
        warnings.push_back(
            {.code = WarningCode::transition_out_of_range,
             .number = number,
             .unit = unit,
             .message = fmt::format("{}: {} would match them better", what, better_layers(options, are_too_low))});
    };
    const double median = transition.median_area_ratio, height = transition.p90_height_ratio;
    if (median < min_ratio || median > max_ratio)
        warn(median, "area ratio",
             fmt::format("the last cells of the layer have {:.2g} times the area of the triangles beyond (median)",
                         median),
             median < 1);
    else if (height > max_height_ratio)
        warn(height, "height ratio",
             fmt::format("the triangles beyond the layer are {:.2g} times as high as its last cells (90th percentile)",
                         height),
             true);
}

void warn_of_areas(const MeshResult& result, const LayerOptions& options, const Mesh& layer,
                   std::vector<Warning>& warnings) {
    constexpr double max_ratio = 50;
    // Where a fan turns round a corner, its first cell is a triangle as high as the first layer, and the next cell is
    // as long as the wall's edge: 70 to 5,000 times as large on ordinary sections, up to 18,000 at a y+ of 0.5. More
    // comes from edges beside corners that are out of proportion, as bases of one edge in files.
    constexpr double max_beside_fans = 2e4;
    const QualitySummary& quality = result.check.layer;
    if (quality.max_neighbour_area_ratio <= max_ratio) return;
    const AreaJumps jumps = find_area_jumps(layer, result.columns, result.column_origins);
    const auto warn = [&](const AreaJump& jump, const std::string& text) {
        warnings.push_back({.code = WarningCode::area_jump,
                            .at = jump.at,
                            .number = jump.ratio,
                            .unit = "area ratio",
                            .message = fmt::format(fmt::runtime(text), jump.ratio, place_text(jump.at))});
    };
    if (jumps.beside_fans.ratio > max_beside_fans)
        warn(jumps.beside_fans,
             "the first cells round a corner are {:.3g} times smaller than those on the wall beside it, at {}: shorter "
             "edges there even them out (--surface resample --spacing-te), or refining rays (--corners refine)");
    AreaJump elsewhere = jumps.elsewhere;
    // The search above sees no neighbours outside of the layer, and no fans in layers without rows.
    const bool knows_fans = options.topology != LayerTopology::delaunay && !result.layer_grid_refused;
    if (quality.max_neighbour_area_ratio > std::max(elsewhere.ratio, jumps.beside_fans.ratio))
        elsewhere = {quality.max_neighbour_area_ratio, quality.max_neighbour_area_ratio_at};
    if (elsewhere.ratio > (knows_fans ? max_ratio : max_beside_fans))
        warn(elsewhere, std::string("neighbouring cells of the layer differ in area by a factor of {:.3g}, at {}: ") +
                            (options.layers ? "--layers auto, or a finer wall, evens them out (--spacing-max)"
                                            : "a higher first layer evens them out (--y-plus, --first-height)"));
}

void warn_of_first_height(const MeshResult& result, const LayerOptions& options, std::vector<Warning>& warnings) {
    // A y+ of 1 asks for 1e-7 chords at a Reynolds number of 4e8, and a y+ of 300 for 1e-2 at 5e5.
    constexpr double min_share = 1e-7, max_share = 1e-2;
    if (!options.enabled || result.y_plus) return;  // so that all elements have the height that was given
    const double chord = result.conditions.chord, height = result.first_heights.front(), share = height / chord;
    if (share >= min_share && share <= max_share) return;
    warnings.push_back({.code = WarningCode::first_height_implausible,
                        .number = share,
                        .unit = "chords",
                        .message = fmt::format("the first height {:.4g} is {:.2g} of the chord {:.6g}: --first-height "
                                               "counts chords, or units of the input with the suffix u",
                                               height, share, chord)});
}

/// Says where the Reynolds number is that of no flow, or velocity and viscosity are in other units than the
/// coordinates.
void warn_of_reynolds(const MeshResult& result, const FlowConditions& conditions, std::vector<Warning>& warnings) {
    const std::string& unit = result.geometry.elements.front().unit;
    if (const auto doubt = doubt_of_reynolds(conditions, result.conditions, unit))
        warnings.push_back({.code = WarningCode::reynolds_implausible,
                            .number = *result.conditions.reynolds,
                            .unit = "Reynolds number",
                            .message = *doubt});
}

void warn_of_large_angles(const MeshResult& result, const WorstPlaces& worst, const Mesh& layer,
                          std::vector<Warning>& warnings) {
    constexpr double max_isotropic = 145;
    const auto exceeds = [](const QualitySummary& quality, double bound) {
        return quality.cells > 0 && quality.max_angle_deg > bound;
    };
    const auto warn = [&](const QualitySummary& quality, Point at, const std::string& where) {
        warnings.push_back({.code = WarningCode::large_angle,
                            .at = at,
                            .number = quality.max_angle_deg,
                            .unit = "degrees",
                            .message = fmt::format("a cell {} has an angle of {:.2f} degrees, at {}", where,
                                                   quality.max_angle_deg, place_text(at))});
    };
    if (exceeds(result.check.isotropic, max_isotropic)) warn(result.check.isotropic, worst.widest, "outside the layer");
    if (exceeds(result.check.layer, layers::largest_layer_angle_deg))
        warn(result.check.layer,
             worst_place(layer, Region::layer, [&](std::size_t cell) { return shape_of(layer, cell).max_angle_deg; }),
             "of the layer");
}

void warn_of_topology(const MeshResult& result, std::vector<Warning>& warnings) {
    if (!result.layer_grid_refused) return;
    warnings.push_back({.code = WarningCode::topology_not_as_asked,
                        .number = static_cast<double>(result.check.layer.cells),
                        .unit = "cells",
                        .message = "the layer has Delaunay triangles instead of rows, since its cells would cross each "
                                   "other (--layer-topology): thinner or fewer layers would fit"});
}

// ---- the isotropic region ----

void warn_of_refinement(const MeshResult& result, const WorstPlaces& worst, std::vector<Warning>& warnings) {
    const auto add = [&](WarningCode code, std::size_t count, const std::string& unit, Point at,
                         const std::string& message) {
        warnings.push_back({.code = code,
                            .at = at,
                            .number = static_cast<double>(count),
                            .unit = unit,
                            .message = fmt::format("{} (worst at {})", message, place_text(at))});
    };
    const auto angle_of = [](const mesh::NarrowTriangle& t) {
        return core::measure_triangle(t.corners[0], t.corners[1], t.corners[2]).min_angle_deg;
    };
    if (const std::span narrow = worst.unexcused; !narrow.empty()) {
        const mesh::NarrowTriangle& narrowest = *std::min_element(
            narrow.begin(), narrow.end(), [&](const auto& a, const auto& b) { return angle_of(a) < angle_of(b); });
        const Point* p = narrowest.corners;
        add(WarningCode::small_angle, narrow.size(), "triangles", (1.0 / 3) * (p[0] + p[1] + p[2]),
            fmt::format("{} below the bound of {} degrees, down to {:.2f}",
                        counted(narrow.size(), "triangle has an angle", "triangles have an angle"), worst.min_angle_deg,
                        angle_of(narrowest)));
    }
    if (const std::size_t refused = result.refinement.refused; refused > 0)
        add(WarningCode::refused_points, refused, "points", worst.narrowest,
            fmt::format("refinement left out {} too near to the layer's border or to a separator",
                        counted(refused, "point", "points")));
    if (const std::size_t oversized = result.refinement.oversized; oversized > 0)
        add(WarningCode::oversized_triangles, oversized, "triangles", worst.oversized,
            counted(oversized, "triangle is", "triangles are") + " larger than the sizes ask for");
}

// ---- the input ----

void warn_of_surfaces(const Geometry& geometry, const SurfaceOptions& options, std::vector<Warning>& warnings) {
    constexpr double max_ratio = 1.25;  // of the numbers of points made and asked for
    const bool asked = options.treatment == SurfaceTreatment::resample || options.points || options.smooth;
    for (const Element& element : geometry.elements) {
        const auto made = static_cast<double>(element.points.size());
        std::string reason;
        if (asked && element.surface_restored) reason = "new points would cross the outline";
        if (reason.empty() && options.points) {
            const auto wanted = static_cast<double>(*options.points);
            if (made > max_ratio * wanted || wanted > max_ratio * made)
                reason = fmt::format("about {} were asked for", *options.points);
        }
        if (reason.empty()) continue;
        warnings.push_back({.code = WarningCode::surface_not_as_asked,
                            .element = element.name,
                            .at = element.features.trailing_edge,
                            .number = made,
                            .unit = "points",
                            .message = fmt::format("{}: the wall has {} {} points, since {} (--surface)", element.name,
                                                   made, element.surface_restored ? "given" : "new", reason)});
    }
}

/// Adds what the reader found, with the name of the element.
void add_reader_warnings(const Geometry& geometry, std::vector<Warning>& warnings) {
    for (const Element& element : geometry.elements) {
        for (Warning warning : element.warnings) {
            warning.element = element.name;
            warning.message = element.name + ": " + warning.message;
            warnings.push_back(std::move(warning));
        }
    }
}

/// Warns of bases whose markers are not called NAME_base, since others have that name.
void warn_of_base_markers(const Geometry& geometry, std::vector<Warning>& warnings) {
    const std::vector<std::string> names = base_marker_names(geometry);
    for (std::size_t e = 0; e < names.size(); ++e) {
        const Element& element = geometry.elements[e];
        const std::string wanted = wanted_base_name(element);
        if (!element.features.base || names[e] == wanted) continue;
        Warning warning = core::renamed_marker_warning({wanted, MarkerKind::wall}, names[e]);
        warning.element = element.name;
        warning.message = fmt::format("{}: base: {}", element.name, warning.message);
        warnings.push_back(std::move(warning));
    }
}

}  // namespace

std::vector<Warning> warnings_of_input(const MeshResult& result, const SurfaceOptions& surface,
                                       const FlowConditions& conditions, const AssembleOptions& markers) {
    std::vector<Warning> warnings;
    add_reader_warnings(result.geometry, warnings);
    if (markers.base_marker) warn_of_base_markers(result.geometry, warnings);
    warn_of_surfaces(result.geometry, surface, warnings);
    warn_of_reynolds(result, conditions, warnings);
    return warnings;
}

std::vector<Warning> warnings_of_mesh(const MeshResult& result, const LayerOptions& options, const WorstPlaces& worst,
                                      const Mesh& layer) {
    std::vector<Warning> warnings;
    warn_of_first_height(result, options, warnings);
    warn_of_topology(result, warnings);
    warn_of_first_layer(result, layer, warnings);
    warn_of_bare_walls(result, warnings);
    warn_of_first_heights(result, warnings);
    warn_of_cut_rays(result, warnings);
    warn_of_thinned_layers(result, warnings);
    warn_of_transition(result, options, warnings);
    warn_of_areas(result, options, layer, warnings);
    warn_of_large_angles(result, worst, layer, warnings);
    warn_of_refinement(result, worst, warnings);
    return warnings;
}

}  // namespace lamina::pipeline
