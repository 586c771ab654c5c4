// Meshes that are handed on piece by piece: memory is bounded by the layer, the borders between the pieces, and one
// piece for each thread, whatever the size of the mesh.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <lamina/export.hpp>
#include <lamina/mesh_sink.hpp>
#include <lamina/pipeline.hpp>

namespace lamina {

/// A mesh that has gone to a sink.
struct StreamedMesh {
    MeshResult result;               ///< with a mesh that holds its markers alone
    MeshCounts counts;               ///< its size
    std::string hash;                ///< as mesh_hash() returns it
    std::unique_ptr<MeshSink> sink;  ///< holds the whole mesh; to be committed
};

/// A function that opens a sink. It is called more than once where a mesh is replaced by a better one.
using OpenSink = std::function<std::unique_ptr<MeshSink>()>;

/// Reads the inputs and runs all stages on them, as generate_mesh() does, and makes the same mesh. Pieces are checked and
/// handed to the sink as they are refined, and then forgotten. Nothing that was written appears before the sink is
/// committed. Throws what generate_mesh() throws and what the sink throws; a mesh that turns out not to be valid is a
/// MeshError.
LAMINA_EXPORT StreamedMesh stream_mesh(const std::vector<std::string>& inputs, const CaseOptions& options,
                                       const OpenSink& open_sink, const Progress& progress = {});

}  // namespace lamina
