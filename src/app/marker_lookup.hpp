// Markers of a mesh that was read, by the names that a user gives.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include <lamina/mesh.hpp>

namespace lamina::app {

/// Returns the marker of this name, or else the one with the legal name that lamina gives a marker of this kind in its
/// place (marker_names.hpp): in the file of a mesh, the wall "0012" is called "wall_0012". Null where there is neither.
inline Marker* find_marker(std::vector<Marker>& markers, const std::string& name, MarkerKind kind) {
    for (const std::string& candidate : {name, legal_marker_name(name, kind)}) {
        const auto marker =
            std::find_if(markers.begin(), markers.end(), [&](const Marker& known) { return known.name == candidate; });
        if (marker != markers.end()) return &*marker;
    }
    return nullptr;
}

}  // namespace lamina::app
