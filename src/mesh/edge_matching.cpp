#include "mesh/edge_matching.hpp"

#include <bit>

#include "core/parallel.hpp"

namespace lamina::mesh {

namespace {

constexpr std::size_t vertex_grain = 1 << 16;

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

}  // namespace

core::UninitializedArray<std::uint32_t> vertex_owners(const MeshView& mesh, std::size_t cells) {
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

void match(const TwoWayEdgeList& list, std::span<std::uint32_t> twin, EdgeMatches& matches) {
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

EdgeBuckets sort_into_buckets(std::span<const SharedEdge> edges, std::size_t count, std::size_t first,
                              std::size_t last) {
    const auto bucket = [&](const SharedEdge& e) { return bucket_of(e.origin, e.target, count) - first; };
    EdgeBuckets buckets{std::vector<SharedEdge>(edges.size()), std::vector<std::uint32_t>(last - first + 2, 0)};
    for (const SharedEdge& e : edges) ++buckets.start[bucket(e) + 2];
    for (std::size_t k = 2; k < buckets.start.size(); ++k) buckets.start[k] += buckets.start[k - 1];
    // start[k + 1] runs through bucket k and ends as the start of bucket k + 1.
    for (const SharedEdge& e : edges) buckets.edges[buckets.start[bucket(e) + 1]++] = e;
    buckets.start.pop_back();
    return buckets;
}

std::size_t bucket_count(std::size_t cells) {
    constexpr std::size_t cells_per_bucket = 1 << 17, max_buckets = 256;
    return std::min(cells / cells_per_bucket + 1, max_buckets);
}

}  // namespace lamina::mesh
