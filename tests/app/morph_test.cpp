// lamina morph: the same cells round other shapes.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include <lamina/io.hpp>

#include "app/program.hpp"

namespace lamina::test {
namespace {

void make_mesh_to_morph(const TemporaryFolder& folder) {
    const ProgramRun run = run_lamina(folder, {"mesh", "naca:0012:100", "--layers", "15", "--first-height", "1e-4",
                                               "--far-field", "10", "--wall-data", "wall.csv", "-o", "mesh.vtu"});
    ASSERT_EQ(run.exit_code, 0) << run.err;
}

void expect_same_cells(const TemporaryFolder& folder, const std::string& file) {
    const Mesh before = read_mesh(folder / "mesh.vtu"), after = read_mesh(folder / file);
    EXPECT_EQ(before.triangles, after.triangles);
    EXPECT_EQ(before.points.size(), after.points.size());
    EXPECT_TRUE(check_mesh(after).valid());
}

TEST(MorphCommand, MovesToShapesAndTransformations) {
    const TemporaryFolder folder;
    make_mesh_to_morph(folder);
    const ProgramRun to = run_lamina(
        folder, {"morph", "mesh.vtu", "--to", "naca:0014:200", "-o", "thicker.vtu", "--report", "report.json"});
    ASSERT_EQ(to.exit_code, 0) << to.err;
    EXPECT_NE(to.out.find("mean smallest"), std::string::npos) << to.out;
    expect_same_cells(folder, "thicker.vtu");
    const auto report = nlohmann::json::parse(folder.read("report.json"));
    EXPECT_EQ(report["fraction"], 1);
    EXPECT_LT(report["max_first_height_change"], 0.01);
    EXPECT_GT(report["after"]["min_scaled_jacobian"], 0);

    const ProgramRun turned =
        run_lamina(folder, {"morph", "mesh.vtu", "--transform", "airfoil:rotate:-10:0.25,0", "-o", "turned.su2"});
    ASSERT_EQ(turned.exit_code, 0) << turned.err;
    expect_same_cells(folder, "turned.su2");
}

TEST(MorphCommand, MovesByDisplacements) {
    const TemporaryFolder folder;
    make_mesh_to_morph(folder);
    folder.write("moves.csv", "vertex,dx,dy\n0,0,0.00001\r\n25,1e-5,0\n");
    const ProgramRun run = run_lamina(folder, {"morph", "mesh.vtu", "--displacements", "moves.csv", "-o", "new.vtu"});
    ASSERT_EQ(run.exit_code, 0) << run.err;
    const Mesh before = read_mesh(folder / "mesh.vtu"), after = read_mesh(folder / "new.vtu");
    EXPECT_EQ(after.points[0], (before.points[0] + Point{0, 0.00001}));
    EXPECT_EQ(after.points[25], (before.points[25] + Point{1e-5, 0}));
    EXPECT_EQ(after.points[50], before.points[50]);
    for (const auto& [text, said] : {std::pair{"0,0\n", "moves.csv:1: '0,0' is not 'vertex,dx,dy'"},
                                     {"\n0,0,nan\n", "moves.csv:2:"},
                                     {"5000000,0,0\n", "has no vertex"},
                                     {"900,0,0\n", "is on no wall"},
                                     {"3,0,0\n3,0,0\n", "moves.csv:2:"}}) {
        folder.write("moves.csv", text);
        expect_refused(folder, {"morph", "mesh.vtu", "--displacements", "moves.csv", "-o", "other.vtu"}, bad_input,
                       said);
    }
}

TEST(MorphCommand, NamesTheCellThatStopsIt) {
    const TemporaryFolder folder;
    make_mesh_to_morph(folder);
    std::vector<std::string> far{"morph", "mesh.vtu", "--transform", "airfoil:shift:9,0", "-o", "far.vtu"};
    expect_refused(folder, far, mesh_failed, "turns over");
    far.emplace_back("--as-far-as-possible");
    const ProgramRun run = run_lamina(folder, far);
    ASSERT_EQ(run.exit_code, 0) << run.err;
    EXPECT_NE(run.out.find("turns over"), std::string::npos) << run.out;
    expect_same_cells(folder, "far.vtu");
}

TEST(MorphCommand, MakesTheMeshOfACase) {
    const TemporaryFolder folder;
    folder.write(
        "case.toml",
        "input = \"naca:0012:100\"\nlayers = 15\nfirst_height = 1e-4\nfar_field = 10\noutput = \"mesh.vtu\"\n");
    ASSERT_EQ(run_lamina(folder, {"mesh", "case.toml"}).exit_code, 0);
    const ProgramRun run = run_lamina(folder, {"morph", "case.toml", "--to", "naca:0011:100", "-o", "thinner.vtu"});
    ASSERT_EQ(run.exit_code, 0) << run.err;
    expect_same_cells(folder, "thinner.vtu");
}

TEST(MorphCommand, RefusesWhatItCannotUse) {
    const TemporaryFolder folder;
    make_mesh_to_morph(folder);
    const auto refused = [&](const std::vector<std::string>& more, int exit_code, const std::string& said) {
        std::vector<std::string> arguments{"morph", "mesh.vtu", "-o", "new.vtu"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        expect_refused(folder, arguments, exit_code, said);
    };
    refused({}, usage, "give --to");
    refused({"--to", "naca:0012", "--displacements", "moves.csv"}, usage, "give --to");
    refused({"--to", "naca:0012:100", "naca:2412:100"}, bad_input, "");
    refused({"--to", "naca:0012:101:blunt"}, bad_input, "corners appear or vanish");
    refused({"--transform", "flap:rotate:5"}, usage, "flap");
    expect_refused(folder, {"morph", "mesh.vtu", "--transform", "all:shift:0,1", "-o", "mesh.vtu"}, usage,
                   "would replace");
}

}  // namespace
}  // namespace lamina::test
