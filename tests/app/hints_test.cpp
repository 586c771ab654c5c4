// What the program says to words that it does not know, and how it gives help.
#include <algorithm>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <lamina/former_options.hpp>

#include "app/program.hpp"

namespace lamina::test {
namespace {

struct OptionAndHint {
    const char* option;
    const char* hint;
};

TEST(Hints, OptionsOfMeshUnderOtherNames) {
    const TemporaryFolder folder;
    const OptionAndHint options[] = {
        {"--farfield", "did you mean --far-field?"},
        {"--far-field-distance", "did you mean --far-field?"},
        {"--first-layer", "did you mean --first-height?"},
        {"--first-cell", "did you mean --first-height?"},
        {"--first_heigth", "did you mean --first-height?"},
        {"--wall-spacing", "did you mean --first-height?"},
        {"--s0", "did you mean --first-height?"},
        {"--growth-rate=1.2", "did you mean --growth?"},
        {"--ratio", "did you mean --growth?"},
        {"--yplus", "did you mean --y-plus?"},
        {"--re", "did you mean --reynolds?"},
        {"--nlayers", "did you mean --layers?"},
        {"--outptu", "did you mean --output?"},
        {"--marchDist", "did you mean --thickness?"},
        {"-format", "did you mean --format?"},
        {"-nt", "did you mean --threads?"},
        {"-q", "did you mean --min-angle?"},
        {"--aoa", "did you mean --alpha?"},
        {"--mach-number", "did you mean --mach?"},
        {"--kinematic_viscosity", "did you mean --viscosity?"},
        {"--naca", "lamina mesh naca:0012"},
        {"-2", "every mesh is two-dimensional"},
        {"--json", "did you mean --report?"},
        {"--require-delaunay", "it belongs to lamina check"},
        {"--far", "did you mean --far-field?"},
        {"--inflation-layers", "did you mean --layers?"},
        {"--quads", "did you mean --layer-topology?"},
        {"--max-cells", "did you mean --max-triangles?"},
        {"--ncells", "did you mean --cells?"},
        {"--elements", "did you mean --cells?"},
        {"--ncores", "did you mean --threads?"},
        {"--seed", "equal inputs give equal meshes"},
        {"--output-format", "did you mean --format?"},
        {"--wake-length", "did you mean --wake?"},
        {"--c-grid", "--layer-topology quads leaves them whole"},
        {"--unstructured", "all cells beyond the layer are triangles"},
    };
    for (const auto& [option, hint] : options) {
        expect_refused(folder, {"mesh", "naca:0012", option, "-o", "a.su2"}, usage,
                       std::string("unknown option ") + option);
        expect_refused(folder, {"mesh", "naca:0012", option, "-o", "a.su2"}, usage, hint);
    }
    // A word that resembles nothing gets no hint.
    expect_refused(folder, {"mesh", "naca:0012", "--zzzzz"}, usage, "unknown option --zzzzz (see");
}

TEST(Hints, ValuesThatAreNoCounts) {
    const TemporaryFolder folder;
    expect_refused(folder, {"batch", "naca:0012", "-o", "{name}.su2", "--jobs", "-1"}, usage,
                   "option --jobs: '-1' is no number that it takes");
    expect_refused(folder, {"family", "naca:0012", "-o", "{level}.su2", "--levels", "many"}, usage,
                   "option --levels: 'many' is no number that it takes");
    expect_refused(folder, {"wing.dat", "-o", "a.su2"}, usage, "did you mean lamina mesh wing.dat?");
}

TEST(Hints, ValuesThatWereForgotten) {
    const TemporaryFolder folder;
    expect_refused(folder, {"mesh", "naca:0012", "--wake-layers", "-o", "w.vtu"}, usage,
                   "--wake-layers wants a value: no or yes (see lamina mesh --help)");
    expect_refused(folder, {"mesh", "naca:0012", "--growth", "--first-height=1e-5", "-o", "w.vtu"}, usage,
                   "--growth wants a value: R");
    expect_refused(folder, {"mesh", "naca:0012", "--layers", "--growth", "1.2", "-o", "w.vtu"}, usage,
                   "--layers wants a value: N or auto");
    expect_refused(folder, {"mesh", "naca:0012", "-o", "--quiet"}, usage, "-o wants a value: FILE");
    expect_refused(folder, {"mesh", "naca:0012", "-o", "w.vtu", "--alpha"}, usage, "--alpha wants a value");
    expect_refused(folder, {"delaunay", "a.poly", "--min-angle", "--insert-crossings"}, usage,
                   "--min-angle wants a value: DEG (see lamina delaunay --help)");
    expect_refused(folder, {"batch", "naca:0012", "--jobs", "--output", "{name}.su2"}, usage,
                   "--jobs wants a value: N");
    expect_refused(folder, {"check", "a.su2", "--far", "--json"}, usage, "--far wants a value: NAME");
    expect_refused(folder, {"plot", "a.su2", "-o", "--axes"}, usage, "-o wants a value");
}

TEST(Hints, ValuesThatBeginWithAHyphen) {
    const TemporaryFolder folder;
    const ProgramRun flow = run_lamina(folder, {"flow", "naca:0012", "--alpha", "-5"});
    EXPECT_EQ(flow.exit_code, 0) << flow.err;
    const ProgramRun mesh = run_lamina(
        folder, {"mesh", "naca:0012:40", "--far-field", "3", "--alpha", "-5", "-o", "-", "--format", "su2", "--quiet"});
    EXPECT_EQ(mesh.exit_code, 0) << mesh.err;
    EXPECT_TRUE(mesh.out.starts_with("NDIME")) << mesh.out.substr(0, 80);
    // A word that names no option is a value.
    expect_refused(folder, {"mesh", "naca:0012", "--growth", "--zzzzz", "-o", "w.vtu"}, usage, "'--zzzzz'");
}

TEST(Hints, NumbersWithCommas) {
    const TemporaryFolder folder;
    expect_refused(folder, {"mesh", "naca:0012", "--alpha", "2,5", "-o", "a.su2"}, usage, "have a decimal point");
    expect_refused(folder, {"batch", "naca:0012", "--layers", "10,20", "-o", "a.su2"}, usage, "--sweep OPTION=A,B");
}

TEST(Hints, MeshesInPlaceOfAirfoils) {
    const TemporaryFolder folder;
    for (const char* command : {"info", "mesh", "flow"})
        for (const char* mesh : {"a.su2", "a.cgns", "folder.one/a.vtu"})
            expect_refused(folder, {command, mesh}, usage, "lamina check describes meshes");
}

TEST(Hints, OptionsOfOtherCommands) {
    const TemporaryFolder folder;
    const std::string triangle = "q is --min-angle DEG, a is --max-area A";
    expect_refused(folder, {"delaunay", "a.poly", "-pq30a0.1"}, usage, triangle);
    expect_refused(folder, {"delaunay", "a.poly", "-p"}, usage, "not needed");
    expect_refused(folder, {"delaunay", "a.poly", "--maxarea", "1"}, usage, "--max-area?");
    expect_refused(folder, {"check", "a.su2", "--minangle", "1"}, usage, "--min-angle?");
    expect_refused(folder, {"plot", "a.su2", "--zoom", "1"}, usage, "--window?");
    expect_refused(folder, {"flow", "naca:0012", "--aoa", "1"}, usage, "--alpha?");
    expect_refused(folder, {"flow", "naca:0012", "--re=1e6"}, usage, "--reynolds?");
    expect_refused(folder, {"convert", "a.su2", "-o", "a.vtu"}, usage, "the second argument is the output");
}

TEST(Hints, KeysOfCaseFiles) {
    const TemporaryFolder folder;
    folder.write("a.toml", "input = 'naca:0012'\nfarfield = 5\n");
    expect_refused(folder, {"mesh", "a.toml"}, usage, "a.toml:2: farfield: no such option: did you mean far_field?");
    folder.write("a.toml", "input = 'naca:0012'\ngrowth_rate = 1.2\n");
    expect_refused(folder, {"mesh", "a.toml"}, usage, "did you mean growth?");
    folder.write("a.toml", "input = 'naca:0012'\naoa = 2\n");
    expect_refused(folder, {"mesh", "a.toml"}, usage, "did you mean alpha?");
    folder.write("a.toml", "input = 'naca:0012'\nnaca = '0012'\n");
    expect_refused(folder, {"mesh", "a.toml"}, usage, "a NACA section is an input");
}

/// Returns the words of a command line, with a number for what stands for one.
std::vector<std::string> arguments_of(const std::string& text) {
    std::vector<std::string> words;
    std::istringstream in(text);
    for (std::string word; in >> word;) words.push_back(word == "N" ? "200" : word);
    return words;
}

TEST(Hints, FormerOptionsNameWhatServesInTheirPlace) {
    const TemporaryFolder folder;
    const std::string all = run_lamina(folder, {"mesh", "--help-all"}).out;
    for (const FormerOption& former : former_options()) {
        const std::string name = former.name, reason = former.reason, arguments = former.arguments, line = former.line;
        SCOPED_TRACE(name);
        EXPECT_EQ(all.find("--" + name + " "), std::string::npos) << "it is no former option";
        const std::string given = arguments.empty() ? "leave it out: " : "give " + arguments + ": ";
        for (const char* command : {"mesh", "family", "batch"})
            for (const std::string value : {"", "=5"})
                expect_refused(folder, {command, "naca:0012", "-o", "a.su2", "--" + name + value}, usage,
                               "unknown option --" + name + value + ": " + given + reason);
        expect_refused(folder, {"mesh", "naca:0012", "-o", "a.su2", "--" + name, "5"}, usage, given + reason);
        expect_refused(folder, {"info", "naca:0012", "--" + name}, usage, given + reason);
        expect_refused(folder, {"batch", "naca:0012", "-o", "a.su2", "--sweep", name + "=1,2"}, usage, given + reason);

        std::string key = name;
        std::replace(key.begin(), key.end(), '-', '_');
        folder.write("a.toml", "input = 'naca:0012'\n" + key + " = 5\n");
        expect_refused(
            folder, {"mesh", "a.toml"}, usage,
            "a.toml:2: " + key + ": no such option: " + (line.empty() ? "delete it" : "write " + line) + ": " + reason);

        // What is advised is taken.
        if (!arguments.empty()) {
            std::vector<std::string> advised{"mesh", "naca:0012", "--dump-config"};
            for (const std::string& word : arguments_of(arguments)) advised.push_back(word);
            const ProgramRun run = run_lamina(folder, advised);
            EXPECT_EQ(run.exit_code, 0) << run.err;
        }
        if (!line.empty()) {
            std::string written = line;
            if (written.ends_with(" N")) written.replace(written.size() - 1, 1, "200");
            folder.write("a.toml", "input = 'naca:0012'\n" + written + "\n");
            const ProgramRun run = run_lamina(folder, {"mesh", "a.toml", "--dump-config"});
            EXPECT_EQ(run.exit_code, 0) << run.err;
        }
    }
}

TEST(Hints, Commands) {
    const TemporaryFolder folder;
    expect_refused(folder, {"mehs", "naca:0012"}, usage, "did you mean lamina mesh?");
    expect_refused(folder, {"generate"}, usage, "did you mean lamina mesh?");
    expect_refused(folder, {"triangulate"}, usage, "did you mean lamina delaunay?");
    expect_refused(folder, {"xfoil"}, usage, "did you mean lamina flow?");
    expect_refused(folder, {"naca:0012"}, usage, "did you mean lamina mesh naca:0012?");
    expect_refused(folder, {"help", "mehs"}, usage, "did you mean lamina mesh?");
    expect_refused(folder, {"xyzzy"}, usage, "known: mesh, family, sizes, remesh, adapt, morph, batch, case");
}

TEST(Hints, ValuesAndFormats) {
    const TemporaryFolder folder;
    expect_refused(folder, {"mesh", "naca:0012", "-o", "a.su2", "--far-field-shape", "circel"}, usage, "'circle'?");
    expect_refused(folder, {"mesh", "naca:0012", "-o", "a.su2", "--growth-law", "geometrical"}, usage, "'geometric'?");
    expect_refused(folder, {"mesh", "naca:0012", "-o", "a", "--format", "gmsh"}, usage, "'msh41'?");
    expect_refused(folder, {"mesh", "naca:0012", "-o", "a", "--format", "vtk"}, usage, "'vtu'?");
    expect_refused(folder, {"mesh", "naca:0012", "-o", "a", "--format", "msh42"}, usage, "'msh41'?");
    expect_refused(folder, {"mesh", "naca:0012", "-o", "a.vtk"}, usage, "'.vtu'?");
    expect_refused(folder, {"completion", "basch"}, usage, "'bash'?");
}

TEST(Hints, SectionsWithoutTheirColon) {
    const TemporaryFolder folder;
    for (const char* input : {"naca0012", "NACA0012", "NACA 0012", "naca-0012", "0012"})
        expect_refused(folder, {"mesh", input, "-o", "a.su2"}, io_failed, "did you mean 'naca:0012'?");
    expect_refused(folder, {"mesh", "naca23012:300", "-o", "a.su2"}, io_failed, "did you mean 'naca:23012:300'?");
    expect_refused(folder, {"mesh", "NACA", "0012", "-o", "a.su2"}, io_failed, "did you mean 'naca:0012'?");
    expect_refused(folder, {"info", "2412"}, io_failed, "did you mean 'naca:2412'?");
    expect_refused(folder, {"info", "naca:0012:Blunt"}, usage, "did you mean 'blunt'?");
    expect_refused(folder, {"info", "naca:0012:many"}, usage, "'many' is neither a number of points nor");
    const ProgramRun missing = run_lamina(folder, {"mesh", "wing.dat", "-o", "a.su2"});
    EXPECT_EQ(missing.err.find("did you mean"), std::string::npos) << missing.err;
}

TEST(Hints, HelpAndVersionInEveryForm) {
    const TemporaryFolder folder;
    const std::string help = run_lamina(folder, {"--help"}).out, mesh_help = run_lamina(folder, {"mesh", "--help"}).out;
    EXPECT_NE(mesh_help.find("--first-height"), std::string::npos);
    EXPECT_EQ(run_lamina(folder, {"help"}).out, help);
    EXPECT_EQ(run_lamina(folder, {"help", "mesh"}).out, mesh_help);
    EXPECT_EQ(run_lamina(folder, {"-h"}).out, help);
    const std::string version = run_lamina(folder, {"--version"}).out;
    EXPECT_TRUE(version.starts_with("lamina ")) << version;
    for (const std::vector<std::string>& arguments : std::vector<std::vector<std::string>>{
             {"-V"}, {"version"}, {"mesh", "--version"}, {"delaunay", "--version"}, {"mesh", "naca:0012", "--version"}})
        EXPECT_EQ(run_lamina(folder, arguments).out, version) << arguments.front();
    const std::string all = run_lamina(folder, {"mesh", "--help-all"}).out;
    const auto options_in = [](const std::string& text) {
        std::size_t count = 0;
        for (std::size_t at = text.find("\n  -"); at != std::string::npos; at = text.find("\n  -", at + 1)) ++count;
        return count;
    };
    EXPECT_EQ(options_in(mesh_help), 26u) << "25 that users need, and --help";
    EXPECT_GT(options_in(all), 60u);
    EXPECT_NE(mesh_help.find("lamina mesh --help-all shows "), std::string::npos);
    EXPECT_EQ(run_lamina(folder, {"help", "mesh", "--help-all"}).out, all);
    EXPECT_EQ(run_lamina(folder, {"convert", "--help-all"}).out, run_lamina(folder, {"convert", "--help"}).out);
}

// The bodies would fit into the far field: it is the layers that do not.
TEST(Hints, ALayerBeyondTheFarFieldBlamesTheHeights) {
    const TemporaryFolder folder;
    expect_refused(folder, {"mesh", "naca:0012", "-o", "a.su2", "--first-height", "0.1", "--layers", "30"}, usage,
                   "option --first-height: a first height of 0.1 and 30 layers make a layer that is 130");
    expect_refused(folder,
                   {"mesh", "naca:0012", "-o", "a.su2", "--y-plus", "300", "--reynolds", "1e4", "--far-field", "20",
                    "--preset", "none", "--layers", "30"},
                   usage, "option --y-plus: a first height of");
    expect_refused(folder, {"mesh", "naca:0012", "-o", "a.su2", "--far-field", "0.2"}, usage, "option --far-field");
}

// SU2 files hold no regions. The cells of the layer must not count as isotropic cells that are too narrow.
TEST(Hints, CheckTellsThinLayerCellsFromOthersWithoutRegions) {
    const TemporaryFolder folder;
    const ProgramRun made = run_lamina(folder, {"mesh", "naca:0012", "--layers", "auto", "--layer-topology", "delaunay",
                                                "--far-field", "5", "-o", "a.su2", "-o", "a.vtu"});
    ASSERT_EQ(made.exit_code, 0) << made.err;
    const ProgramRun run = run_lamina(folder, {"check", "a.su2", "--min-angle", "20.7", "--require-delaunay"});
    EXPECT_EQ(run.exit_code, 0) << run.err << run.out;
    EXPECT_NE(run.out.find("thin cells that hang together with a wall"), std::string::npos) << run.out;
    EXPECT_NE(run.out.find(" 0 isotropic cells have an angle below the bound"), std::string::npos) << run.out;
    EXPECT_EQ(run.out.find("transition"), std::string::npos) << run.out;
    EXPECT_NE(run_lamina(folder, {"check", "a.su2", "--json"}).out.find("\"regions\": \"estimate\""),
              std::string::npos);
    EXPECT_NE(run_lamina(folder, {"check", "a.vtu", "--json"}).out.find("\"regions\": \"file\""), std::string::npos);
}

}  // namespace
}  // namespace lamina::test
