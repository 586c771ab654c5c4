// Constrained triangulation in pieces: the same as at once, on any number of threads.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <lamina/delaunay.hpp>
#include <lamina/error.hpp>
#include <lamina/threads.hpp>

#include "delaunay/pieces/line_partition.hpp"
#include "delaunay/triangulate/triangulate_points.hpp"
#include "support/constrained_cases.hpp"
#include "support/point_sets.hpp"
#include "support/triangulation_checks.hpp"

namespace lamina::test {
namespace {

const DecompositionOptions in_one_piece{.depth = 0}, in_many_pieces{.depth = 6, .leaf_vertices = 20};

ConstrainedTriangulation triangulated(const ConstrainedCase& c, ConstrainedOptions options,
                                      const DecompositionOptions& decomposition) {
    options.decomposition = decomposition;
    return triangulate(c.points, c.segments, options);
}

/// Compares all but the order of the triangles.
void expect_same_as_whole(const ConstrainedCase& c, const ConstrainedOptions& options = {},
                          const DecompositionOptions& decomposition = in_many_pieces) {
    const ConstrainedTriangulation expected = triangulated(c, options, in_one_piece),
                                   t = triangulated(c, options, decomposition);
    EXPECT_EQ(canonical(t.triangles), canonical(expected.triangles));
    EXPECT_EQ(t.segments, expected.segments);
    EXPECT_EQ(t.parents, expected.parents);
    EXPECT_EQ(t.steiner_points, expected.steiner_points);
    EXPECT_EQ(t.repeated_segments, expected.repeated_segments);
    EXPECT_EQ(t.zero_length_segments, expected.zero_length_segments);
    EXPECT_EQ(expected.decomposition.pieces, 1u);
}

/// Returns a lattice with chains of segments of all lengths along its lines, which run through points and overlap.
ConstrainedCase overlapping_case(std::uint64_t seed) {
    constexpr int side = 40;
    ConstrainedCase c{square_lattice(side, side), {}};
    Random random(seed);
    for (int i = 0; i < 300; ++i) {
        const std::size_t row = random.below(side), from = random.below(side), to = random.below(side);
        c.segments.push_back({VertexId{row * side + from}, VertexId{row * side + to}});
    }
    return c;
}

ConstrainedCase star_case(std::size_t n) {
    ConstrainedCase c{random_points(n, 3), {}};
    for (std::size_t i = 1; i < n; i += 2) c.segments.push_back({VertexId{0u}, VertexId{i}});
    return c;
}

/// Returns random points between long lines from one side to the other.
ConstrainedCase ruled_case(std::size_t n, int lines = 20) {
    ConstrainedCase c{random_points(n, 5), {}};
    for (int i = 0; i < lines; ++i) {
        const std::size_t first = c.points.size();
        c.points.push_back({-0.1, (i + 0.26) / lines});
        c.points.push_back({1.1, (i + 0.4) / lines});
        c.segments.push_back({VertexId{first}, VertexId{first + 1}});
    }
    return c;
}

/// Returns nested closed rings.
ConstrainedCase rings_case() {
    ConstrainedCase c;
    for (int ring = 1; ring <= 12; ++ring) {
        const std::size_t first = c.points.size(), n = 120;
        for (std::size_t i = 0; i < n; ++i) {
            const double angle = 2 * 3.14159 * static_cast<double>(i) / static_cast<double>(n);
            c.points.push_back({ring * std::cos(angle), ring * std::sin(angle)});
            c.segments.push_back({VertexId{first + i}, VertexId{first + (i + 1) % n}});
        }
    }
    return c;
}

/// Returns a case with every point twice, and segments between either of the two.
ConstrainedCase twofold(ConstrainedCase c) {
    const std::vector<Point> copies = c.points;
    const std::size_t half = copies.size();
    c.points.resize(7);
    c.points.insert(c.points.end(), copies.begin(), copies.end());
    c.points.insert(c.points.end(), copies.begin() + 7, copies.end());
    Random random(9);
    for (Segment& s : c.segments)
        for (VertexId* v : {&s.a, &s.b}) {
            // The copy of point i stands at 7 + i; the points from 7 on have moved up.
            const std::size_t i = v->index(), copy = 7 + i, moved = i < 7 ? i : i + half;
            *v = VertexId{random.below(2) == 0 ? copy : moved};
        }
    return c;
}

TEST(ConstrainedPieces, MakeTheTriangulationOfTheWhole) {
    for (const std::size_t one_edge_in : {1u, 3u, 30u}) expect_same_as_whole(stretched_edges_case(3000, one_edge_in));
    for (const std::uint64_t seed : {1u, 2u, 3u}) expect_same_as_whole(overlapping_case(seed));
    expect_same_as_whole(star_case(2000));
    for (const int lines : {5, 20, 700}) expect_same_as_whole(ruled_case(2000, lines));
    expect_same_as_whole(rings_case());
    for (const unsigned depth : {1u, 2u, 3u, 8u})
        expect_same_as_whole(stretched_edges_case(3000, 4), {}, {.depth = depth, .leaf_vertices = 5});
    const ConstrainedCase c = stretched_edges_case(3000, 3);
    const ConstrainedTriangulation t = triangulated(c, {}, in_many_pieces);
    EXPECT_GT(t.decomposition.pieces, 30u);
    expect_valid(c.points, t.triangles, t.segments);
}

/// Returns a hub with segments to all others, where a third of the points have the distance of the one before.
ConstrainedCase hub_case(std::size_t n, Point hub) {
    ConstrainedCase c;
    Random random(5);
    c.points.push_back(hub);
    double radius = 1;
    for (std::size_t i = 1; i < n; ++i) {
        if (i % 3 != 0) radius = random.real(0.1, 1);
        const double angle = 6.28 * static_cast<double>(i) / static_cast<double>(n);
        c.points.push_back(hub + radius * Point{std::cos(angle), std::sin(angle)});
        c.segments.push_back({VertexId{0u}, VertexId{i}});
    }
    return c;
}

/// Returns a lattice turned by a small angle (exactly), with segments along its rows and parts of them, so that the
/// lines of a partition run through many points.
ConstrainedCase slanted_rows_case(int side) {
    ConstrainedCase c{square_lattice(side, side), {}};
    for (Point& p : c.points) p = {8 * p.x - p.y, p.x + 8 * p.y};
    const auto n = static_cast<std::size_t>(side);
    for (std::size_t row = 0; row < n; ++row) {
        c.segments.push_back({VertexId{row * n}, VertexId{row * n + n - 1}});
        if (row % 3 == 0) c.segments.push_back({VertexId{row * n + n - 2}, VertexId{row * n + 2}});
    }
    return c;
}

/// Returns the lines of ruled_case(), cut in three, and joined to the next ones at their ends.
ConstrainedCase zigzag_case(std::size_t n, int lines) {
    const ConstrainedCase ruled = ruled_case(n, lines);
    ConstrainedCase c{ruled.points, {}};
    for (std::size_t i = 0; i < ruled.segments.size(); ++i) {
        const Segment s = ruled.segments[i];
        VertexId from = s.a;
        for (const double t : {0.31, 0.77}) {
            const Point p = ruled.points[s.a.index()], q = ruled.points[s.b.index()];
            c.points.push_back(p + t * (q - p));
            const VertexId to{c.points.size() - 1};
            c.segments.push_back({from, to});
            from = to;
        }
        c.segments.push_back({from, s.b});
        if (i + 1 < ruled.segments.size())
            c.segments.push_back(i % 2 == 0 ? Segment{s.b, ruled.segments[i + 1].b}
                                            : Segment{s.a, ruled.segments[i + 1].a});
    }
    return c;
}

/// Returns the partition that lines through the segments make of the plane.
delaunay::pieces::LinePartition partition_of(const ConstrainedCase& c) {
    return delaunay::pieces::LinePartition(c.points, c.segments);
}

TEST(LinePartition, KeepsPartsApart) {
    for (const ConstrainedCase& c : {hub_case(1000, {0.3, -0.7}), slanted_rows_case(40), zigzag_case(1000, 60),
                                     ruled_case(1000, 60), star_case(500)}) {
        const delaunay::pieces::LinePartition partition = partition_of(c);
        EXPECT_GE(partition.size(), 7u);
        const delaunay::Tris tris = delaunay::triangulate_points(c.points);
        const auto part_of = [&](std::size_t t) {
            delaunay::pieces::Part parts[3] = {0, 0, 0};
            for (int i = 0; i < 3; ++i)
                if (tris[t].v[i] != delaunay::ghost_vertex) parts[i] = partition.of_point(c.points[tris[t].v[i]]);
            return partition.of_triangle(parts[0], parts[1], parts[2]);
        };
        std::size_t apart = 0;
        for (std::size_t t = 0; t < tris.size(); ++t)
            for (const delaunay::Link n : tris[t].n) {
                const auto p = part_of(t), q = part_of(n.triangle());
                apart += !partition.is_within(p, q) && !partition.is_within(q, p);
            }
        EXPECT_EQ(apart, 0u);
    }
    // Segments that all lines cross leave one part.
    ConstrainedCase crossing{random_points(200, 3), {}};
    for (std::size_t i = 0; i < 100; ++i) crossing.segments.push_back({VertexId{i}, VertexId{i + 100}});
    EXPECT_LT(partition_of(crossing).size(), 4u);
}

TEST(ConstrainedPieces, InsertLongSegmentsInParts) {
    for (const ConstrainedCase& c : {hub_case(3000, {0.3, -0.7}), hub_case(2000, {0, 0}), slanted_rows_case(50),
                                     zigzag_case(3000, 90), ruled_case(3000, 200)}) {
        expect_same_as_whole(c);
        const ConstrainedTriangulation t = triangulated(c, {}, in_many_pieces);
        expect_valid(c.points, t.triangles, t.segments);
    }
    // One segment across all others; the error is that of the insertion one by one.
    ConstrainedCase c = ruled_case(3000, 200);
    c.points.push_back({0.513, -0.5});
    c.points.push_back({0.511, 1.5});
    c.segments.push_back({VertexId{c.points.size() - 2}, VertexId{c.points.size() - 1}});
    expect_same_as_whole(c, {.crossings = Crossings::insert});
    EXPECT_THROW(triangulated(c, {}, in_many_pieces), InputError);
}

TEST(ConstrainedPieces, KeepTheSameRegions) {
    const ConstrainedCase rings = rings_case();
    for (const KeptRegion keep :
         {KeptRegion::inside_segments, KeptRegion::left_of_segments, KeptRegion::even_odd, KeptRegion::non_zero}) {
        expect_same_as_whole(rings, {.keep = keep});
        expect_same_as_whole(rings, {.keep = keep, .holes = {{0.1, 0.2}, {5.5, 0.1}}});
    }
    expect_same_as_whole(stretched_edges_case(2000, 7), {.holes = {{0.4, 0.4}}});
}

TEST(ConstrainedPieces, MakeTheSameOfCrossings) {
    ConstrainedCase c = ruled_case(1000);
    for (std::size_t i = 0; i < 15; ++i) c.segments.push_back({VertexId{3 * i}, VertexId{3 * i + 500}});
    expect_same_as_whole(c, {.crossings = Crossings::insert});
    const auto refusal = [&](const DecompositionOptions& decomposition) -> std::string {
        try {
            triangulated(c, {}, decomposition);
        } catch (const InputError& error) {
            return error.what();
        }
        return "none";
    };
    EXPECT_NE(refusal(in_one_piece), "none");
    EXPECT_EQ(refusal(in_many_pieces), refusal(in_one_piece));
}

TEST(ConstrainedPieces, MakeTheSameOfBadInput) {
    ConstrainedCase c = stretched_edges_case(1000, 5);
    c.segments[4] = {VertexId{7u}, VertexId{7u}};
    c.segments.push_back(c.segments[2]);
    expect_same_as_whole(c);
    c.points.push_back(c.points[17]);
    expect_same_as_whole(c, {.merge_distance = 0.0});
    EXPECT_THROW(triangulated(c, {}, in_many_pieces), InputError);
    c.points.pop_back();
    c.segments.push_back({VertexId{0u}, VertexId{5000u}});
    EXPECT_THROW(triangulated(c, {}, in_many_pieces), InputError);
    EXPECT_THROW(triangulated(c, {}, {.depth = 100}), OptionError);
}

TEST(ConstrainedPieces, MakeTheSameOfMergedPoints) {
    for (const ConstrainedCase& c : {twofold(stretched_edges_case(3000, 3)), twofold(star_case(1000)),
                                     twofold(ruled_case(1000, 40)), twofold(overlapping_case(4))}) {
        for (const double distance : {0.0, 1e-9, 0.003}) {
            // Segments between points that have moved may cross.
            const ConstrainedOptions options{.crossings = distance > 1e-3 ? Crossings::insert : Crossings::refuse,
                                             .merge_distance = distance};
            expect_same_as_whole(c, options);
            const ConstrainedTriangulation t = triangulated(c, options, in_many_pieces);
            EXPECT_EQ(t.merged_into, triangulated(c, options, in_one_piece).merged_into);
            EXPECT_GT(t.decomposition.pieces, 10u);
        }
    }
    ConstrainedOptions options{.keep = KeptRegion::even_odd, .merge_distance = 0.0};
    expect_same_as_whole(twofold(rings_case()), options);
    // Nothing is merged.
    options = {.merge_distance = 1e-9};
    expect_same_as_whole(stretched_edges_case(2000, 3), options);
    EXPECT_GT(triangulated(stretched_edges_case(2000, 3), options, in_many_pieces).decomposition.pieces, 10u);
}

void expect_same_on_any_threads(const ConstrainedCase& c, const ConstrainedOptions& options) {
    ConstrainedTriangulation one;
    with_threads(1, [&] { one = triangulate(c.points, c.segments, options); });
    EXPECT_GE(one.decomposition.pieces, 16u);
    for (const unsigned threads : {2u, 3u, 8u}) {
        with_threads(threads, [&] {
            const ConstrainedTriangulation t = triangulate(c.points, c.segments, options);
            EXPECT_EQ(t.triangles, one.triangles);
            EXPECT_EQ(t.segments, one.segments);
            EXPECT_EQ(t.parents, one.parents);
            EXPECT_EQ(t.merged_into, one.merged_into);
            EXPECT_EQ(t.repeated_segments, one.repeated_segments);
        });
    }
}

TEST(ConstrainedPieces, DoNotDependOnTheNumberOfThreads) {
    expect_same_on_any_threads(stretched_edges_case(60'000, 3), {});
    const DecompositionOptions small{.leaf_vertices = 700};
    expect_same_on_any_threads(star_case(8000), {.decomposition = small});
    expect_same_on_any_threads(ruled_case(8000, 300), {.decomposition = small});
    expect_same_on_any_threads(hub_case(8000, {0.3, -0.7}), {.decomposition = small});
    expect_same_on_any_threads(slanted_rows_case(90), {.decomposition = small});
    expect_same_on_any_threads(zigzag_case(8000, 200), {.decomposition = small});
    expect_same_on_any_threads(overlapping_case(5), {.decomposition = {{.leaf_vertices = 120}}});
    expect_same_on_any_threads(twofold(ruled_case(8000, 300)), {.merge_distance = 0.0, .decomposition = small});
}

}  // namespace
}  // namespace lamina::test
