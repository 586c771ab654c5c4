#include <lamina/io.hpp>

#include <lamina/files.hpp>

#include "io/formats.hpp"
#include "io/mesh_arrays.hpp"

namespace lamina {

namespace fs = std::filesystem;

StoredMesh::StoredMesh(Mesh mesh, CurvedNodes curved)
    : arrays_(std::make_unique<Arrays>(std::move(mesh), std::move(curved))) {}
StoredMesh::StoredMesh(std::unique_ptr<Arrays> arrays) : arrays_(std::move(arrays)) {}
StoredMesh::StoredMesh(StoredMesh&&) noexcept = default;
StoredMesh& StoredMesh::operator=(StoredMesh&&) noexcept = default;
StoredMesh::~StoredMesh() = default;

MeshView StoredMesh::view() const {
    MeshView view = arrays_->has_arrays ? arrays_->arrays.view() : MeshView(arrays_->mesh);
    if (arrays_->has_region) view.region = arrays_->region;
    return view;
}

std::vector<Marker>& StoredMesh::markers() {
    return arrays_->has_arrays ? arrays_->arrays.markers : arrays_->mesh.markers;
}

void StoredMesh::set_region(std::vector<Region> region) {
    arrays_->region = std::move(region);
    arrays_->has_region = true;
}

bool StoredMesh::in_files() const { return arrays_->in_files; }

const CurvedNodes& StoredMesh::curved() const { return arrays_->curved; }

StoredMesh read_stored_mesh(const fs::path& file, const StoreOptions& options) {
    const io::FormatRow& format = io::format_to_read(file, options.format);
    std::error_code error;
    const std::uintmax_t size = is_standard_stream(file) ? 0 : fs::file_size(file, error);
    const bool large = !error && size > options.max_bytes_in_memory;
    const bool in_parts = large && format.read_stored != nullptr;
    if (options.curved && format.read_curved != nullptr && !in_parts) {
        CurvedMesh curved = format.read_curved(file);
        return StoredMesh(std::move(curved.mesh), std::move(curved.nodes));
    }
    if (!in_parts) return StoredMesh(format.read(file));
    auto arrays = std::make_unique<StoredMesh::Arrays>(true);
    format.read_stored(file, arrays->arrays);
    return StoredMesh(std::move(arrays));
}

}  // namespace lamina
