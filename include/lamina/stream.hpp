// Meshes that no process holds as a whole: handed to a sink piece by piece, or left with the processes that make them.
//
// Guarantees:
//  1. The mesh is that of generate_mesh(), on any number of threads and processes.
//  2. Memory of a streamed mesh is bounded by the layer, the borders between pieces, and one piece per thread: pieces
//     are checked and handed to the sink as they are refined, and forgotten. Files appear once the sink is committed.
//  3. Processes that share a mesh compute the border of the layer, and cut the outer region together. Each then takes
//     pieces, the largest first, refines and checks them on its threads, and keeps them.
// Limits:
//  1. Inputs and options are the same for all processes. Where one throws, it must call Ranks::fail().
// Example:
//     const CaseOptions options{.layer = {.enabled = false}};
//     const StreamedMesh made = stream_mesh({"naca:0012:60"}, options, [] { return open_mesh_sink("streamed.su2"); });
//     made.sink->commit();
//     assert(mesh_hash(read_mesh("streamed.su2")) == made.hash);
#pragma once

#include <filesystem>
#include <memory>

#include <lamina/mesh_sink.hpp>
#include <lamina/pipeline.hpp>
#include <lamina/ranks.hpp>

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

/// Reads the inputs and runs all stages on them. Throws what generate_mesh() and the sink throw.
LAMINA_EXPORT StreamedMesh stream_mesh(const std::vector<std::string>& inputs, const CaseOptions& options,
                                       const OpenSink& open_sink, const Progress& progress = {});

/// A mesh whose parts lie with the processes that have made them.
struct SharedMesh {
    MeshResult result;                 ///< with a mesh that holds its markers alone; the check is that of rank 0
    MeshCounts counts;                 ///< the size of the whole mesh
    std::string hash;                  ///< as mesh_hash() returns it, on rank 0
    std::vector<Segment> constraints;  ///< as Mesh::constraints
    std::shared_ptr<const mesh::MeshParts> parts;  ///< those of this process, for write_shared_mesh()
};

/// Collective: reads the inputs and runs all stages on them. Parts are kept in memory, or on the disk of the file
/// `beside`. Throws what generate_mesh() throws, perhaps on one process alone; RankFailure where another has failed.
LAMINA_EXPORT SharedMesh share_mesh(const std::vector<std::string>& inputs, const CaseOptions& options, Ranks& ranks,
                                    const std::optional<std::filesystem::path>& beside = {},
                                    const Progress& progress = {});

}  // namespace lamina
