// The flow at the vertices as SU2 writes it to go on with: restart_flow.dat, or restart_flow.csv. Source: the functions
// of SU2 8 that write and read them (CSU2BinaryFileWriter, CSU2FileWriter, CSolver::Read_SU2_Restart_Binary).
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include <lamina/solution.hpp>

#include "io/field_request.hpp"

namespace lamina::io {

/// All fields of a file. The first two are the coordinates x and y.
struct Su2Restart {
    std::vector<std::string> names;
    std::vector<std::vector<double>> values;  ///< per name: one finite number for each vertex
};

/// Reads a file in SU2's binary format, or in its ASCII format where the name ends with .csv. Throws IoError, and
/// InputError where the file is damaged or a number is not finite.
LAMINA_EXPORT Su2Restart read_su2_restart(const std::filesystem::path& file);
/// Writes it in binary.
LAMINA_EXPORT void write_su2_restart(const Su2Restart& restart, const std::filesystem::path& file);
/// Returns a mesh and all fields but the coordinates, on its vertices. Throws InputError where these are not those of
/// the file.
LAMINA_EXPORT Solution with_mesh(Su2Restart restart, Mesh mesh, const std::filesystem::path& file);
/// Reads some fields; vectors are those whose components end with _x and _y. The mesh is mesh.su2 beside the file where
/// none is given.
Solution read_su2_solution(const std::filesystem::path& file, std::span<const FieldRequest> fields,
                           const std::filesystem::path& mesh);

}  // namespace lamina::io
