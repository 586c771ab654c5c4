// Presets: options to begin with, which case files and the command line override.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "app/program.hpp"

namespace lamina::test {
namespace {

/// Returns the configuration in force, as --dump-config prints it.
std::string dumped(const TemporaryFolder& folder, std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "mesh");
    arguments.push_back("--dump-config");
    const ProgramRun run = run_lamina(folder, arguments);
    EXPECT_EQ(run.exit_code, 0) << run.err;
    return run.out;
}

void expect_line(const std::string& text, const std::string& line) {
    EXPECT_NE(text.find("\n" + line + "\n"), std::string::npos) << line << " is missing in\n" << text;
}

TEST(Presets, ThesisIsWhatItsCasesHaveInCommon) {
    const TemporaryFolder folder;
    const std::string examples = LAMINA_SOURCE_DIR "/examples/thesis/";
    const std::string preset = dumped(folder, {"naca:0012:200", "--preset", "thesis"});
    for (const char* file : {"fig21.toml", "fig22.toml", "fig24.toml", "fig27.toml", "fig29.toml"}) {
        SCOPED_TRACE(file);
        const std::string figure = dumped(folder, {examples + file});
        for (const char* key :
             {"first_height", "growth", "layers", "max_ray_angle", "layer_topology", "far_field", "growth_law"}) {
            const std::size_t at = figure.find("\n" + std::string(key) + " = ");
            ASSERT_NE(at, std::string::npos) << key;
            expect_line(preset, figure.substr(at + 1, figure.find('\n', at + 1) - at - 1));
        }
    }
}

TEST(Presets, AreOverriddenByTheFileAndTheCommandLine) {
    const TemporaryFolder folder;
    folder.write("case.toml", "far_field = 20\ngrowth = 1.3\ninput = 'naca:0012'\npreset = 'thesis'\n");
    const std::string file = dumped(folder, {"case.toml"});
    expect_line(file, "preset = 'thesis'");
    expect_line(file, "far_field = 20");
    expect_line(file, "layer_topology = 'delaunay'");
    const std::string both = dumped(folder, {"case.toml", "--growth", "1.1", "--layers", "auto"});
    expect_line(both, "growth = 1.1");
    expect_line(both, "layers = 'auto'");
    expect_line(both, "max_ray_angle = 4");
    // The command line takes the preset of the file back, or gives one beneath its options.
    const std::string without = dumped(folder, {"case.toml", "--preset", "none"});
    expect_line(without, "growth = 1.3");
    expect_line(without, "layer_topology = 'layered'");
    folder.write("plain.toml", "far_field = 20\ninput = 'naca:0012'\n");
    const std::string beneath = dumped(folder, {"plain.toml", "--preset", "thesis"});
    expect_line(beneath, "far_field = 20");
    expect_line(beneath, "layer_topology = 'delaunay'");
}

TEST(Presets, AReynoldsNumberMeansRans) {
    const TemporaryFolder folder;
    folder.write("case.toml", "input = 'naca:0012'\nvelocity = 50\nviscosity = 1e-5\ngrowth = 1.15\n");
    for (const std::string& guided :
         {dumped(folder, {"naca:0012", "--reynolds", "1e6"}), dumped(folder, {"case.toml"}),
          dumped(folder, {"naca:0012", "--velocity", "50", "--viscosity", "1e-5", "--growth", "1.15"})}) {
        expect_line(guided, "use_flow = 'yes'");
        expect_line(guided, "y_plus = 1");
        expect_line(guided, "layers = 'auto'");
    }
    for (const std::string& plain : {dumped(folder, {"naca:0012"}), dumped(folder, {"case.toml", "--preset", "none"}),
                                     dumped(folder, {"naca:0012", "--reynolds", "1e6", "--preset", "thesis"})})
        expect_line(plain, "use_flow = 'no'");
    const std::string given = dumped(folder, {"naca:0012", "--reynolds", "1e6", "--first-height", "1e-4"});
    expect_line(given, "first_height = 0.0001");
    expect_line(given, "use_flow = 'yes'");
}

TEST(Presets, AreDumpedWithAllThatFollows) {
    const TemporaryFolder folder;
    const std::string once =
        dumped(folder, {"naca:0012", "--preset", "thesis", "--y-plus", "1", "--reynolds", "1e6", "--layers", "20"});
    expect_line(once, "# first_height is not set");
    folder.write("case.toml", once);
    EXPECT_EQ(dumped(folder, {"case.toml"}), once);
}

TEST(Presets, UnknownNamesAreRefused) {
    const TemporaryFolder folder;
    expect_refused(folder, {"mesh", "naca:0012", "-o", "a.su2", "--preset", "thesys"}, usage,
                   "option --preset: 'thesys' is not known: did you mean 'thesis'? (known: auto, none, rans, "
                   "wall-function, euler, les2d, thesis)");
    folder.write("a.toml", "input = 'naca:0012'\npreset = 'pardue'\n");
    expect_refused(folder, {"mesh", "a.toml"}, usage, "a.toml:2: preset: 'pardue' is not known");
    folder.write("a.toml", "input = 'naca:0012'\npreset = 4\n");
    expect_refused(folder, {"mesh", "a.toml"}, usage, "a.toml:2: preset: must be a string");
}

}  // namespace
}  // namespace lamina::test
