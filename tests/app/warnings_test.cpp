// Warnings, --strict, and runs that are refused before the work.
#include <gtest/gtest.h>

#include <chrono>
#include <set>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "app/program.hpp"

namespace lamina::test {
namespace {

using WarningsJson = nlohmann::json;

constexpr int not_to_the_standard = 4;

const std::vector<std::string> coarse_section{
    "mesh", "naca:4412:40", "--layer-topology", "delaunay", "--layers", "30",   "--far-field",
    "10",   "--quiet",      "--report",         "r.json",   "-o",       "m.su2"};

TEST(WarningsOfTheProgram, AreLinesAndDataAlsoUnderQuiet) {
    const TemporaryFolder folder;
    const ProgramRun run = run_lamina(folder, coarse_section);
    EXPECT_EQ(run.exit_code, 0);
    EXPECT_EQ(run.out, "");
    const WarningsJson warnings = WarningsJson::parse(folder.read("r.json"))["warnings"];
    const std::vector<std::string> lines = lines_of(run.err);
    ASSERT_EQ(lines.size(), warnings.size()) << run.err;
    ASSERT_GE(warnings.size(), 1u);
    for (std::size_t i = 0; i < lines.size(); ++i)
        EXPECT_EQ(lines[i], "lamina: warning: " + warnings[i]["message"].get<std::string>());
    EXPECT_EQ(warnings[0]["code"], "first_layer_lost");
    EXPECT_EQ(warnings[0]["unit"], "wall edges");
    EXPECT_GT(warnings[0]["number"].get<double>(), 0);
    EXPECT_EQ(warnings[0]["at"].size(), 2u);
}

TEST(WarningsOfTheProgram, StrictWritesTheOutputsAndFails) {
    const TemporaryFolder folder;
    std::vector<std::string> arguments = coarse_section;
    arguments.push_back("--strict");
    const ProgramRun run = run_lamina(folder, arguments);
    EXPECT_EQ(run.exit_code, not_to_the_standard);
    EXPECT_EQ(folder.names(), (std::vector<std::string>{"m.su2", "r.json"}));
    EXPECT_TRUE(lines_of(run.err).back().starts_with("lamina: error: ")) << run.err;
    const ProgramRun good = run_lamina(folder, {"mesh", "naca:0012", "--far-field", "10", "--strict", "-o", "g.su2"});
    EXPECT_EQ(good.exit_code, 0) << good.err;
    EXPECT_EQ(good.err, "");
}

/// A plate with a slit that narrows to a point.
const std::string plate_with_slit = "1 0\n1 0.1\n0.61 0.1\n0.2 0.03\n0.6 0.1\n0 0.1\n0 0\n1 0\n";

TEST(WarningsOfTheProgram, AnglesBelowTheBoundWriteNothingUnlessDefectsAreAllowed) {
    const TemporaryFolder folder;
    folder.write("slit.dat", plate_with_slit);
    const std::vector<std::string> arguments{"mesh", "slit.dat", "--far-field", "4",    "--surface",
                                             "keep", "--quiet",  "-o",          "m.su2"};
    const ProgramRun refused = run_lamina(folder, arguments);
    EXPECT_EQ(refused.exit_code, not_to_the_standard);
    EXPECT_NE(lines_of(refused.err).back().find("--allow-defects"), std::string::npos) << refused.err;
    EXPECT_EQ(folder.names(), std::vector<std::string>{"slit.dat"});

    std::vector<std::string> allowed = arguments;
    allowed.push_back("--allow-defects");
    const ProgramRun run = run_lamina(folder, allowed);
    EXPECT_EQ(run.exit_code, 0) << run.err;
    EXPECT_NE(run.err.find("angle below the bound"), std::string::npos) << run.err;
    EXPECT_EQ(run_lamina(folder, {"check", "m.su2"}).exit_code, 0);
}

/// A square that is 10 wide, as a .poly file.
const std::string wide_square = "4 2 0 0\n1 0 0\n2 10 0\n3 10 10\n4 0 10\n4 0\n1 1 2\n2 2 3\n3 3 4\n4 4 1\n0\n";

TEST(WarningsOfTheProgram, WhatTheReaderFoundIsSaidByCommandsWithoutAMesh) {
    const TemporaryFolder folder;
    for (const std::vector<std::string>& arguments :
         std::vector<std::vector<std::string>>{{"flow", "naca:63012", "-o", "f.csv"},
                                               {"plot", "naca:63012", "-o", "p.svg"},
                                               {"mesh", "naca:63012", "--far-field", "10", "--quiet", "-o", "m.su2"}}) {
        const ProgramRun run = run_lamina(folder, arguments);
        EXPECT_EQ(run.exit_code, 0) << run.err;
        EXPECT_EQ(run.err.find("lamina: warning: airfoil: naca:63012 is the five-digit section"), 0u) << run.err;
    }
    EXPECT_NE(run_lamina(folder, {"info", "naca:63012"}).out.find("naca:63012 is the five-digit"), std::string::npos);
}

TEST(WarningsOfTheProgram, DelaunayWarnsToo) {
    const TemporaryFolder folder;
    folder.write("square.poly", wide_square);
    const std::vector<std::string> kept{"delaunay",      "square.poly", "--max-area", "0.01",
                                        "--keep-border", "--quiet",     "--report",   "r.json"};
    const ProgramRun run = run_lamina(folder, kept);
    EXPECT_EQ(run.exit_code, 0) << run.err;
    EXPECT_TRUE(run.err.starts_with("lamina: warning: ")) << run.err;
    std::set<std::string> codes;
    const WarningsJson report = WarningsJson::parse(folder.read("r.json"));
    for (const WarningsJson& warning : report["warnings"]) codes.insert(warning["code"].get<std::string>());
    EXPECT_TRUE(codes.count("oversized_triangles")) << run.err;
    std::vector<std::string> strict = kept;
    strict.push_back("--strict");
    EXPECT_EQ(run_lamina(folder, strict).exit_code, not_to_the_standard);
    const ProgramRun good =
        run_lamina(folder, {"delaunay", "square.poly", "--max-area", "0.01", "--min-angle", "20.7", "--strict"});
    EXPECT_EQ(good.exit_code, 0) << good.err;
    EXPECT_EQ(good.err, "");
}

/// Expects a refusal in less than two seconds, or ten times as long under sanitizers, that names the option and gives
/// the estimate.
void expect_refused_at_once(const TemporaryFolder& folder, std::vector<std::string> arguments,
                            const std::string& option) {
    const auto start = std::chrono::steady_clock::now();
    expect_refused(folder, arguments, usage, option);
    const ProgramRun run = run_lamina(folder, arguments);
    EXPECT_NE(run.err.find(" triangles, "), std::string::npos) << run.err;
    constexpr double seconds_for_two_runs = LAMINA_SANITIZED ? 40 : 4;
    EXPECT_LT(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(), seconds_for_two_runs);
}

TEST(LimitsOfTheProgram, RunsBeyondThemAreRefusedBeforeTheWork) {
    const TemporaryFolder folder;
    folder.write("square.poly", wide_square);
    expect_refused_at_once(folder, {"delaunay", "square.poly", "--max-area", "1e-12"}, "--max-area: 1e-12 asks for");
    expect_refused_at_once(folder, {"delaunay", "square.poly", "--max-area", "1e-3", "--max-triangles", "10000"},
                           "10000 triangles are allowed");
    expect_refused_at_once(folder, {"delaunay", "square.poly", "--max-area", "1e-4", "--max-memory", "50M"},
                           "50 MiB of memory are allowed");
    expect_refused_at_once(
        folder, {"mesh", "naca:0012", "--far-size", "0.001", "--far-field", "20", "--max-memory", "18G", "-o", "m.su2"},
        "option --far-size: 0.001 asks for");
    expect_refused_at_once(folder,
                           {"mesh", "naca:0012", "--surface-points", "1e7", "--max-memory", "18G", "-o", "m.su2"},
                           "option --surface-points: 10000000 asks for");
    folder.write("strip.poly", "4 2 0 0\n1 0 0\n2 4e3 0\n3 4e3 0.5\n4 0 0.5\n4 0\n1 1 2\n2 2 3\n3 3 4\n4 4 1\n0\n");
    expect_refused_at_once(folder, {"delaunay", "strip.poly", "--min-angle", "20.7", "--max-triangles", "2000"},
                           "--min-angle: 20.7, with segments so close together, asks for");
    expect_refused_at_once(folder, {"mesh", "naca:0012", "--max-triangles", "20000", "-o", "m.su2"}, "--max-triangles");
    expect_refused_at_once(folder, {"mesh", "naca:0012", "--max-triangles", "2e4", "-o", "m.su2"},
                           "20000 triangles are allowed");
}

}  // namespace
}  // namespace lamina::test
