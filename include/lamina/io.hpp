// Stage "write": meshes to and from files. The format follows from the extension of the file unless it is named. The
// file "-" is standard input or standard output, whose format must be named (files.hpp).
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <lamina/export.hpp>
#include <lamina/mesh.hpp>
#include <lamina/mesh_sink.hpp>
#include <lamina/ranks.hpp>
#include <lamina/sizing.hpp>

namespace lamina {

/// A format that meshes are written in. Most formats can also be read.
struct MeshFormat {
    std::string name;  ///< "msh22"
    /// The extensions of its files, with the dot, or the name of its folder ("polyMesh"). Where several formats share
    /// an extension, it stands for the first of them.
    std::vector<std::string> extensions;
    std::string description;  ///< one line
    bool readable = false;    ///< whether read_mesh() reads it
    bool quads = true;        ///< whether it holds quadrilaterals, too
    bool one_stream = false;  ///< whether it is one stream of bytes, which a pipe can carry
};

/// Returns all formats of this build, in the order of the guide's table.
LAMINA_EXPORT std::vector<MeshFormat> mesh_formats();

/// The thickness of OpenFOAM's meshes, which are one cell thick, in units of the mesh.
inline constexpr double openfoam_span = 1;

/// The largest number of parts that write_mesh() divides a mesh into.
inline constexpr std::size_t max_parts = 65'536;

/// Options of write_mesh().
struct WriteOptions {
    std::string format{};        ///< a name, or an extension without its dot; empty: by the extension of the file
    bool wall_distance = false;  ///< writes the distance to the nearest wall as point data, in VTU files
    /// Number of parts of PVTU files. More than one make OpenFOAM's cellDecomposition beside polyMesh, too.
    std::size_t parts = 1;
};

/// Writes a mesh. Files get temporary names beside the target and are renamed, so that a failure leaves nothing
/// half-written. Coordinates are read back exactly. Throws IoError; UsageError for an unknown format or extension, and
/// for marker names that the format cannot hold; MeshError for a mesh that the format cannot hold.
LAMINA_EXPORT void write_mesh(const MeshView& mesh, const std::filesystem::path& file,
                              const WriteOptions& options = {});

/// Writes a table of the walls as CSV: one line for each wall vertex, body by body in the order of the outline.
/// Columns: marker, vertex (from 0), x, y, arc length from the body's first vertex, unit normal into the flow (the
/// bisector at corners), and first height: the height above the wall of the lowest vertex of the cells on the two edges
/// beside the wall vertex. Numbers have 17 significant digits. Throws IoError.
LAMINA_EXPORT void write_wall_data(const Mesh& mesh, const std::filesystem::path& file);

/// Options of read_mesh().
struct ReadOptions {
    std::string format{};  ///< a name, or an extension without its dot; empty: by the extension of the file
};

/// Reads a mesh. Throws IoError where the file cannot be read, InputError (with the line, for text formats) where it is
/// malformed, UsageError for an unknown format or extension.
LAMINA_EXPORT Mesh read_mesh(const std::filesystem::path& file, const ReadOptions& options = {});

/// Reads a background mesh from a VTU file (point data) or an MSH file ($NodeData of one component). The sizes are the
/// array named `size`; a file without one must have a single scalar array. Quadrilaterals are cut in two; points of no
/// triangle are left out. Throws IoError; UsageError for another extension; InputError where the file is malformed,
/// where it has no triangles or no size array, and where the size at a vertex is missing or not positive.
LAMINA_EXPORT SizedMesh read_sizes(const std::filesystem::path& file);

/// Throws what write_mesh() would throw for the name of the file and the format, so that a wrong name is found before
/// minutes of meshing: UsageError for an unknown format and for one that standard output cannot carry, IoError where
/// the folder does not exist or is not writable.
LAMINA_EXPORT void check_writable(const std::filesystem::path& file, const WriteOptions& options = {});

/// Opens a sink that writes the same bytes as write_mesh() does, part by part. A sink for /dev/null counts the bytes
/// alone. Throws UsageError for formats that are written as a whole, and what check_writable() throws.
LAMINA_EXPORT std::unique_ptr<MeshSink> open_mesh_sink(const std::filesystem::path& file,
                                                       const WriteOptions& options = {});

/// Collective: writes one file from the parts of a mesh that several processes hold, with the bytes of write_mesh(). Nothing
/// appears under its name before all have written their parts. /dev/null takes no bytes. A PVTU file has one part or more
/// for each process, with the cells that this one holds. Throws what open_mesh_sink()
/// throws, UsageError for standard output and for devices, IoError where a process cannot write, which must then call
/// Ranks::fail(), and RankFailure where another has failed.
LAMINA_EXPORT void write_shared_mesh(const MeshParts& parts, const MeshFrame& frame, Ranks& ranks,
                                     const std::filesystem::path& file, const WriteOptions& options = {});

/// Throws UsageError for formats that open_mesh_sink() refuses, without opening anything.
LAMINA_EXPORT void require_streamable(const std::filesystem::path& file, const WriteOptions& options = {});

/// Returns whether WriteOptions::parts counts for this file.
LAMINA_EXPORT bool takes_parts(const std::filesystem::path& file, const WriteOptions& options = {});

/// Throws UsageError for formats that write_shared_mesh() refuses, without opening anything.
LAMINA_EXPORT void require_shareable(const std::filesystem::path& file, const WriteOptions& options = {});

/// Returns the name of the format that write_mesh() writes the file in; empty where there is no such format.
LAMINA_EXPORT std::string format_name(const std::filesystem::path& file, const WriteOptions& options = {});

/// Returns the files that write_mesh() creates or replaces: one, several, or the folder of a format that is a folder.
/// Throws UsageError for an unknown format.
LAMINA_EXPORT std::vector<std::filesystem::path> output_files(const std::filesystem::path& file,
                                                              const WriteOptions& options = {});

}  // namespace lamina
