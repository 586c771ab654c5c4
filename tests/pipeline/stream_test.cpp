// stream_mesh(): the bytes of the mesh that generate_mesh() makes, whatever the number of threads; and the check of the
// pieces as they are made against check_mesh(), which finds everything itself.
#include <gtest/gtest.h>

#include <atomic>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <lamina/error.hpp>
#include <lamina/io.hpp>
#include <lamina/stream.hpp>

#include "pipeline/stream_cases.hpp"
#include "support/temporary_folder.hpp"

namespace lamina::test {
namespace {

void expect_same_check(const MeshCheck& made, const MeshCheck& found) {
    EXPECT_TRUE(found.valid());
    EXPECT_TRUE(made.valid());
    EXPECT_NEAR(made.area, found.area, 1e-12 * found.area);
    EXPECT_EQ(made.euler_characteristic, found.euler_characteristic);
    EXPECT_EQ(made.boundary_loops, found.boundary_loops);
    EXPECT_EQ(made.interior_edges, found.interior_edges);
    EXPECT_EQ(made.delaunay_violations, found.delaunay_violations);
    EXPECT_EQ(made.edges_without_first_layer, found.edges_without_first_layer);
    EXPECT_EQ(made.unexcused_cells, found.unexcused_cells);
    EXPECT_EQ(made.transition.edges, found.transition.edges);
    EXPECT_NEAR(made.transition.median_area_ratio, found.transition.median_area_ratio, 1e-9);
    EXPECT_EQ(made.walls.edges, found.walls.edges);
    EXPECT_EQ(made.walls.max_ratio, found.walls.max_ratio);
    EXPECT_EQ(made.walls.first_cells, found.walls.first_cells);
    EXPECT_EQ(made.walls.median_first_height, found.walls.median_first_height);
    for (const auto& [one, other] : {std::pair{made.layer, found.layer}, std::pair{made.isotropic, found.isotropic}}) {
        EXPECT_EQ(one.cells, other.cells);
        EXPECT_EQ(one.min_angle_deg, other.min_angle_deg);
        EXPECT_EQ(one.max_angle_deg, other.max_angle_deg);
        EXPECT_EQ(one.angle_histogram, other.angle_histogram);
        EXPECT_EQ(one.angles_below_bound, other.angles_below_bound);
        EXPECT_EQ(one.exempt, other.exempt);
        EXPECT_EQ(one.max_aspect_ratio, other.max_aspect_ratio);
        EXPECT_NEAR(one.mean_ratio, other.mean_ratio, 1e-12);
        EXPECT_NEAR(one.mean_min_angle_deg, other.mean_min_angle_deg, 1e-10);
        EXPECT_NEAR(one.max_neighbour_area_ratio, other.max_neighbour_area_ratio,
                    1e-9 * other.max_neighbour_area_ratio);
        EXPECT_NEAR(one.p999_neighbour_area_ratio, other.p999_neighbour_area_ratio, 0.003);
    }
}

TEST(Stream, HasTheBytesOfTheWholeMesh) {
    for (StreamCase& c : stream_cases()) {
        SCOPED_TRACE(c.name);
        const TemporaryFolder folder;
        const MeshResult whole = generate_mesh(c.inputs, c.options);
        for (const char* format : {"su2", "vtu"}) write_mesh(whole.mesh, folder / (std::string("whole.") + format));
        expect_same_check(whole.check, check_mesh(whole.mesh));
        for (const auto& [threads, format] : {std::pair{1u, ".su2"}, std::pair{2u, ".vtu"}, std::pair{5u, ".su2"}}) {
            c.options.threads = threads;
            const std::string file = std::string("stream") + format;
            const StreamedMesh streamed =
                stream_mesh(c.inputs, c.options, [&] { return open_mesh_sink(folder / file); });
            EXPECT_EQ(folder.names(), (std::vector<std::string>{"whole.su2", "whole.vtu"}));
            streamed.sink->commit();
            EXPECT_TRUE(folder.read(file) == folder.read(std::string("whole") + format)) << format;
            std::filesystem::remove(folder / file);
            EXPECT_EQ(streamed.hash, mesh_hash(whole.mesh));
            EXPECT_EQ(streamed.counts.vertices, whole.mesh.points.size());
            EXPECT_EQ(streamed.counts.triangles, whole.mesh.triangles.size());
            EXPECT_EQ(streamed.counts.quads, whole.mesh.quads.size());
            expect_same_check(streamed.result.check, whole.check);
            EXPECT_EQ(streamed.result.inviscid_pieces, whole.inviscid_pieces);
            EXPECT_EQ(streamed.result.warnings.size(), whole.warnings.size());
        }
    }
}

/// A sink that fails when it takes its n-th part.
class FailingSink : public MeshSink {
public:
    explicit FailingSink(std::size_t parts) : left_(parts) {}
    Bytes format(const MeshPart&) const override { return {"bytes"}; }
    void append(const Bytes& bytes) override {
        EXPECT_EQ(bytes, Bytes{"bytes"});
        EXPECT_FALSE(failed_) << "parts go on to come after a failure";
        failed_ = left_-- == 0;
        if (failed_) throw IoError("mesh.su2", "cannot write: no room");
    }
    void finish(const MeshCounts&, std::span<const Marker>, std::span<const Segment>) override {}
    void commit() override {}
    std::size_t bytes() const override { return 0; }

private:
    std::size_t left_;
    bool failed_ = false;
};

TEST(Stream, ReplacesAMeshByABetterOne) {
    const TemporaryFolder folder;
    const auto [name, inputs, options] = thinned_case(folder);
    const MeshResult whole = generate_mesh(inputs, options);
    ASSERT_GT(whole.thinned_rays, 0u);
    ASSERT_GT(whole.check.isotropic.exempt, 1u);
    expect_same_check(whole.check, check_mesh(whole.mesh));
    write_mesh(whole.mesh, folder / "whole.su2");
    std::size_t sinks = 0;
    const StreamedMesh streamed = stream_mesh(inputs, options, [&] {
        ++sinks;
        return open_mesh_sink(folder / "stream.su2");
    });
    streamed.sink->commit();
    EXPECT_GT(sinks, 1u);
    EXPECT_TRUE(folder.read("stream.su2") == folder.read("whole.su2"));
    EXPECT_EQ(streamed.result.thinned_rays, whole.thinned_rays);
}

TEST(Stream, EndsWhereTheSinkFails) {
    CaseOptions options = quick_options(6);
    options.decoupling.pieces_target = 500;
    for (const std::size_t parts : {0u, 1u, 3u, 20u})
        for (const unsigned threads : {1u, 4u}) {
            options.threads = threads;
            EXPECT_THROW(stream_mesh({"naca:0012:60"}, options, [&] { return std::make_unique<FailingSink>(parts); }),
                         IoError);
        }
}

TEST(Stream, KeepsLinesOfOneSide) {
    const TemporaryFolder folder;
    CaseOptions options = quick_options(6);
    options.decoupling.pieces_target = 1000;
    options.lines = {{"rake", {{0.3, 0.3}, {0.3, 0}}}, {"sensor", {{0.1, 0.2}, {0.8, 0.4}}}};
    const MeshResult whole = generate_mesh({"naca:0012:60"}, options);
    EXPECT_TRUE(whole.check.valid());
    for (const std::string format : {".su2", ".vtu"}) {
        write_mesh(whole.mesh, folder / ("whole" + format));
        const StreamedMesh streamed =
            stream_mesh({"naca:0012:60"}, options, [&] { return open_mesh_sink(folder / ("stream" + format)); });
        streamed.sink->commit();
        EXPECT_TRUE(folder.read("stream" + format) == folder.read("whole" + format)) << format;
        EXPECT_EQ(streamed.hash, mesh_hash(whole.mesh));
        EXPECT_EQ(lost_marker_warnings(streamed.result.mesh.markers, "stream" + format).size(), format == ".su2");
        EXPECT_EQ(streamed.result.check.unexcused_cells, whole.check.unexcused_cells);
    }
    options.lines.front().two_sided = true;
    EXPECT_THROW(stream_mesh({"naca:0012:60"}, options, [&] { return open_mesh_sink(folder / "stream.su2"); }),
                 OptionError);
}

TEST(Stream, RefusesFormatsThatAreWrittenAsAWhole) {
    EXPECT_THROW(require_streamable("mesh.msh"), UsageError);
    EXPECT_THROW(require_streamable("mesh.unknown"), UsageError);
    EXPECT_NO_THROW(require_streamable("mesh.su2"));
    EXPECT_NO_THROW(require_streamable("mesh", {.format = "su2"}));
}

}  // namespace
}  // namespace lamina::test
