// The outer boundary as inlet and outlet, ground and tunnel.
#include <algorithm>
#include <initializer_list>
#include <iterator>
#include <string_view>
#include <utility>

#include <lamina/error.hpp>
#include <lamina/pipeline.hpp>

#include "core/reproducible_math.hpp"
#include "pipeline/assemble.hpp"

namespace lamina::pipeline {

namespace {

/// Throws OptionError where a marker that is no far field has one of the names.
void require_free_names(std::span<const Marker> markers, std::initializer_list<std::string_view> names,
                        const char* option) {
    for (const Marker& marker : markers)
        if (marker.kind != MarkerKind::far_field && std::find(names.begin(), names.end(), marker.name) != names.end())
            throw OptionError(option, "an element has the name '" + marker.name + "' already: give --names");
}

}  // namespace

void split_far_field(std::span<const Point> points, std::vector<Marker>& markers, double alpha_deg) {
    require_free_names(markers, {"inlet", "outlet"}, "inlet_outlet");
    const double alpha = core::radians(alpha_deg);
    const Point flow{core::cos_reproducible(alpha), core::sin_reproducible(alpha)};
    // The mesh lies on the left of an edge, so a flow that enters crosses it from the right to the left.
    const auto enters = [&](const Segment& edge) {
        return cross(points[edge.b.index()] - points[edge.a.index()], flow) > 0;
    };
    Marker inlet{"inlet", MarkerKind::far_field, {}}, outlet{"outlet", MarkerKind::far_field, {}};
    for (const Marker& marker : markers)
        if (marker.kind == MarkerKind::far_field)
            std::partition_copy(marker.edges.begin(), marker.edges.end(), std::back_inserter(inlet.edges),
                                std::back_inserter(outlet.edges), enters);
    std::erase_if(markers, [](const Marker& marker) { return marker.kind == MarkerKind::far_field; });
    for (Marker* part : {&inlet, &outlet})
        if (!part->edges.empty()) markers.push_back(std::move(*part));
}

void mark_slip_walls(std::span<const Point> points, std::vector<Marker>& markers, const decoupling::FarField& far_field,
                     bool has_ground) {
    require_free_names(markers, {"ground", "tunnel"}, has_ground ? "ground" : "tunnel");
    Marker ground{"ground", MarkerKind::symmetry, {}}, tunnel{"tunnel", MarkerKind::symmetry, {}};
    // Edges of the floor have the very y of its corners, and so have those of the ceiling.
    const auto lies_on = [&](const Segment& edge, double y) {
        return points[edge.a.index()].y == y && points[edge.b.index()].y == y;
    };
    for (Marker& marker : markers) {
        if (marker.kind != MarkerKind::far_field) continue;
        std::erase_if(marker.edges, [&](const Segment& edge) {
            const bool on_floor = lies_on(edge, far_field.floor);
            if (!on_floor && !lies_on(edge, far_field.ceiling)) return false;
            (on_floor && has_ground ? ground : tunnel).edges.push_back(edge);
            return true;
        });
    }
    for (Marker* part : {&ground, &tunnel})
        if (!part->edges.empty()) markers.push_back(std::move(*part));
}

}  // namespace lamina::pipeline
