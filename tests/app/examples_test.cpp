// The case files of examples/.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include <nlohmann/json.hpp>

#include "app/program.hpp"

namespace lamina::test {
namespace {

using Json = nlohmann::json;

/// Runs a case file of examples/ and expects its mesh to be valid, Delaunay and within the angle bound.
Json mesh_of_example(const std::string& name) {
    const TemporaryFolder folder;
    const ProgramRun mesh = run_lamina(
        folder, {"mesh", std::string(LAMINA_SOURCE_DIR "/examples/") + name, "-o", "m.vtu", "--report", "r.json"});
    EXPECT_EQ(mesh.exit_code, 0) << mesh.err;
    if (mesh.exit_code != 0) return {};
    const ProgramRun check = run_lamina(folder, {"check", "m.vtu", "--require-delaunay", "--min-angle", "20.7",
                                                 "--wall", "airfoil", "--far", "farfield"});
    EXPECT_EQ(check.exit_code, 0) << check.out << check.err;
    return Json::parse(folder.read("r.json"));
}

TEST(Examples, TheCaseOfTheReadmeIsMeshed) {
    const Json report = mesh_of_example("case.toml");
    ASSERT_TRUE(report.is_object());
    EXPECT_GT(report["triangles"].get<double>(), 10'000);
    EXPECT_EQ(report["layer_cells"]["share"], 1);
}

TEST(Examples, TheLayerOfTheThesisInPieces) {
    const Json report = mesh_of_example("thesis/fig21.toml");
    ASSERT_TRUE(report.is_object());
    EXPECT_EQ(report["layer_cells"]["share"], 1);
    const Json& decomposition = report["decomposition"];
    EXPECT_EQ(decomposition["pieces"], 64u);
    EXPECT_EQ(decomposition["sequential_fallbacks"], 0);
    EXPECT_LE(decomposition["largest_piece_vertices"].get<double>() * 64,
              1.25 * decomposition["piece_vertices"].get<double>());
}

TEST(Examples, TheDenseLayerOfTheThesisIsMeshed) {
    const Json report = mesh_of_example("thesis/fig22.toml");
    ASSERT_TRUE(report.is_object());
    EXPECT_EQ(report["layer_cells"]["share"], 1);
}

/// Figs. 24 to 26, with 3.3 million triangles, take too long for a test (docs/reproduction.md).
TEST(Examples, FiguresOfTheThesisHaveTheirNumberOfTriangles) {
    struct Figure {
        const char* file;
        double triangles;
    };
    for (const auto& [file, in_the_thesis] : {Figure{"thesis/fig27.toml", 451'091}, {"thesis/fig29.toml", 196'291}}) {
        SCOPED_TRACE(file);
        const Json report = mesh_of_example(file);
        ASSERT_TRUE(report.is_object());
        const auto triangles = report["triangles"].get<double>();
        EXPECT_LT(std::abs(triangles - in_the_thesis), 0.05 * in_the_thesis) << triangles;
        EXPECT_EQ(report["layer_cells"]["share"], 1);
        EXPECT_EQ(report["quality"]["isotropic"]["oversized"], 0);
        EXPECT_EQ(report["quality"]["isotropic"]["refused_points"], 0);
        EXPECT_LT(report["pieces"]["largest_inviscid"].get<double>(), 100'000);
        EXPECT_GT(report["pieces"]["estimates_within_15_percent"].get<double>(), 0.95);
    }
}

}  // namespace
}  // namespace lamina::test
