// find_adjacency(), find_edges() and the survey of edges against a map of all edges, on whole and damaged meshes of
// several blocks.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <mutex>
#include <optional>
#include <random>
#include <span>
#include <utility>
#include <vector>

#include "core/parallel.hpp"
#include "mesh/adjacency.hpp"
#include "mesh/edge_survey.hpp"
#include "support/sample_meshes.hpp"

namespace lamina {
namespace {

using mesh::Adjacency;
using mesh::CellEdges;
using mesh::no_edge;

struct Expected {
    std::vector<std::uint32_t> twin, boundary, overused;
    std::vector<VertexId> orphans;
    std::map<std::pair<VertexId, VertexId>, std::vector<std::uint32_t>> users;
};

Expected adjacency_by_map(const Mesh& mesh) {
    const CellEdges edges(mesh);
    Expected expected;
    std::vector<bool> used(mesh.points.size(), false);
    for (std::uint32_t e = 0; e < edges.size(); ++e) {
        const VertexId a = edges.origin(e), b = edges.target(e);
        used[a.index()] = true;
        expected.users[std::pair(std::min(a, b), std::max(a, b))].push_back(e);
    }
    expected.twin.assign(edges.size(), no_edge);
    for (const auto& [_, users] : expected.users) {
        if (users.size() == 1) {
            expected.boundary.push_back(users[0]);
        } else if (users.size() == 2 && edges.origin(users[0]) == edges.target(users[1])) {
            expected.twin[users[0]] = users[1];
            expected.twin[users[1]] = users[0];
        } else {
            expected.overused.insert(expected.overused.end(), users.begin(), users.end());
        }
    }
    std::sort(expected.boundary.begin(), expected.boundary.end());
    std::sort(expected.overused.begin(), expected.overused.end());
    for (std::size_t v = 0; v < used.size(); ++v)
        if (!used[v]) expected.orphans.emplace_back(v);
    return expected;
}

/// Runs a survey in so much memory, and returns how often it has read the cells.
std::size_t expect_survey(const Mesh& mesh, const Expected& expected, std::optional<std::size_t> max_bytes) {
    const CellEdges edges(mesh);
    mesh::EdgeSurvey survey(mesh, max_bytes, 1 << 16);
    std::vector<std::uint32_t> twin(edges.size(), no_edge);
    const auto set = [&](mesh::EdgePair pair) {
        EXPECT_LT(pair.edge, pair.twin);
        EXPECT_EQ(twin[pair.edge], no_edge);
        twin[pair.edge] = pair.twin;
        twin[pair.twin] = pair.edge;
    };
    core::parallel_for(edges.cells(), mesh::cells_per_block, [&](std::size_t begin, std::size_t end) {
        std::vector<std::uint32_t> within;
        survey.match_block(begin, end, within);
        const auto first = static_cast<std::uint32_t>(edges.first(begin));
        for (std::uint32_t e = 0; e < within.size(); ++e)
            if (within[e] != no_edge && within[e] > e) set({first + e, first + within[e]});
    });
    std::mutex mutex;
    survey.match_between([&](std::span<const mesh::EdgePair> pairs) {
        const std::lock_guard lock(mutex);
        for (const mesh::EdgePair pair : pairs) set(pair);
    });
    const mesh::EdgeTotals totals = survey.take_totals();
    EXPECT_EQ(twin, expected.twin);
    EXPECT_EQ(totals.boundary, expected.boundary);
    EXPECT_EQ(totals.overused, expected.overused);
    EXPECT_EQ(totals.orphans, expected.orphans);
    EXPECT_EQ(totals.edges, expected.users.size());
    return survey.passes();
}

void expect_agreement(const Mesh& mesh) {
    const Expected expected = adjacency_by_map(mesh);
    for (const unsigned threads : {1u, 4u})
        with_threads(threads, [&] {
            const Adjacency adjacency = mesh::find_adjacency(mesh);
            EXPECT_TRUE(
                std::equal(adjacency.twin.begin(), adjacency.twin.end(), expected.twin.begin(), expected.twin.end()));
            EXPECT_EQ(adjacency.boundary, expected.boundary);
            EXPECT_EQ(adjacency.overused, expected.overused);
            EXPECT_EQ(adjacency.orphans, expected.orphans);
            EXPECT_EQ(adjacency.edges, expected.users.size());

            EXPECT_EQ(expect_survey(mesh, expected, {}), 1u);
            expect_survey(mesh, expected, 20000);

            std::vector<Segment> segments;
            std::vector<std::uint32_t> lowest;
            for (const auto& [ends, users] : expected.users) {
                if (users.front() % 7 != 0) continue;
                segments.push_back(users.front() % 2 == 0 ? Segment{ends.first, ends.second}
                                                          : Segment{ends.second, ends.first});
                lowest.push_back(users.front());
            }
            segments.push_back({VertexId{0}, VertexId{0}});
            lowest.push_back(no_edge);
            EXPECT_EQ(mesh::find_edges(mesh, segments), lowest);
            const std::vector<mesh::EdgePair> pairs = mesh::find_pairs(mesh, segments);
            for (std::size_t i = 0; i < pairs.size(); ++i)
                EXPECT_EQ(pairs[i].twin, lowest[i] == no_edge ? no_edge : expected.twin[lowest[i]]);
        });
}

/// Meshes whose cells make several blocks.
std::vector<Mesh> large_meshes() {
    const test::AnnulusOptions options{.around = 600, .rings = 25, .layer_rings = 5};
    test::AnnulusOptions with_quads = options;
    with_quads.quads_in_layer = true;
    return {test::annulus(options), test::annulus(with_quads), test::shuffled(test::annulus(with_quads), 1)};
}

TEST(Adjacency, AgreesWithAMapOfAllEdges) {
    expect_agreement(test::annulus({.around = 5, .rings = 1, .layer_rings = 0}));
    for (const Mesh& mesh : large_meshes()) expect_agreement(mesh);
    Mesh wheel;  // all edges that are not on its boundary have one end in common
    constexpr std::size_t spokes = 30000;
    wheel.points.resize(spokes + 1);
    for (std::size_t i = 0; i < spokes; ++i)
        wheel.triangles.push_back({{VertexId{0}, VertexId{1 + i}, VertexId{1 + (i + 1) % spokes}}});
    expect_agreement(wheel);
}

TEST(Adjacency, ReadsCellsSeveralTimesWhereMemoryIsShort) {
    const Mesh mesh = test::shuffled(large_meshes().front(), 1);
    EXPECT_GT(expect_survey(mesh, adjacency_by_map(mesh), 4 * mesh.points.size()), 3u);
}

TEST(Adjacency, FindsEveryDefect) {
    std::mt19937 random(5);
    for (Mesh mesh : large_meshes()) {
        const std::size_t n = mesh.triangles.size();
        const auto any = [&] { return random() % n; };
        mesh.points.push_back({9, 9});  // belongs to no cell
        for (int i = 0; i < 40; ++i) {
            mesh.triangles.push_back(mesh.triangles[any()]);  // the same triangle twice, far apart
            // Folds: edges with two cells on one side.
            std::swap(mesh.triangles[any()].v[0], mesh.triangles[any()].v[1]);
            std::swap(mesh.triangles[any()], mesh.triangles.back());
        }
        for (int i = 0; i < 40; ++i) mesh.triangles.erase(mesh.triangles.begin() + std::ptrdiff_t(any() / 2));
        expect_agreement(mesh);
    }
    // Every cell is there twice, and the copies lie in other blocks.
    Mesh twice = test::annulus({.around = 600, .rings = 25});
    twice.triangles.insert(twice.triangles.end(), twice.triangles.begin(), twice.triangles.end());
    expect_agreement(twice);
}

}  // namespace
}  // namespace lamina
