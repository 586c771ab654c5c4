// lamina morph: the same cells round other shapes.
#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>
#include <sstream>
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

TEST(MorphCommand, ReconnectsOnRequest) {
    const TemporaryFolder folder;
    make_mesh_to_morph(folder);
    std::vector<std::string> arguments{"morph", "mesh.vtu", "--transform", "airfoil:rotate:-25:0.25,0",
                                       "-o",    "new.vtu"};
    ASSERT_EQ(run_lamina(folder, arguments).exit_code, 0);
    const Mesh as_it_is = read_mesh(folder / "new.vtu");
    arguments.emplace_back("--reconnect");
    const ProgramRun run = run_lamina(folder, arguments);
    ASSERT_EQ(run.exit_code, 0) << run.err;
    const Mesh better = read_mesh(folder / "new.vtu");
    EXPECT_TRUE(check_mesh(better).valid());
    EXPECT_EQ(better.points.size(), as_it_is.points.size());
    EXPECT_NE(better.triangles, as_it_is.triangles);
    expect_refused(folder, {"morph", "mesh.vtu", "--sequence", "all:pitch:0:5:1", "--reconnect", "-o", "{step}.vtu"},
                   usage, "--reconnect");
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

TEST(MorphCommand, WritesSequences) {
    const TemporaryFolder folder;
    make_mesh_to_morph(folder);
    const ProgramRun run = run_lamina(folder, {"morph", "mesh.vtu", "--sequence", "airfoil:pitch:2:5:0.5:0.25,0",
                                               "--steps", "10", "-o", "at_{step}.vtu", "--report", "report.json"});
    ASSERT_EQ(run.exit_code, 0) << run.err;
    EXPECT_NE(run.out.find("moved to 11 times, up to 2\n"), std::string::npos) << run.out;
    for (const char* file : {"at_00.vtu", "at_03.vtu", "at_10.vtu"}) expect_same_cells(folder, file);
    const auto report = nlohmann::json::parse(folder.read("report.json"));
    ASSERT_EQ(report.size(), 11U);
    EXPECT_EQ(report[5]["time"], 1);
    EXPECT_LT(report[5]["max_first_height_change"], 0.01);
    const ProgramRun turned =
        run_lamina(folder, {"morph", "mesh.vtu", "--transform", "airfoil:rotate:-2:0.25,0", "-o", "turned.vtu"});
    ASSERT_EQ(turned.exit_code, 0) << turned.err;
    EXPECT_EQ(read_mesh(folder / "at_00.vtu").points, read_mesh(folder / "turned.vtu").points);
}

TEST(MorphCommand, WritesMovingCasesOfOpenFoam) {
    const TemporaryFolder folder;
    make_mesh_to_morph(folder);
    const ProgramRun run = run_lamina(folder, {"morph", "mesh.vtu", "--sequence", "airfoil:deflect:5:2:0.25,0",
                                               "--until", "3", "--steps", "4", "-o", "moving"});
    ASSERT_EQ(run.exit_code, 0) << run.err;
    for (const char* file : {"Allrun", "motion/dynamicMeshDict", "motion/fvSolution", "motion/fvSolution.unsteady",
                             "motion/pointDisplacement", "0/displacement", "1.5/polyMesh/points", "3/displacement"})
        EXPECT_TRUE(std::filesystem::exists(folder / "moving" / file)) << file;
    const Mesh before = read_mesh(folder / "moving");
    const ProgramRun turned =
        run_lamina(folder, {"morph", "mesh.vtu", "--transform", "airfoil:rotate:-5:0.25,0", "-o", "turned.vtu"});
    ASSERT_EQ(turned.exit_code, 0) << turned.err;
    std::filesystem::copy_file(folder / "moving/3/polyMesh/points", folder / "moving/constant/polyMesh/points",
                               std::filesystem::copy_options::overwrite_existing);
    const Mesh after = read_mesh(folder / "moving"), expected = read_mesh(folder / "turned.vtu");
    EXPECT_EQ(after.points, expected.points);
    // Times of another motion would count as this one's.
    expect_refused(folder,
                   {"morph", "mesh.vtu", "--sequence", "airfoil:deflect:5:2:0.25,0", "--steps", "3", "-o", "moving"},
                   usage, "is the time of another motion");
    // The displacements, of which each vertex has one on either side.
    std::istringstream text(folder.read("moving/3/displacement"));
    std::string line;
    while (std::getline(text, line) && line != "(") {
    }
    for (int side = 0; side < 2; ++side)
        for (std::size_t i = 0; i < before.points.size(); ++i) {
            ASSERT_TRUE(std::getline(text, line));
            Point by;
            ASSERT_EQ(std::sscanf(line.c_str(), "(%lf %lf 0)", &by.x, &by.y), 2);
            EXPECT_EQ(by, after.points[i] - before.points[i]);
        }
}

TEST(MorphCommand, WritesPitchingCasesOfSu2) {
    const TemporaryFolder folder;
    make_mesh_to_morph(folder);
    const auto write = [&](const std::string& turn, const std::string& mesh) {
        return std::vector<std::string>{"morph", mesh,       "--sequence", turn, "--steps",
                                        "20",    "--format", "su2",        "-o", "pitching"};
    };
    const ProgramRun run = run_lamina(folder, write("airfoil:pitch:1:5:0.04:0.25,0", "mesh.vtu"));
    ASSERT_EQ(run.exit_code, 0) << run.err;
    EXPECT_EQ(read_mesh(folder / "pitching/mesh.su2").points, read_mesh(folder / "mesh.vtu").points);
    const std::string script = folder.read("pitching/Allrun");
    for (const char* line : {"steps=$((20 * per_time))", "step = 25 / steps", "GRID_MOVEMENT= RIGID_MOTION",
                             "MOTION_ORIGIN= 0.25 0 0.0", "PITCHING_AMPL= 0.0 0.0 5\n", "alpha + 1,"})
        EXPECT_NE(script.find(line), std::string::npos) << line;
    expect_refused(folder, write("airfoil:deflect:5:1", "mesh.vtu"), usage, "pitch together");
    expect_refused(folder, write("flap:pitch:0:5:1", "mesh.vtu"), usage, "pitch together");
    const ProgramRun ground = run_lamina(folder, {"mesh", "naca:0012:100", "--layers", "15", "--first-height", "1e-4",
                                                  "--far-field", "10", "--ground", "0.3", "-o", "ground.vtu"});
    ASSERT_EQ(ground.exit_code, 0) << ground.err;
    expect_refused(folder, write("all:pitch:0:5:1", "ground.vtu"), usage, "closed far field");
}

TEST(MorphCommand, RefusesSequencesThatItCannotWrite) {
    const TemporaryFolder folder;
    make_mesh_to_morph(folder);
    const auto refused = [&](const std::string& turn, const std::string& output, int exit_code,
                             const std::string& said) {
        expect_refused(folder, {"morph", "mesh.vtu", "--sequence", turn, "--steps", "2", "-o", output}, exit_code,
                       said);
    };
    refused("airfoil:pitch:0:5:1", "one.vtu", usage, "{step}");
    refused("airfoil:pitch:0:5", "{step}.vtu", usage, "option --sequence: a turn in time is");
    refused("flap:pitch:0:5:1", "{step}.vtu", usage, "option --sequence: element 'flap'");
    refused("all:pitch:0:1e9:1", "{step}.vtu", usage, "must be from -180 to 180");
    refused("all:pitch:0:5:1e-320", "{step}.vtu", usage, "must be from 1e-100 to 1e100");
    refused("all:pitch:0:5:1", "no/folder.vtk", usage, "option --output");
    for (const char* until : {"nan", "0", "1e300"})
        expect_refused(folder,
                       {"morph", "mesh.vtu", "--sequence", "all:pitch:0:5:1", "--until", until, "-o", "{step}.vtu"},
                       usage, "--until");
    expect_refused(folder, {"morph", "mesh.vtu", "--transform", "all:shift:0,0", "--steps", "3", "-o", "new.vtu"},
                   usage, "--sequence");
    refused("airfoil:deflect:170:1", "{step}.vtu", mesh_failed, "at time 1: the motion can be made to");
    expect_refused(folder, {"morph", "mesh.vtu", "--sequence", "all:pitch:0:5:1", "--to", "naca:0012", "-o", "new.vtu"},
                   usage, "give --to");
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
    for (const auto& [line, said] : {std::pair{"order = 2", "option --order"},
                                     {"stream = true", "option --stream"},
                                     {"surface = \"keep\"\nexact_points = 50", "exact-points"}}) {
        folder.write("case.toml", std::string("input = \"naca:0012:100\"\n") + line + "\n");
        expect_refused(folder, {"morph", "case.toml", "--to", "naca:0011:100", "-o", "new.vtu"}, usage, said);
    }
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
    refused({"--transform", "airfoil:flap:80:0.7,0", "--to", "naca:0012:100"}, mesh_failed, "turns over");
    expect_refused(folder, {"morph", "mesh.vtu", "--transform", "all:shift:0,1", "-o", "mesh.vtu"}, usage,
                   "would replace");
}

}  // namespace
}  // namespace lamina::test
