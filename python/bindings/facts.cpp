#include "facts.hpp"

#include <string>

#include <nanobind/stl/array.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include "values.hpp"

namespace lamina::python {

namespace nb = nanobind;

namespace {

nb::dict seconds_of(const StageSeconds& seconds) {
    nb::dict result;
    result["flow"] = seconds.flow;
    result["geometry"] = seconds.geometry;
    result["layers"] = seconds.layers;
    result["decomposition"] = seconds.decomposition;
    result["layer_triangulation"] = seconds.layer_triangulation;
    result["sizing"] = seconds.sizing;
    result["decoupling"] = seconds.decoupling;
    result["refinement"] = seconds.refinement;
    result["assembly"] = seconds.assembly;
    result["check"] = seconds.check;
    result["total"] = seconds.total;
    return result;
}

nb::dict quality_of(const QualitySummary& quality) {
    nb::dict result;
    result["cells"] = quality.cells;
    result["min_angle"] = quality.min_angle_deg;
    result["max_angle"] = quality.max_angle_deg;
    result["mean_min_angle"] = quality.mean_min_angle_deg;
    result["mean_max_angle"] = quality.mean_max_angle_deg;
    result["mean_ratio"] = quality.mean_ratio;
    result["share_below_40"] = quality.share_below_40_deg;
    result["angles_below_bound"] = quality.angles_below_bound;
    result["exempt"] = quality.exempt;
    result["max_neighbour_area_ratio"] = quality.max_neighbour_area_ratio;
    result["max_neighbour_area_ratio_at"] = to_python(quality.max_neighbour_area_ratio_at);
    result["p999_neighbour_area_ratio"] = quality.p999_neighbour_area_ratio;
    result["max_aspect_ratio"] = quality.max_aspect_ratio;
    result["angle_histogram"] = quality.angle_histogram;
    return result;
}

nb::dict transition_of(const TransitionSummary& transition) {
    nb::dict result;
    result["edges"] = transition.edges;
    result["p01_area_ratio"] = transition.p01_area_ratio;
    result["median_area_ratio"] = transition.median_area_ratio;
    result["p99_area_ratio"] = transition.p99_area_ratio;
    result["p90_height_ratio"] = transition.p90_height_ratio;
    return result;
}

nb::dict walls_of(const WallSummary& walls) {
    nb::dict result;
    result["edges"] = walls.edges;
    result["max_ratio"] = walls.max_ratio;
    result["max_ratio_at"] = to_python(walls.max_ratio_at);
    result["uneven_vertices"] = walls.uneven_vertices;
    result["bare_edges"] = walls.bare_edges;
    result["first_cells"] = walls.first_cells;
    result["median_first_height"] = walls.median_first_height;
    result["share_of_kept_heights"] = walls.share_of_kept_heights;
    result["worst_first_height"] = walls.worst_first_height;
    result["worst_first_height_at"] = to_python(walls.worst_first_height_at);
    return result;
}

nb::dict curving_of(const MeshResult& result) {
    nb::dict facts;
    facts["order"] = result.curved.order;
    facts["wall_edges"] = result.curving.wall_edges;
    facts["curved_wall_edges"] = result.curving.curved_edges;
    facts["reduced_wall_edges"] = result.curving.reduced_edges;
    facts["reduced_distance"] = result.curving.reduced_distance;
    facts["wall_distance"] = result.curving.wall_distance;
    facts["min_scaled_jacobian"] = result.curved_check.min_scaled_jacobian;
    facts["p01_scaled_jacobian"] = result.curved_check.p01_scaled_jacobian;
    facts["straight_min_scaled_jacobian"] = result.curving.straight_min_scaled_jacobian;
    return facts;
}

}  // namespace

nb::list warnings_of(const std::vector<Warning>& warnings) {
    nb::list result;
    for (const Warning& warning : warnings) {
        nb::dict data;
        data["code"] = warning_name(warning.code);
        data["element"] = warning.element;
        data["at"] = to_python(warning.at);
        data["number"] = warning.number;
        data["unit"] = warning.unit;
        data["message"] = warning.message;
        result.append(data);
    }
    return result;
}

nb::dict facts_of(const Element& element) {
    nb::dict facts;
    facts["name"] = element.name;
    facts["source"] = element.file;
    facts["title"] = element.title;
    facts["format"] = element.format;
    facts["points_read"] = element.points_read;
    facts["repairs"] = element.repairs;
    facts["transformations"] = element.transformations;
    facts["surface_notes"] = element.surface_notes;
    facts["wall_vertices"] = element.points.size();
    facts["trailing_edge"] = to_python(element.features.trailing_edge);
    return facts;
}

nb::dict facts_of(const MeshResult& result) {
    nb::dict facts;
    facts["chord"] = result.conditions.chord;
    facts["alpha"] = result.conditions.alpha_deg;
    facts["reynolds"] = result.conditions.reynolds;
    facts["mach"] = result.conditions.mach;
    facts["threads"] = result.threads;
    nb::list elements;
    for (std::size_t e = 0; e < result.geometry.elements.size(); ++e) {
        nb::dict element = facts_of(result.geometry.elements[e]);
        element["first_height"] = e < result.first_heights.size() ? nb::cast(result.first_heights[e]) : nb::none();
        elements.append(element);
    }
    facts["elements"] = elements;
    if (result.curved.order > 1) facts["curved"] = curving_of(result);
    facts["thinned_rays"] = result.thinned_rays;
    facts["estimate"] = to_python(result.estimate);
    facts["seconds"] = seconds_of(result.seconds);
    return facts;
}

nb::dict check_of(const MeshCheck& check) {
    nb::list defects;
    for (const MeshDefect& defect : check.defects)
        defects.append(nb::make_tuple(defect.description, to_python(defect.at)));
    nb::dict result;
    result["defects"] = defects;
    result["defect_count"] = check.defect_count;
    result["area"] = check.area;
    result["euler_characteristic"] = check.euler_characteristic;
    result["boundary_loops"] = check.boundary_loops;
    result["layer"] = quality_of(check.layer);
    result["isotropic"] = quality_of(check.isotropic);
    result["transition"] = transition_of(check.transition);
    result["walls"] = walls_of(check.walls);
    result["interior_edges"] = check.interior_edges;
    result["delaunay_violations"] = check.delaunay_violations;
    result["edges_without_first_layer"] = check.edges_without_first_layer;
    return result;
}

}  // namespace lamina::python
