// Sizes at the vertices of a mesh, as the readers of formats find them.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <lamina/mesh.hpp>
#include <lamina/sizing.hpp>

namespace lamina::io {

/// A mesh and a number at each point; NaN where the file has none.
struct PointValues {
    Mesh mesh;
    std::vector<double> values;
    std::optional<double> gradation{};  ///< SizedMesh::gradation
    std::vector<SizedWall> walls{};     ///< SizedMesh::walls
};

/// The field data of VTU files that hold it.
inline constexpr const char* gradation_array = "FieldData/lamina_size_gradation";

/// The names of the field data of SizedMesh::walls in VTU files: the number of points of each, and for each point its
/// coordinates, spacing, unit and thickness.
inline constexpr const char *wall_sizes_array = "lamina_wall_points", *wall_rows_array = "lamina_wall_rows";
inline constexpr std::size_t numbers_of_wall_row = 5;

/// Returns the name of the array that holds the sizes: `size`, or else the only scalar array. Throws InputError where
/// there is neither.
std::string size_array(const std::vector<std::string>& scalar_arrays, const std::filesystem::path& file);

/// Reads a mesh and its sizes. `reader` has two members, called in this order: read() returns the mesh, sizes() returns
/// the sizes.
template <class Reader>
PointValues read_point_values(Reader reader) {
    PointValues result;
    result.mesh = reader.read();
    result.values = reader.sizes();
    return result;
}

}  // namespace lamina::io
