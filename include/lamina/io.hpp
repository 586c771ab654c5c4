// Meshes to and from files. The format follows from the extension unless it is named.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <lamina/export.hpp>
#include <lamina/mesh.hpp>
#include <lamina/sizing.hpp>

namespace lamina {

/// A format that meshes are written in, and most are read from.
struct MeshFormat {
    std::string name;                     ///< "msh22"
    std::vector<std::string> extensions;  ///< of its files, with the dot; each stands for the first format that has it
    std::string holds;                    ///< one line: what it is
    bool readable = false;                ///< by read_mesh
    bool quads = true;                    ///< holds quadrilaterals, too
};

/// All of them, in the order of the guide's table.
LAMINA_EXPORT std::vector<MeshFormat> mesh_formats();

struct WriteOptions {
    std::string format{};        ///< a name, or an extension without its dot; empty = by the extension of the file
    bool wall_distance = false;  ///< VTU: the distance to the nearest wall as point data
};

/// Writes to temporary names beside the target and renames, so that a failure leaves nothing half-written. Coordinates
/// are read back exactly. Throws IoError; UsageError for an unknown format or extension, and for marker names that the
/// format cannot hold.
LAMINA_EXPORT void write_mesh(const Mesh& mesh, const std::filesystem::path& file, const WriteOptions& options = {});

/// One line of CSV for each vertex of the walls, body by body in the order of the outline: marker, vertex (from 0), x,
/// y, arc length from the body's first vertex, unit normal into the flow (bisector at corners), and first height: that
/// of the lowest vertex, above the wall, of the cells on the edges beside it. 17 significant digits. Throws IoError.
LAMINA_EXPORT void write_wall_data(const Mesh& mesh, const std::filesystem::path& file);

/// By the extension of the file. Throws IoError where it cannot be read, InputError (with the line, for text formats)
/// where it is malformed, UsageError for an unknown extension.
LAMINA_EXPORT Mesh read_mesh(const std::filesystem::path& file);

/// A background mesh from a VTU file (point data) or an MSH file ($NodeData of one component): the sizes are the array
/// named `size`, or the only scalar one where none is. Quadrilaterals are cut in two; points of no triangle are left
/// out. Throws IoError, UsageError for another extension, InputError where the file is malformed, has no triangles or
/// no such array, or the size at a vertex is missing or not positive.
LAMINA_EXPORT SizedMesh read_sizes(const std::filesystem::path& file);

/// Throws UsageError now rather than after minutes of meshing if write_mesh knows no format of this name, IoError if
/// the folder does not exist or is not writable.
LAMINA_EXPORT void check_writable(const std::filesystem::path& file, const WriteOptions& options = {});

}  // namespace lamina
