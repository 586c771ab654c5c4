// The far field as inlet and outlet.
#include <algorithm>
#include <iterator>
#include <utility>

#include <lamina/error.hpp>
#include <lamina/pipeline.hpp>

#include "core/reproducible_math.hpp"

namespace lamina {

void split_far_field(Mesh& mesh, double alpha_deg) {
    for (const Marker& marker : mesh.markers)
        if (marker.kind != MarkerKind::far_field && (marker.name == "inlet" || marker.name == "outlet"))
            throw OptionError("inlet_outlet", "an element has the name '" + marker.name + "' already: give --names");
    const double alpha = core::radians(alpha_deg);
    const Point flow{core::cos_reproducible(alpha), core::sin_reproducible(alpha)};
    // The mesh lies on the left of an edge, so a flow that enters crosses it from the right to the left.
    const auto enters = [&](const Segment& edge) {
        return cross(mesh.points[edge.b.index()] - mesh.points[edge.a.index()], flow) > 0;
    };
    Marker inlet{"inlet", MarkerKind::far_field, {}}, outlet{"outlet", MarkerKind::far_field, {}};
    for (const Marker& marker : mesh.markers)
        if (marker.kind == MarkerKind::far_field)
            std::partition_copy(marker.edges.begin(), marker.edges.end(), std::back_inserter(inlet.edges),
                                std::back_inserter(outlet.edges), enters);
    std::erase_if(mesh.markers, [](const Marker& marker) { return marker.kind == MarkerKind::far_field; });
    for (Marker* part : {&inlet, &outlet})
        if (!part->edges.empty()) mesh.markers.push_back(std::move(*part));
}

}  // namespace lamina
