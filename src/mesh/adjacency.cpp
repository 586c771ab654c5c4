#include "mesh/adjacency.hpp"

#include <algorithm>
#include <atomic>
#include <bit>
#include <numeric>
#include <span>
#include <utility>

#include <lamina/error.hpp>

#include "core/parallel.hpp"

namespace lamina::mesh {

namespace {

constexpr std::size_t vertex_grain = 1 << 16;

/// Calls f(edge, origin, target) for the edges of the cells [begin, end).
template <class F>
void for_each_edge(const Mesh& mesh, std::size_t begin, std::size_t end, F&& f) {
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

// --- Which block owns a vertex

/// The owner of a vertex is the block that all its cells are in. These stand for no cell and for several blocks.
constexpr std::uint32_t unclaimed = 0xffffffff, shared = 0xfffffffe;

void claim(std::uint32_t& owner, std::uint32_t block, bool concurrently) {
    // Locked exchanges are slow, so a single thread does without.
    if (!concurrently) {
        owner = owner == unclaimed || owner == block ? block : shared;
        return;
    }
    const std::atomic_ref claimed(owner);
    std::uint32_t found = claimed.load(std::memory_order_relaxed);
    if (found == block || found == shared) return;
    if (found == unclaimed && claimed.compare_exchange_strong(found, block, std::memory_order_relaxed)) return;
    claimed.store(shared, std::memory_order_relaxed);
}

/// Returns for each vertex its owner, `shared` or `unclaimed`.
core::UninitializedArray<std::uint32_t> vertex_owners(const Mesh& mesh, std::size_t cells) {
    core::UninitializedArray<std::uint32_t> owners(mesh.points.size());
    core::parallel_for(owners.size(), vertex_grain, [&](std::size_t begin, std::size_t end) {
        std::fill(owners.begin() + begin, owners.begin() + end, unclaimed);
    });
    const bool concurrently = thread_count() > 1;
    core::parallel_for(cells, cells_per_block, [&](std::size_t begin, std::size_t end) {
        const auto block = static_cast<std::uint32_t>(begin / cells_per_block);
        for_each_edge(mesh, begin, end,
                      [&](std::size_t, VertexId a, VertexId) { claim(owners[a.index()], block, concurrently); });
    });
    return owners;
}

std::vector<VertexId> find_orphans(const core::UninitializedArray<std::uint32_t>& owners) {
    const auto orphans_among = [&](std::size_t begin, std::size_t end) {
        std::vector<VertexId> orphans;
        for (std::size_t v = begin; v < end; ++v)
            if (owners[v] == unclaimed) orphans.emplace_back(v);
        return orphans;
    };
    std::vector<VertexId> all;
    for (const auto& orphans : core::parallel_blocks(owners.size(), vertex_grain, orphans_among))
        all.insert(all.end(), orphans.begin(), orphans.end());
    return all;
}

// --- Matching a list of edges

/// An edge of a cell without its direction.
struct UndirectedEdge {
    VertexId low, high;  ///< its ends, low <= high
    std::uint32_t number = no_edge;
};

bool have_same_ends(const UndirectedEdge& a, const UndirectedEdge& b) { return a.low == b.low && a.high == b.high; }

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

/// Finds the twins in a list that holds all directed edges of each undirected edge in it.
void match(const TwoWayEdgeList& list, core::UninitializedArray<std::uint32_t>& twin, EdgeMatches& matches) {
    // An entry of the table is the first edge of an undirected edge. It is marked as crowded where more than two cells,
    // or two cells on one side, share the edge.
    constexpr std::uint32_t empty = 0xffffffff, crowded = 0x80000000;
    const std::size_t mask = std::bit_ceil(list.capacity() + list.capacity() / 3 + 8) - 1;
    std::vector<std::uint32_t> table(mask + 1, empty);
    const auto slot_of = [&](const UndirectedEdge& e) -> std::uint32_t& {
        // Successive vertices have successive rows of 8 slots, so that neighbours, which have similar numbers, share
        // cache lines. The step depends on the other end, since all edges of a hub may meet in one row.
        const std::uint32_t row = e.low.value ^ (e.low.value >> 12) * 0x9e3779b1u, hash = e.high.value * 0x85ebca6bu;
        const std::size_t step = hash >> 8 | 1;
        std::size_t slot = (std::size_t{row} * 8 + (hash >> 29)) & mask;
        while (table[slot] != empty && !have_same_ends(list[table[slot] & ~crowded], e)) slot = (slot + step) & mask;
        return table[slot];
    };
    std::size_t distinct = 0, pairs = 0;
    for (std::size_t i = list.begin(); i < list.end(); i = list.after(i)) {
        const std::uint32_t mine = list[i].number;
        std::uint32_t& slot = slot_of(list[i]);
        twin[mine] = no_edge;
        if (slot == empty) {
            slot = static_cast<std::uint32_t>(i);
            ++distinct;
            continue;
        }
        const std::size_t first = slot & ~crowded;
        const std::uint32_t other = list[first].number, others_twin = twin[other];
        if (!(slot & crowded) && others_twin == no_edge && list.ascends(first) && !list.ascends(i)) {
            twin[other] = mine;
            twin[mine] = other;
            ++pairs;
            continue;
        }
        matches.overused.push_back(mine);
        if (slot & crowded) continue;
        slot |= crowded;
        matches.overused.push_back(other);
        if (others_twin == no_edge) continue;
        matches.overused.push_back(others_twin);
        twin[other] = twin[others_twin] = no_edge;
        --pairs;
    }
    matches.edges += distinct;
    if (pairs == distinct) return;
    for (const std::uint32_t i : table)
        if (i != empty && !(i & crowded) && twin[list[i].number] == no_edge) matches.boundary.push_back(list[i].number);
}

// --- Edges between blocks

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

EdgeBuckets sort_into_buckets(std::span<const SharedEdge> edges, std::size_t count) {
    const auto bucket_of = [&](const SharedEdge& e) {
        const std::uint32_t hash = (e.origin.value ^ e.target.value) * 0x9e3779b1u;
        return std::uint64_t{hash} * count >> 32;
    };
    EdgeBuckets buckets{std::vector<SharedEdge>(edges.size()), std::vector<std::uint32_t>(count + 2, 0)};
    for (const SharedEdge& e : edges) ++buckets.start[bucket_of(e) + 2];
    for (std::size_t k = 2; k < buckets.start.size(); ++k) buckets.start[k] += buckets.start[k - 1];
    // start[k + 1] runs through bucket k and ends as the start of bucket k + 1.
    for (const SharedEdge& e : edges) buckets.edges[buckets.start[bucket_of(e) + 1]++] = e;
    buckets.start.pop_back();
    return buckets;
}

/// The matches within one block of cells, and its other edges.
struct BlockMatches {
    EdgeMatches matches;
    EdgeBuckets between;  ///< its edges that may have a twin in another block
};

void append(std::vector<std::uint32_t>& all, const std::vector<std::uint32_t>& part) {
    all.insert(all.end(), part.begin(), part.end());
}

/// Appends to an Adjacency or to EdgePairs.
template <class Pairs>
void append_matches(Pairs& pairs, const EdgeMatches& matches) {
    append(pairs.boundary, matches.boundary);
    append(pairs.overused, matches.overused);
    pairs.edges += matches.edges;
}

/// Returns a number of buckets that makes each small enough for the cache.
std::size_t bucket_count(std::size_t cells) {
    constexpr std::size_t cells_per_bucket = 1 << 17, max_buckets = 256;
    return std::min(cells / cells_per_bucket + 1, max_buckets);
}

/// Finds the twins in all buckets, which together hold all directed edges of each undirected edge in them. All lists have
/// the same number of buckets.
template <class Pairs>
void match_buckets(std::span<const EdgeBuckets* const> lists, std::size_t buckets, Pairs& pairs) {
    const auto match_bucket = [&](std::size_t bucket, std::size_t) {
        std::size_t size = 0;
        for (const EdgeBuckets* list : lists) size += list->start[bucket + 1] - list->start[bucket];
        TwoWayEdgeList edges(size);
        for (const EdgeBuckets* list : lists)
            for (std::size_t i = list->start[bucket]; i < list->start[bucket + 1]; ++i)
                edges.add(list->edges[i].origin, list->edges[i].target, list->edges[i].number);
        EdgeMatches matches;
        match(edges, pairs.twin, matches);
        return matches;
    };
    for (const EdgeMatches& matches : core::parallel_blocks(buckets, 1, match_bucket)) append_matches(pairs, matches);
    std::sort(pairs.boundary.begin(), pairs.boundary.end());
    std::sort(pairs.overused.begin(), pairs.overused.end());
}

}  // namespace

Adjacency find_adjacency(const Mesh& mesh) {
    const CellEdges cell_edges(mesh);
    const std::size_t cells = cell_edges.cells();
    if (cell_edges.size() >= no_edge) throw MeshError("mesh too large: more than 2^32 edges of cells");
    const core::UninitializedArray<std::uint32_t> owners = vertex_owners(mesh, cells);
    Adjacency adjacency;
    adjacency.twin = core::UninitializedArray<std::uint32_t>(cell_edges.size());

    const std::size_t buckets = bucket_count(cells);
    const auto match_block = [&](std::size_t begin, std::size_t end) {
        TwoWayEdgeList within(cell_edges.first(end) - cell_edges.first(begin));
        std::vector<SharedEdge> between;
        for_each_edge(mesh, begin, end, [&](std::size_t e, VertexId a, VertexId b) {
            if (owners[a.index()] == shared && owners[b.index()] == shared)
                between.push_back({a, b, static_cast<std::uint32_t>(e)});
            else
                within.add(a, b, e);
        });
        BlockMatches result{{}, sort_into_buckets(between, buckets)};
        match(within, adjacency.twin, result.matches);
        return result;
    };
    const std::vector<BlockMatches> blocks = core::parallel_blocks(cells, cells_per_block, match_block);
    std::vector<const EdgeBuckets*> between;
    for (const BlockMatches& block : blocks) {
        append_matches(adjacency, block.matches);
        between.push_back(&block.between);
    }
    match_buckets(between, buckets, adjacency);
    adjacency.orphans = find_orphans(owners);
    return adjacency;
}

EdgePairs pair_edges(std::span<const Segment> edges) {
    if (edges.size() >= no_edge) throw MeshError("mesh too large: more than 2^32 edges between pieces");
    std::vector<SharedEdge> all(edges.size());
    for (std::size_t e = 0; e < edges.size(); ++e) all[e] = {edges[e].a, edges[e].b, static_cast<std::uint32_t>(e)};
    const std::size_t buckets = bucket_count(edges.size());
    const EdgeBuckets sorted = sort_into_buckets(all, buckets);
    EdgePairs pairs;
    pairs.twin = core::UninitializedArray<std::uint32_t>(edges.size());
    const EdgeBuckets* const lists[] = {&sorted};
    match_buckets(lists, buckets, pairs);
    return pairs;
}

std::vector<std::uint32_t> find_edges(const Mesh& mesh, std::span<const Segment> segments) {
    if (segments.empty()) return {};
    const auto ends_of = [&](std::size_t i) { return std::minmax(segments[i].a, segments[i].b); };
    std::vector<std::uint32_t> order(segments.size()), found(segments.size(), no_edge);
    std::iota(order.begin(), order.end(), 0u);
    std::sort(order.begin(), order.end(), [&](std::uint32_t i, std::uint32_t j) { return ends_of(i) < ends_of(j); });
    std::vector<std::uint8_t> is_end(mesh.points.size(), 0);
    for (const Segment& s : segments) is_end[s.a.index()] = is_end[s.b.index()] = 1;

    struct FoundEdge {
        std::uint32_t edge;
        std::size_t rank;  ///< position in `order` of the first segment with these ends
    };
    const auto find_in_block = [&](std::size_t begin, std::size_t end) {
        std::vector<FoundEdge> edges;
        for_each_edge(mesh, begin, end, [&](std::size_t e, VertexId a, VertexId b) {
            if (!is_end[a.index()] || !is_end[b.index()]) return;
            const auto ends = std::minmax(a, b);
            const auto at =
                std::partition_point(order.begin(), order.end(), [&](std::uint32_t i) { return ends_of(i) < ends; });
            if (at != order.end() && ends_of(*at) == ends)
                edges.push_back({static_cast<std::uint32_t>(e), static_cast<std::size_t>(at - order.begin())});
        });
        return edges;
    };
    for (const std::vector<FoundEdge>& edges :
         core::parallel_blocks(CellEdges(mesh).cells(), cells_per_block, find_in_block))
        for (const auto [edge, rank] : edges)
            for (std::size_t i = rank; i < order.size() && ends_of(order[i]) == ends_of(order[rank]); ++i)
                found[order[i]] = std::min(found[order[i]], edge);
    return found;
}

}  // namespace lamina::mesh
