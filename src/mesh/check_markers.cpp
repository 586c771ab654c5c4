#include "mesh/check_markers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <utility>

#include "mesh/cell_text.hpp"
#include "mesh/periodic.hpp"

namespace lamina::mesh {

void check_markers(std::span<const Point> points, std::span<const Marker> markers, const std::vector<Segment>& boundary,
                   DefectList& defects) {
    std::vector<std::uint8_t> marked(boundary.size(), 0);
    const auto report = [&](const Segment& edge, const std::string& description) {
        defects.add([&] { return MeshDefect{description, points[edge.a.index()]}; });
    };
    for (const Marker& marker : markers) {
        const auto is_earlier_namesake = [&](const Marker& other) {
            return &other < &marker && other.name == marker.name;
        };
        if (std::any_of(markers.begin(), markers.end(), is_earlier_namesake))
            defects.add([&] { return MeshDefect{fmt::format("two markers are named '{}'", marker.name), {}}; });
        for (const Segment& edge : marker.edges) {
            const auto found = std::lower_bound(boundary.begin(), boundary.end(), edge);
            if (found == boundary.end() || *found != edge) {
                const bool reversed = std::binary_search(boundary.begin(), boundary.end(), Segment{edge.b, edge.a});
                report(edge, fmt::format("edge {} of marker '{}' {}", edge_text(edge), marker.name,
                                         reversed ? "has the mesh on its right" : "is not on the boundary"));
            } else if (std::exchange(marked[static_cast<std::size_t>(found - boundary.begin())], 1)) {
                report(edge,
                       fmt::format("boundary edge {} is marked twice, once as '{}'", edge_text(edge), marker.name));
            }
        }
    }
    for (std::size_t i = 0; i < boundary.size(); ++i)
        if (!marked[i]) report(boundary[i], fmt::format("boundary edge {} is in no marker", edge_text(boundary[i])));
    std::optional<PeriodicMismatch> mismatch;
    find_periodic_pair(points, markers, mismatch);
    if (mismatch) defects.add([&] { return MeshDefect{mismatch->reason, mismatch->at}; });
}

}  // namespace lamina::mesh
