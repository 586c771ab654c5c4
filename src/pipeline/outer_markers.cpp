// The outer boundary as inlet and outlet, and its walls.
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

void add_outer_walls(std::span<const OuterWallFacts> walls, std::span<const std::vector<Segment>> edges,
                     std::vector<Marker>& markers) {
    for (const OuterWallFacts& wall : walls) require_free_names(markers, {wall.name}, wall.option);
    for (std::size_t k = 0; k < walls.size(); ++k)
        markers.push_back(
            {walls[k].name, walls[k].kind == OuterWallKind::slip ? MarkerKind::symmetry : MarkerKind::wall, edges[k]});
}

void add_row(std::span<const Marker> row, std::vector<Marker>& markers) {
    for (const Marker& marker : row) require_free_names(markers, {marker.name}, "periodic");
    std::erase_if(markers, [](const Marker& marker) { return marker.kind == MarkerKind::far_field; });
    markers.insert(markers.end(), row.begin(), row.end());
}

}  // namespace lamina::pipeline
