// The table of mesh formats, and the functions that read and write each format. A new format needs its functions here
// and a row in format_table.cpp; everything else reads the table.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <ostream>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <lamina/io.hpp>
#include <lamina/mesh.hpp>
#include <lamina/mesh_sink.hpp>
#include <lamina/solution.hpp>

#include "core/connected_ranks.hpp"
#include "io/extrusion.hpp"
#include "io/field_request.hpp"
#include "io/mesh_layout.hpp"
#include "io/sizes.hpp"
#include "mesh/shared_parts.hpp"

namespace lamina::io {

struct MeshArrays;

/// A row of the table of formats.
struct FormatRow {
    const char* name = nullptr;
    /// Endings of file names, compared without regard to case. The longest one that fits a file decides; where several
    /// formats have it, the first of the table does.
    std::vector<std::string> extensions{};
    const char* description = nullptr;  ///< one line for help and guide
    /// Writes all files of the mesh, whole or not at all. Throws IoError; UsageError and MeshError for what the format
    /// cannot hold.
    void (*write)(const MeshView&, const std::filesystem::path&, const WriteOptions&) = nullptr;
    /// Returns the files that `write` creates or replaces, or the one folder where the format is a folder.
    std::vector<std::filesystem::path> (*files)(const std::filesystem::path&, const WriteOptions&) = nullptr;
    /// Throws IoError where the mesh certainly cannot be written. Null: it can where each of its files can.
    void (*check)(const std::filesystem::path&) = nullptr;
    /// Writes a mesh with curved cells, internal markers included, as `write` does. Null: the format holds straight
    /// cells.
    void (*write_curved)(const MeshView&, const CurvedNodes&, const std::filesystem::path&,
                         const WriteOptions&) = nullptr;
    /// Reads a mesh whose cells may be curved. Null: the format is read with straight cells.
    CurvedMesh (*read_curved)(const std::filesystem::path&) = nullptr;
    /// Reads a mesh. Throws IoError, InputError. Null: the format is not read.
    Mesh (*read)(const std::filesystem::path&) = nullptr;
    /// Reads the same mesh into arrays that may lie in files, in constant memory beside the markers where the variant
    /// of the format allows it. Null: meshes are read as a whole.
    void (*read_stored)(const std::filesystem::path&, MeshArrays&) = nullptr;
    /// Reads a mesh and its sizes from the bytes of a file. Throws InputError. Null: the format holds no sizes.
    PointValues (*read_sizes)(const std::string& bytes, const std::filesystem::path&) = nullptr;
    /// Returns whether the path holds a mesh of this format, whatever its name. Null: the name alone decides.
    bool (*recognizes)(const std::filesystem::path&) = nullptr;
    /// Returns how the file is written part by part. Null: the format is written as a whole.
    std::unique_ptr<MeshLayout> (*layout)(const std::filesystem::path&) = nullptr;
    /// Collective: writes what each process holds. Null: as `layout` says.
    void (*write_shared)(const mesh::MeshParts&, const MeshFrame&, core::ConnectedRanks&,
                         const std::filesystem::path&) = nullptr;
    bool takes_parts = false;       ///< whether WriteOptions::parts counts
    bool takes_span = false;        ///< whether WriteOptions::span counts
    bool quads = true;              ///< whether the format holds quadrilaterals, too
    bool one_stream = false;        ///< whether standard input and standard output can carry it
    bool internal_markers = false;  ///< whether `write` is given internal markers, too, because the format holds them
    bool gauss_lobatto = false;     ///< whether `write_curved` takes nodes of this distribution
};

/// Returns the formats of this build. --format, the help text, the guide's table and the choice by extension follow it.
const std::vector<FormatRow>& format_table();

/// Returns the format of this name, or with this extension (without its dot); where no name is given, the format that
/// the file's name stands for. Throws UsageError where there is none, and where the file is "-" and the format is not
/// one stream.
const FormatRow& find_format(const std::filesystem::path& file, const std::string& name = {});

/// Returns the format that a file is read in: the one of this name, or else one that recognizes the file, or else the
/// one that its name stands for. Throws UsageError where there is none, or where it is only written.
const FormatRow& format_to_read(const std::filesystem::path& file, const std::string& name = {});

// --- The functions of the formats
//
// Writers of a single file write its contents to `out`; other writers see to their files themselves. Most readers take
// the whole file as bytes, and its name for messages. They return meshes with all indices in range and finite points,
// and throw InputError; check_mesh() judges the rest.

/// Throws UsageError where the format cannot hold the names.
void require_su2_marker_names(std::span<const Marker> markers, const std::filesystem::path& file);
void write_su2(const MeshView& mesh, const std::filesystem::path& file, std::ostream& out);
Mesh read_su2(const std::string& bytes, const std::filesystem::path& file);
void read_su2_arrays(const std::filesystem::path& file, MeshArrays& arrays);

struct VtuVariant {
    bool compressed = false;     ///< by zlib
    bool wall_distance = false;  ///< written as point data
};
void write_vtu(const MeshView& mesh, VtuVariant variant, std::ostream& out);
/// Writes curved cells as Lagrange cells.
void write_curved_vtu(const MeshView& mesh, const CurvedNodes& nodes, bool compressed, std::ostream& out);
/// Writes a mesh in space.
void write_vtu_extruded(const MeshView& mesh, const Extrusion& extrusion, bool compressed, std::ostream& out);
/// Reads a mesh with straight cells.
Mesh read_vtu(const std::string& bytes, const std::filesystem::path& file);
/// Reads a mesh with cells of one order.
CurvedMesh read_curved_vtu(const std::string& bytes, const std::filesystem::path& file);
void read_vtu_arrays(const std::filesystem::path& file, MeshArrays& arrays);
/// Reads the mesh and these fields.
Solution read_vtu_solution(const std::string& bytes, const std::filesystem::path& file,
                           std::span<const FieldRequest> fields);
/// Returns solution_fields().
std::vector<std::string> vtu_fields(const std::string& bytes, const std::filesystem::path& file);
/// Writes the mesh and all fields.
void write_vtu_solution(const Solution& solution, std::ostream& out);
/// Writes a part of a mesh, with the numbers of its vertices in the mesh.
void write_vtu_part(const MeshView& part, std::span<const VertexId> vertices, std::ostream& out);
/// Returns the list and the files of the parts.
std::vector<std::filesystem::path> pvtu_files(const std::filesystem::path& file, std::size_t parts);
void write_pvtu(const MeshView& mesh, const std::filesystem::path& file, std::size_t parts);
/// Collective: writes the parts that each process holds. Throws what write_shared_mesh() throws.
void write_shared_pvtu(const mesh::MeshParts& parts, const MeshFrame& frame, core::ConnectedRanks& ranks,
                       const std::filesystem::path& file);
/// Writes sizes as point data.
void write_vtu_sizes(const SizedMesh& sizes, std::ostream& out);
/// Reads the mesh and the array of point data that size_array() names.
PointValues read_vtu_sizes(const std::string& bytes, const std::filesystem::path& file);

struct MshVariant {
    bool version_4 = true;  ///< 4.1, else 2.2
    bool binary = false;
};
/// Writes a mesh with straight cells, whose nodes are none, or with curved ones.
void write_msh(const MeshView& mesh, const CurvedNodes& nodes, const std::filesystem::path& file, MshVariant variant,
               std::ostream& out);
/// Writes a mesh with straight or curved cells in the format of MFEM.
void write_mfem(const MeshView& mesh, const CurvedNodes& nodes, const std::filesystem::path& file, std::ostream& out);
/// Writes a mesh with straight or curved cells in the format of Nektar++.
void write_nektar(const MeshView& mesh, const CurvedNodes& nodes, const std::filesystem::path& file, std::ostream& out);
/// Reads a plane mesh of Nektar++ that is not compressed, with curves of one order.
CurvedMesh read_curved_nektar(const std::string& bytes, const std::filesystem::path& file);
/// Reads a mesh with straight cells.
Mesh read_nektar(const std::string& bytes, const std::filesystem::path& file);
/// Writes version 2.2, ASCII, in space.
void write_msh_extruded(const MeshView& mesh, const std::filesystem::path& file, const Extrusion& extrusion,
                        std::ostream& out);
/// Reads either version, ASCII or binary, with cells of one order.
CurvedMesh read_curved_msh(const std::string& bytes, const std::filesystem::path& file);
/// Reads a mesh with straight cells.
Mesh read_msh(const std::string& bytes, const std::filesystem::path& file);
/// Reads the mesh and the $NodeData that size_array() names.
PointValues read_msh_sizes(const std::string& bytes, const std::filesystem::path& file);

struct CgnsVariant {
    bool adf = false;                      ///< writes the older container in place of HDF5
    bool three_coordinates = false;        ///< writes CoordinateZ = 0, for readers that accept no plane meshes
    const Extrusion* extrusion = nullptr;  ///< writes a mesh in space; null: a plane one
};
/// Writes a mesh with straight cells, whose nodes are none, or a plane one with curved ones.
void write_cgns(const MeshView& mesh, const CurvedNodes& nodes, const std::filesystem::path& file, CgnsVariant variant);
/// Reads a mesh with straight cells.
Mesh read_cgns(const std::filesystem::path& file);
/// Reads a mesh with cells of one order.
CurvedMesh read_curved_cgns(const std::filesystem::path& file);
/// Reads the mesh and fields at its vertices.
Solution read_cgns_solution(const std::filesystem::path& file, std::span<const FieldRequest> fields);
/// Returns the names of all arrays at the vertices.
std::vector<std::string> cgns_fields(const std::filesystem::path& file);

/// Writes ASCII, or binary.
void write_fluent(const MeshView& mesh, const std::filesystem::path& file, bool binary, std::ostream& out);
/// Reads either.
Mesh read_fluent(const std::string& bytes, const std::filesystem::path& file);
/// Returns whether a file is Fluent's although its extension, .msh, stands for Gmsh's.
bool holds_fluent_mesh(const std::filesystem::path& file);

/// The patch for the two sides of meshes that are one cell thick.
inline constexpr const char* front_and_back = "frontAndBack";
/// The marker of kind symmetry that lies on the axis y = 0 of an axisymmetric flow.
inline constexpr std::string_view axis_name = "axis";
/// Returns whether a marker, or a part of a boundary, lies on the axis of a body of revolution.
bool is_axis(const auto& marker) { return marker.kind == MarkerKind::symmetry && marker.name == axis_name; }
void check_openfoam_writable(const std::filesystem::path& file);
/// Writes the folder and, for more than one part, the file of the parts beside it.
void write_openfoam(const MeshView& mesh, const std::filesystem::path& file, const Extrusion& extrusion,
                    std::size_t parts);
/// Returns the file beside the folder that says which part a cell belongs to, for decomposePar with the method
/// `manual`.
std::filesystem::path openfoam_parts_file(const std::filesystem::path& file);
/// Writes the places of all vertices into the folder of a time: as points, and as the field `displacement` from their
/// places in the mesh.
void write_openfoam_time(const MeshView& reference, std::span<const Point> points, const std::filesystem::path& folder);
/// Returns the names of both files.
std::vector<std::filesystem::path> openfoam_time_files(const std::filesystem::path& folder);
Mesh read_openfoam(const std::filesystem::path& file);
/// A mesh, and the number of each of its cells in the files it was read from: triangles, then quads. Where the files
/// hold several cells across the span, these are the lowest ones.
struct NumberedCells {
    Mesh mesh;
    std::vector<std::uint32_t> numbers;
    std::size_t cells_in_files = 0;
};
LAMINA_EXPORT NumberedCells read_numbered_openfoam(const std::filesystem::path& file);
/// Reads fields of a time folder, or of the latest one in the folder of a case. `mesh`: its case or polyMesh; empty:
/// the case round the time folder.
Solution read_openfoam_solution(const std::filesystem::path& folder, std::span<const FieldRequest> fields,
                                const std::filesystem::path& mesh);
/// Returns the folder of the mesh: the path itself where it ends in "polyMesh", else the folder of this name in the
/// case folder that the path names.
std::filesystem::path poly_mesh_folder(const std::filesystem::path& file);
bool holds_openfoam_mesh(const std::filesystem::path& file);

/// Returns the file and the .mapbc file beside it, which holds the names of the boundaries.
std::vector<std::filesystem::path> ugrid_files(const std::filesystem::path& file);
/// Writes a plane mesh in ASCII.
void write_ugrid(const MeshView& mesh, const std::filesystem::path& file);
/// Writes a mesh in space: big-endian for .b8.ugrid, little-endian for .lb8.ugrid, else in ASCII.
void write_fun3d(const MeshView& mesh, const std::filesystem::path& file, const Extrusion& extrusion);
/// Reads what write_ugrid() and write_fun3d() write.
Mesh read_ugrid(const std::string& bytes, const std::filesystem::path& file);

/// Returns the four files of one stem that hold the mesh.
std::vector<std::filesystem::path> triangle_mesh_files(const std::filesystem::path& file);
void write_triangle_mesh(const MeshView& mesh, const std::filesystem::path& file);
Mesh read_triangle_mesh(const std::filesystem::path& file);

}  // namespace lamina::io
