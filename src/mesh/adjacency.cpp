#include "mesh/adjacency.hpp"

#include <algorithm>
#include <numeric>
#include <span>
#include <utility>

#include <lamina/error.hpp>

#include "core/parallel.hpp"
#include "mesh/edge_matching.hpp"

namespace lamina::mesh {

namespace {

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

template <class Pairs>
void sort_matches(Pairs& pairs) {
    std::sort(pairs.boundary.begin(), pairs.boundary.end());
    std::sort(pairs.overused.begin(), pairs.overused.end());
}

/// Finds the twins in all buckets, which together hold all directed edges of each undirected edge in them. All lists
/// have the same number of buckets.
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
        match(edges, {pairs.twin.data(), pairs.twin.size()}, matches);
        return matches;
    };
    for (const EdgeMatches& matches : core::parallel_blocks(buckets, 1, match_bucket)) append_matches(pairs, matches);
    sort_matches(pairs);
}

}  // namespace

Adjacency find_adjacency(const MeshView& mesh) {
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
        BlockMatches result{{}, sort_into_buckets(between, buckets, 0, buckets)};
        match(within, {adjacency.twin.data(), adjacency.twin.size()}, result.matches);
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
    EdgePairs pairs;
    pairs.twin = core::UninitializedArray<std::uint32_t>(edges.size());
    const std::size_t buckets = bucket_count(edges.size());
    if (buckets == 1) {
        // Few edges need no copies in buckets, which would take longer than the search.
        TwoWayEdgeList list(edges.size());
        for (std::size_t e = 0; e < edges.size(); ++e) list.add(edges[e].a, edges[e].b, static_cast<std::uint32_t>(e));
        EdgeMatches matches;
        match(list, {pairs.twin.data(), pairs.twin.size()}, matches);
        append_matches(pairs, matches);
        sort_matches(pairs);
        return pairs;
    }
    std::vector<SharedEdge> all(edges.size());
    for (std::size_t e = 0; e < edges.size(); ++e) all[e] = {edges[e].a, edges[e].b, static_cast<std::uint32_t>(e)};
    const EdgeBuckets sorted = sort_into_buckets(all, buckets, 0, buckets);
    const EdgeBuckets* const lists[] = {&sorted};
    match_buckets(lists, buckets, pairs);
    return pairs;
}

std::vector<EdgePair> find_pairs(const MeshView& mesh, std::span<const Segment> segments) {
    if (segments.empty()) return {};
    const auto ends_of = [&](std::size_t i) { return std::minmax(segments[i].a, segments[i].b); };
    std::vector<std::uint32_t> order(segments.size());
    std::iota(order.begin(), order.end(), 0u);
    std::sort(order.begin(), order.end(), [&](std::uint32_t i, std::uint32_t j) { return ends_of(i) < ends_of(j); });
    std::vector<bool> is_end(mesh.points.size(), false);
    for (const Segment& s : segments) is_end[s.a.index()] = is_end[s.b.index()] = true;

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
    const CellEdges edges(mesh);
    std::vector<EdgePair> pairs(segments.size());          // per rank
    std::vector<std::uint32_t> users(segments.size(), 0);  // likewise: the number of directed edges
    for (const std::vector<FoundEdge>& found : core::parallel_blocks(edges.cells(), cells_per_block, find_in_block))
        for (const auto [edge, rank] : found) {
            EdgePair& pair = pairs[rank];
            if (++users[rank] == 1)
                pair.edge = edge;
            else if (users[rank] == 2 && edges.origin(edge) == edges.target(pair.edge) &&
                     edges.origin(edge) != edges.target(edge))
                pair.twin = edge;
            else
                pair.twin = no_edge;
        }
    std::vector<EdgePair> result(segments.size());
    for (std::size_t rank = 0, i = 0; i < order.size(); ++i) {
        if (ends_of(order[i]) != ends_of(order[rank])) rank = i;
        result[order[i]] = pairs[rank];
    }
    return result;
}

std::vector<std::uint32_t> find_edges(const MeshView& mesh, std::span<const Segment> segments) {
    std::vector<std::uint32_t> edges;
    edges.reserve(segments.size());
    for (const EdgePair& pair : find_pairs(mesh, segments)) edges.push_back(pair.edge);
    return edges;
}

}  // namespace lamina::mesh
