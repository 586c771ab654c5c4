// One function to read and one to write a mesh for each format; format_table.cpp holds the table of them.
#pragma once

#include <filesystem>
#include <ostream>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <lamina/io.hpp>
#include <lamina/mesh.hpp>

namespace lamina::io {

/// A row of the table of formats: --format, the help text, the guide and the choice by extension all read it.
struct Format {
    const char* name;
    /// How names of files end, in whatever case. The longest one that fits stands for its format, of several alike the
    /// first in the table.
    std::vector<std::string> extensions;
    const char* holds;  ///< one line for the guide
    /// Writes every file of the mesh, whole or not at all. Throws IoError; UsageError for what it cannot hold.
    void (*write)(const Mesh&, const std::filesystem::path&, const WriteOptions&);
    /// Throws IoError, InputError; null where the format cannot be read.
    Mesh (*read)(const std::filesystem::path&);
    bool quads;  ///< holds quadrilaterals, too
    /// Throws IoError where `file` can be seen now not to be writable.
    void (*check)(const std::filesystem::path& file);
};

const std::vector<Format>& formats();

/// By its name, or an extension without the dot, where one is given, else by how the name of the file ends. Throws
/// UsageError.
const Format& format_of(const std::filesystem::path& file, const std::string& name = {});

// Writers of a single file send the whole of it to `out`; readers get the whole file as bytes, and its name for
// messages. Meshes come out with all indices in range and finite points; more is for check_mesh to say. Readers throw
// InputError.

void write_su2(const Mesh& mesh, const std::filesystem::path& file, std::ostream& out);
Mesh read_su2(const std::string& bytes, const std::filesystem::path& file);

struct VtuVariant {
    bool compressed = false;     ///< by zlib
    bool wall_distance = false;  ///< as point data
};
void write_vtu(const Mesh& mesh, VtuVariant variant, std::ostream& out);
Mesh read_vtu(const std::string& bytes, const std::filesystem::path& file);

/// A mesh and a value at each point; NaN where the file has none.
struct PointValues {
    Mesh mesh;
    std::vector<double> values;
};
/// By a reader of a format: read() makes the mesh, then sizes() finds the values.
template <class Reader>
PointValues read_point_values(Reader reader) {
    PointValues result;
    result.mesh = reader.read();
    result.values = reader.sizes();
    return result;
}

/// With the array of its point data that holds sizes (size_array).
PointValues read_vtu_sizes(const std::string& bytes, const std::filesystem::path& file);

struct MshVariant {
    bool version_4 = true;  ///< 4.1, else 2.2
    bool binary = false;
};
void write_msh(const Mesh& mesh, const std::filesystem::path& file, MshVariant variant, std::ostream& out);
/// Either version, ASCII or binary.
Mesh read_msh(const std::string& bytes, const std::filesystem::path& file);
/// With the $NodeData that holds sizes (size_array).
PointValues read_msh_sizes(const std::string& bytes, const std::filesystem::path& file);

/// The one named `size`, or the only one. Throws InputError.
std::string size_array(const std::vector<std::string>& scalar_arrays, const std::filesystem::path& file);

/// 2.2, ASCII, one cell thick.
void write_msh_extruded(const Mesh& mesh, const std::filesystem::path& file, std::ostream& out);

struct CgnsVariant {
    bool adf = false;                ///< the older container in place of HDF5
    bool three_coordinates = false;  ///< with CoordinateZ = 0, for readers that know no plane
};
void write_cgns(const Mesh& mesh, const std::filesystem::path& file, CgnsVariant variant);
Mesh read_cgns(const std::filesystem::path& file);

/// The patch of OpenFOAM's sides, and of others' that are one cell thick.
inline constexpr const char* front_and_back = "frontAndBack";
/// `file` itself where its name ends so, else the folder in a case of that name.
std::filesystem::path poly_mesh_folder(const std::filesystem::path& file);
void check_openfoam_writable(const std::filesystem::path& file);
void write_openfoam(const Mesh& mesh, const std::filesystem::path& file);
Mesh read_openfoam(const std::filesystem::path& file);

// Beside a UGRID file stands a .mapbc with the names of the boundaries.
void check_ugrid_writable(const std::filesystem::path& file);
/// Plane, in ASCII.
void write_ugrid(const Mesh& mesh, const std::filesystem::path& file);
/// One cell thick; .b8.ugrid is big-endian, .lb8.ugrid little-endian, else ASCII.
void write_fun3d(const Mesh& mesh, const std::filesystem::path& file);
/// Either.
Mesh read_ugrid(const std::string& bytes, const std::filesystem::path& file);

// Four files of one stem.
void check_triangle_writable(const std::filesystem::path& file);
void write_triangle_mesh(const Mesh& mesh, const std::filesystem::path& file);
Mesh read_triangle_mesh(const std::filesystem::path& file);

}  // namespace lamina::io
