// lamina remesh: from a mesh and a metric to the next mesh.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include <lamina/io.hpp>
#include <lamina/metric.hpp>

#include "app/program.hpp"

namespace lamina::test {
namespace {

TEST(RemeshCommand, AdaptsTheTrianglesBeyondTheLayer) {
    const TemporaryFolder folder;
    ASSERT_EQ(run_lamina(folder, {"mesh", "naca:0012", "--far-field", "5", "-o", "first.vtu"}).exit_code, 0);
    const Mesh first = read_mesh(folder / "first.vtu");
    write_metric(std::vector<MetricTensor>(first.points.size(), {25, 0, 400}), folder / "m.sol");
    const std::vector<std::string> remesh{"remesh",           "first.vtu", "--metric",    "m.sol",
                                          "--vertices",       "20000",     "--gradation", "0.5",
                                          "--divide-borders", "-o",        "second.vtu"};
    const ProgramRun run = run_lamina(folder, remesh);
    ASSERT_EQ(run.exit_code, 0) << run.err;
    EXPECT_NE(run.out.find("long in the metric"), std::string::npos) << run.out;
    const Mesh second = read_mesh(folder / "second.vtu");
    EXPECT_EQ(second.quads.size(), first.quads.size());
    EXPECT_EQ(check_mesh(second).layer.cells, check_mesh(first).layer.cells);
    EXPECT_EQ(run_lamina(folder, {"check", "second.vtu"}).exit_code, 0);
}

TEST(RemeshCommand, RefusesWhatItCannotUse) {
    const TemporaryFolder folder;
    ASSERT_EQ(run_lamina(folder, {"mesh", "naca:0012", "--far-field", "5", "-o", "a.su2"}).exit_code, 0);
    folder.write("m.sol", "MeshVersionFormatted 2\nDimension 2\nSolAtVertices\n1\n1 1\n0.1\nEnd\n");
    folder.write("bad.sol", "MeshVersionFormatted 2\nDimension 2\nSolAtVertices\n1\n1 1\nx\nEnd\n");
    const auto refused = [&](const std::string& metric, const std::string& output, int exit_code,
                             const std::string& word) {
        const ProgramRun run = run_lamina(folder, {"remesh", "a.su2", "--metric", metric, "-o", output});
        EXPECT_EQ(run.exit_code, exit_code);
        EXPECT_NE(run.err.find(word), std::string::npos) << run.err;
    };
    refused("m.sol", "b.su2", 3, "1 metric tensors");
    refused("bad.sol", "b.su2", 3, "bad.sol:6");
    refused("none.sol", "b.su2", 5, "none.sol");
    refused("m.txt", "b.su2", 2, "m.txt");
    refused("m.sol", "a.su2", 2, "a.su2");
}

}  // namespace
}  // namespace lamina::test
