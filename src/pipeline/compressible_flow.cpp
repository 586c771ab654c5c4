// Compressible flow on a coarse mesh of its own.
#include <lamina/compressible_flow.hpp>

#include <algorithm>
#include <cstddef>
#include <vector>

#include <lamina/error.hpp>
#include <lamina/pipeline.hpp>
#include <lamina/threads.hpp>

#include "flow/boundary_layer.hpp"
#include "flow/euler/euler.hpp"
#include "flow/euler/wall_flow.hpp"
#include "flow/potential.hpp"
#include "geometry/sheets.hpp"
#include "pipeline/shock_sizes.hpp"

namespace lamina::pipeline {

namespace {

using flow::euler::EulerMesh;
using flow::euler::EulerOptions;
using flow::euler::EulerSolution;
using flow::euler::EulerWall;

/// Returns the options of a mesh for flow of this Mach number, without layers.
CaseOptions options_of_mesh(const FlowConditions& conditions) {
    // A vortex stands for the lift at the far field below Mach 1 alone. Bow shocks of thick sections are some chords
    // away at Mach 1.2.
    constexpr double far = 50, far_supersonic = 15, clearly_supersonic = 1.2;
    CaseOptions options;
    options.conditions = {.alpha_deg = conditions.alpha_deg, .chord = conditions.chord};
    options.layer.enabled = false;
    options.surface.max_spacing = 0.008;
    options.sizing.gradation = 0.16;
    options.far_field.size = *conditions.mach < clearly_supersonic ? far : far_supersonic;
    options.threads = thread_count();
    return options;
}

/// Returns the wall of an element. Precondition: its marker's edges are one loop.
EulerWall wall_of(const Element& element, const Marker& marker, const Mesh& mesh) {
    std::vector<VertexId> before(mesh.points.size());
    for (const Segment& edge : marker.edges) before[edge.b.index()] = edge.a;  // the mesh is on their left
    const auto vertex_at = [&](Point p) {
        const auto nearer = [&](const Segment& a, const Segment& b) {
            return squared_length(mesh.points[a.a.index()] - p) < squared_length(mesh.points[b.a.index()] - p);
        };
        return std::min_element(marker.edges.begin(), marker.edges.end(), nearer)->a;
    };
    const OutlineFeatures& features = element.features;
    const VertexId first = vertex_at(features.base ? element.points[features.base->last] : features.trailing_edge);
    EulerWall wall;
    VertexId v = first;
    do {
        wall.outline.push_back(v);
        v = before[v.index()];
    } while (v != first);
    wall.sides_end = wall.outline.size();
    if (features.base) {
        const VertexId lower = vertex_at(element.points[features.base->first]);
        wall.sides_end =
            static_cast<std::size_t>(std::find(wall.outline.begin(), wall.outline.end(), lower) - wall.outline.begin());
    }
    return wall;
}

/// Returns the mesh as the solver takes it. It refers to `made`.
EulerMesh euler_mesh(const MeshResult& made) {
    EulerMesh mesh{made.mesh.points, made.mesh.triangles, {}, {}};
    for (const Element& element : made.geometry.elements)
        for (const Marker& marker : made.mesh.markers)
            if (marker.name == element.name) mesh.walls.push_back(wall_of(element, marker, made.mesh));
    for (const Marker& marker : made.mesh.markers)
        if (marker.kind == MarkerKind::far_field) mesh.far_field = marker.edges;
    return mesh;
}

/// Puts the drag together where there are boundary layers.
void add_drag(const EulerSolution& solution, CompressibleFlow& found) {
    found.viscous_drag = flow::euler::viscous_drag(solution);
    for (const CompressibleElement& element : found.elements)
        for (const CompressibleSide* side : {&element.upper, &element.lower})
            for (const WallShock& shock : side->shocks) found.wave_drag += wave_drag(found, shock);
    found.drag = found.viscous_drag + found.wave_drag;
}

CompressibleFlow flow_of(const MeshResult& made, const EulerMesh& mesh, const EulerSolution& solution,
                         const EulerOptions& options) {
    CompressibleFlow flow;
    flow.mach = options.mach;
    flow.alpha_deg = options.alpha_deg;
    flow.chord = options.chord;
    flow.lift = solution.lift;
    flow.drag = solution.drag;
    flow.critical_pressure_coefficient = critical_pressure_coefficient(options.mach);
    flow.elements = wall_flows(mesh, solution, options);
    flow.has_layers = !solution.layers.empty();
    flow.iterations = solution.iterations;
    flow.residual = solution.residual;
    flow.converged = solution.converged;
    for (std::size_t e = 0; e < flow.elements.size(); ++e) {
        CompressibleElement& element = flow.elements[e];
        element.name = made.geometry.elements[e].name;
        for (const CompressibleSide* side : {&element.upper, &element.lower})
            for (const CompressibleWallPoint& point : side->points)
                flow.largest_mach = std::max(flow.largest_mach, point.mach);
    }
    for (std::size_t v = 0; v < solution.pressures.size(); ++v) {
        flow.mach_numbers.push_back(mach_at(solution, v));
        flow.pressures.push_back(1.4 * solution.pressures[v]);
    }
    flow.velocities = solution.velocities;
    flow.points = made.mesh.points;
    flow.triangles = made.mesh.triangles;
    for (CompressibleElement& element : flow.elements)
        for (CompressibleSide* side : {&element.upper, &element.lower})
            for (WallShock& shock : side->shocks) shock.front = trace_front(flow, *side, shock);
    if (flow.has_layers) add_drag(solution, flow);
    return flow;
}

}  // namespace

}  // namespace lamina::pipeline

namespace lamina {

using namespace pipeline;

bool is_beyond_critical(const Flow& flow, const FlowConditions& conditions) {
    // Flow that is faster than sound along fewer chords, as at peaks beside lips and noses, counts as subsonic.
    constexpr double longest_peak = 0.05;
    if (!conditions.mach) return false;
    return *conditions.mach >= 1 || flow::supersonic_length(flow, *conditions.mach) > longest_peak;
}

CompressibleFlow solve_compressible_flow(const Geometry& geometry, const FlowConditions& conditions) {
    validate(conditions);
    if (!conditions.mach) throw OptionError("mach", "a compressible flow needs it");
    const ReferenceConditions reference = reference_conditions(conditions, geometry);
    Geometry whole = geometry::with_thickness(geometry);
    whole.symmetry.reset();
    for (Element& element : whole.elements) {
        element.is_mirrored = false;  // both halves are in the domain
        element.parts.clear();        // one marker each
    }
    const MeshResult made = generate_mesh(whole, options_of_mesh(conditions));
    const EulerMesh mesh = euler_mesh(made);
    // Layers hardly move the shocks of supersonic flow.
    const bool has_layers = *conditions.mach < 1 && !flow::is_laminar(reference);
    const EulerOptions options{.mach = *conditions.mach,
                               .alpha_deg = reference.alpha_deg,
                               .chord = reference.chord,
                               .reynolds = has_layers ? reference.reynolds : std::nullopt};
    const EulerSolution solution = solve_euler(mesh, options);
    return flow_of(made, mesh, solution, options);
}

}  // namespace lamina
