#include "mesh/adjacency.hpp"

#include <algorithm>
#include <atomic>

#include <lamina/error.hpp>

#include "core/parallel.hpp"

namespace lamina::detail {

namespace {

constexpr std::size_t cell_grain = 1 << 14;
constexpr std::size_t vertex_grain = 1 << 14;

/// Counts where several threads may come at once; plain where they cannot, since locked additions cost.
std::uint32_t fetch_increment(std::uint32_t& count, bool shared) {
    return shared ? std::atomic_ref(count).fetch_add(1, std::memory_order_relaxed) : count++;
}

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

/// Counting sort of the directed edges by their smaller vertex.
void sort_by_smaller_vertex(const Mesh& mesh, Adjacency& adjacency, std::vector<std::uint8_t>& used) {
    const std::size_t cells = mesh.triangles.size() + mesh.quads.size();
    const bool shared = thread_count() > 1;
    auto& start = adjacency.start;
    start.assign(mesh.points.size() + 2, 0);
    parallel_for(cells, cell_grain, [&](std::size_t begin, std::size_t end) {
        for_each_edge(mesh, begin, end, [&](std::size_t, VertexId a, VertexId b) {
            fetch_increment(start[std::min(a, b).index() + 2], shared);
            std::atomic_ref(used[a.index()]).store(1, std::memory_order_relaxed);
        });
    });
    for (std::size_t v = 2; v < start.size(); ++v) start[v] += start[v - 1];
    adjacency.entries.resize(CellEdges(mesh).size());
    // start[v + 1] runs through the entries of v and ends as the start of v + 1.
    parallel_for(cells, cell_grain, [&](std::size_t begin, std::size_t end) {
        for_each_edge(mesh, begin, end, [&](std::size_t e, VertexId a, VertexId b) {
            const auto [low, high] = std::minmax(a, b);
            const std::uint32_t slot = fetch_increment(start[low.index() + 1], shared);
            adjacency.entries[slot] = std::uint64_t{high.value} << 32 | e << 1 | (a > b);
        });
    });
    start.pop_back();
}

struct Matches {
    std::vector<std::uint32_t> boundary, overused;
    std::vector<VertexId> orphans;
    std::size_t edges = 0;
};

/// The entries of one undirected edge, first..last: twins, a boundary edge, or a defect.
void match(const std::uint64_t* first, const std::uint64_t* last, std::vector<std::uint32_t>& twin, Matches& matches) {
    const auto edge = [](std::uint64_t entry) { return static_cast<std::uint32_t>(entry) >> 1; };
    ++matches.edges;
    if (last - first == 1) {
        matches.boundary.push_back(edge(first[0]));
    } else if (last - first == 2 && (first[0] & 1) != (first[1] & 1)) {
        twin[edge(first[0])] = edge(first[1]);
        twin[edge(first[1])] = edge(first[0]);
    } else {
        for (const std::uint64_t* entry = first; entry != last; ++entry) matches.overused.push_back(edge(*entry));
    }
}

}  // namespace

std::uint32_t Adjacency::find(VertexId a, VertexId b) const {
    const auto first = entries.begin() + start[a.index()], last = entries.begin() + start[a.index() + 1];
    const auto entry = std::lower_bound(first, last, std::uint64_t{b.value} << 32);
    return entry != last && *entry >> 32 == b.value ? static_cast<std::uint32_t>(*entry) >> 1 : no_edge;
}

Adjacency find_adjacency(const Mesh& mesh) {
    const std::size_t edge_count = CellEdges(mesh).size();
    if (edge_count > std::size_t{1} << 31) throw MeshError("mesh too large to check: more than 2^31 edges of cells");
    Adjacency adjacency;
    std::vector<std::uint8_t> used(mesh.points.size(), 0);
    sort_by_smaller_vertex(mesh, adjacency, used);
    adjacency.twin.assign(edge_count, no_edge);

    const auto match_edges_of = [&](std::size_t begin, std::size_t end) {
        Matches matches;
        for (std::size_t v = begin; v < end; ++v) {
            if (!used[v]) matches.orphans.emplace_back(v);
            std::uint64_t* const first = adjacency.entries.data() + adjacency.start[v];
            std::uint64_t* const last = adjacency.entries.data() + adjacency.start[v + 1];
            std::sort(first, last);  // also undoes any order in which threads came
            for (std::uint64_t *group = first, *next = first; group != last; group = next) {
                while (next != last && *next >> 32 == *group >> 32) ++next;
                match(group, next, adjacency.twin, matches);
            }
        }
        return matches;
    };
    for (const Matches& m : parallel_blocks(mesh.points.size(), vertex_grain, match_edges_of)) {
        adjacency.boundary.insert(adjacency.boundary.end(), m.boundary.begin(), m.boundary.end());
        adjacency.overused.insert(adjacency.overused.end(), m.overused.begin(), m.overused.end());
        adjacency.orphans.insert(adjacency.orphans.end(), m.orphans.begin(), m.orphans.end());
        adjacency.edges += m.edges;
    }
    std::sort(adjacency.boundary.begin(), adjacency.boundary.end());
    std::sort(adjacency.overused.begin(), adjacency.overused.end());
    return adjacency;
}

}  // namespace lamina::detail
