// Meshes that several processes make together, and that none of them holds as a whole.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <lamina/export.hpp>
#include <lamina/mesh_sink.hpp>
#include <lamina/pipeline.hpp>
#include <lamina/ranks.hpp>

namespace lamina {

/// A mesh whose parts lie with the processes that have made them.
struct SharedMesh {
    MeshResult result;                 ///< with a mesh that holds its markers alone; the check is that of rank 0
    MeshCounts counts;                 ///< the size of the whole mesh
    std::string hash;                  ///< as mesh_hash() returns it, on rank 0
    std::vector<Segment> constraints;  ///< as Mesh::constraints
    std::unique_ptr<MeshParts> parts;  ///< those of this process
};

/// Collective: reads the inputs and runs all stages on them, as generate_mesh() does, and makes the same mesh. All
/// processes compute the border of the layer, and cut the outer region together. Each then takes pieces, the largest
/// first, refines and checks them on its threads, and keeps them: in memory, or on the disk of the file `beside`. Throws
/// what generate_mesh() throws, perhaps on one process alone, which must then call Ranks::fail(); RankFailure where
/// another process has failed.
/// Precondition: inputs and options are the same everywhere.
LAMINA_EXPORT SharedMesh share_mesh(const std::vector<std::string>& inputs, const CaseOptions& options, Ranks& ranks,
                                    const std::optional<std::filesystem::path>& beside = {},
                                    const Progress& progress = {});

}  // namespace lamina
