// lamina flow: its table, its picture, its summary; and what lamina mesh says of the flow.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "app/program.hpp"
#include "support/geometry_fixtures.hpp"

namespace lamina::test {
namespace {

TEST(FlowCommand, PrintsAndWritesTheFlow) {
    const TemporaryFolder folder;
    const ProgramRun run = run_lamina(
        folder, {"flow", "naca:0012", "--alpha", "10", "--reynolds", "3e6", "-o", "a.csv", "--picture", "a.png"});
    ASSERT_EQ(run.exit_code, 0) << run.err;
    EXPECT_EQ(run.err, "");
    EXPECT_NE(run.out.find("flow at 10 degrees: lift coefficient 1.1"), std::string::npos) << run.out;
    EXPECT_NE(run.out.find("upper "), std::string::npos) << run.out;
    EXPECT_NE(run.out.find("largest skin friction"), std::string::npos) << run.out;
    const std::vector<std::string> rows = lines_of(folder.read("a.csv"));
    ASSERT_GT(rows.size(), 100u);
    EXPECT_EQ(rows[0], "element,side,x,y,s,speed,cp,momentum,displacement,thickness,shape,skin_friction,state");
    EXPECT_TRUE(rows[1].starts_with("airfoil,upper,0.0248")) << rows[1];
    EXPECT_TRUE(rows.back().starts_with("airfoil,lower,1,0,")) << rows.back();
    EXPECT_EQ(folder.read("a.png").substr(1, 3), "PNG");
    // Without a Reynolds number there are no boundary layers to report.
    const ProgramRun inviscid = run_lamina(folder, {"flow", "naca:0012", "-o", "-"});
    ASSERT_EQ(inviscid.exit_code, 0) << inviscid.err;
    EXPECT_TRUE(inviscid.out.starts_with("element,side,"));
    EXPECT_NE(inviscid.err.find("lift coefficient"), std::string::npos);
    EXPECT_EQ(inviscid.err.find("friction"), std::string::npos);
}

TEST(FlowCommand, ReportsShocksBeyondTheCriticalMachNumber) {
    const TemporaryFolder folder;
    const ProgramRun run = run_lamina(
        folder, {"flow", "naca:0012", "--alpha", "1.25", "--mach", "0.8", "-o", "a.csv", "--picture", "a.png"});
    ASSERT_EQ(run.exit_code, 0) << run.err;
    for (const char* words : {"lift coefficient 0.3", "drag coefficient 0.02", "of shocks", "cp* -0.4346",
                              "shock at 0.6", "shock at 0.3", "without boundary layers"})
        EXPECT_NE(run.out.find(words), std::string::npos) << words << run.out;
    EXPECT_TRUE(folder.read("a.csv").starts_with(
        "element,side,x,y,cp,mach,momentum,displacement,skin_friction\nairfoil,upper,"));
    EXPECT_EQ(folder.read("a.png").substr(1, 3), "PNG");
    const ProgramRun turbulent = run_lamina(folder, {"flow", "naca:0012", "--alpha", "2.5", "--mach", "0.76",
                                                     "--reynolds", "6e6", "--mach-picture", "mach.png"});
    ASSERT_EQ(turbulent.exit_code, 0) << turbulent.err;
    for (const char* words : {"with boundary layers", "of them of boundary layers", "shock at 0.50"})
        EXPECT_NE(turbulent.out.find(words), std::string::npos) << words << turbulent.out;
    EXPECT_EQ(folder.read("mach.png").substr(1, 3), "PNG");
    expect_refused(folder, {"flow", "naca:0012", "--mach-picture", "b.png"}, usage, "--mach");
    expect_refused(folder, {"flow", "naca:0012", "--mach", "0.4", "--mach-picture", "b.png"}, usage,
                   "slower than sound");
    const ProgramRun slow = run_lamina(folder, {"flow", "naca:0012", "--alpha", "2", "--mach", "0.5"});
    ASSERT_EQ(slow.exit_code, 0) << slow.err;
    EXPECT_NE(slow.out.find("below the critical Mach number"), std::string::npos) << slow.out;
    EXPECT_NE(slow.out.find("lift coefficient 0.29"), std::string::npos) << slow.out;
    expect_refused(folder, {"flow", "naca:0012", "--mach", "11", "-o", "b.csv"}, usage, "mach");
}

TEST(FlowCommand, TakesCaseFilesAndSeveralElements) {
    const TemporaryFolder folder;
    folder.write("two.dat", fixtures::two_999);
    folder.write("case.toml", "input = [\"two.dat\"]\nnames = [\"main\", \"flap\"]\n");
    const ProgramRun run = run_lamina(folder, {"flow", "case.toml", "--picture", "a.svg"});
    ASSERT_EQ(run.exit_code, 0) << run.err;
    EXPECT_NE(run.out.find("main: lift coefficient"), std::string::npos) << run.out;
    EXPECT_NE(run.out.find("flap: lift coefficient"), std::string::npos) << run.out;
    EXPECT_EQ(folder.read("a.svg").substr(0, 5), "<?xml");
}

/// A y+ gives each element a first height of its own, with its source. A first height holds for all.
TEST(MeshFromTheFlow, ReportsFirstHeightsWakesAndSpacings) {
    const TemporaryFolder folder;
    folder.write("two.dat", fixtures::two_999);
    folder.write("case.toml", "input = [\"two.dat\"]\nnames = [\"main\", \"flap\"]\nfar_field = 5\nreynolds = 3e6\n");
    const ProgramRun run = run_lamina(folder, {"mesh", "case.toml", "-o", "a.su2", "--report", "a.json"});
    ASSERT_EQ(run.exit_code, 0) << run.err;
    const auto report = nlohmann::json::parse(folder.read("a.json"));
    const auto& height = report["conditions"]["first_height"]["elements"];
    const auto& measured = report["quality"]["walls"]["first_heights"];
    ASSERT_EQ(height.size(), 2u);
    ASSERT_EQ(measured.size(), 2u);
    for (std::size_t e = 0; e < 2; ++e) {
        const std::string name = e == 0 ? "main" : "flap";
        EXPECT_EQ(height[e]["element"], name);
        EXPECT_NE(height[e]["source"].get<std::string>().find("skin friction"), std::string::npos);
        EXPECT_EQ(measured[e]["marker"], name);
        EXPECT_NEAR(measured[e]["median"].get<double>() / height[e]["units"].get<double>(), 1, 0.01);
        EXPECT_NE(run.out.find("units of the input on " + name + " (from y+"), std::string::npos) << run.out;
    }
    EXPECT_NE(height[0]["units"], height[1]["units"]);

    // The wakes and the spacings of the walls that follow from the flow stand beside them.
    const auto& conditions = report["conditions"];
    ASSERT_EQ(conditions["wakes"].size(), 2u);
    EXPECT_EQ(conditions["wakes"][1]["element"], "flap");
    const double chord = conditions["chord"]["value"].get<double>();
    for (const char* key : {"length", "first_width", "last_width"}) {
        const auto& length = conditions["wakes"][0][key];
        EXPECT_NEAR(length["units"].get<double>() / (chord * length["chords"].get<double>()), 1, 1e-12);
    }
    ASSERT_GE(conditions["wall_spacings"].size(), 1u);
    EXPECT_FALSE(conditions["wall_spacings"][0]["source"].get<std::string>().empty());
    EXPECT_GT(conditions["least_thickness"]["chords"].get<double>(), 0);
    EXPECT_NE(run.out.find("  wake        1 of 2, behind main: "), std::string::npos) << run.out;
    EXPECT_NE(run.out.find("  wake        2 of 2, behind flap: "), std::string::npos) << run.out;
    EXPECT_NE(run.out.find("  wall        spacings on main down to "), std::string::npos) << run.out;

    const ProgramRun given =
        run_lamina(folder, {"mesh", "case.toml", "--first-height", "2e-5", "-o", "a.su2", "--report", "b.json"});
    ASSERT_EQ(given.exit_code, 0) << given.err;
    const auto one = nlohmann::json::parse(folder.read("b.json"))["conditions"]["first_height"];
    EXPECT_EQ(one["chords"], 2e-5);
    EXPECT_EQ(one["source"], "given");
    EXPECT_FALSE(one.contains("elements"));

    const ProgramRun without =
        run_lamina(folder, {"mesh", "case.toml", "--use-flow", "no", "-o", "a.su2", "--report", "c.json"});
    ASSERT_EQ(without.exit_code, 0) << without.err;
    const auto block = nlohmann::json::parse(folder.read("c.json"))["conditions"];
    for (const char* key : {"wakes", "wall_spacings", "least_thickness", "boundary_layer"})
        EXPECT_FALSE(block.contains(key)) << key;
}

TEST(FlowCommand, TurnsConfigurationsAlongWalls) {
    const TemporaryFolder folder;
    expect_refused(folder, {"flow", "naca:0012", "--alpha", "4", "--ground", "0.2"}, usage,
                   "--transform all:rotate:-4");
    const auto lift = [&](const std::vector<std::string>& more) {
        std::vector<std::string> words{"flow", "naca:0012", "--transform", "all:rotate:-4", "--reynolds", "1e6"};
        words.insert(words.end(), more.begin(), more.end());
        const ProgramRun run = run_lamina(folder, words);
        EXPECT_EQ(run.exit_code, 0) << run.err;
        const std::string name = "lift coefficient ";
        return std::stod(run.out.substr(run.out.find(name) + name.size()));
    };
    const double free = lift({});
    EXPECT_GT(free, 0.4);
    EXPECT_GT(lift({"--ground", "0.2"}), 1.05 * free);
    EXPECT_GT(lift({"--tunnel", "1"}), 1.05 * free);
}

TEST(FlowCommand, RefusesBeforeItWrites) {
    const TemporaryFolder folder;
    expect_refused(folder, {"flow"}, usage, "no INPUT");
    expect_refused(folder, {"flow", "naca:0012", "--alpha", "100"}, usage, "--alpha");
    expect_refused(folder, {"flow", "naca:0012", "--reynolds", "-1"}, usage, "--reynolds");
    expect_refused(folder, {"flow", "naca:0012", "--picture", "a.bmp", "-o", "a.csv"}, usage, ".bmp");
    expect_refused(folder, {"flow", "naca:0012", "--picture", "a.png", "-o", "a.png"}, usage, "a.png");
    expect_refused(folder, {"flow", "missing.dat", "-o", "a.csv"}, io_failed, "missing.dat");
}

}  // namespace
}  // namespace lamina::test
