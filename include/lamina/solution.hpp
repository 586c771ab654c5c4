// Solutions of flow solvers: fields on a mesh, and files that hold them.
//
// Guarantees:
//  1. A field that was read has one finite value for each vertex, or one for each cell.
//  2. read_sizes() reads sizes back exactly.
// Example:
//     const SizedMesh sizes{{{0, 0}, {1, 0}, {0, 1}}, {{{VertexId{0u}, VertexId{1u}, VertexId{2u}}}}, {0.1, 0.2, 0.3}};
//     write_sizes(sizes, "sizes.vtu");
//     const Solution solution = read_solution("sizes.vtu", {"size"});
//     assert(solution.fields[0].values == sizes.sizes && read_sizes("sizes.vtu").sizes == sizes.sizes);
#pragma once

#include <filesystem>

#include <lamina/mesh.hpp>
#include <lamina/sizing.hpp>

namespace lamina {

/// A field of a solution: one number per vertex of a mesh, or one per cell.
struct SolutionField {
    std::string name;            ///< as it was asked for: "p", "U:x", "mag(U)"
    bool at_cells = false;       ///< whether there is one number per cell, those of triangles before those of quads
    std::vector<double> values;  ///< finite
};

/// Fields on a mesh.
struct Solution {
    Mesh mesh;                          ///< the mesh that the solver had
    std::vector<SolutionField> fields;  ///< those asked for, in the order of their names
};

/// Reads fields of a solution: a VTU file of triangles and quads with point data or cell data; or a time folder of an
/// OpenFOAM case with fields in ASCII or binary (volScalarField, volVectorField) on a mesh one cell thick, or the
/// folder of the case, of which the latest time is read; or a restart file of SU2 (.dat, .csv), whose vectors are those
/// with the components NAME_x and NAME_y; or a CGNS file with values at vertices, and vectors NAMEX and NAMEY. A name
/// is that of an array of one component; "NAME:x", "NAME:y" or "NAME:z", a component; or "mag(NAME)", the length of its
/// vectors. Point data come before cell data of the same name. `mesh` holds the mesh of the solution in any format that
/// can be read; empty: the VTU or CGNS file itself, constant/polyMesh beside the time folder, or mesh.su2 beside the
/// restart file. Throws IoError; UsageError where a field or component is missing; InputError where a file is malformed
/// or of another mesh, where numbers of values and of points or cells differ, and where a value is not finite.
LAMINA_EXPORT Solution read_solution(const std::filesystem::path& solution, const std::vector<std::string>& fields,
                                     const std::filesystem::path& mesh = {});
/// Returns the names with which read_solution() reads all point data and cell data of a VTU file, or all values at the
/// vertices of a CGNS file: "p", "U:x", "U:y". Arrays that lamina writes about a mesh are left out. Throws IoError and
/// InputError.
LAMINA_EXPORT std::vector<std::string> solution_fields(const std::filesystem::path& file);
/// Writes a solution as a VTU file of lamina. Fields that are named as the components of a vector, "U:x", "U:y" and
/// "U:z" in a row, become one array. Throws IoError.
LAMINA_EXPORT void write_solution(const Solution& solution, const std::filesystem::path& file);
/// Writes sizes as a VTU file: point data `size`, and the field data `lamina_size_gradation` where SizedMesh::gradation
/// is set. Throws IoError.
LAMINA_EXPORT void write_sizes(const SizedMesh& sizes, const std::filesystem::path& file);

}  // namespace lamina
