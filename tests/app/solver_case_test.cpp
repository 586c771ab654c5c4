// lamina case: what it writes, what it refuses, and that OpenFOAM runs it where it is installed.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <lamina/io.hpp>
#include <lamina/mesh.hpp>

#include "app/program.hpp"

namespace lamina::test {
namespace {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;

/// Returns the arguments for a case with some 5,000 cells.
Words small_case(const std::string& solver, const Words& more = {}) {
    Words words{"case",     solver, "naca:0012",     "--reynolds", "1e6",         "--alpha",  "4",
                "-o",       "c",    "--quiet",       "--use-flow", "no",          "--y-plus", "2",
                "--growth", "1.4",  "--spacing-max", "0.05",       "--gradation", "0.4"};
    words.insert(words.end(), more.begin(), more.end());
    return words;
}

TEST(SolverCaseCommand, WritesAMeshInQuadsAndTheCase) {
    const TemporaryFolder folder;
    const ProgramRun run = run_lamina(folder, small_case("openfoam", {"--report", "r.json"}));
    ASSERT_EQ(run.exit_code, 0) << run.err;
    EXPECT_EQ(run.err, "");
    for (const char* file : {"Allrun", "Allclean", "0/U", "0/p", "0/nut", "0/nuTilda", "constant/transportProperties",
                             "constant/turbulenceProperties", "system/controlDict", "system/fvSchemes",
                             "system/fvSolution", "constant/polyMesh/faces"})
        EXPECT_TRUE(fs::exists(folder / "c" / file)) << file;
    const Mesh mesh = read_mesh(folder / "c");
    EXPECT_TRUE(check_mesh(mesh).valid());
    EXPECT_GT(mesh.quads.size(), mesh.triangles.size() / 4);
    const auto report = nlohmann::json::parse(folder.read("r.json"));
    EXPECT_EQ(report["warnings"].size(), 0u);
    EXPECT_NE(folder.read("c/Allrun").find("angles=\"4\" "), std::string::npos);
}

TEST(SolverCaseCommand, WritesSu2WithAFarFieldForAUniformStream) {
    const TemporaryFolder folder;
    const ProgramRun run = run_lamina(folder, small_case("su2", {"--mach", "0.2", "--inlet-outlet"}));
    ASSERT_EQ(run.exit_code, 0) << run.err;
    const std::string text = folder.read("c/case.cfg");
    for (const char* line : {"\nMACH_NUMBER= 0.2\n", "\nAOA= 4\n", "\nREYNOLDS_NUMBER= 1000000\n",
                             "\nMARKER_FAR= ( inlet, outlet )\n", "\nMARKER_HEATFLUX= ( airfoil, 0.0 )\n"})
        EXPECT_NE(text.find(line), std::string::npos) << line;
    const Mesh mesh = read_mesh(folder / "c/mesh.su2");
    double farthest = 0;
    for (const Point p : mesh.points) farthest = std::max(farthest, std::abs(p.y));
    EXPECT_NEAR(farthest, 5000, 10);
}

/// Returns a word of a text that stands before a list in parentheses, and the words in it: "walls" of "walls (a b);".
std::vector<std::string> list_behind(const std::string& text, const std::string& beginning, const std::string& end) {
    const std::size_t at = text.find(beginning);
    EXPECT_NE(at, std::string::npos) << beginning;
    const std::size_t from = at + beginning.size();
    std::istringstream words(text.substr(from, text.find(end, from) - from));
    return {std::istream_iterator<std::string>(words), {}};
}

// Markers with names that no solver takes have the same other ones in every file of a run.
TEST(SolverCaseCommand, NamesOfMarkersAreTheSameInEveryFile) {
    const TemporaryFolder folder;
    folder.write("0012.dat", "0012\n1 0\n0.7 0.05\n0.3 0.08\n0 0\n0.3 -0.08\n0.7 -0.05\n1 0\n");
    folder.write("63-215.dat", "63-215\n1 0\n0.7 0.05\n0.3 0.08\n0 0\n0.3 -0.08\n0.7 -0.05\n1 0\n");
    const Words names{"wall_0012", "wall_63-215"};
    const auto case_for = [&](const char* solver) {
        return run_lamina(folder, {"case",     solver,   "0012.dat",    "63-215.dat", "--transform", "63-215:shift:0,1",
                                   "-o",       solver,   "--reynolds",  "1e5",        "--use-flow",  "no",
                                   "--y-plus", "2",      "--gradation", "0.4",        "--growth",    "1.4",
                                   "--report", "r.json", "--html",      "r.html",     "--wall-data", "w.csv"});
    };
    const ProgramRun openfoam = case_for("openfoam");
    ASSERT_EQ(openfoam.exit_code, 0) << openfoam.err;
    for (const Words& said : {Words{"0012", names[0]}, Words{"63-215", names[1]}}) {
        const std::string warning =
            fmt::format("lamina: warning: {1}: the name '{0}' does not begin with a letter: the marker is '{1}'\n",
                        said[0], said[1]);
        EXPECT_EQ(openfoam.err.find(warning), openfoam.err.rfind(warning));
        EXPECT_NE(openfoam.err.find(warning), std::string::npos) << openfoam.err;
    }
    const Mesh mesh = read_mesh(folder / "openfoam");
    for (std::size_t i = 0; i < 2; ++i) EXPECT_EQ(mesh.markers[i].name, names[i]);
    EXPECT_EQ(list_behind(folder.read("openfoam/Allrun"), "walls=\"", "\""), names);
    const std::string control = folder.read("openfoam/system/controlDict");
    EXPECT_EQ(list_behind(control, "patches         (", ")"), names);
    for (const std::string& name : names)
        EXPECT_NE(control.find(fmt::format("{0} {{ type patch; patches ({0}); }}", name)), std::string::npos);
    const auto report = nlohmann::json::parse(folder.read("r.json"));
    EXPECT_EQ(report["input"][1]["name"], names[1]);
    EXPECT_EQ(report["quality"]["walls"]["first_heights"][0]["marker"], names[0]);
    EXPECT_EQ(report["warnings"][0]["code"], "marker_renamed");
    EXPECT_NE(folder.read("r.html").find("<title>wall_0012, wall_63-215"), std::string::npos);
    EXPECT_NE(folder.read("w.csv").find("\nwall_63-215,"), std::string::npos);
    EXPECT_EQ(folder.read("w.csv").find("\n63-215,"), std::string::npos);

    const ProgramRun su2 = case_for("su2");
    ASSERT_EQ(su2.exit_code, 0) << su2.err;
    EXPECT_EQ(list_behind(folder.read("su2/case.cfg"), "MARKER_MONITORING= (", ")"), (Words{names[0] + ",", names[1]}));
    EXPECT_NE(folder.read("su2/mesh.su2").find("MARKER_TAG= wall_63-215\n"), std::string::npos);
}

TEST(SolverCaseCommand, TunnelsAndGroundAreSlipWallsWithoutAVortex) {
    const TemporaryFolder folder;
    const Words walls{"--alpha", "0", "--transform", "all:rotate:-4", "--tunnel", "3", "--ground", "1"};
    for (const char* solver : {"openfoam", "su2"}) {
        Words words = small_case(solver, walls);
        words.erase(std::find(words.begin(), words.end(), "--alpha"), std::find(words.begin(), words.end(), "-o"));
        *std::find(words.begin(), words.end(), "c") = solver;
        const ProgramRun run = run_lamina(folder, words);
        ASSERT_EQ(run.exit_code, 0) << run.err;
    }
    for (const char* field : {"U", "p", "nut", "nuTilda"}) {
        const std::string text = folder.read(std::string("openfoam/0/") + field);
        for (const char* name : {"ground", "ceiling"})
            EXPECT_NE(text.find(std::string(name) + "\n    {\n        type            symmetry;"), std::string::npos);
        EXPECT_NE(text.find("(inlet|outlet)"), std::string::npos);
    }
    EXPECT_NE(folder.read("openfoam/Allrun").find("vortex=no"), std::string::npos);
    EXPECT_NE(folder.read("su2/case.cfg").find("\nMARKER_SYM= ( ground, ceiling )\n"), std::string::npos);
    const ProgramRun across = run_lamina(folder, small_case("su2", {"--tunnel", "3"}));
    EXPECT_EQ(across.exit_code, usage);
    EXPECT_NE(across.err.find("--transform"), std::string::npos) << across.err;
}

TEST(SolverCaseCommand, AMovingGroundHasTheFreeStreamsVelocityAndBearsNoForces) {
    const TemporaryFolder folder;
    for (const char* solver : {"openfoam", "su2"}) {
        Words words = small_case(solver, {"--ground", "0.1", "--ground-wall", "moving"});
        words.erase(std::find(words.begin(), words.end(), "--alpha"), std::find(words.begin(), words.end(), "-o"));
        *std::find(words.begin(), words.end(), "c") = solver;
        const ProgramRun run = run_lamina(folder, words);
        ASSERT_EQ(run.exit_code, 0) << run.err;
    }
    const std::string velocity = folder.read("openfoam/0/U"), control = folder.read("openfoam/system/controlDict");
    EXPECT_NE(velocity.find("|ground)\"\n    {\n        type            noSlip;"), std::string::npos) << velocity;
    EXPECT_NE(velocity.find("\n    ground\n    {\n        type            fixedValue;\n        value           uniform "
                            "$streamVelocity;"),
              std::string::npos)
        << velocity;
    EXPECT_NE(folder.read("openfoam/0/nut").find("|ground)\""), std::string::npos);
    EXPECT_EQ(control.find("ground"), std::string::npos) << "forces are those of the section";
    EXPECT_NE(folder.read("openfoam/Allrun").find("vortex=no"), std::string::npos);
    const std::string su2 = folder.read("su2/case.cfg");
    EXPECT_NE(su2.find("SURFACE_MOVEMENT= MOVING_WALL\nMARKER_MOVING= ( ground )\nSURFACE_TRANSLATION_RATE= 52.08"),
              std::string::npos)
        << su2;
    EXPECT_NE(su2.find(", 0.0, ground, 0.0 )"), std::string::npos);
    EXPECT_EQ(list_behind(su2, "MARKER_MONITORING= (", ")").size(), 1u);
}

TEST(SolverCaseCommand, WritesAFamilyOfCases) {
    const TemporaryFolder folder;
    Words words = small_case("openfoam", {"--levels", "2", "--base-level", "1"});
    *std::find(words.begin(), words.end(), "c") = "c{level}";
    const ProgramRun run = run_lamina(folder, words);
    ASSERT_EQ(run.exit_code, 0) << run.err;
    const Mesh coarse = read_mesh(folder / "c0"), fine = read_mesh(folder / "c1");
    EXPECT_TRUE(check_mesh(coarse).valid() && check_mesh(fine).valid());
    EXPECT_GT(fine.points.size(), 1.5 * static_cast<double>(coarse.points.size()));
    for (const char* file : {"c0/Allrun", "c1/Allrun", "cfamily.csv"}) EXPECT_TRUE(fs::exists(folder / file)) << file;

    const ProgramRun again = run_lamina(folder, words);
    EXPECT_EQ(again.exit_code, usage) << "the cases are there already";
    EXPECT_EQ(run_lamina(folder, small_case("su2", {"--levels", "2"})).exit_code, usage) << "one folder for both";
    EXPECT_EQ(run_lamina(folder, small_case("su2", {"--ratio", "2"})).exit_code, usage) << "a ratio of one level";
}

TEST(SolverCaseCommand, OptionsOfTheMeshOverrideWhatTheSolverPrefers) {
    const TemporaryFolder folder;
    const ProgramRun run =
        run_lamina(folder, small_case("openfoam", {"--layer-topology", "layered", "--far-field", "20", "--turbulence",
                                                   "komega-sst", "--velocity", "30", "--viscosity", "3e-5"}));
    EXPECT_EQ(run.exit_code, usage) << run.err;  // the Reynolds number is given, too

    Words words =
        small_case("openfoam", {"--layer-topology", "layered", "--far-field", "20", "--turbulence", "komega-sst"});
    const ProgramRun triangles = run_lamina(folder, words);
    ASSERT_EQ(triangles.exit_code, 0) << triangles.err;
    EXPECT_NE(triangles.err.find("simpleFoam diverges"), std::string::npos) << triangles.err;
    EXPECT_TRUE(read_mesh(folder / "c").quads.empty());
    EXPECT_TRUE(fs::exists(folder / "c/0/omega"));
    EXPECT_FALSE(fs::exists(folder / "c/0/nuTilda"));
}

TEST(SolverCaseCommand, MeshesForOpenFoamHaveQuadsUnlessToldOtherwise) {
    const TemporaryFolder folder;
    const Words mesh{"mesh", "naca:0012", "--quiet", "--far-field", "10", "--format", "openfoam", "-o", "c"};
    const ProgramRun quads = run_lamina(folder, mesh);
    ASSERT_EQ(quads.exit_code, 0) << quads.err;
    EXPECT_EQ(quads.err, "");
    EXPECT_FALSE(read_mesh(folder / "c").quads.empty());
    Words asked = mesh;
    asked.insert(asked.end(), {"--layer-topology", "delaunay"});
    const ProgramRun triangles = run_lamina(folder, asked);
    EXPECT_NE(triangles.err.find("simpleFoam diverges"), std::string::npos) << triangles.err;
    EXPECT_TRUE(read_mesh(folder / "c").quads.empty());
}

TEST(SolverCaseCommand, RefusesWhatItCannotDo) {
    const TemporaryFolder folder;
    expect_refused(folder, {"case", "fluent", "naca:0012", "--reynolds", "1e6", "-o", "c"}, usage, "SOLVER");
    expect_refused(folder, {"case", "openfoam", "naca:0012", "--reynolds", "1e6"}, usage, "-o DIR");
    expect_refused(folder, {"case", "openfoam", "naca:0012", "-o", "c"}, usage, "option --reynolds");
    expect_refused(folder, {"case", "openfoam", "--reynolds", "1e6", "-o", "c"}, usage, "INPUT");
    expect_refused(folder, {"case", "openfoam", "naca:0012", "--reynolds", "1e6", "-o", "c", "--order", "2"}, usage,
                   "option --order");
    expect_refused(folder, {"case", "openfoam", "naca:0012", "--reynolds", "1e6", "-o", "c", "--turbulence", "ke"},
                   usage, "option --turbulence");
    // Before the mesh is made: one of so many triangles would be refused, too.
    expect_refused(folder,
                   {"case", "pyfr", "naca:0012", "--reynolds", "5e3", "-o", "c", "--mach", "2", "--max-triangles", "1"},
                   usage, "option --mach");
    // Files of an earlier case stay as they are, and so do inputs.
    ASSERT_EQ(run_lamina(folder, small_case("su2")).exit_code, 0);
    expect_refused(folder, small_case("su2"), usage, "exists");
    EXPECT_EQ(run_lamina(folder, small_case("su2", {"--overwrite"})).exit_code, 0);
    fs::rename(folder / "c", folder / "d");
    expect_refused(
        folder, {"case", "su2", "naca:0012", "--reynolds", "1e6", "-o", "d", "--overwrite", "--report", "d/case.cfg"},
        usage, "is written by");
}

/// Returns the values of a column of a function object's file.
std::vector<double> column_of(const fs::path& file, const std::string& name) {
    std::ifstream in(file);
    std::vector<double> values;
    std::size_t column = 0;
    for (std::string line; std::getline(in, line);) {
        std::istringstream words(line.starts_with("#") ? line.substr(1) : line);
        std::string word;
        for (std::size_t i = 0; words >> word; ++i) {
            if (line.starts_with("#") && word == name) column = i;
            if (!line.starts_with("#") && i == column) values.push_back(std::stod(word));
        }
    }
    return values;
}

/// Returns the lift coefficient that pressure and skin friction at the walls' faces have together, at a chord of 1.
double lift_of_wall_table(const fs::path& file, const Mesh& mesh, double alpha_deg) {
    struct Row {
        Point at;
        double cp, cf_x, cf_y;
    };
    std::vector<Row> rows;
    std::ifstream lines(file);
    std::string line;
    std::getline(lines, line);
    EXPECT_EQ(line, "wall,x,y,cp,cf_x,cf_y,y_plus");
    while (std::getline(lines, line)) {
        Row row{};
        double y_plus = 0;
        EXPECT_EQ(std::sscanf(line.c_str(), "airfoil,%lf,%lf,%lf,%lf,%lf,%lf", &row.at.x, &row.at.y, &row.cp, &row.cf_x,
                              &row.cf_y, &y_plus),
                  6)
            << line;
        rows.push_back(row);
    }
    Point force{0, 0};
    for (const Marker& marker : mesh.markers) {
        if (marker.kind != MarkerKind::wall) continue;
        EXPECT_EQ(rows.size(), marker.edges.size());
        for (const auto& edge : marker.edges) {
            // The mesh is on the left of its boundary edges, and the wall on the right.
            const Point a = mesh.points[edge.a.index()], b = mesh.points[edge.b.index()], middle = 0.5 * (a + b);
            const auto nearest = std::min_element(rows.begin(), rows.end(), [&](const Row& r, const Row& s) {
                return distance(r.at, middle) < distance(s.at, middle);
            });
            EXPECT_LT(distance(nearest->at, middle), 1e-9);
            force = force + nearest->cp * Point{b.y - a.y, a.x - b.x} +
                    distance(a, b) * Point{nearest->cf_x, nearest->cf_y};
        }
    }
    const double alpha = alpha_deg * std::acos(-1) / 180;
    return force.y * std::cos(alpha) - force.x * std::sin(alpha);
}

/// Returns what settled.awk says, with the numbers of Allrun, of blocks of iterations: means of lift, drag and moment,
/// ranges of lift and drag.
std::string settled(const TemporaryFolder& folder, const std::vector<std::array<double, 5>>& blocks) {
    std::string text;
    for (const auto& block : blocks) text += fmt::format("{:.8g}\n", fmt::join(block, " "));
    std::ofstream(folder / "blocks") << text;
    const std::string path = folder.path().string();
    const std::string command = "cd '" + path + "' && sed -n '/^first=/p' c/Allrun > rule.sh && . ./rule.sh && " +
                                "awk -v tolerance=$tolerance -v cycle=$cycle -v blocks=$cycle_blocks -f c/settled.awk "
                                "blocks > said";
    EXPECT_EQ(std::system(command.c_str()), 0);
    return folder.read("said");
}

TEST(SolverCaseCommand, AllrunTellsSteadyStatesFromCyclesAndDrift) {
    const TemporaryFolder folder;
    ASSERT_EQ(run_lamina(folder, small_case("openfoam")).exit_code, 0);
    using Blocks = std::vector<std::array<double, 5>>;
    EXPECT_EQ(settled(folder, {}), "");
    EXPECT_EQ(settled(folder, {{1.0, 0.01, 0, 1e-3, 1e-4}}), "");
    EXPECT_EQ(settled(folder, {{1.0, 0.01, 0, 1e-3, 1e-4}, {1.0, 0.01, 0, 1e-4, 4e-6}}), "steady\n");
    // Without lift, that of a degree says what a small change of lift is.
    EXPECT_EQ(settled(folder, {{0.0, 0.01, 0, 5e-5, 4e-6}}), "steady\n");
    EXPECT_EQ(settled(folder, {{0.0, 0.01, 0, 6e-5, 4e-6}}), "");
    // Blocks of NACA 0012 at 0 degrees on 11,464 cells, which go on so for thousands of iterations.
    EXPECT_EQ(settled(folder, {{-1.03e-4, 0.0079506, 0, 1.14e-4, 1.88e-5},
                               {-9.5e-5, 0.0079512, 0, 8.14e-5, 1.95e-5},
                               {-1.09e-4, 0.0079503, 0, 8.59e-5, 1.64e-5},
                               {-1.25e-4, 0.0079503, 0, 9.57e-5, 2.17e-5},
                               {-1.11e-4, 0.0079499, 0, 1.1e-4, 2.3e-5}}),
              "steady in the mean\n");

    // Drag cycles by 0.4 %, about a mean that moves by `drift` from block to block.
    const auto cycle = [](std::size_t blocks, double drift, double range) {
        Blocks made;
        for (std::size_t i = 0; i < blocks; ++i)
            made.push_back({3.77, 0.06 * (1 + drift * static_cast<double>(i)), -0.66, 4e-4, range * 0.06});
        return made;
    };
    EXPECT_EQ(settled(folder, cycle(4, 0, 0.004)), "");
    EXPECT_EQ(settled(folder, cycle(5, 0, 0.004)), "steady in the mean\n");
    EXPECT_EQ(settled(folder, cycle(30, 1e-4, 0.004)), "steady in the mean\n");
    EXPECT_EQ(settled(folder, cycle(30, 2e-4, 0.004)), "");
    EXPECT_EQ(settled(folder, cycle(30, -2e-4, 0.004)), "");
    EXPECT_EQ(settled(folder, cycle(30, 0, 0.02)), "");
    // The first of the last five blocks still falls to the cycle.
    Blocks falling = cycle(4, 0, 0.004);
    falling.insert(falling.begin(), {3.77, 0.0605, -0.66, 4e-4, 0.004 * 0.06});
    EXPECT_EQ(settled(folder, falling), "");
    falling.push_back(falling.back());
    EXPECT_EQ(settled(folder, falling), "steady in the mean\n");
}

/// Returns result.json that unsteady.awk writes of these steps: time, lift, drag and moment.
nlohmann::json result_in_time(const TemporaryFolder& folder, const std::vector<std::array<double, 4>>& steps) {
    std::string text;
    for (const auto& step : steps) text += fmt::format("{}\n", fmt::join(step, " "));
    std::ofstream(folder / "forces") << text;
    folder.write("walls", "airfoil 0.75 0.5\n");
    const std::string command = "cd '" + folder.path().string() + "' && awk -v times=20 -v steps=50 -f '" +
                                LAMINA_SOURCE_DIR + "/share/cases/common/unsteady.awk' forces walls >said";
    if (std::system(command.c_str()) != 0) return {};
    return nlohmann::json::parse(folder.read("result.json"));
}

TEST(SolverCaseCommand, RunsInTimeAreSummedUp) {
    const TemporaryFolder folder;
    const double pi = std::acos(-1);
    // Lift swings with a frequency of 0.165 and has noise, and drag with twice of it; the first slowly rises.
    std::vector<std::array<double, 4>> steps;
    for (int i = 500; i <= 1500; ++i) {
        const double t = i / 50.0, phase = 2 * pi * 0.165 * t;
        steps.push_back({t, 0.1 + 0.3 * std::sin(phase) + 0.01 * (i % 2), 1.3 + 0.01 * std::cos(2 * phase), -0.1});
    }
    const auto result = result_in_time(folder, steps);
    EXPECT_NEAR(result["Strouhal"], 0.165, 0.0005);
    EXPECT_EQ(result["periods"], 2);
    EXPECT_NEAR(result["CL"], 0.105, 0.03);  // of whole periods and a part
    EXPECT_NEAR(result["CD"], 1.3, 0.001);
    EXPECT_NEAR(result["CM"], -0.1, 1e-9);
    EXPECT_NEAR(result["deviation_CL"], 0.3 / std::sqrt(2), 0.01);
    EXPECT_NEAR(result["range_CD"][0], 1.29, 1e-4);
    EXPECT_NEAR(result["range_CD"][1], 1.31, 1e-4);
    EXPECT_EQ(result["y_plus"]["airfoil"]["largest"], 0.75);
    // One swing alone says no frequency.
    auto once = steps;
    for (auto& step : once)
        step[1] = 0.5 + (step[0] > 14 && step[0] < 20 ? 0.1 * std::sin(pi * (step[0] - 14) / 3) : 0);
    EXPECT_TRUE(result_in_time(folder, once)["Strouhal"].is_null());
    // Flow that does not swing has none either.
    for (auto& step : steps) step = {step[0], 0.5, 0.02, 0};
    EXPECT_TRUE(result_in_time(folder, steps)["Strouhal"].is_null());
    steps[300][1] = NAN;
    EXPECT_TRUE(result_in_time(folder, steps).is_null());
}

/// Runs the case of SU2 with a program in place of SU2_CFD whose lift is a tenth of the angle plus a fading part, and
/// whose y+ is the number of the vertex. Returns the exit code of Allrun.
int run_with_stand_in(const TemporaryFolder& folder, const std::string& amplitude) {
    fs::create_directories(folder / "bin");
    folder.write(
        "bin/SU2_CFD",
        "#!/bin/sh\n"
        "[ \"$#\" = 1 ] && grep -E '^(AOA|ITER|RESTART_SOL|DISCARD_INFILES)=' \"$1\" | tr '\\n' ' ' >>asked\n"
        "echo >>asked\n"
        "awk -v amplitude=" +
            amplitude +
            " '/^AOA=/ { a = $2 } /^ITER=/ { n = $2 > 700 ? 700 : $2 } END {\n"
            "  print \"\\\"Inner_Iter\\\",   \\\"CD\\\"   , \\\"CL\\\"  , \\\"CMz\\\" \"\n"
            "  for (i = 0; i < n; ++i) print i \", 0.02, \" a / 10 + amplitude * (i % 2) \", -0.006\" }' \"$1\" "
            ">history.csv\n"
            "echo flow >restart_flow.dat\n"
            "awk 'BEGIN { print \"\\\"Point\\\",\\\"x\\\",\\\"Y_Plus\\\"\"; for (i = 0; i < 3; ++i) print i \", 0.0, "
            "\" "
            "(i + 1) / 4 }' >surface_flow.csv\n");
    const std::string path = folder.path().string();
    const std::string command = "chmod +x '" + path + "/bin/SU2_CFD' && PATH='" + path + "/bin':$PATH '" + path +
                                "/c/Allrun' > '" + path + "/said' 2>&1";
    return WEXITSTATUS(std::system(command.c_str()));
}

TEST(SolverCaseCommand, Su2IsRunThroughItsAnglesAndSummedUp) {
    const TemporaryFolder folder;
    Words words = small_case("su2");
    *std::find(words.begin(), words.end(), "4") = "15";
    ASSERT_EQ(run_lamina(folder, words).exit_code, 0);
    EXPECT_EQ(run_with_stand_in(folder, "0.0001"), 0) << folder.read("said");
    EXPECT_EQ(folder.read("c/asked"),
              "RESTART_SOL= NO DISCARD_INFILES= YES AOA= 10 ITER= 150 \n"
              "RESTART_SOL= YES DISCARD_INFILES= YES AOA= 12.5 ITER= 150 \n"
              "RESTART_SOL= YES DISCARD_INFILES= YES AOA= 15 ITER= 5000 \n");
    auto result = nlohmann::json::parse(folder.read("c/result.json"));
    EXPECT_EQ(result["steady"], true);
    EXPECT_EQ(result["iterations"], 1000);
    EXPECT_NEAR(result["CL"], 1.50005, 1e-6);
    EXPECT_NEAR(result["CD"], 0.02, 1e-9);
    EXPECT_NEAR(result["CM"], 0.006, 1e-9) << "nose up";
    EXPECT_NEAR(result["y_plus"]["airfoil"]["largest"], 0.75, 1e-9);
    EXPECT_NEAR(result["y_plus"]["airfoil"]["mean"], 0.5, 1e-9);
    // Results are not written over, and Allclean removes them.
    EXPECT_EQ(run_with_stand_in(folder, "0.1"), 1);
    EXPECT_EQ(std::system(("'" + (folder / "c/Allclean").string() + "'").c_str()), 0);
    EXPECT_EQ(run_with_stand_in(folder, "0.1"), 2) << folder.read("said");
    result = nlohmann::json::parse(folder.read("c/result.json"));
    EXPECT_EQ(result["steady"], false);
    EXPECT_EQ(result["steady_in_the_mean"], false);
}

/// A stand-in for SU2_CFD that starts with a steady run, and whose lift then swings with a frequency of 0.2 per chord.
TEST(SolverCaseCommand, Su2IsRunInTimeAndSummedUp) {
    const TemporaryFolder folder;
    ASSERT_EQ(run_lamina(folder, small_case("su2", {"--unsteady"})).exit_code, 0);
    fs::create_directories(folder / "bin");
    folder.write("bin/SU2_CFD", R"sh(#!/bin/sh
grep -E '^(TIME_DOMAIN|TIME_ITER|ITER|RESTART_SOL)=' "$1" | sort | tr '\n' ' ' >>asked
echo >>asked
if grep -q '^TIME_DOMAIN= NO' "$1"; then
    printf '"PointID","x","y","Density","Momentum_x","Momentum_y","Energy"\n0, 0.5, 0.0, 1.0, 0.15, 0.0, 2\n' >restart_flow.csv
    exit
fi
awk '/^TIME_ITER=/ { n = $2 } END {
    print "\"Time_Iter\", \"CD\", \"CL\", \"CMz\""
    for (i = 2; i < n; ++i) printf "%d, 0.3, %.8f, -0.006\n", i, 0.5 + 0.1 * sin(6.283185307 * 0.2 * (i - 1) / steps)
}' steps="$(sed -n 's/^steps=\([0-9]*\).*/\1/p' Allrun)" "$1" >history_00002.csv
for step in 00009 00012; do
    awk -v y="$step" 'BEGIN { print "\"Point\",\"x\",\"Y_Plus\""; for (i = 0; i < 3; ++i) print i ", 0.0, " y / 10 }' \
        >surface_flow_$step.csv
    echo flow >flow_$step.vtu
done
)sh");
    const auto run = [&](const char* variables) {
        const std::string path = folder.path().string();
        return WEXITSTATUS(std::system(fmt::format("chmod +x '{0}/bin/SU2_CFD' && {1} PATH='{0}/bin':$PATH "
                                                   "'{0}/c/Allrun' >'{0}/said' 2>&1",
                                                   path, variables)
                                           .c_str()));
    };
    EXPECT_EQ(run("TIMES=ten"), 1);
    ASSERT_EQ(run("TIMES=40"), 0) << folder.read("said");
    const std::string asked = folder.read("c/asked");
    EXPECT_NE(asked.find("ITER= 150 RESTART_SOL= NO TIME_DOMAIN= NO \n"), std::string::npos) << asked;
    EXPECT_NE(asked.find("RESTART_SOL= YES TIME_DOMAIN= YES TIME_ITER= "), std::string::npos) << asked;
    // The gust: three tenths of the momentum across it, in the middle of the chord.
    const std::string gust = folder.read("c/solution_flow_00001.csv");
    EXPECT_EQ(gust, folder.read("c/solution_flow_00000.csv"));
    EXPECT_NE(gust.find("4.5000"), std::string::npos) << gust;
    const auto result = nlohmann::json::parse(folder.read("c/result.json"));
    EXPECT_NEAR(result["Strouhal"], 0.2, 1e-3);
    EXPECT_NEAR(result["CL"], 0.5, 1e-3);
    EXPECT_NEAR(result["CM"], 0.006, 1e-9) << "nose up";
    EXPECT_NEAR(result["y_plus"]["airfoil"]["largest"], 1.2, 1e-9) << "at the last time";
    EXPECT_EQ(std::system(("'" + (folder / "c/Allclean").string() + "'").c_str()), 0);
    for (const char* left : {"c/result.json", "c/flow.vtu", "c/solution_flow_00000.csv"})
        EXPECT_FALSE(fs::exists(folder / left)) << left;
}

/// Returns the points of a circle of diameter 1.
std::string circle_of(int points) {
    std::string circle;
    for (int i = 0; i < points; ++i)
        circle += fmt::format("{} {}\n", 0.5 + 0.5 * std::cos(2 * std::acos(-1) * i / points),
                              0.5 * std::sin(2 * std::acos(-1) * i / points));
    return circle;
}

TEST(SolverCaseCommand, WarnsOfSpeedsAndOfFlowThatSeparates) {
    const TemporaryFolder folder;
    folder.write("diamond.dat", "1 0\n0.5 0.05\n0 0\n0.5 -0.05\n1 0\n");
    const auto run = [&](const Words& more) {
        Words words = more;
        words.insert(words.end(),
                     {"--reynolds", "1e6", "--quiet", "--y-plus", "2", "--growth", "1.4", "--gradation", "0.4"});
        const ProgramRun done = run_lamina(folder, words);
        EXPECT_EQ(done.exit_code, 0) << done.err;
        return done.err;
    };
    EXPECT_EQ(run({"case", "su2", "diamond.dat", "--mach", "2", "-o", "a"}).find("Mach"), std::string::npos);
    EXPECT_NE(run({"case", "su2", "naca:0012", "--mach", "0.7", "-o", "b"}).find("Mach number 0.7"), std::string::npos);
    EXPECT_EQ(run({"case", "su2", "naca:0012", "--alpha", "15", "-o", "c"}).find("Mach"), std::string::npos);
    folder.write("circle.dat", circle_of(120));
    for (const Words& stalled :
         {Words{"naca:0012", "--alpha", "30"}, Words{"naca:0012", "--alpha", "-30"}, Words{"circle.dat"}}) {
        Words words = stalled;
        words.insert(words.begin(), "mesh");
        words.insert(words.end(), {"-o", "m.su2"});
        EXPECT_NE(run(words).find("stalled or bluff"), std::string::npos) << stalled.front();
    }
    for (const char* section : {"naca:0012", "naca:4415"})
        for (const char* alpha : {"4", "15"})
            EXPECT_EQ(run({"mesh", section, "--alpha", alpha, "-o", "m.su2"}).find("stalled"), std::string::npos)
                << section << " " << alpha;
}

TEST(SolverCaseCommand, Su2IsRefusedTrianglesInTheLayer) {
    const TemporaryFolder folder;
    for (const char* topology : {"layered", "delaunay"})
        expect_refused(folder, small_case("su2", {"--layer-topology", topology}), usage, "must be quads");
    EXPECT_FALSE(fs::exists(folder / "c"));
}

TEST(SolverCaseCommand, WritesPyfrWithCurvedCells) {
    const TemporaryFolder folder;
    const ProgramRun turbulent = run_lamina(folder, small_case("pyfr"));
    ASSERT_EQ(turbulent.exit_code, 0) << turbulent.err;
    EXPECT_NE(turbulent.err.find("no model of turbulence"), std::string::npos) << turbulent.err;
    const CurvedMesh mesh = read_curved_mesh(folder / "c/mesh.msh");
    EXPECT_EQ(mesh.nodes.order, 3u);
    EXPECT_TRUE(check_curved(mesh.mesh, mesh.nodes).valid());
    EXPECT_TRUE(mesh.mesh.region.empty());
    EXPECT_NE(folder.read("c/case.ini").find("\norder = 3\n"), std::string::npos);
    Words words = small_case("pyfr", {"--order", "1", "--overwrite"});
    *(std::find(words.begin(), words.end(), "--reynolds") + 1) = "5000";
    const ProgramRun laminar = run_lamina(folder, words);
    ASSERT_EQ(laminar.exit_code, 0) << laminar.err;
    EXPECT_EQ(laminar.err.find("no model of turbulence"), std::string::npos) << laminar.err;
    EXPECT_EQ(read_curved_mesh(folder / "c/mesh.msh").nodes.order, 1u);
    EXPECT_NE(folder.read("c/case.ini").find("\norder = 1\n"), std::string::npos);
}

TEST(SolverCaseCommand, PyfrIsRefusedWhatItDoesNotKnow) {
    const TemporaryFolder folder;
    expect_refused(folder, small_case("su2", {"--order", "2"}), usage, "pyfr");
    expect_refused(folder, small_case("pyfr", {"--order", "5"}), usage, "order");
    expect_refused(folder, small_case("pyfr", {"--node-distribution", "gauss-lobatto"}), usage, "evenly spaced");
    expect_refused(folder, small_case("pyfr", {"--turbulence", "sa"}), usage, "laminar");
    expect_refused(folder, small_case("pyfr", {"--mach", "1.2"}), usage, "below 1 in a case of PyFR");
    expect_refused(folder, small_case("pyfr", {"--layer-topology", "delaunay"}), usage, "quads or layered");
    EXPECT_FALSE(fs::exists(folder / "c"));
}

// First order, then one block of second order: enough to see that files fit each other and residuals fall.
TEST(SolverCaseCommand, OpenFoamRunsTheCase) {
    if (std::system("command -v rhoSimpleFoam >/dev/null 2>&1") != 0)
        GTEST_SKIP() << "rhoSimpleFoam is not in PATH: nothing says here that OpenFOAM runs the case";
    for (const Words& more : {Words{}, Words{"--mach", "0.2"}, Words{"--turbulence", "komega-sst", "--mach", "0.2"}}) {
        const TemporaryFolder folder;
        const ProgramRun made = run_lamina(folder, small_case("openfoam", more));
        ASSERT_EQ(made.exit_code, 0) << made.err;
        const Mesh mesh = read_mesh(folder / "c");
        EXPECT_LT(mesh.triangles.size() + mesh.quads.size(), 6000u);
        const std::string command = "ITERATIONS=350 '" + (folder / "c/Allrun").string() + "' > '" +
                                    (folder / "c/Allrun.log").string() + "' 2>&1";
        const int code = std::system(command.c_str());
        // 2: so few iterations are not enough for a steady state or a steady mean.
        ASSERT_TRUE(WIFEXITED(code) && (WEXITSTATUS(code) == 0 || WEXITSTATUS(code) == 2))
            << folder.read("c/Allrun.log");
        const auto result = nlohmann::json::parse(folder.read("c/result.json"));
        EXPECT_EQ(result["iterations"], 350);
        EXPECT_NEAR(result["CL"], 0.43, 0.06);
        EXPECT_NEAR(lift_of_wall_table(folder / "c/walls.csv", mesh, 4), result["CL"], 0.01);
        EXPECT_GT(result["CD"], 0.005);
        EXPECT_LT(result["CD"], 0.03);
        EXPECT_GT(result["y_plus"]["airfoil"]["largest"], 0.2);
        EXPECT_LT(result["y_plus"]["airfoil"]["largest"], 10);
        const fs::path residuals = folder / "c/postProcessing/residuals/150/solverInfo.dat";
        for (const char* field : {"Ux_initial", "p_initial"}) {
            const std::vector<double> values = column_of(residuals, field);
            ASSERT_EQ(values.size(), 200u);
            EXPECT_LT(values.back(), 0.1 * values.front())
                << field << " of " << fmt::format("{}", fmt::join(more, " "));
        }
    }
}

TEST(SolverCaseCommand, OpenFoamRunsTheCaseInTime) {
    if (std::system("command -v pimpleFoam >/dev/null 2>&1") != 0)
        GTEST_SKIP() << "pimpleFoam is not in PATH: nothing says here that OpenFOAM runs the case";
    const TemporaryFolder folder;
    folder.write("circle.dat", circle_of(40));
    const ProgramRun made =
        run_lamina(folder, {"case", "openfoam", "circle.dat", "-o", "c", "--unsteady", "--reynolds", "100", "--quiet",
                            "--use-flow", "no", "--no-layers", "--gradation", "0.3"});
    ASSERT_EQ(made.exit_code, 0) << made.err;
    const auto run = [&](const char* variables) {
        const std::string command =
            fmt::format("{} '{}' > '{}' 2>&1", variables, (folder / "c/Allrun").string(), (folder / "said").string());
        return WEXITSTATUS(std::system(command.c_str()));
    };
    EXPECT_EQ(run("TIMES=9"), 1) << "too few";
    ASSERT_EQ(run("TIMES=10 FIELDS=4"), 0) << folder.read("said");
    const auto result = nlohmann::json::parse(folder.read("c/result.json"));
    EXPECT_EQ(result["convective_times"], 10);
    EXPECT_GT(result["CD"], 1);
    EXPECT_LT(result["CD"], 4);
    for (const char* file : {"c/6/U", "c/10/U", "c/10/UMean"}) EXPECT_TRUE(fs::exists(folder / file)) << file;
    EXPECT_EQ(folder.read("c/walls.csv").find("nan"), std::string::npos);
    // Results are not written over, and Allclean leaves the case as it was.
    EXPECT_EQ(run("TIMES=10"), 1);
    EXPECT_EQ(std::system(("'" + (folder / "c/Allclean").string() + "'").c_str()), 0);
    EXPECT_FALSE(fs::exists(folder / "c/10"));
    EXPECT_TRUE(fs::exists(folder / "c/0/U"));
}

}  // namespace
}  // namespace lamina::test
