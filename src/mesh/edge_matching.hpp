// Matching of directed edges with their opposites: what find_adjacency() and the survey of edges have in common. Blocks
// of successive cells match their own edges. Edges whose ends are both shared with other blocks are distributed by a
// hash of their ends and matched later.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <span>
#include <vector>

#include <lamina/mesh.hpp>

#include "core/uninitialized.hpp"
#include "mesh/adjacency.hpp"

namespace lamina::mesh {

/// Calls f(edge, origin, target) for the edges of the cells [begin, end).
template <class F>
void for_each_edge(const MeshView& mesh, std::size_t begin, std::size_t end, F&& f) {
    const std::size_t triangles = mesh.triangles.size();
    for (std::size_t t = begin; t < std::min(end, triangles); ++t) {
        const VertexId* v = mesh.triangles[t].v;
        for (std::size_t i = 0; i < 3; ++i) f(3 * t + i, v[i], v[i == 2 ? 0 : i + 1]);
    }
    for (std::size_t q = std::max(begin, triangles); q < end; ++q) {
        const VertexId* v = mesh.quads[q - triangles].v;
        for (std::size_t i = 0; i < 4; ++i) f(4 * q - triangles + i, v[i], v[(i + 1) % 4]);
    }
}

/// The owner of a vertex is the block that all its cells are in. These stand for no cell and for several blocks.
inline constexpr std::uint32_t unclaimed = 0xffffffff, shared = 0xfffffffe;

/// Returns for each vertex its owner, `shared` or `unclaimed`.
core::UninitializedArray<std::uint32_t> vertex_owners(const MeshView& mesh, std::size_t cells);

/// Returns the vertices without an owner, which no cell has.
std::vector<VertexId> find_orphans(const core::UninitializedArray<std::uint32_t>& owners);

/// An edge of a cell without its direction.
struct UndirectedEdge {
    VertexId low, high;  ///< its ends, low <= high
    std::uint32_t number = no_edge;
};

inline bool have_same_ends(const UndirectedEdge& a, const UndirectedEdge& b) {
    return a.low == b.low && a.high == b.high;
}

/// A list of edges. Edges that ascend, from their lower vertex to the higher one, stand at the front and the others at
/// the back: cells of one orientation use an edge once each way. Adding an edge takes no branch, which the processor
/// would mispredict half of the time.
class TwoWayEdgeList {
public:
    explicit TwoWayEdgeList(std::size_t capacity) : edges_(capacity) {}

    std::size_t capacity() const { return edges_.size(); }
    /// Precondition: the list is not full.
    void add(VertexId origin, VertexId target, std::size_t number) {
        const std::uint32_t ascends = origin.value < target.value;
        const std::uint32_t flip = (origin.value ^ target.value) & (ascends - 1);
        edges_[ascending_] = edges_[edges_.size() - 1 - descending_] = {
            VertexId{origin.value ^ flip}, VertexId{target.value ^ flip}, static_cast<std::uint32_t>(number)};
        ascending_ += ascends;
        descending_ += 1 - ascends;
    }
    const UndirectedEdge& operator[](std::size_t i) const { return edges_[i]; }
    bool ascends(std::size_t i) const { return i < ascending_; }
    /// Run through all edges, the ascending ones first: for (i = begin(); i < end(); i = after(i)).
    std::size_t begin() const { return after(std::size_t(-1)); }
    std::size_t end() const { return edges_.size(); }
    std::size_t after(std::size_t i) const { return i + 1 == ascending_ ? edges_.size() - descending_ : i + 1; }

private:
    core::UninitializedArray<UndirectedEdge> edges_;
    std::size_t ascending_ = 0, descending_ = 0;
};

/// The results of match(), as in Adjacency.
struct EdgeMatches {
    std::vector<std::uint32_t> boundary, overused;
    std::size_t edges = 0;
};

/// Finds the twins in a list that holds all directed edges of each undirected edge in it. twin[e] is set for the
/// numbers of these edges.
void match(const TwoWayEdgeList& list, std::span<std::uint32_t> twin, EdgeMatches& matches);

/// A directed edge whose ends are both shared between blocks.
struct SharedEdge {
    VertexId origin, target;
    std::uint32_t number = no_edge;
};

/// Edges sorted into buckets by a hash of their ends: bucket k is [start[k], start[k + 1]).
struct EdgeBuckets {
    std::vector<SharedEdge> edges;
    std::vector<std::uint32_t> start;
};

/// Returns which of `count` buckets an edge belongs to. Edges with the same ends share one.
inline std::size_t bucket_of(VertexId a, VertexId b, std::size_t count) {
    const std::uint32_t hash = (a.value ^ b.value) * 0x9e3779b1u;
    return std::uint64_t{hash} * count >> 32;
}

/// Sorts edges into the buckets [first, last) of `count`, which hold them all.
EdgeBuckets sort_into_buckets(std::span<const SharedEdge> edges, std::size_t count, std::size_t first,
                              std::size_t last);

/// Returns a number of buckets that makes each small enough for the cache.
std::size_t bucket_count(std::size_t cells);

}  // namespace lamina::mesh
