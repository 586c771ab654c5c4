// One run of `lamina check`: whether the mesh of a file is valid, and has what the user requires of it.
#pragma once

#include <string>
#include <vector>

#include <lamina/limits.hpp>
#include <lamina/mesh.hpp>

namespace lamina::app {

struct CheckSettings {
    std::string mesh;                ///< the file
    std::string format;              ///< of the mesh; empty: by the name of the file
    std::vector<std::string> walls;  ///< markers that are required, and count as walls
    std::string far_field;           ///< marker that is required, and counts as the far field; empty: none
    MeshCheckOptions options{};      ///< without max_memory_bytes, which follows from the limits
    bool require_angles = false;     ///< whether angles below the bound of the options are a shortcoming
    bool require_delaunay = false;   ///< whether edges that are not Delaunay are one
    WorkLimits limits{};             ///< of which the memory counts
    bool json = false;               ///< whether the result is printed as JSON
};

/// Checks the mesh and prints the result. Throws MeshError where the mesh is not valid or lacks what is required, and
/// the errors of readers.
void run_check(const CheckSettings& settings);

}  // namespace lamina::app
