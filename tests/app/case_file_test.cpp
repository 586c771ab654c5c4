// Case files and --dump-config: a dumped case reproduces the run.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <string>

#include <nlohmann/json.hpp>

#include "app/program.hpp"

namespace lamina::test {
namespace {

TEST(CaseFile, ADumpReproducesTheRunFromAnyFolder) {
    const TemporaryFolder here;
    here.write("wedge.dat", "wedge\n1 0\n0.5 0.08\n0 0\n0.5 -0.05\n");
    const ProgramRun dump =
        run_lamina(here, {"mesh", "wedge.dat", "-o", "a.su2", "--far-field", "3", "--layers", "4", "--first-height",
                          "0.001", "--names", "wing", "--gradation", "0.3", "--far-size", "0.7", "--dump-config"});
    ASSERT_EQ(dump.exit_code, 0) << dump.err;
    EXPECT_EQ(here.names(), std::vector<std::string>{"wedge.dat"});

    const TemporaryFolder elsewhere;
    elsewhere.write("case.toml", dump.out);
    EXPECT_EQ(run_lamina(elsewhere, {"mesh", "case.toml", "--dump-config"}).out, dump.out);

    const ProgramRun first =
        run_lamina(here, {"mesh", "wedge.dat", "-o", "b.su2", "--far-field", "3", "--layers", "4", "--first-height",
                          "0.001", "--names", "wing", "--gradation", "0.3", "--far-size", "0.7"});
    ASSERT_EQ(first.exit_code, 0) << first.err;
    const ProgramRun again = run_lamina(elsewhere, {"mesh", "case.toml"});
    ASSERT_EQ(again.exit_code, 0) << again.err;
    EXPECT_EQ(here.read("a.su2"), here.read("b.su2"));
}

TEST(CaseFile, ADumpWithWallsOfTheDomainIsRead) {
    const TemporaryFolder folder;
    const std::vector<std::vector<std::string>> domains{
        {"--ground", "0.1", "--ground-wall", "moving"},
        {"--tunnel", "3:5:10", "--ground", "0.5"},
        {"--symmetry", "0", "--tunnel", "3"},
        {"--periodic", "1,30"},
        {"--points", "80:60", "--points", "airfoil:90:70:3"},
    };
    for (const std::vector<std::string>& domain : domains) {
        std::vector<std::string> arguments{"mesh", "naca:0012", "--dump-config"};
        arguments.insert(arguments.end(), domain.begin(), domain.end());
        const ProgramRun dump = run_lamina(folder, arguments);
        ASSERT_EQ(dump.exit_code, 0) << dump.err;
        folder.write("case.toml", dump.out);
        EXPECT_EQ(run_lamina(folder, {"mesh", "case.toml", "--dump-config"}).out, dump.out) << domain.front();
    }
}

TEST(CaseFile, HoldsWakesAndSizeSources) {
    const TemporaryFolder folder;
    const ProgramRun dump =
        run_lamina(folder, {"mesh", "naca:0012", "--far-field-outline", "-9,-9,9,-9.5,0,9", "--wake", "-5:3", "--wake",
                            "auto:1:0.02", "--refine", "box:1,1,0,-1,0.05", "--refine", "circle:1,2,0.5,0.01",
                            "--refine", "line:0,-0.5,1e3,1,2", "--dump-config"});
    ASSERT_EQ(dump.exit_code, 0) << dump.err;
    EXPECT_NE(dump.out.find("wake = [ '-5:3', 'auto:1:0.02' ]\n"), std::string::npos) << dump.out;
    EXPECT_NE(dump.out.find("far_field_outline = '-9,-9,9,-9.5,0,9'\n"), std::string::npos) << dump.out;
    EXPECT_NE(dump.out.find("refine = [ 'box:0,-1,1,1,0.05', 'circle:1,2,0.5,0.01', 'line:0,-0.5,1000,1,2' ]\n"),
              std::string::npos)
        << dump.out;
    folder.write("case.toml", dump.out);
    EXPECT_EQ(run_lamina(folder, {"mesh", "case.toml", "--dump-config"}).out, dump.out);
    folder.write("short.toml", "input = 'naca:0012'\nwake = 10\nrefine = 'circle:1,2,3,4'\n");
    const std::string dumped = run_lamina(folder, {"mesh", "short.toml", "--dump-config"}).out;
    EXPECT_NE(dumped.find("wake = [ '10:2' ]\n"), std::string::npos) << dumped;
    folder.write("list.toml", "input = 'naca:0012'\nwake = [2, -0.5, 'auto:3']\n");
    const std::string listed = run_lamina(folder, {"mesh", "list.toml", "--dump-config"}).out;
    EXPECT_NE(listed.find("wake = [ '2:2', '-0.5:2', 'auto:3' ]\n"), std::string::npos) << listed;
    EXPECT_NE(dumped.find("refine = [ 'circle:1,2,3,4' ]\n"), std::string::npos) << dumped;
}

TEST(CaseFile, AFirstHeightFromAFlatPlateIsDumpedAndReported) {
    const TemporaryFolder folder;
    const ProgramRun dump = run_lamina(
        folder, {"mesh", "naca:0012", "-o", "a.su2", "--report", "a.json", "--far-field", "5", "--y-plus", "2",
                 "--reynolds", "3e6", "--preset", "none", "--layers", "auto", "--growth-law", "aflr", "--dump-config"});
    ASSERT_EQ(dump.exit_code, 0) << dump.err;
    EXPECT_NE(dump.out.find("# first_height is not set\n"), std::string::npos) << dump.out;
    EXPECT_NE(dump.out.find("layers = 'auto'\n"), std::string::npos) << dump.out;
    folder.write("case.toml", dump.out);
    EXPECT_EQ(run_lamina(folder, {"mesh", "case.toml", "--dump-config"}).out, dump.out);

    const ProgramRun run = run_lamina(folder, {"mesh", "case.toml"});
    ASSERT_EQ(run.exit_code, 0) << run.err;
    EXPECT_NE(run.out.find("first layer 1.697e-05 chords"), std::string::npos) << run.out;
    const auto report = nlohmann::json::parse(folder.read("a.json"));
    const double height = 2 / (3e6 * std::sqrt(0.5 * 0.026 / std::pow(3e6, 1.0 / 7)));
    EXPECT_NEAR(report["conditions"]["first_height"]["units"].get<double>() / height, 1, 1e-9);
    EXPECT_EQ(report["conditions"]["chord"]["value"], 1);
    EXPECT_GT(report["quality"]["transition"]["edges"], 100);

    // The same height, given directly, makes the same mesh.
    const ProgramRun given = run_lamina(
        folder, {"mesh", "naca:0012", "-o", "b.su2", "--far-field", "5", "--first-height",
                 report["conditions"]["first_height"]["units"].dump(), "--layers", "auto", "--growth-law", "aflr"});
    ASSERT_EQ(given.exit_code, 0) << given.err;
    EXPECT_EQ(folder.read("a.su2"), folder.read("b.su2"));
}

TEST(CaseFile, LengthsCountChordsOrUnitsOfTheInput) {
    const TemporaryFolder folder;
    folder.write("case.toml",
                 "input = 'naca:0012'\nfirst_height = '2e-5u'\nthickness = 0.25\nfar_size = 3\nwall_size = '0.5'\n"
                 "wake = 'auto:3u:0.01'\n");
    const ProgramRun dump =
        run_lamina(folder, {"mesh", "case.toml", "-o", "a.su2", "--far-field", "20u", "--dump-config"});
    ASSERT_EQ(dump.exit_code, 0) << dump.err;
    for (const char* line : {"first_height = '2e-05u'\n", "thickness = 0.25\n", "far_size = 3\n", "wall_size = 0.5\n",
                             "wake = [ 'auto:3u:0.01' ]\n", "far_field = '20u'\n"})
        EXPECT_NE(dump.out.find(line), std::string::npos) << line << dump.out;
    folder.write("dumped.toml", dump.out);
    EXPECT_EQ(run_lamina(folder, {"mesh", "dumped.toml", "--dump-config"}).out, dump.out);
}

TEST(CaseFile, TheChordMayBeThatOfAnElement) {
    const TemporaryFolder folder;
    folder.write("case.toml",
                 "input = ['naca:0012', 'naca:0012']\nnames = ['wing', 'tail']\nchord = 'wing'\n"
                 "transform = ['tail:scale:0.3', 'tail:shift:3,0.2']\nfirst_height = 1e-3\nfar_field = 5\n");
    const ProgramRun dump = run_lamina(folder, {"mesh", "case.toml", "-o", "a.su2", "--dump-config"});
    EXPECT_NE(dump.out.find("chord = 'wing'\n"), std::string::npos) << dump.out;
    const ProgramRun run = run_lamina(folder, {"mesh", "case.toml", "-o", "a.su2", "--report", "a.json"});
    ASSERT_EQ(run.exit_code, 0) << run.err;
    const auto report = nlohmann::json::parse(folder.read("a.json"))["conditions"];
    EXPECT_EQ(report["chord"]["value"], 1);
    EXPECT_EQ(report["chord"]["source"], "extent in x of wing");
    EXPECT_EQ(report["far_field"]["units"], 5);
    const std::vector<std::string> inputs{"naca:0012", "naca:4412"};
    const auto with = [&](std::vector<std::string> words, const std::vector<std::string>& options) {
        words.insert(words.end(), inputs.begin(), inputs.end());
        words.insert(words.end(), options.begin(), options.end());
        return run_lamina(folder, words);
    };
    const std::vector<std::string> apart{"--transform", "naca4412:shift:3,0"};
    EXPECT_NE(with({"info"}, apart).out.find("reference chord 4 (extent in x)\n"), std::string::npos);
    EXPECT_NE(with({"info", "--chord", "naca0012"}, apart).out.find("reference chord 1 (extent in x of naca0012)\n"),
              std::string::npos);
    EXPECT_NE(with({"info", "--chord", "0.25"}, apart).out.find("reference chord 0.25 (given)\n"), std::string::npos);
    expect_refused(folder, {"info", "naca:0012", "--chord", "wing"}, usage, "element 'wing' is not known");
    expect_refused(folder, {"yplus", "--reynolds", "1e6", "--chord", "wing"}, usage, "'wing' is no number");
}

TEST(CaseFile, TheReportGivesEachConditionWithItsSource) {
    const TemporaryFolder folder;
    folder.write("plate.dat", "4 0\n2 0.3\n0 0\n2 -0.3\n");
    const ProgramRun run = run_lamina(
        folder, {"mesh",     "plate.dat", "-o",          "a.su2", "--report",    "a.json", "--preset", "thesis",
                 "--y-plus", "30",        "--velocity",  "30",    "--viscosity", "1.5e-5", "--alpha",  "-2",
                 "--mach",   "0.1",       "--thickness", "0.4u",  "--layers",    "10"});
    ASSERT_EQ(run.exit_code, 0) << run.err;
    const auto report = nlohmann::json::parse(folder.read("a.json"))["conditions"];
    const auto expect_number = [&](const char* key, double value, const char* source) {
        EXPECT_EQ(report[key]["value"], value) << key;
        EXPECT_EQ(report[key]["source"], source) << key;
    };
    const auto expect_length = [&](const char* key, double chords, const char* source) {
        EXPECT_NEAR(report[key]["chords"].get<double>() / chords, 1, 1e-9) << key;
        EXPECT_NEAR(report[key]["units"].get<double>() / (4 * chords), 1, 1e-9) << key;
        EXPECT_EQ(report[key]["source"], source) << key;
    };
    expect_number("chord", 4, "extent in x");
    expect_number("alpha_deg", -2, "given");
    expect_number("reynolds", 30 * 4 / 1.5e-5, "velocity x chord / viscosity");
    expect_number("mach", 0.1, "given");
    expect_number("y_plus", 30, "given");
    const double reynolds = 8e6;
    expect_length("first_height", 30 / (reynolds * std::sqrt(0.5 * 0.026 / std::pow(reynolds, 1.0 / 7))),
                  "from y+ on a flat plate: White, Fluid Mechanics");
    expect_length("thickness", 0.1, "given");
    expect_length("far_field", 50, "preset thesis");
    EXPECT_FALSE(report.contains("far_size"));
    EXPECT_NE(run.out.find("conditions: chord 4 (extent in x)"), std::string::npos) << run.out;
}

TEST(CaseFile, TheCommandLineGoesOverTheFile) {
    const TemporaryFolder folder;
    folder.write("case.toml",
                 "input = 'naca:0012'\nfar_field = 50\nno_layers = true\nthickness = 0.25\nnames = ['a', 'b']\n");
    const std::string dumped =
        run_lamina(folder, {"mesh", "case.toml", "--far-field", "7", "--no-layers=false", "--dump-config"}).out;
    EXPECT_NE(dumped.find("far_field = 7\n"), std::string::npos) << dumped;
    EXPECT_NE(dumped.find("no_layers = false\n"), std::string::npos) << dumped;
    EXPECT_NE(dumped.find("thickness = 0.25\n"), std::string::npos) << dumped;
    EXPECT_NE(dumped.find("# far_size is not set\n"), std::string::npos) << dumped;
    EXPECT_NE(dumped.find("names = [ 'a', 'b' ]\n"), std::string::npos) << dumped;
}

TEST(CaseFile, PathsAreRelativeToItsFolder) {
    const TemporaryFolder folder;
    std::filesystem::create_directory(folder / "sub");
    folder.write("sub/case.toml", "input = ['wing.dat', 'naca:0012']\noutput = 'wing.vtu'\n");
    const std::string dumped = run_lamina(folder, {"mesh", "sub/case.toml", "--dump-config"}).out;
    EXPECT_NE(dumped.find((folder / "sub/wing.dat").string()), std::string::npos) << dumped;
    EXPECT_NE(dumped.find((folder / "sub/wing.vtu").string()), std::string::npos) << dumped;
    EXPECT_NE(dumped.find("'naca:0012'"), std::string::npos) << dumped;
}

TEST(CaseFile, ExactNumbersOfPointsAreDumpedAndReadBack) {
    const TemporaryFolder folder;
    for (const std::string value : {"200", "200:7"}) {
        const ProgramRun dump = run_lamina(folder, {"mesh", "naca:0012", "--exact-points", value, "--dump-config"});
        ASSERT_EQ(dump.exit_code, 0) << dump.err;
        EXPECT_NE(dump.out.find("\nexact_points = '" + value + "'\n"), std::string::npos) << dump.out;
        EXPECT_NE(dump.out.find("\n# surface_points is not set\n"), std::string::npos) << dump.out;
        folder.write("case.toml", dump.out);
        EXPECT_EQ(run_lamina(folder, {"mesh", "case.toml", "--dump-config"}).out, dump.out);
    }
    folder.write("short.toml", "input = 'naca:0012'\nexact_points = 200\n");
    EXPECT_NE(run_lamina(folder, {"mesh", "short.toml", "--dump-config"}).out.find("\nexact_points = '200'\n"),
              std::string::npos);
}

TEST(CaseFile, EveryOptionOfTheHelpIsDumped) {
    const TemporaryFolder folder;
    const std::string help = run_lamina(folder, {"mesh", "--help-all"}).out;
    const std::string dumped = run_lamina(folder, {"mesh", "naca:0012", "--dump-config"}).out;
    std::size_t options = 0;
    for (std::size_t at = help.find("\n  --"); at != std::string::npos; at = help.find("\n  --", at + 1)) {
        std::string key = help.substr(at + 5, help.find_first_of(" \n", at + 5) - at - 5);
        std::replace(key.begin(), key.end(), '-', '_');
        if (key == "dump_config" || key == "dry_run") continue;
        ++options;
        EXPECT_NE(dumped.find(key), std::string::npos) << key;
    }
    EXPECT_GT(options, 50u);
}

TEST(CaseFile, SheetsNeedNoInput) {
    const TemporaryFolder folder;
    folder.write("sail.dat", "A curve\n# with a title\n0 0\n0.5 0.1\n1 0\n");
    const ProgramRun given =
        run_lamina(folder, {"mesh", "--sheet", "sail:sail.dat", "--first-height", "1e-4", "--dump-config"});
    ASSERT_EQ(given.exit_code, 0) << given.err;
    folder.write("case.toml", given.out);
    const ProgramRun run = run_lamina(folder, {"mesh", "case.toml", "-o", "sail.su2", "--far-field", "10"});
    EXPECT_EQ(run.exit_code, 0) << run.err;
    EXPECT_NE(folder.read("sail.su2").find("MARKER_TAG= sail"), std::string::npos);
    EXPECT_EQ(run_lamina(folder, {"info", "--sheet", "sail:sail.dat"}).exit_code, 0);
    EXPECT_EQ(run_lamina(folder, {"flow", "--sheet", "sail:sail.dat", "--alpha", "3"}).exit_code, 0);
    // A curve as INPUT is refused, with the option that takes it.
    EXPECT_NE(run_lamina(folder, {"mesh", "sail.dat", "-o", "a.su2"}).err.find("--sheet"), std::string::npos);
    EXPECT_NE(run_lamina(folder, {"mesh", "--sheet", "sail:sail.dat", "--stream", "-o", "a.vtu"}).err.find("--stream"),
              std::string::npos);
}

}  // namespace
}  // namespace lamina::test
