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

/// Cells a block: what matching their edges takes stays in the second-level cache.
constexpr std::size_t block_cells = 1 << 13;
constexpr std::size_t vertex_grain = 1 << 16;

/// f(edge, origin, target) for the edges of the cells [begin, end).
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

// --- Which block a vertex belongs to, if to one alone.

constexpr std::uint32_t unclaimed = 0xffffffff, shared = 0xfffffffe;

void claim(std::uint32_t& owner, std::uint32_t block, bool concurrently) {
    // Plain where no other thread can come: locked exchanges cost.
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

/// For each vertex the block of all its cells, `shared` between blocks, or `unclaimed` by any cell.
core::UninitializedArray<std::uint32_t> vertex_owners(const Mesh& mesh, std::size_t cells) {
    core::UninitializedArray<std::uint32_t> owners(mesh.points.size());
    core::parallel_for(owners.size(), vertex_grain, [&](std::size_t begin, std::size_t end) {
        std::fill(owners.begin() + begin, owners.begin() + end, unclaimed);
    });
    const bool concurrently = thread_count() > 1;
    core::parallel_for(cells, block_cells, [&](std::size_t begin, std::size_t end) {
        const auto block = static_cast<std::uint32_t>(begin / block_cells);
        for_each_edge(mesh, begin, end,
                      [&](std::size_t, VertexId a, VertexId) { claim(owners[a.index()], block, concurrently); });
    });
    return owners;
}

// --- Matching a list of edges.

/// An edge of a cell, without its direction.
struct Edge {
    VertexId low, high;  ///< its ends, low <= high
    std::uint32_t number = no_edge;
};

bool same_ends(const Edge& a, const Edge& b) { return a.low == b.low && a.high == b.high; }

/// Edges that go up, from their lower vertex, at the front, the others at the back: cells of one orientation use an
/// edge once each way. Sorted in without a branch, which would be guessed wrong half of the time.
class EdgeList {
public:
    explicit EdgeList(std::size_t most) : edges_(most) {}

    std::size_t most() const { return edges_.size(); }
    /// Precondition: fewer than `most` so far.
    void add(VertexId origin, VertexId target, std::size_t number) {
        const std::uint32_t up = origin.value < target.value;
        const std::uint32_t flip = (origin.value ^ target.value) & (up - 1);
        edges_[ups_] = edges_[edges_.size() - 1 - downs_] = {
            VertexId{origin.value ^ flip}, VertexId{target.value ^ flip}, static_cast<std::uint32_t>(number)};
        ups_ += up;
        downs_ += 1 - up;
    }
    const Edge& operator[](std::size_t i) const { return edges_[i]; }
    bool is_up(std::size_t i) const { return i < ups_; }
    /// All edges, those that go up first: for (i = begin(); i < end(); i = after(i)).
    std::size_t begin() const { return after(std::size_t(-1)); }
    std::size_t end() const { return edges_.size(); }
    std::size_t after(std::size_t i) const { return i + 1 == ups_ ? edges_.size() - downs_ : i + 1; }

private:
    core::UninitializedArray<Edge> edges_;
    std::size_t ups_ = 0, downs_ = 0;
};

struct Matches {
    std::vector<std::uint32_t> boundary, overused;
    std::size_t edges = 0;
};

/// Finds the twins in a list that holds all directed edges of every undirected edge in it.
void match(const EdgeList& list, core::UninitializedArray<std::uint32_t>& twin, Matches& matches) {
    constexpr std::uint32_t empty = 0xffffffff, crowded = 0x80000000;  // crowded: more cells than two, or on one side
    const std::size_t mask = std::bit_ceil(list.most() + list.most() / 3 + 8) - 1;
    std::vector<std::uint32_t> table(mask + 1, empty);  // the first edge of each undirected edge
    const auto slot_of = [&](const Edge& e) -> std::uint32_t& {
        // Successive vertices have successive rows of 8 slots: neighbours, numbered alike, share cache lines. Edges of
        // one vertex part at once where they meet: a hub may have all of them.
        const std::uint32_t row = e.low.value ^ (e.low.value >> 12) * 0x9e3779b1u, hash = e.high.value * 0x85ebca6bu;
        const std::size_t step = hash >> 8 | 1;
        std::size_t slot = (std::size_t{row} * 8 + (hash >> 29)) & mask;
        while (table[slot] != empty && !same_ends(list[table[slot] & ~crowded], e)) slot = (slot + step) & mask;
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
        if (!(slot & crowded) && others_twin == no_edge && list.is_up(first) && !list.is_up(i)) {
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

// --- Blocks of cells first, then what lies between them.

struct DirectedEdge {
    VertexId origin, target;
    std::uint32_t number = no_edge;
};

/// Edges whose ends are both shared between blocks, dealt by their ends: bucket k is [start[k], start[k + 1]).
struct Dealt {
    std::vector<DirectedEdge> edges;
    std::vector<std::uint32_t> start;
};

Dealt deal(std::span<const DirectedEdge> edges, std::size_t buckets) {
    const auto bucket_of = [&](const DirectedEdge& e) {
        const std::uint32_t hash = (e.origin.value ^ e.target.value) * 0x9e3779b1u;
        return std::uint64_t{hash} * buckets >> 32;
    };
    Dealt dealt{std::vector<DirectedEdge>(edges.size()), std::vector<std::uint32_t>(buckets + 2, 0)};
    for (const DirectedEdge& e : edges) ++dealt.start[bucket_of(e) + 2];
    for (std::size_t k = 2; k < dealt.start.size(); ++k) dealt.start[k] += dealt.start[k - 1];
    // start[k + 1] runs through bucket k and ends as the start of k + 1.
    for (const DirectedEdge& e : edges) dealt.edges[dealt.start[bucket_of(e) + 1]++] = e;
    dealt.start.pop_back();
    return dealt;
}

struct BlockResult {
    Matches matches;
    Dealt between;
};

void append(std::vector<std::uint32_t>& all, const std::vector<std::uint32_t>& part) {
    all.insert(all.end(), part.begin(), part.end());
}

void append(Adjacency& adjacency, const Matches& matches) {
    append(adjacency.boundary, matches.boundary);
    append(adjacency.overused, matches.overused);
    adjacency.edges += matches.edges;
}

}  // namespace

Adjacency find_adjacency(const Mesh& mesh) {
    const CellEdges cell_edges(mesh);
    const std::size_t cells = cell_edges.cells();
    if (cell_edges.size() >= no_edge) throw MeshError("mesh too large: more than 2^32 edges of cells");
    const core::UninitializedArray<std::uint32_t> owners = vertex_owners(mesh, cells);
    Adjacency adjacency;
    adjacency.twin = core::UninitializedArray<std::uint32_t>(cell_edges.size());

    constexpr std::size_t cells_a_bucket = 1 << 17, most_buckets = 256;
    const std::size_t buckets = std::min(cells / cells_a_bucket + 1, most_buckets);
    const auto match_block = [&](std::size_t begin, std::size_t end) {
        EdgeList within(cell_edges.first(end) - cell_edges.first(begin));
        std::vector<DirectedEdge> between;
        for_each_edge(mesh, begin, end, [&](std::size_t e, VertexId a, VertexId b) {
            if (owners[a.index()] == shared && owners[b.index()] == shared)
                between.push_back({a, b, static_cast<std::uint32_t>(e)});
            else
                within.add(a, b, e);
        });
        BlockResult result{{}, deal(between, buckets)};
        match(within, adjacency.twin, result.matches);
        return result;
    };
    const std::vector<BlockResult> blocks = core::parallel_blocks(cells, block_cells, match_block);
    for (const BlockResult& block : blocks) append(adjacency, block.matches);

    const auto match_bucket = [&](std::size_t bucket, std::size_t) {
        std::size_t most = 0;
        for (const auto& [_, between] : blocks) most += between.start[bucket + 1] - between.start[bucket];
        EdgeList edges(most);
        for (const auto& [_, between] : blocks)
            for (std::size_t i = between.start[bucket]; i < between.start[bucket + 1]; ++i)
                edges.add(between.edges[i].origin, between.edges[i].target, between.edges[i].number);
        Matches matches;
        match(edges, adjacency.twin, matches);
        return matches;
    };
    for (const Matches& matches : core::parallel_blocks(buckets, 1, match_bucket)) append(adjacency, matches);

    const auto orphans_among = [&](std::size_t begin, std::size_t end) {
        std::vector<VertexId> orphans;
        for (std::size_t v = begin; v < end; ++v)
            if (owners[v] == unclaimed) orphans.emplace_back(v);
        return orphans;
    };
    for (const auto& orphans : core::parallel_blocks(owners.size(), vertex_grain, orphans_among))
        adjacency.orphans.insert(adjacency.orphans.end(), orphans.begin(), orphans.end());
    std::sort(adjacency.boundary.begin(), adjacency.boundary.end());
    std::sort(adjacency.overused.begin(), adjacency.overused.end());
    return adjacency;
}

std::vector<std::uint32_t> find_edges(const Mesh& mesh, std::span<const Segment> segments) {
    if (segments.empty()) return {};
    const auto undirected = [&](std::size_t i) { return std::minmax(segments[i].a, segments[i].b); };
    std::vector<std::uint32_t> order(segments.size()), found(segments.size(), no_edge);
    std::iota(order.begin(), order.end(), 0u);
    std::sort(order.begin(), order.end(),
              [&](std::uint32_t i, std::uint32_t j) { return undirected(i) < undirected(j); });
    std::vector<std::uint8_t> sought(mesh.points.size(), 0);
    for (const Segment& s : segments) sought[s.a.index()] = sought[s.b.index()] = 1;

    struct Hit {
        std::uint32_t edge;
        std::size_t place;  // first in order
    };
    const auto hits_of = [&](std::size_t begin, std::size_t end) {
        std::vector<Hit> hits;
        for_each_edge(mesh, begin, end, [&](std::size_t e, VertexId a, VertexId b) {
            if (!sought[a.index()] || !sought[b.index()]) return;
            const auto key = std::minmax(a, b);
            const auto at =
                std::partition_point(order.begin(), order.end(), [&](std::uint32_t i) { return undirected(i) < key; });
            if (at != order.end() && undirected(*at) == key)
                hits.push_back({static_cast<std::uint32_t>(e), static_cast<std::size_t>(at - order.begin())});
        });
        return hits;
    };
    for (const std::vector<Hit>& hits : core::parallel_blocks(CellEdges(mesh).cells(), block_cells, hits_of))
        for (const auto [edge, place] : hits)
            for (std::size_t i = place; i < order.size() && undirected(order[i]) == undirected(order[place]); ++i)
                found[order[i]] = std::min(found[order[i]], edge);
    return found;
}

}  // namespace lamina::mesh
