// share_mesh(): the mesh and the check of stream_mesh(), whatever the number of ranks. Threads stand in for processes.
#include <gtest/gtest.h>

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <lamina/error.hpp>
#include <lamina/ids.hpp>
#include <lamina/io.hpp>
#include <lamina/point.hpp>
#include <lamina/stream.hpp>

#include "pipeline/sharing/shared_seams.hpp"
#include "pipeline/stream_cases.hpp"
#include "support/pvtu_parts.hpp"
#include "support/temporary_folder.hpp"
#include "support/thread_ranks.hpp"

namespace lamina::test {
namespace {

/// Expects the same numbers, to the last bit: sums do not depend on the order of the pieces.
void expect_equal_checks(const MeshCheck& one, const MeshCheck& other) {
    EXPECT_TRUE(one.valid());
    EXPECT_EQ(one.area, other.area);
    EXPECT_EQ(one.euler_characteristic, other.euler_characteristic);
    EXPECT_EQ(one.interior_edges, other.interior_edges);
    EXPECT_EQ(one.delaunay_violations, other.delaunay_violations);
    EXPECT_EQ(one.unexcused_cells, other.unexcused_cells);
    EXPECT_EQ(one.transition.edges, other.transition.edges);
    EXPECT_EQ(one.transition.p99_area_ratio, other.transition.p99_area_ratio);
    EXPECT_EQ(one.walls.median_first_height, other.walls.median_first_height);
    EXPECT_EQ(one.isotropic.cells, other.isotropic.cells);
    EXPECT_EQ(one.isotropic.mean_ratio, other.isotropic.mean_ratio);
    EXPECT_EQ(one.isotropic.mean_min_angle_deg, other.isotropic.mean_min_angle_deg);
    EXPECT_EQ(one.isotropic.angle_histogram, other.isotropic.angle_histogram);
    EXPECT_EQ(one.isotropic.exempt, other.isotropic.exempt);
    EXPECT_EQ(one.isotropic.max_neighbour_area_ratio, other.isotropic.max_neighbour_area_ratio);
    EXPECT_EQ(one.isotropic.p999_neighbour_area_ratio, other.isotropic.p999_neighbour_area_ratio);
    EXPECT_EQ(one.layer.max_aspect_ratio, other.layer.max_aspect_ratio);
}

/// Makes and writes the mesh on so many ranks, and compares it with the streamed one in "stream".
void expect_same_mesh(const TemporaryFolder& folder, const StreamCase& c, const StreamedMesh& streamed, unsigned n,
                      const std::string& format, bool on_disk) {
    SCOPED_TRACE(n);
    const std::filesystem::path file = folder / ("shared" + format);
    const std::string failure = run_ranks(n, [&](Ranks& ranks) {
        const SharedMesh shared = share_mesh(c.inputs, c.options, ranks, on_disk ? std::optional(file) : std::nullopt);
        EXPECT_EQ(shared.counts.vertices, streamed.counts.vertices);
        EXPECT_EQ(shared.counts.triangles, streamed.counts.triangles);
        EXPECT_EQ(shared.counts.quads, streamed.counts.quads);
        EXPECT_EQ(shared.counts.layer_triangles, streamed.counts.layer_triangles);
        if (ranks.rank() == 0) {
            EXPECT_EQ(shared.hash, streamed.hash);
            expect_equal_checks(shared.result.check, streamed.result.check);
            EXPECT_EQ(shared.result.warnings.size(), streamed.result.warnings.size());
            EXPECT_EQ(shared.result.mean_edge_over_size, streamed.result.mean_edge_over_size);
            EXPECT_EQ(shared.result.estimates_within_15_percent, streamed.result.estimates_within_15_percent);
            EXPECT_EQ(shared.result.thinned_rays, streamed.result.thinned_rays);
        }
        write_shared_mesh(*shared.parts, {shared.counts, shared.result.mesh.markers, shared.constraints}, ranks, file);
    });
    EXPECT_EQ(failure, "");
    EXPECT_TRUE(folder.read("shared" + format) == folder.read("stream" + format)) << format;
    std::filesystem::remove(file);
}

TEST(SharedMesh, HashesOfPlacesCancelWherePlacesAreTheSame) {
    const std::vector<Point> points{{0, 0}, {1, 0.5}, {2, -3}};
    std::vector<Point> moved = points;
    moved[1].y += 0x1p-53;
    const Segment edge{VertexId{0}, VertexId{1}}, opposite{VertexId{1}, VertexId{0}}, other{VertexId{1}, VertexId{2}};
    EXPECT_EQ(pipeline::hash_of_places(edge, points) + pipeline::hash_of_places(opposite, points), 0u);
    EXPECT_NE(pipeline::hash_of_places(edge, points) + pipeline::hash_of_places(opposite, moved), 0u);
    EXPECT_NE(pipeline::hash_of_places(edge, points), pipeline::hash_of_places(opposite, points));
    EXPECT_NE(pipeline::hash_of_places(edge, points), pipeline::hash_of_places(other, points));
}

TEST(SharedMesh, IsTheMeshOfOneProcess) {
    for (StreamCase& c : stream_cases()) {
        SCOPED_TRACE(c.name);
        const TemporaryFolder folder;
        c.options.threads = 2;
        std::vector<StreamedMesh> streamed;
        for (const char* format : {".su2", ".vtu"}) {
            streamed.push_back(stream_mesh(c.inputs, c.options,
                                           [&] { return open_mesh_sink(folder / (std::string("stream") + format)); }));
            streamed.back().sink->commit();
        }
        expect_same_mesh(folder, c, streamed.front(), 1, ".su2", false);
        expect_same_mesh(folder, c, streamed.front(), 2, ".vtu", true);
        c.options.threads = 1;
        expect_same_mesh(folder, c, streamed.front(), 3, ".su2", true);
        expect_same_mesh(folder, c, streamed.front(), 5, ".vtu", false);
        EXPECT_EQ(folder.names(), (std::vector<std::string>{"stream.su2", "stream.vtu"}));
    }
}

// Which parts there are depends on the ranks; all together are the mesh.
TEST(SharedMesh, IsWrittenInParts) {
    for (const StreamCase& c : stream_cases()) {
        if (c.name != "many pieces" && c.name != "quads" && c.name != "inlet and outlet") continue;
        SCOPED_TRACE(c.name);
        const MeshResult whole = generate_mesh(c.inputs, c.options);
        for (const unsigned n : {1u, 3u}) {
            SCOPED_TRACE(n);
            const TemporaryFolder folder;
            CaseOptions options = c.options;
            options.threads = 1;
            const std::string failure = run_ranks(n, [&](Ranks& ranks) {
                std::optional<std::filesystem::path> beside;
                if (n > 1) beside = folder / "mesh.pvtu";
                const SharedMesh shared = share_mesh(c.inputs, options, ranks, beside);
                write_shared_mesh(*shared.parts, {shared.counts, shared.result.mesh.markers, shared.constraints}, ranks,
                                  folder / "mesh.pvtu");
            });
            EXPECT_EQ(failure, "");
            const Mesh joined = join_parts(folder, "mesh.pvtu");
            EXPECT_EQ(joined.points, whole.mesh.points);
            EXPECT_EQ(mesh_hash(joined), mesh_hash(whole.mesh));
            EXPECT_LE(folder.names().size(), n + 1);
        }
    }
    const TemporaryFolder folder;
    CaseOptions options = stream_cases().front().options;
    options.threads = 1;
    const std::string failure = run_ranks(2, [&](Ranks& ranks) {
        const SharedMesh shared = share_mesh({"naca:0012:60"}, options, ranks);
        if (ranks.rank() == 1) throw IoError("somewhere", "no room");
        write_shared_mesh(*shared.parts, {shared.counts, shared.result.mesh.markers, shared.constraints}, ranks,
                          folder / "mesh.pvtu");
    });
    EXPECT_NE(failure.find("no room"), std::string::npos) << failure;
    EXPECT_TRUE(folder.names().empty());
}

TEST(SharedMesh, IsReplacedByABetterOne) {
    const TemporaryFolder folder;
    const StreamCase c = thinned_case(folder);
    const StreamedMesh streamed =
        stream_mesh(c.inputs, c.options, [&] { return open_mesh_sink(folder / "stream.su2"); });
    streamed.sink->commit();
    ASSERT_GT(streamed.result.thinned_rays, 0u);
    expect_same_mesh(folder, c, streamed, 2, ".su2", false);
}

TEST(SharedMesh, SendsLessThanAKibibyteAPiece) {
    CaseOptions options = quick_options(50);
    options.sizing.gradation = 0.012;
    options.decoupling.pieces_target = 20'000;
    options.threads = 1;
    std::vector<std::size_t> bytes(3), pieces(3);
    const std::string failure = run_ranks(3, [&](Ranks& ranks) {
        const SharedMesh shared = share_mesh({"naca:0012:120"}, options, ranks);
        bytes[ranks.rank()] = ranks.traffic().bytes;
        if (ranks.rank() == 0) pieces[0] = shared.result.inviscid_pieces;
    });
    EXPECT_EQ(failure, "");
    ASSERT_GT(pieces[0], 20u);
    RecordProperty("bytes_a_piece", static_cast<int>((bytes[0] + bytes[1] + bytes[2]) / pieces[0]));
    EXPECT_LT(bytes[0] + bytes[1] + bytes[2], 1024 * pieces[0]);
}

TEST(SharedMesh, EndsOnAllRanksWhereOneFails) {
    const TemporaryFolder folder;
    CaseOptions options = quick_options(6);
    options.decoupling.pieces_target = 500;
    options.threads = 1;
    for (const unsigned failing : {0u, 2u}) {
        const std::string before = run_ranks(3, [&](Ranks& ranks) {
            if (ranks.rank() == failing) throw InputError({.file = "somewhere"}, "no such thing");
            share_mesh({"naca:0012:60"}, options, ranks);
        });
        EXPECT_NE(before.find("no such thing"), std::string::npos) << before;
        // The pieces of one rank fail.
        const std::string within = run_ranks(
            3,
            [&](Ranks& ranks) {
                CaseOptions own = options;
                if (ranks.rank() == failing) own.refine.max_points = 5;
                share_mesh({"naca:0012:60"}, own, ranks);
            },
            failing);
        EXPECT_NE(within, "");
        EXPECT_EQ(within.find("differently"), std::string::npos) << within;
    }
    const std::string other_input = run_ranks(
        2, [&](Ranks& ranks) { share_mesh({ranks.rank() == 0 ? "naca:0012:60" : "naca:0012:62"}, options, ranks); });
    EXPECT_NE(other_input.find("another way"), std::string::npos) << other_input;
    const std::string writing = run_ranks(3, [&](Ranks& ranks) {
        const SharedMesh shared = share_mesh({"naca:0012:60"}, options, ranks);
        write_shared_mesh(*shared.parts, {shared.counts, shared.result.mesh.markers, shared.constraints}, ranks,
                          folder / "no-folder" / "mesh.su2");
    });
    EXPECT_NE(writing.find("no-folder"), std::string::npos) << writing;
    EXPECT_TRUE(folder.names().empty());
}

}  // namespace
}  // namespace lamina::test
