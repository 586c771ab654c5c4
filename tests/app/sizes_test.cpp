// lamina sizes: from a solution to the next mesh.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include <lamina/io.hpp>
#include <lamina/solution.hpp>

#include "app/program.hpp"

namespace lamina::test {
namespace {

/// Writes a mesh whose point data are sizes, which here stand for the field of a solution.
void write_solution(const TemporaryFolder& folder, const std::string& mesh_file) {
    const Mesh mesh = read_mesh(folder / mesh_file);
    SizedMesh field{mesh.points, mesh.triangles, {}, {}};
    for (const Point p : mesh.points) field.sizes.push_back(2 + std::tanh(10 * (p.x + p.y - 1)));
    write_sizes(field, folder / "solution.vtu");
}

TEST(SizesCommand, TheNextMeshHasTheVerticesAskedFor) {
    const TemporaryFolder folder;
    const std::vector<std::string> mesh{"mesh", "naca:0012", "--far-field", "10", "-o"};
    const auto with = [](std::vector<std::string> arguments, const std::vector<std::string>& more) {
        arguments.insert(arguments.end(), more.begin(), more.end());
        return arguments;
    };
    ASSERT_EQ(run_lamina(folder, with(mesh, {"first.vtu"})).exit_code, 0);
    write_solution(folder, "first.vtu");
    const std::vector<std::string> sizes{"sizes",     "solution.vtu", "--field", "size", "--mesh",
                                         "first.vtu", "--vertices",   "14000",   "-o",   "sizes.vtu"};
    const ProgramRun run = run_lamina(folder, sizes);
    ASSERT_EQ(run.exit_code, 0) << run.err;
    EXPECT_NE(run.out.find("where 14000 are wanted"), std::string::npos) << run.out;
    ASSERT_EQ(run_lamina(folder, with(mesh, {"second.vtu", "--background", "sizes.vtu"})).exit_code, 0);
    EXPECT_NEAR(double(read_mesh(folder / "second.vtu").points.size()), 14'000, 0.05 * 14'000);

    const ProgramRun dump = run_lamina(folder, {"mesh", "naca:0012", "--far-field", "10", "--dump-config"});
    folder.write("case.toml", dump.out);
    const ProgramRun by_case = run_lamina(folder, with(sizes, {"--case", "case.toml"}));
    ASSERT_EQ(by_case.exit_code, 0) << by_case.err;
    ASSERT_EQ(run_lamina(folder, with(mesh, {"third.vtu", "--background", "sizes.vtu"})).exit_code, 0);
    EXPECT_NEAR(double(read_mesh(folder / "third.vtu").points.size()), 14'000, 0.02 * 14'000);
}

TEST(SizesCommand, RefusesWhatItCannotUse) {
    const TemporaryFolder folder;
    ASSERT_EQ(run_lamina(folder, {"mesh", "naca:0012", "--far-field", "10", "-o", "first.vtu"}).exit_code, 0);
    write_solution(folder, "first.vtu");
    folder.write("case.toml", "input = \"naca:0012\"\n");
    expect_refused(
        folder,
        {"sizes", "solution.vtu", "--field", "size", "--vertices", "14000", "--case", "case.toml", "-o", "case.toml"},
        usage, "would replace");
    EXPECT_EQ(folder.read("case.toml"), "input = \"naca:0012\"\n");
    folder.write("cells.toml", "input = \"naca:0012\"\ncells = 9000\n");
    expect_refused(
        folder,
        {"sizes", "solution.vtu", "--field", "size", "--vertices", "14000", "--case", "cells.toml", "-o", "sizes.vtu"},
        usage, "the sizes decide");
    const std::vector<std::string> velocity{"sizes", "solution.vtu", "--field", "size", "--vertices",
                                            "14000", "--velocity",   "U",       "-o",   "sizes.vtu"};
    expect_refused(folder, velocity, usage, "--velocity requires --case");
    std::vector<std::string> by_case = velocity;
    by_case.insert(by_case.end(), {"--case", "case.toml"});
    expect_refused(folder, by_case, usage, "option --velocity needs a case with a Reynolds number");
    std::filesystem::create_directories(folder / "case/1000");
    std::filesystem::create_directories(folder / "case/constant/polyMesh");
    for (const char* file : {"case/1000/U", "case/constant/polyMesh/points"}) {
        folder.write(file, "mine");
        expect_refused(folder, {"sizes", "case/1000/", "--field", "U", "--vertices", "9000", "-o", file}, usage,
                       "would replace");
        EXPECT_EQ(folder.read(file), "mine");
    }
    expect_refused(folder, {"sizes", "solution.vtu", "--vertices", "14000", "-o", "s.vtu"}, usage, "--field");
    expect_refused(folder, {"sizes", "solution.vtu", "--field", "size", "-o", "s.vtu"}, usage, "--vertices");
    expect_refused(folder, {"sizes", "solution.vtu", "--field", "q", "--vertices", "14000", "-o", "s.vtu"}, usage, "q");
    expect_refused(folder, {"sizes", "solution.vtu", "--field", "size", "--vertices", "2000", "-o", "s.vtu"}, usage,
                   "no fewer than");
    expect_refused(folder, {"sizes", "solution.vtu", "--field", "size", "--vertices", "9", "-o", "s.vtu"}, usage,
                   "--vertices");
    expect_refused(folder, {"sizes", "none.vtu", "--field", "size", "--vertices", "9000", "-o", "s.vtu"}, io_failed,
                   "none.vtu");
    expect_refused(folder, {"sizes", "solution.vtu", "--field", "size", "--vertices", "9000", "-o", "solution.vtu"},
                   usage, "solution.vtu");
}

}  // namespace
}  // namespace lamina::test
