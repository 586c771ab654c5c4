// "-" stands for standard input and standard output.
#include <algorithm>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "app/program.hpp"

namespace lamina::test {
namespace {

const std::string section = "section\n1 0\n0.5 0.06\n0.1 0.04\n0 0\n0.1 -0.04\n0.5 -0.06\n1 0\n";

std::vector<std::string> small_mesh(std::vector<std::string> more) {
    std::vector<std::string> arguments{"mesh",     "naca:0012:60", "--far-field",    "4",
                                       "--layers", "auto",         "--first-height", "5e-4"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
}

TEST(Streams, AMeshOnStandardOutputHasTheBytesOfTheFile) {
    for (const char* format :
         {"su2", "msh41", "msh41-binary", "msh22", "msh22-binary", "msh22-extruded", "vtu", "vtu-zlib"}) {
        const TemporaryFolder folder;
        const ProgramRun file = run_lamina(folder, small_mesh({"--format", format, "-o", "mesh"}));
        ASSERT_EQ(file.exit_code, 0) << file.err;
        const ProgramRun stream = run_lamina(folder, small_mesh({"--format", format, "-o", "-"}));
        ASSERT_EQ(stream.exit_code, 0) << stream.err;
        EXPECT_EQ(stream.out, folder.read("mesh")) << format;
        EXPECT_NE(stream.err.find("wrote       standard output"), std::string::npos) << stream.err;
        EXPECT_EQ(folder.names(), std::vector<std::string>{"mesh"});
    }
}

TEST(Streams, AMeshWrittenWhileItIsMadeHasTheBytesOfTheFile) {
    const TemporaryFolder folder;
    ASSERT_EQ(run_lamina(folder, small_mesh({"-o", "a.su2", "--report", "a.json"})).exit_code, 0);
    const ProgramRun run = run_lamina(folder, small_mesh({"--stream", "-o", "b.su2", "--report", "b.json"}));
    ASSERT_EQ(run.exit_code, 0) << run.err;
    EXPECT_EQ(folder.read("a.su2"), folder.read("b.su2"));
    EXPECT_EQ(nlohmann::json::parse(folder.read("a.json"))["hash"],
              nlohmann::json::parse(folder.read("b.json"))["hash"]);
    const ProgramRun out = run_lamina(folder, small_mesh({"--stream", "-o", "-", "--format", "su2"}));
    EXPECT_EQ(out.out, folder.read("a.su2")) << out.err;
    EXPECT_EQ(run_lamina(folder, small_mesh({"--stream", "-o", "/dev/null", "--format", "su2"})).exit_code, 0);
    EXPECT_EQ(folder.names(), (std::vector<std::string>{"a.json", "a.su2", "b.json", "b.su2"}));
    expect_refused(folder, small_mesh({"--stream", "-o", "c.msh"}), usage, "su2, vtu");
    expect_refused(folder, small_mesh({"--stream", "-o", "c.su2", "-o", "d.su2"}), usage, "one mesh file");
    expect_refused(folder, small_mesh({"--stream", "-o", "c.su2", "--wall-data", "w.csv"}), usage, "--wall-data");
}

TEST(Streams, TheSummaryGoesToStandardErrorBesideAReportOrWallData) {
    const TemporaryFolder folder;
    const ProgramRun report = run_lamina(folder, small_mesh({"-o", "a.su2", "--report", "-"}));
    EXPECT_EQ(report.exit_code, 0) << report.err;
    EXPECT_TRUE(nlohmann::json::parse(report.out).contains("hash"));
    EXPECT_NE(report.err.find("mesh: "), std::string::npos);
    const ProgramRun walls = run_lamina(folder, small_mesh({"-o", "a.su2", "--wall-data", "-", "--quiet"}));
    EXPECT_TRUE(walls.out.starts_with("marker,vertex,")) << walls.out;
    EXPECT_EQ(walls.err, "");
    EXPECT_NE(run_lamina(folder, small_mesh({"-o", "a.su2"})).out.find("mesh: "), std::string::npos);
}

TEST(Streams, SectionsAreReadFromStandardInput) {
    const TemporaryFolder folder;
    folder.write("a.dat", section);
    const std::vector<std::string> file{"mesh", "a.dat", "--far-field", "4", "-o", "a.su2"};
    ASSERT_EQ(run_lamina(folder, file).exit_code, 0);
    const ProgramRun run = run_lamina(folder, {"mesh", "-", "--far-field", "4", "-o", "b.su2"}, section);
    ASSERT_EQ(run.exit_code, 0) << run.err;
    EXPECT_EQ(folder.read("a.su2"), folder.read("b.su2"));
    EXPECT_NE(run.out.find("from standard input"), std::string::npos) << run.out;
    // Where several meshes are made, they are made of one reading, which has its say as ever.
    const ProgramRun several =
        run_lamina(folder, {"mesh", "-", "--far-field", "4", "--vertices", "8000", "-o", "d.su2"}, section);
    ASSERT_EQ(several.exit_code, 0) << several.err;
    EXPECT_NE(several.out.find("closing point merged"), std::string::npos) << several.out;
    EXPECT_NE(run_lamina(folder, {"info", "-"}, section).out.find("standard input"), std::string::npos);
    const ProgramRun bad = run_lamina(folder, {"mesh", "-", "-o", "c.su2"}, "title\n1 0\n0.5 nan\n0 0\n");
    EXPECT_EQ(bad.exit_code, bad_input);
    EXPECT_NE(bad.err.find("standard input:3: "), std::string::npos) << bad.err;
    const ProgramRun dump = run_lamina(folder, {"mesh", "-", "-o", "-", "--format", "su2", "--dump-config"});
    EXPECT_NE(dump.out.find("input = [ '-' ]\noutput = [ '-' ]\n"), std::string::npos) << dump.out;
}

TEST(Streams, MeshesAreReadFromStandardInput) {
    const TemporaryFolder folder;
    ASSERT_EQ(run_lamina(folder, small_mesh({"-o", "a.su2", "-o", "a.vtu"})).exit_code, 0);
    const std::string su2 = folder.read("a.su2");
    const ProgramRun check = run_lamina(folder, {"check", "-", "--input-format", "su2"}, su2);
    EXPECT_EQ(check.exit_code, 0) << check.err;
    EXPECT_TRUE(check.out.starts_with("standard input: valid\n")) << check.out;
    const ProgramRun convert =
        run_lamina(folder, {"convert", "-", "-", "--input-format", "vtu", "--format", "su2"}, folder.read("a.vtu"));
    EXPECT_EQ(convert.exit_code, 0) << convert.err;
    EXPECT_EQ(convert.out, su2);
    const ProgramRun plot =
        run_lamina(folder, {"plot", "-", "--input-format", "su2", "-o", "-", "--format", "png", "--width", "50"}, su2);
    EXPECT_EQ(plot.exit_code, 0) << plot.err;
    EXPECT_TRUE(plot.out.starts_with("\x89PNG")) << plot.err;
    // The option also serves files whose names say nothing.
    folder.write("mesh", su2);
    EXPECT_EQ(run_lamina(folder, {"check", "mesh", "--input-format", "su2"}).exit_code, 0);
}

TEST(Streams, DelaunayReadsStandardInput) {
    const TemporaryFolder folder;
    const std::string poly = "3 2 0 0\n1 0 0\n2 1 0\n3 0 1\n3 0\n1 1 2\n2 2 3\n3 3 1\n0\n";
    const ProgramRun run = run_lamina(folder, {"delaunay", "-", "--input-format", "poly", "-o", "t"}, poly);
    EXPECT_EQ(run.exit_code, 0) << run.err;
    EXPECT_EQ(folder.names(), (std::vector<std::string>{"t.ele", "t.node", "t.poly"}));
    const ProgramRun points = run_lamina(
        folder, {"delaunay", "-", "--input-format", "node", "-o", "p", "--report", "-"}, "3 2\n1 0 0\n2 1 0\n3 0 1\n");
    EXPECT_EQ(points.exit_code, 0) << points.err;
    EXPECT_EQ(nlohmann::json::parse(points.out)["triangles"], 1);
    expect_refused(folder, {"delaunay", "-", "-o", "t"}, usage, "--input-format");
    expect_refused(folder, {"delaunay", "-", "--input-format", "poly"}, usage, "-o STEM");
    expect_refused(folder, {"delaunay", "t.poly", "-o", "-"}, usage, "several files");
    const ProgramRun bare =
        run_lamina(folder, {"delaunay", "-", "--input-format", "poly", "-o", "u"}, "0 2\n1 0\n1 1 2\n0\n");
    EXPECT_EQ(bare.exit_code, bad_input);
    EXPECT_NE(bare.err.find("standard input:1: no vertices"), std::string::npos) << bare.err;
}

TEST(Streams, WhatOneStreamCannotCarryIsRefused) {
    const TemporaryFolder folder;
    expect_refused(folder, {"mesh", "naca:0012", "-o", "-"}, usage, "give --format NAME");
    for (const char* format : {"cgns", "openfoam", "ugrid", "fun3d", "triangle"})
        expect_refused(folder, {"mesh", "naca:0012", "-o", "-", "--format", format}, usage,
                       "is not one stream of bytes");
    expect_refused(folder, {"mesh", "naca:0012", "-o", "-", "-o", "-", "--format", "su2"}, usage, "is written by");
    expect_refused(folder, {"mesh", "naca:0012", "-o", "-", "--format", "su2", "--report", "-"}, usage,
                   "is written by");
    expect_refused(folder, {"mesh", "naca:0012", "-o", "a.su2", "--wall-data", "-", "--report", "-"}, usage,
                   "is written by");
    expect_refused(folder, {"mesh", "-", "-", "-o", "a.su2"}, usage, "given twice");
    expect_refused(folder, {"mesh", "naca:0012", "-o", "a.su2", "--background", "-"}, usage, "--background");
    expect_refused(folder, {"check", "-"}, usage, "give --input-format NAME");
    expect_refused(folder, {"check", "-", "--input-format", "openfoam"}, usage, "is not one stream of bytes");
    expect_refused(folder, {"check", "-", "--input-format", "mfem"}, usage, "only written");
    expect_refused(folder, {"convert", "-", "a.su2"}, usage, "give --input-format NAME");
    expect_refused(folder, {"convert", "a.su2", "-"}, usage, "give --format NAME");
    expect_refused(folder, {"plot", "a.su2", "-o", "-"}, usage, "give --format NAME");
    expect_refused(folder, {"plot", "a.su2", "-o", "a.png", "--format", "jpg"}, usage, "'jpg' is not known");
}

// A shell opens a file for standard output before lamina runs; what is renamed to its name would take its place.
TEST(Streams, TheFileBehindAStreamIsNotReplaced) {
    const TemporaryFolder folder;
    folder.write("a.dat", section);
    const std::string lamina = LAMINA_PROGRAM;
    const auto run = [&](const std::string& line) {
        return std::system(("cd '" + folder.path().string() + "' && '" + lamina + "' " + line + " 2> err").c_str());
    };
    EXPECT_NE(run("mesh a.dat -o - --format su2 --report r.json > r.json"), 0);
    EXPECT_NE(folder.read("err").find("is written by option --output - already"), std::string::npos);
    EXPECT_NE(run("mesh - -o a.dat --format su2 < a.dat"), 0);
    EXPECT_NE(folder.read("err").find("would replace the input '-'"), std::string::npos);
    EXPECT_EQ(folder.read("a.dat"), section);
    EXPECT_NE(run("mesh a.dat -o - --format su2 >> a.dat"), 0);
    EXPECT_EQ(folder.read("a.dat"), section);
}

TEST(Streams, APipeThatNobodyReadsEndsInOneLine) {
    const TemporaryFolder folder;
    ASSERT_EQ(run_lamina(folder, small_mesh({"-o", "a.su2"})).exit_code, 0);
    const std::vector<std::vector<std::string>> runs{small_mesh({"-o", "-", "--format", "su2", "--quiet"}),
                                                     small_mesh({"-o", "-", "--format", "vtu", "--quiet"}),
                                                     {"check", "a.su2"},
                                                     {"check", "a.su2", "--json"},
                                                     {"info", "naca:0012"},
                                                     {"mesh", "--help"},
                                                     {"--version"},
                                                     {"mesh", "naca:0012", "--dump-config"},
                                                     {"plot", "a.su2", "-o", "-", "--format", "png", "--width", "50"},
                                                     {"convert", "a.su2", "-", "--format", "msh22"},
                                                     {"completion", "bash"}};
    for (const std::vector<std::string>& arguments : runs) {
        const ProgramRun run = run_lamina_unread(folder, arguments);
        EXPECT_EQ(run.exit_code, io_failed) << arguments.front();
        EXPECT_TRUE(run.err.starts_with("lamina: error: standard output: cannot ")) << run.err;
        EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
    }
}

}  // namespace
}  // namespace lamina::test
