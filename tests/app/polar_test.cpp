// Polars: lamina flow with a range of angles, lamina polar, lamina yplus, ranges in sweeps. A script stands in for the
// solver.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "app/program.hpp"
#include "support/geometry_fixtures.hpp"

namespace lamina::test {
namespace {

namespace fs = std::filesystem;

TEST(FlowPolar, IsPrintedAndWrittenAsXfoilDoes) {
    const TemporaryFolder folder;
    const ProgramRun run = run_lamina(
        folder, {"flow", "naca:0012", "--alpha", "-4:18:2", "--reynolds", "3e6", "-o", "a.txt", "--picture", "a.svg"});
    ASSERT_EQ(run.exit_code, 0) << run.err;
    const std::vector<std::string> said = lines_of(run.out);
    ASSERT_EQ(said.size(), 2u + 12u) << run.out;
    EXPECT_NE(said[2].find("-4.000"), std::string::npos) << said[2];
    EXPECT_NE(said[2].find("attached"), std::string::npos) << said[2];
    EXPECT_NE(said.back().find("separated"), std::string::npos) << said.back();
    const std::vector<std::string> rows = lines_of(folder.read("a.txt"));
    ASSERT_GT(rows.size(), 12u + 5u);
    EXPECT_EQ(rows[8], " Mach =   0.000     Re =     3.000 e 6     Ncrit =   9.000");
    EXPECT_EQ(rows[10], "   alpha    CL        CD       CDp       CM     Top_Xtr  Bot_Xtr");
    // Columns have the widths of XFOIL's.
    for (std::size_t i = 12; i < rows.size(); ++i) EXPECT_EQ(rows[i].size(), rows[11].size()) << rows[i];
    EXPECT_EQ(rows.size(), 12u + 12u);
    EXPECT_EQ(run_lamina(folder, {"flow", "naca:0012", "--alpha=0:2", "-o", "b.csv"}).exit_code, 0);
    EXPECT_EQ(lines_of(folder.read("b.csv")).size(), 4u);
    EXPECT_NE(folder.read("b.csv").find("inviscid"), std::string::npos);
}

TEST(FlowPolar, TakesRangesFromCaseFilesAndRefusesWrongOnes) {
    const TemporaryFolder folder;
    folder.write("case.toml", "input = \"naca:0012\"\nalpha = \"-2:2:2\"\nreynolds = 1e6\n");
    EXPECT_EQ(run_lamina(folder, {"flow", "case.toml", "-o", "a.json"}).exit_code, 0);
    const auto polar = nlohmann::json::parse(folder.read("a.json"));
    EXPECT_EQ(polar["rows"].size(), 3u);
    EXPECT_EQ(polar["rows"][0]["alpha"], -2);
    const TemporaryFolder empty;
    for (const char* range : {"0:10:0", "0:10:-1", "0:1e9:1", "0:1e9"})
        expect_refused(empty, {"flow", "naca:0012", "--alpha", range}, usage, "option --alpha");
    expect_refused(empty, {"flow", "naca:0012", "--alpha", "10:0"}, usage, "A is above B");
    expect_refused(empty, {"flow", "naca:0012", "--alpha", "0:100"}, usage, "90");
    expect_refused(empty, {"mesh", "naca:0012", "--alpha", "0:x", "-o", "a.su2"}, usage, "option --alpha");
    expect_refused(empty, {"case", "su2", "naca:0012", "--alpha", "0:4", "--reynolds", "1e6", "-o", "a"}, usage,
                   "lamina polar");
    expect_refused(empty, {"mesh", "naca:0012", "--alpha", "0:4", "--tunnel", "3", "-o", "a.su2"}, usage, "alpha");
}

TEST(Sweeps, TakeRanges) {
    const TemporaryFolder folder;
    const ProgramRun run = run_lamina(
        folder, {"batch", "naca:0012", "-o", "{name}_{alpha}_{growth}.su2", "--sweep", "alpha=-1:1,4", "--sweep",
                 "growth=1.2:1.3:0.1", "--far-field", "5", "--layers", "3", "--first-height", "1e-3", "--quiet"});
    ASSERT_EQ(run.exit_code, 0) << run.err;
    for (const char* alpha : {"-1", "0", "1", "4"})
        for (const char* growth : {"1.2", "1.3"})
            EXPECT_TRUE(fs::exists(folder / ("naca_0012_" + std::string(alpha) + "_" + growth + ".su2"))) << alpha;
    const TemporaryFolder empty;
    expect_refused(empty, {"batch", "naca:0012", "-o", "{alpha}.su2", "--sweep", "alpha=4:0"}, usage, "A is above B");
    expect_refused(empty, {"batch", "naca:0012", "-o", "{reynolds}.su2", "--sweep", "reynolds=1:1e9:1"}, usage,
                   "10000 values");
}

TEST(PolarCommand, WritesThePolarOfTheFlowAndSaysWhereItIsStalled) {
    const TemporaryFolder folder;
    const std::vector<std::string> attached{"polar", "naca:0012", "--alpha", "0:4:2", "--reynolds", "3e6", "-o", "out"};
    const ProgramRun run = run_lamina(folder, attached);
    ASSERT_EQ(run.exit_code, 0) << run.err;
    for (const char* file : {"out/polar.csv", "out/polar.json", "out/polar.txt"})
        EXPECT_TRUE(fs::exists(folder / file)) << file;
    // Layers in a row of blades do not displace the flow.
    const ProgramRun stalled = run_lamina(
        folder, {"polar", "naca:0012", "--alpha", "0:30:30", "--reynolds", "3e6", "--periodic", "2", "-o", "row"});
    EXPECT_EQ(stalled.exit_code, mesh_failed);
    EXPECT_NE(stalled.err.find("1 of 2 angles are not steady"), std::string::npos) << stalled.err;
    EXPECT_NE(folder.read("row/polar.csv").find(",stalled,no"), std::string::npos);
    const std::string caution = "layers do not displace this flow: its lift is";
    EXPECT_NE(stalled.out.find(caution), std::string::npos) << stalled.out;
    EXPECT_EQ(run.out.find(caution), std::string::npos) << run.out;
    EXPECT_EQ(nlohmann::json::parse(folder.read("row/polar.json"))["undisplaced"], true);
    EXPECT_NE(run_lamina(folder, {"flow", "naca:0012", "--reynolds", "3e6", "--periodic", "1"}).out.find(caution),
              std::string::npos);
    const TemporaryFolder empty;
    expect_refused(empty, {"polar", "naca:0012", "--alpha", "4", "-o", "out"}, usage, "a polar needs a range");
    expect_refused(empty, {"polar", "naca:0012", "--alpha", "0:4", "--order", "2", "-o", "out"}, usage, "--order");
}

TEST(PolarCommand, BendsBeyondStall) {
    const TemporaryFolder folder;
    const ProgramRun run = run_lamina(
        folder, {"polar", "naca:0012", "--alpha", "8:20:6", "--velocity", "15", "--viscosity", "1.5e-5", "-o", "out"});
    EXPECT_EQ(run.exit_code, 0) << run.err;
    EXPECT_NE(folder.read("out/polar.csv").find(",separated,yes"), std::string::npos);
    EXPECT_EQ(lines_of(folder.read("out/polar.txt")).size(), 12u + 3u);
    // Velocity and viscosity are a Reynolds number, too.
    EXPECT_NE(run.out.find("Reynolds number 1e+06"), std::string::npos) << run.out;
    const auto polar = nlohmann::json::parse(folder.read("out/polar.json"));
    EXPECT_EQ(polar["reynolds"], 1e6);
    EXPECT_LT(polar["rows"][2]["CL"], polar["rows"][1]["CL"]);
}

/// The bubble on the lower side is open at 95 % of it, and closes ahead of the trailing edge.
TEST(FlowPolar, BubblesThatCloseAheadOfTheTrailingEdgeAreAttached) {
    const ProgramRun run =
        run_lamina(TemporaryFolder(), {"flow", "naca:0012", "--alpha", "4:8:4", "--reynolds", "1e6"});
    ASSERT_EQ(run.exit_code, 0) << run.err;
    const std::vector<std::string> lines = lines_of(run.out);
    ASSERT_GE(lines.size(), 4u) << run.out;
    EXPECT_TRUE(lines[2].ends_with("attached")) << lines[2];
    EXPECT_TRUE(lines[3].ends_with("separated")) << lines[3];
}

TEST(FlowPolar, TripsAndWavesMakeLayersTurbulent) {
    const TemporaryFolder folder;
    const ProgramRun run = run_lamina(folder, {"flow", "naca:0012", "--alpha", "0:2:2", "--reynolds", "1e6", "--trip",
                                               "0.1", "--trip-lower", "0.2", "--ncrit", "5", "-o", "a.txt"});
    ASSERT_EQ(run.exit_code, 0) << run.err;
    EXPECT_NE(run.out.find("  0.1000   0.2000  attached"), std::string::npos) << run.out;
    const std::vector<std::string> rows = lines_of(folder.read("a.txt"));
    EXPECT_EQ(rows[7], " xtrf =   0.100 (top)        0.200 (bottom)  ");
    EXPECT_EQ(rows[8], " Mach =   0.000     Re =     1.000 e 6     Ncrit =   5.000");
    expect_refused(folder, {"flow", "naca:0012", "--reynolds", "1e6", "--trip", "2"}, usage, "option --trip");
    expect_refused(folder, {"flow", "naca:0012", "--reynolds", "1e6", "--ncrit", "0"}, usage, "option --ncrit");
    // Layers that do not displace the flow have no such options.
    expect_refused(folder, {"flow", "naca:0012", "--trip", "0.1"}, usage, "trip");
    expect_refused(folder, {"flow", "naca:0012", "--reynolds", "5e3", "--ncrit", "5"}, usage, "ncrit");
    expect_refused(folder, {"polar", "naca:0012", "--alpha", "0:2:2", "--solver", "su2", "--trip", "0.1", "-o", "p"},
                   usage, "--solver flow");
}

TEST(PolarCommand, DragWithoutLayersIsNoDrag) {
    const TemporaryFolder folder;
    const ProgramRun run = run_lamina(folder, {"polar", "naca:0012", "--alpha", "0:0.5", "--mach", "0.8", "-o", "out"});
    ASSERT_EQ(run.exit_code, 0) << run.err;
    const std::vector<std::string> rows = lines_of(folder.read("out/polar.csv"));
    ASSERT_EQ(rows.size(), 2u);
    EXPECT_NE(rows[1].find(",,,,,,,inviscid,yes"), std::string::npos) << rows[1];
    EXPECT_EQ(lines_of(folder.read("out/polar.txt")).size(), 12u);
}

TEST(PolarCommand, RunsASolverAtEachAngleAndGoesOnWhereItWas) {
    const TemporaryFolder folder;
    // Lift is a tenth of the angle; the flow at 4 degrees is not steady at first.
    folder.write("solve.sh", "#!/bin/sh\necho call >>\"$1/../../calls\"\npython3 " LAMINA_SOLUTION_SCRIPT
                             " mesh.su2 solution.vtu || exit 9\nalpha=$(sed -n 's/^alpha = //p' case.toml)\n"
                             "steady=yes\n[ \"$alpha\" = 2.0 ] && steady=no\n[ \"$alpha\" = 2 ] && steady=no\n"
                             "[ -f start.vtu ] && echo start >>\"$1/../../starts\"\n"
                             "printf 'CL,CD,CM,y_plus,steady\\n%s,0.01,-0.02,0.7,%s\\n' $alpha $steady >forces.csv\n");
    const std::vector<std::string> arguments{
        "polar",       "naca:0012", "--alpha", "0:6:2", "--solver", "sh ../../solve.sh {case}",
        "--far-field", "10",        "-o",      "out"};
    const ProgramRun run = run_lamina(folder, arguments);
    EXPECT_EQ(run.exit_code, mesh_failed) << run.err;
    EXPECT_NE(run.err.find("1 of 4 angles"), std::string::npos) << run.err;
    EXPECT_EQ(lines_of(folder.read("calls")).size(), 4u);
    EXPECT_EQ(lines_of(folder.read("starts")).size(), 3u);
    const std::vector<std::string> rows = lines_of(folder.read("out/polar.csv"));
    ASSERT_EQ(rows.size(), 5u);
    EXPECT_EQ(rows[1], "0,0,0.01,,-0.02,,,0.7,steady,yes");
    EXPECT_EQ(rows[2], "2,2,0.01,,-0.02,,,0.7,not steady,no");
    EXPECT_EQ(rows[4], "6,6,0.01,,-0.02,,,0.7,steady,yes");
    // What is there is kept; an angle that was removed is solved again.
    fs::remove_all(folder / "out/alpha_6");
    EXPECT_EQ(run_lamina(folder, arguments).exit_code, mesh_failed);
    EXPECT_EQ(lines_of(folder.read("calls")).size(), 5u);
    EXPECT_EQ(lines_of(folder.read("out/polar.csv")), rows);
    // The format of XFOIL has columns that no solver fills. Its polar is not replaced by that of the flow.
    EXPECT_FALSE(fs::exists(folder / "out/polar.txt"));
    EXPECT_EQ(nlohmann::json::parse(folder.read("out/polar.json"))["name"], "naca:0012");
    expect_refused(folder, {"polar", "naca:0012", "--alpha", "0:6:2", "-o", "out"}, usage, "the polar of a solver");
    EXPECT_EQ(lines_of(folder.read("out/polar.csv")), rows);
    // Angles of other options are found before any is solved.
    fs::remove_all(folder / "out/alpha_0");
    std::vector<std::string> others = arguments;
    *std::find(others.begin(), others.end(), "10") = "12";
    expect_refused(folder, others, usage, "alpha_2: was made with other options");
    EXPECT_EQ(lines_of(folder.read("calls")).size(), 5u);
}

TEST(PolarCommand, FailedAnglesStayUntilTheyAreTriedAgain) {
    const TemporaryFolder folder;
    const std::string solves = "#!/bin/sh\npython3 " LAMINA_SOLUTION_SCRIPT
                               " mesh.su2 solution.vtu || exit 9\nprintf 'CL,CD,steady\\n1,0.01,yes\\n' >forces.csv\n";
    folder.write("solve.sh", solves + "grep -q '^alpha = 2' case.toml && exit 7\nexit 0\n");
    fs::create_directories(folder / "out/alpha.part-1");
    const std::vector<std::string> arguments{
        "polar", "naca:0012:60", "--alpha", "0:4:2", "--solver", "sh ../../solve.sh", "--far-field", "4", "-o", "out"};
    const ProgramRun run = run_lamina(folder, arguments);
    EXPECT_EQ(run.exit_code, mesh_failed) << run.err;
    EXPECT_FALSE(fs::exists(folder / "out/alpha.part-1"));
    const auto polar = nlohmann::json::parse(folder.read("out/polar.json"));
    EXPECT_EQ(polar["rows"][1]["state"], "failed");
    EXPECT_EQ(polar["rows"][1]["note"], "out/alpha_2.failed/log.solver: the solver ended with exit code 7");
    EXPECT_TRUE(fs::exists(folder / "out/alpha_2.failed/log.solver"));
    EXPECT_EQ(polar["rows"][2]["state"], "steady");
    // The next one begins from rest where the flow before it cannot be read.
    folder.write("solve.sh", solves);
    folder.write("out/alpha_0/solution.vtu", "nothing");
    const ProgramRun again = run_lamina(folder, arguments);
    EXPECT_EQ(again.exit_code, 0) << again.err;
    EXPECT_NE(again.err.find("2 degrees begin from rest"), std::string::npos) << again.err;
    EXPECT_FALSE(fs::exists(folder / "out/alpha_2.failed"));
    EXPECT_TRUE(fs::exists(folder / "out/alpha_2/row.json"));
}

TEST(PolarCommand, RefusesCurvedCellsOfCaseFiles) {
    const TemporaryFolder folder;
    folder.write("curved.toml", "input = 'naca:0012'\norder = 2\nalpha = '0:2'\n");
    expect_refused(folder, {"polar", "curved.toml", "--solver", "true", "-o", "out"}, usage, "curved cells");
}

TEST(YPlusCommand, ComputesFirstHeightsWithoutASection) {
    const TemporaryFolder folder;
    const ProgramRun run = run_lamina(folder, {"yplus", "--reynolds", "6e6", "--y-plus", "1", "--chord", "2"});
    ASSERT_EQ(run.exit_code, 0) << run.err;
    EXPECT_NE(run.out.find("4.457e-06 chords, 8.914e-06 units"), std::string::npos) << run.out;
    const ProgramRun back =
        run_lamina(folder, {"yplus", "--velocity", "90", "--viscosity", "1.5e-5", "--first-height", "8.914e-6u"});
    ASSERT_EQ(back.exit_code, 0) << back.err;
    EXPECT_NE(back.out.find("y+          2"), std::string::npos) << back.out;
    expect_refused(folder, {"yplus"}, usage, "reynolds");
    expect_refused(folder, {"yplus", "--reynolds", "1e200", "--y-plus", "1e-200"}, usage, "--y-plus");
    expect_refused(folder, {"yplus", "--reynolds", "1e6", "--y-plus", "1", "--first-height", "1e-5"}, usage,
                   "exclude each other");
}

TEST(MeshOfARange, ServesAnglesAndABudget) {
    const TemporaryFolder folder;
    const ProgramRun run =
        run_lamina(folder, {"mesh", "naca:4412", "--alpha", "0:12:4", "--reynolds", "1e6", "--far-field", "10",
                            "--vertices", "20000", "-o", "a.su2", "--report", "a.json"});
    ASSERT_EQ(run.exit_code, 0) << run.err;
    EXPECT_NE(run.out.find("one mesh for all angles"), std::string::npos) << run.out;
    EXPECT_NE(run.out.find("angle of attack 0:12:4 deg (given), 8 where one is needed"), std::string::npos) << run.out;
    const auto report = nlohmann::json::parse(folder.read("a.json"));
    EXPECT_NEAR(report["vertices"].get<double>(), 20000, 0.03 * 20000);
    EXPECT_NE(report["scale"].get<double>(), 1);
    EXPECT_EQ(report["conditions"]["angles"].size(), 4u);
    expect_refused(folder, {"mesh", "naca:0012", "--vertices", "20000", "--cells", "9000", "-o", "b.su2"}, usage,
                   "exclude each other");
}

}  // namespace
}  // namespace lamina::test
