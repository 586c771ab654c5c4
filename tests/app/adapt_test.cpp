// lamina adapt: rounds, restarts of the loop, and solvers that fail. A script stands in for the solver.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <thread>
#include <vector>

#include <lamina/io.hpp>
#include <lamina/mesh.hpp>
#include <lamina/solution.hpp>

#include "app/program.hpp"

namespace lamina::test {
namespace {

/// A script that counts its calls, solves by tests/documentation/solution.py, and then runs these lines.
std::string script(const std::string& more) {
    return "#!/bin/sh\necho call >>\"$1/../../calls\"\npython3 " LAMINA_SOLUTION_SCRIPT
           " mesh.su2 solution.vtu || exit 9\nprintf 'CL,CD,steady,iterations\\n1.25,0.0125,yes,40\\n' >forces.csv\n" +
           more;
}

std::vector<std::string> adapt(const std::vector<std::string>& more = {},
                               const std::string& solver = "sh '../../so lve.sh' {case}") {
    std::vector<std::string> arguments{"adapt", "naca:0012", "--far-field", "10",   "--solver", solver,
                                       "-o",    "loop",      "--vertices",  "7000", "--rounds", "2"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
}

std::size_t calls(const TemporaryFolder& folder) { return lines_of(folder.read("calls")).size(); }

TEST(AdaptCommand, ClosesTheLoopAndGoesOnWhereItWas) {
    const TemporaryFolder folder;
    folder.write("so lve.sh", script(""));
    const ProgramRun first = run_lamina(folder, adapt());
    ASSERT_EQ(first.exit_code, 0) << first.err;
    EXPECT_EQ(calls(folder), 2u);
    for (const char* round : {"loop/round_0/", "loop/round_1/"}) {
        const Mesh mesh = read_mesh(folder / (round + std::string("mesh.vtu")));
        EXPECT_NEAR(double(mesh.points.size()), 7000, 0.05 * 7000) << round;
    }
    const Solution start = read_solution(folder / "loop/round_1/start.vtu", {"Mach", "mag(U)"});
    EXPECT_EQ(start.mesh.points.size(), start.fields[0].values.size());
    EXPECT_GT(*std::max_element(start.fields[0].values.begin(), start.fields[0].values.end()), 0.14);
    EXPECT_FALSE(std::filesystem::exists(folder / "loop/round_0/start.vtu"));
    const std::string page = folder.read("loop/adapt.html");
    EXPECT_NE(page.find("round_1/mesh.html"), std::string::npos);
    EXPECT_TRUE(std::filesystem::exists(folder / "loop/round_1/mesh.html"));
    const std::vector<std::string> table = lines_of(folder.read("loop/adapt.csv"));
    ASSERT_EQ(table.size(), 3u);
    EXPECT_NE(table[1].find(",40,yes,1.25,0.0125,"), std::string::npos) << table[1];

    // The same command has nothing to do; with more rounds it goes on, until the forces stay.
    const ProgramRun again = run_lamina(folder, adapt());
    ASSERT_EQ(again.exit_code, 0) << again.err;
    EXPECT_EQ(calls(folder), 2u);
    std::vector<std::string> more = adapt();
    more.back() = "9";
    ASSERT_EQ(run_lamina(folder, more).exit_code, 0);
    EXPECT_EQ(calls(folder), 3u);
    EXPECT_EQ(lines_of(folder.read("loop/adapt.csv")).size(), 4u);

    expect_refused(folder, adapt({"--gradation", "0.15"}), usage, "round_0: was made with other options");
    std::filesystem::rename(folder / "loop/round_0", folder / "elsewhere");
    expect_refused(folder, adapt(), usage, "a round before it is missing");
    std::filesystem::rename(folder / "elsewhere", folder / "loop/round_0");
    folder.write("loop/round_0/round.json", "{}");
    EXPECT_EQ(run_lamina(folder, adapt()).exit_code, bad_input);
}

TEST(AdaptCommand, WallsFollowTheSolutionWhereTheReynoldsNumberIsKnown) {
    const TemporaryFolder folder;
    folder.write("so lve.sh", script(""));
    std::vector<std::string> arguments = adapt({"--reynolds", "1e6"});
    *std::find(arguments.begin(), arguments.end(), "7000") = "20000";
    const ProgramRun run = run_lamina(folder, arguments);
    ASSERT_EQ(run.exit_code, 0) << run.err;
    const SizedMesh sizes = read_sizes(folder / "loop/round_1/sizes.vtu");
    ASSERT_EQ(sizes.walls.size(), 1u);
    const Mesh before = read_mesh(folder / "loop/round_0/mesh.vtu"),
               after = read_mesh(folder / "loop/round_1/mesh.vtu");
    EXPECT_EQ(sizes.walls[0].points.size(), wall_vertices(before).vertex.size());
    EXPECT_EQ(check_mesh(after).defect_count, 0u);
    EXPECT_NE(wall_vertices(after).first_height, wall_vertices(before).first_height);
}

TEST(AdaptCommand, TrianglesAreStretchedWhereThatIsAsked) {
    const TemporaryFolder folder;
    folder.write("so lve.sh", script(""));
    // With 7,000 vertices the growth of sizes from the layer on leaves none over.
    const auto stretched = [](std::vector<std::string> more) {
        std::vector<std::string> arguments = adapt(more);
        *std::find(arguments.begin(), arguments.end(), "7000") = "15000";
        return arguments;
    };
    for (const char* goal : {"fields", "drag"}) {
        const ProgramRun run = run_lamina(folder, stretched({"--anisotropy", "50", "--goal", goal}));
        ASSERT_EQ(run.exit_code, 0) << run.err;
        const Mesh mesh = read_mesh(folder / "loop/round_1/mesh.vtu");
        const MeshCheck check = check_mesh(mesh);
        EXPECT_EQ(check.defect_count, 0u);
        EXPECT_GT(check.isotropic.angles_below_bound, 100u);
        EXPECT_NEAR(double(mesh.points.size()), 15000, 0.02 * 15000);
        const Solution start = read_solution(folder / "loop/round_1/start.vtu", {"Mach"});
        EXPECT_EQ(start.fields[0].values.size(), mesh.points.size());
        expect_refused(folder, stretched({"--goal", goal}), usage, "was made with other options");
        std::filesystem::remove_all(folder / "loop");
    }
    expect_refused(folder, adapt({"--anisotropy", "much"}), usage, "--anisotropy");
    expect_refused(folder, adapt({"--order", "2"}), usage, "option --order");
    expect_refused(folder, adapt({"--anisotropy", "0.5"}), usage, "--anisotropy");
}

TEST(AdaptCommand, AFailedRoundLeavesThoseBefore) {
    const TemporaryFolder folder;
    folder.write("so lve.sh", script("test ! -e start.vtu || exit 7\n"));
    const ProgramRun failed = run_lamina(folder, adapt());
    EXPECT_EQ(failed.exit_code, io_failed);
    EXPECT_NE(failed.err.find("the solver ended with exit code 7"), std::string::npos) << failed.err;
    EXPECT_TRUE(std::filesystem::exists(folder / "loop/round_0/round.json"));
    EXPECT_EQ(lines_of(folder.read("loop/adapt.csv")).size(), 2u);
    const auto fails = [&](const std::string& last, const std::string& said) {
        folder.write("so lve.sh", script(last));
        const ProgramRun run = run_lamina(folder, adapt());
        EXPECT_EQ(run.exit_code, io_failed) << run.err;
        EXPECT_NE(run.err.find(said), std::string::npos) << run.err;
        EXPECT_FALSE(std::filesystem::exists(folder / "loop/round_1"));
    };
    fails("rm forces.csv\n", "has not left this file");
    fails("rm solution.vtu\n", "has not left this file");
    fails("printf 'CL,CD,steady\\nnan,0.01,yes\\n' >forces.csv\n", "has diverged");
    folder.write("so lve.sh", script(""));
    EXPECT_EQ(run_lamina(folder, adapt()).exit_code, 0);
    EXPECT_TRUE(std::filesystem::exists(folder / "loop/round_1/round.json"));
    for (const std::string& name : folder.names()) EXPECT_EQ(name.find(".part-"), std::string::npos) << name;
}

TEST(AdaptCommand, AGoalNeedsTheAdjointOfTheSolver) {
    const TemporaryFolder folder;
    folder.write("so lve.sh", script("sed -i 's/Ua/Ub/' solution.vtu\n"));
    const ProgramRun without = run_lamina(folder, adapt({"--goal", "drag"}));
    EXPECT_EQ(without.exit_code, usage);
    EXPECT_NE(without.err.find("no array 'Ua'"), std::string::npos) << without.err;
    std::filesystem::remove_all(folder / "loop");
    folder.write("so lve.sh", script(""));
    const ProgramRun run = run_lamina(folder, adapt({"--goal", "drag"}));
    EXPECT_EQ(run.exit_code, 0) << run.err;
    EXPECT_NE(run.err.find("in the goal"), std::string::npos) << run.err;
}

TEST(AdaptCommand, RefusesSolutionsThatItCannotUse) {
    const TemporaryFolder folder;
    folder.write("so lve.sh", script("sed -i 's/Mach/Much/' solution.vtu\n"));
    const ProgramRun renamed = run_lamina(folder, adapt());
    EXPECT_EQ(renamed.exit_code, usage);
    EXPECT_NE(renamed.err.find("no array 'Mach'"), std::string::npos) << renamed.err;
    std::filesystem::remove_all(folder / "loop");
    folder.write("so lve.sh", script("test -e start.vtu || sed -i '0,/^0\\.1[0-9]*$/s//nan/' solution.vtu\n"));
    const ProgramRun diverged = run_lamina(folder, adapt());
    EXPECT_EQ(diverged.exit_code, usage);
    EXPECT_NE(diverged.err.find("is not a finite number"), std::string::npos) << diverged.err;
}

TEST(AdaptCommand, ASignalEndsTheSolverAndTheLoopGoesOn) {
    const TemporaryFolder folder;
    folder.write("so lve.sh", script("test -e ../../quick || { echo $$ >../../pid; sleep 100; }\n"));
    const auto waits = [&] { return std::filesystem::exists(folder / "pid") && !folder.read("pid").empty(); };
    EXPECT_EQ(interrupt_lamina(folder, adapt(), SIGTERM, waits), SIGTERM);
    const int solver = std::stoi(folder.read("pid"));
    for (int i = 0; i < 500 && kill(solver, 0) == 0; ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
    EXPECT_NE(kill(solver, 0), 0);
    EXPECT_FALSE(std::filesystem::exists(folder / "loop/round_0"));
    folder.write("quick", "");
    EXPECT_EQ(run_lamina(folder, adapt()).exit_code, 0);
    EXPECT_TRUE(std::filesystem::exists(folder / "loop/round_1/round.json"));
}

TEST(AdaptCommand, SaysWhatIsMissingBeforeTheFirstMesh) {
    const TemporaryFolder folder;
    folder.write("so lve.sh", script(""));
    expect_refused(folder, adapt({}, "no_such_solver {case}"), usage, "no_such_solver is not in PATH");
    expect_refused(folder, adapt({}, "'./so lve.sh'"), usage, "./so lve.sh cannot be run");
    expect_refused(folder, adapt({}, "sh 'solve.sh"), usage, "the quote ' does not end");
    expect_refused(folder, adapt({}, " "), usage, "is empty");
    expect_refused(folder, adapt({"--goal", "drag"}, "su2"), usage, "needs an adjoint solution of the drag");
    expect_refused(folder, adapt({"--goal", "lift", "--mach", "0.2"}, "openfoam"), usage,
                   "in incompressible flow alone");
    expect_refused(folder, adapt({"--goal", "drags"}), usage, "drags");
    expect_refused(folder, adapt({"--goal", "drag", "--norm", "4"}), usage, "without --field and --norm");
    expect_refused(folder, adapt({"--tolerance", "0"}), usage, "tolerance");
    const std::vector<std::string> before = folder.names();
    const ProgramRun plan = run_lamina(folder, adapt({"--dry-run"}));
    EXPECT_EQ(plan.exit_code, 0) << plan.err;
    EXPECT_NE(plan.out.find("loop/round_1: 7000 vertices"), std::string::npos) << plan.out;
    EXPECT_EQ(folder.names(), before);
}

TEST(AdaptCommand, TakesItsCaseAsOtherCommandsDo) {
    const TemporaryFolder folder;
    folder.write("so lve.sh", script(""));
    folder.write("stream.toml", "input = ['naca:0012']\nstream = true\n");
    std::vector<std::string> streamed = adapt();
    streamed[1] = "stream.toml";
    expect_refused(folder, streamed, usage, "only 'lamina mesh' writes a mesh while it is made");
    folder.write("both.toml", "input = ['naca:0012']\nfirst_height = 1e-4\ny_plus = 1\nreynolds = 1e6\n");
    std::vector<std::string> contradiction = adapt();
    contradiction[1] = "both.toml";
    expect_refused(folder, contradiction, usage, "exclude each other");
    folder.write("cells.toml", "input = ['naca:0012']\ncells = 9000\n");
    std::vector<std::string> cells = adapt();
    cells[1] = "cells.toml";
    expect_refused(folder, cells, usage, "cells: the loop aims at vertices");
    expect_refused(folder, adapt({"--alpha", "0:4:2"}), usage, "lamina polar");
}

TEST(AdaptCommand, StrictRunsEndBeforeTheSolver) {
    const TemporaryFolder folder;
    folder.write("so lve.sh", script(""));
    const std::vector<std::string> coarse{"--first-height", "1e-4", "--layers", "3", "--rounds", "1"};
    std::vector<std::string> arguments = adapt();
    arguments.resize(arguments.size() - 4);
    arguments.insert(arguments.end(), coarse.begin(), coarse.end());
    const ProgramRun run = run_lamina(folder, arguments);
    EXPECT_EQ(run.exit_code, 0) << run.err;
    ASSERT_NE(run.err.find("lamina: warning:"), std::string::npos) << run.err;
    std::filesystem::remove_all(folder / "loop");
    arguments.push_back("--strict");
    const ProgramRun strict = run_lamina(folder, arguments);
    EXPECT_EQ(strict.exit_code, mesh_failed) << strict.err;
    EXPECT_NE(strict.err.find("(--strict)"), std::string::npos) << strict.err;
    EXPECT_EQ(calls(folder), 1u);
    EXPECT_FALSE(std::filesystem::exists(folder / "loop/round_0"));
}

TEST(AdaptCommand, AnglesBesideLinesAreNotPromised) {
    const TemporaryFolder folder;
    folder.write("so lve.sh", script(""));
    std::vector<std::string> arguments = adapt();
    arguments.resize(arguments.size() - 4);
    for (const char* word :
         {"--rounds", "1", "--first-height", "1e-4", "--layers", "8", "--line", "a:-0.2,0.05,1.2,0.06"})
        arguments.push_back(word);
    const ProgramRun run = run_lamina(folder, arguments);
    EXPECT_EQ(run.exit_code, 0) << run.err;
}

TEST(AdaptCommand, CountsThatAreNoneAreLeftOut) {
    for (const char* iterations : {"inf", "nan", "-3", "1e300", "many"}) {
        const TemporaryFolder folder;
        folder.write("so lve.sh", script(std::string("printf 'CL,CD,steady,iterations\\n1.25,0.0125,yes,") +
                                         iterations + "\\n' >forces.csv\n"));
        std::vector<std::string> arguments = adapt();
        arguments.back() = "1";
        const ProgramRun run = run_lamina(folder, arguments);
        ASSERT_EQ(run.exit_code, 0) << run.err;
        const std::vector<std::string> table = lines_of(folder.read("loop/adapt.csv"));
        EXPECT_NE(table[1].find(",,yes,1.25,0.0125,"), std::string::npos) << iterations << ": " << table[1];
    }
}

TEST(AdaptCommand, ALostExitCodeIsNoSuccess) {
    const TemporaryFolder folder;
    // Where SIGCHLD is ignored, the system keeps no exit codes of children.
    folder.write("run.py",
                 "import os, signal, sys\nsignal.signal(signal.SIGCHLD, signal.SIG_IGN)\n"
                 "os.dup2(os.open('said', os.O_WRONLY | os.O_CREAT), 2)\nos.execv(sys.argv[1], sys.argv[1:])\n");
    std::string command = "cd '" + folder.path().string() + "' && python3 run.py " LAMINA_PROGRAM;
    for (const std::string& word : adapt({}, "true")) command += " '" + word + "'";
    EXPECT_EQ(WEXITSTATUS(std::system(command.c_str())), io_failed);
    EXPECT_NE(folder.read("said").find("its exit code cannot be read"), std::string::npos) << folder.read("said");
}

}  // namespace
}  // namespace lamina::test
