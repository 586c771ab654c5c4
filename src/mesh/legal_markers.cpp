// Markers of meshes from elsewhere get names that every format takes.
#include <lamina/mesh.hpp>

#include "core/marker_names.hpp"

namespace lamina {

std::vector<Warning> make_marker_names_legal(std::span<Marker> markers) {
    std::vector<core::NamedMarker> given;
    for (const Marker& marker : markers) given.push_back({marker.name, marker.kind});
    const std::vector<std::string> names = core::legal_marker_names(given);
    std::vector<Warning> warnings;
    for (std::size_t i = 0; i < markers.size(); ++i) {
        if (names[i] == given[i].name) continue;
        markers[i].name = names[i];
        warnings.push_back(core::renamed_marker_warning(given[i], names[i]));
    }
    return warnings;
}

}  // namespace lamina
