// Meshes to and from files.
//
// Guarantees:
//  1. Coordinates are read back exactly.
//  2. Files get temporary names beside the target and are renamed, so that a failure leaves nothing half-written.
//  3. The bytes are the same whether a mesh is written at once, part by part or by several processes.
//  4. The arrays of a large StoredMesh lie in temporary files, which vanish with it or with the process. SU2 and
//     uncompressed VTU files are read in constant memory beside the markers, others as a whole.
// Limits:
//  1. The format follows from the extension unless it is named. "-" is standard input or output: name its format.
//  2. UsageError for an unknown format or extension, IoError where a file cannot be read or written.
//  3. Stored files must not shrink while they are read. TMPDIR, or /var/tmp, needs 20 to 27 bytes a triangle.
// Example:
//     const Mesh mesh = generate_mesh({"naca:0012:60"}, {.layer = {.enabled = false}}).mesh;
//     write_mesh(mesh, "section.su2");
//     assert(mesh_hash(read_mesh("section.su2")) == mesh_hash(mesh));
#pragma once

#include <filesystem>
#include <memory>

#include <lamina/curved_mesh.hpp>
#include <lamina/mesh_sink.hpp>
#include <lamina/ranks.hpp>
#include <lamina/sizing.hpp>

namespace lamina {

/// A format that meshes are written in. Most formats can also be read.
struct MeshFormat {
    std::string name;  ///< "msh22"
    /// With the dot, or the name of its folder; the first format that has it counts.
    std::vector<std::string> extensions;
    std::string description;        ///< one line
    bool readable = false;          ///< whether read_mesh() reads it
    bool quads = true;              ///< whether it holds quadrilaterals, too
    bool one_stream = false;        ///< whether it is one stream of bytes, which a pipe can carry
    bool internal_markers = false;  ///< whether it holds markers of lines inside the mesh; others leave them out
};

LAMINA_EXPORT std::vector<MeshFormat> mesh_formats();  ///< all formats of this build, in the order of the guide's table

inline constexpr std::size_t max_parts = 65'536;  ///< the largest number of parts that write_mesh() makes of a mesh

/// Options of write_mesh().
struct WriteOptions {
    std::string format{};        ///< a name, or an extension without its dot; empty: by the extension of the file
    bool wall_distance = false;  ///< writes the distance to the nearest wall as point data, in VTU files
    std::size_t parts = 1;  ///< of PVTU files; more than one make OpenFOAM's cellDecomposition beside polyMesh, too
    double span = 0;        ///< depth in units of the mesh; 0: a plane mesh, or one that is 1 deep
    std::size_t span_cells = 1;  ///< number of cells across the span
    bool span_periodic = false;  ///< whether each end of the span continues the other; else both are planes of symmetry
};

/// Writes a mesh. Throws UsageError, too, for marker names, and MeshError for a mesh that the format cannot hold.
LAMINA_EXPORT void write_mesh(const MeshView& mesh, const std::filesystem::path& file,
                              const WriteOptions& options = {});

/// Returns a warning where the format of this file leaves out the internal markers of a mesh, and where there are any.
LAMINA_EXPORT std::vector<Warning> lost_marker_warnings(std::span<const Marker> markers,
                                                        const std::filesystem::path& file,
                                                        const WriteOptions& options = {});

/// Options of read_mesh().
struct ReadOptions {
    std::string format{};  ///< a name, or an extension without its dot; empty: by the extension of the file
};

/// Reads a mesh. Throws InputError (with the line, for text formats) where the file is malformed.
LAMINA_EXPORT Mesh read_mesh(const std::filesystem::path& file, const ReadOptions& options = {});

/// Writes a mesh with curved cells. Throws what require_curved_format() and write_mesh() throw.
LAMINA_EXPORT void write_curved_mesh(const MeshView& mesh, const CurvedNodes& nodes, const std::filesystem::path& file,
                                     const WriteOptions& options = {});
/// Throws UsageError for formats that do not hold curved cells of this order with such nodes, in one line that names
/// those that do. At order 2 nodes are evenly spaced.
LAMINA_EXPORT void require_curved_format(const std::filesystem::path& file, const WriteOptions& options = {},
                                         unsigned order = 2,
                                         NodeDistribution distribution = NodeDistribution::equidistant);
/// Reads a mesh whose cells may be curved, all of one order: MSH, VTU, CGNS and Nektar++. Other formats are read as
/// read_mesh() does; their order is 1. Throws InputError where the file is malformed.
LAMINA_EXPORT CurvedMesh read_curved_mesh(const std::filesystem::path& file, const ReadOptions& options = {});

/// Writes wall_vertices() as CSV, one line each: marker, vertex (from 0), x, y, arc length, unit normal and first
/// height. Numbers have 17 significant digits.
LAMINA_EXPORT void write_wall_data(const Mesh& mesh, const std::filesystem::path& file);
/// Reads a background mesh from a VTU file (point data) or an MSH file ($NodeData of one component). The sizes are the
/// array named `size`, or the only scalar one. Quadrilaterals are cut in two; points of no triangle are left out.
/// Throws InputError where the file is malformed, has no triangles or no sizes, or a size is missing or not positive.
LAMINA_EXPORT SizedMesh read_sizes(const std::filesystem::path& file);

/// Opens a sink that writes a mesh part by part, as require_streamable() and check_writable() let it.
LAMINA_EXPORT std::unique_ptr<MeshSink> open_mesh_sink(const std::filesystem::path& file,
                                                       const WriteOptions& options = {});
/// Collective: writes one file from the parts of a mesh that several processes hold, of which a PVTU file has one or
/// more for each. /dev/null takes no bytes. Throws what require_shareable() throws, UsageError for standard output and
/// devices, IoError where a process cannot write, which then calls Ranks::fail(), and RankFailure elsewhere.
LAMINA_EXPORT void write_shared_mesh(const mesh::MeshParts& parts, const MeshFrame& frame, Ranks& ranks,
                                     const std::filesystem::path& file, const WriteOptions& options = {});
/// Throws what write_mesh() would throw for the name of the file and the format: UsageError also for one that standard
/// output cannot carry, IoError where the folder does not exist or is not writable.
LAMINA_EXPORT void check_writable(const std::filesystem::path& file, const WriteOptions& options = {});
/// Throws UsageError for formats that are written as a whole, which open_mesh_sink() refuses.
LAMINA_EXPORT void require_streamable(const std::filesystem::path& file, const WriteOptions& options = {});
/// Throws UsageError for formats that write_shared_mesh() refuses.
LAMINA_EXPORT void require_shareable(const std::filesystem::path& file, const WriteOptions& options = {});
/// Returns whether WriteOptions::parts counts for this file.
LAMINA_EXPORT bool takes_parts(const std::filesystem::path& file, const WriteOptions& options = {});
/// Returns the name of the format that write_mesh() writes the file in; empty where there is no such format.
LAMINA_EXPORT std::string format_name(const std::filesystem::path& file, const WriteOptions& options = {});
/// Returns the files that write_mesh() creates or replaces: one, several, or the folder of a format that is a folder.
LAMINA_EXPORT std::vector<std::filesystem::path> output_files(const std::filesystem::path& file,
                                                              const WriteOptions& options = {});

/// A mesh from a file. The arrays of a large one lie in temporary files, which are mapped into memory.
class LAMINA_EXPORT StoredMesh {
public:
    explicit StoredMesh(Mesh mesh, CurvedNodes curved = {});  ///< holds a mesh in memory
    StoredMesh(StoredMesh&& other) noexcept;                  ///< leaves nothing but destruction to the other object
    StoredMesh& operator=(StoredMesh&& other) noexcept;       ///< does the same, and gives up the arrays of this object
    ~StoredMesh();

    MeshView view() const;                        ///< the whole mesh, as long as this object lives and is not changed
    std::vector<Marker>& markers();               ///< the markers, which always lie in memory and may be changed
    void set_region(std::vector<Region> region);  ///< sets the region of each cell, or of none
    bool in_files() const;                        ///< whether arrays lie in temporary files
    const CurvedNodes& curved() const;            ///< what makes its cells curved (StoreOptions::curved)

    struct Arrays;
    explicit StoredMesh(std::unique_ptr<Arrays> arrays);  ///< holds arrays that a reader has filled

private:
    std::unique_ptr<Arrays> arrays_;
};

/// Options of read_stored_mesh().
struct StoreOptions {
    std::string format{};                                    ///< that of ReadOptions
    std::size_t max_bytes_in_memory = std::size_t{1} << 30;  ///< arrays of larger files go to temporary files
    bool curved = false;  ///< whether cells of files read into memory may be curved; else such a file is an InputError
};

/// Reads the mesh that read_mesh() reads, and throws what it throws.
LAMINA_EXPORT StoredMesh read_stored_mesh(const std::filesystem::path& file, const StoreOptions& options = {});

}  // namespace lamina
