// The neighbours in a mesh, found block by block and forgotten: what a check needs that looks at each pair of
// neighbours once, in a memory that does not grow by twelve bytes for each triangle.
#pragma once

#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>
#include <span>
#include <vector>

#include <lamina/export.hpp>
#include <lamina/mesh.hpp>

#include "core/uninitialized.hpp"
#include "mesh/adjacency.hpp"
#include "mesh/edge_matching.hpp"

namespace lamina::mesh {

/// These totals are known once all edges have been matched, as in Adjacency.
struct EdgeTotals {
    std::vector<std::uint32_t> boundary, overused;
    std::vector<VertexId> orphans;
    std::size_t edges = 0;
};

/// Finds the same pairs as find_adjacency(). Takes 4 bytes for each vertex, and 12 for each edge whose ends are both
/// shared between blocks: 0.5 to 3 bytes for each triangle where successive cells are neighbours. Where these would
/// exceed the memory that is allowed, they are looked at part by part, and the cells are read once for each part.
class LAMINA_EXPORT EdgeSurvey {
public:
    /// The arrays of the mesh must outlive this object. `max_bytes` bounds the memory that it takes, unless less than
    /// `least_bytes_for_edges` would be left for edges. Precondition: all indices are in range. Throws MeshError from
    /// 2^32 directed edges on.
    explicit EdgeSurvey(const MeshView& mesh, std::optional<std::size_t> max_bytes = {},
                        std::size_t least_bytes_for_edges = std::size_t{64} << 20);

    /// Matches the edges of the cells [begin, end), which are a block: cells_per_block ones from a multiple of this
    /// number on, or the last ones. twin[e] then holds the twin of edge e, both counted from the first edge of the
    /// block; no_edge where it may lie in another block, or nowhere. To be called once for each block, by any thread.
    void match_block(std::size_t begin, std::size_t end, std::vector<std::uint32_t>& twin);
    /// Matches all other edges, once the blocks are matched. Calls visit() with their pairs, on several threads at
    /// once. May be called once.
    void match_between(const std::function<void(std::span<const EdgePair>)>& visit);
    /// Returns the rest. To be called at the end, once.
    EdgeTotals take_totals();

    /// Returns how often the cells are read.
    std::size_t passes() const { return passes_; }

private:
    MeshView mesh_;
    CellEdges cell_edges_;
    core::UninitializedArray<std::uint32_t> owners_;  ///< per vertex
    std::size_t buckets_ = 1, passes_ = 1;
    std::vector<EdgeBuckets> between_;  ///< per block: its edges in the buckets of this pass
    EdgeTotals totals_;
    std::mutex mutex_;  ///< guards totals_

    bool is_between(VertexId a, VertexId b) const {
        return owners_[a.index()] == shared && owners_[b.index()] == shared;
    }
    std::size_t first_bucket(std::size_t pass) const { return pass * buckets_ / passes_; }
    std::size_t passes_within(std::size_t max_bytes, std::size_t least_bytes_for_edges) const;
    void collect_between(std::size_t pass);
    void match_bucket(std::size_t bucket, const std::function<void(std::span<const EdgePair>)>& visit);
    void add(const EdgeMatches& matches, std::span<const std::uint32_t> numbers);
};

}  // namespace lamina::mesh
