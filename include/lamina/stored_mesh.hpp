// Meshes from files that need not fit into memory.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include <lamina/export.hpp>
#include <lamina/io.hpp>
#include <lamina/mesh.hpp>

namespace lamina {

/// A mesh from a file. The arrays of a large one lie in temporary files, which are mapped into memory: of these the system
/// keeps what it has room for, and they vanish with this object or with the process.
class LAMINA_EXPORT StoredMesh {
public:
    /// Holds a mesh in memory.
    explicit StoredMesh(Mesh mesh);
    /// Takes over the arrays of another object, of which only the destructor may be called then.
    StoredMesh(StoredMesh&& other) noexcept;
    /// Does the same, and gives up the arrays that this object has.
    StoredMesh& operator=(StoredMesh&& other) noexcept;
    ~StoredMesh();

    /// Returns the whole mesh. The view holds as long as this object lives and is not changed.
    MeshView view() const;
    /// Returns the markers, which always lie in memory and may be changed.
    std::vector<Marker>& markers();
    /// Sets the region of each cell, or of none.
    void set_region(std::vector<Region> region);
    /// Returns whether arrays lie in temporary files.
    bool in_files() const;

    struct Arrays;
    /// Holds arrays that a reader has filled.
    explicit StoredMesh(std::unique_ptr<Arrays> arrays);

private:
    std::unique_ptr<Arrays> arrays_;
};

/// Options of read_stored_mesh().
struct StoreOptions {
    std::string format{};  ///< that of ReadOptions
    /// Arrays go to temporary files where the file of the mesh is larger than this.
    std::size_t max_bytes_in_memory = std::size_t{1} << 30;
};

/// Reads the mesh that read_mesh() reads. SU2 and uncompressed VTU files are read in place, in constant memory beside the
/// markers; others are read as a whole. Regular files must not shrink while they are read. Throws what read_mesh() throws,
/// and IoError where the disk has no room for temporary files: 20 to 27 bytes for each triangle, in the folder that TMPDIR
/// names, or else in /var/tmp.
LAMINA_EXPORT StoredMesh read_stored_mesh(const std::filesystem::path& file, const StoreOptions& options = {});

}  // namespace lamina
