// Input that cannot be meshed is refused with the documented exit code and one clear line, and nothing is written.
#include <gtest/gtest.h>

#include <cstdlib>
#include <string>
#include <vector>

#include "app/program.hpp"

namespace lamina::test {
namespace {

const std::vector<std::string> mesh_naca{"mesh", "naca:0012", "-o", "out.su2", "--report", "out.json"};

std::vector<std::string> mesh_naca_with(std::vector<std::string> more) {
    more.insert(more.begin(), mesh_naca.begin(), mesh_naca.end());
    return more;
}

struct BadFile {
    const char* content;
    const char* said;
};

TEST(BadInput, FilesThatHoldNoOutline) {
    const BadFile files[] = {
        {"", "bad.dat"},
        {"\n\n \n", "bad.dat"},
        {"These are words.\nAnd nothing but words, here.\n", "bad.dat"},
        {"title\n1 0\n0.5 0.1\n0 nan\n0.5 -0.1\n1 0\n", "bad.dat:4"},
        {"title\n1 0\n0.5 inf\n0 0\n0.5 -0.1\n1 0\n", "bad.dat:3"},
        {"title\n1 0\n0 0\n", "bad.dat"},
        {"title\n1 0\n0.5 0\n0.25 0\n0 0\n0.25 0\n", "bad.dat"},
        {"title\n0 0\n1 1\n1 0\n0 1\n", "bad.dat"},
    };
    for (const BadFile& bad : files) {
        const TemporaryFolder folder;
        folder.write("bad.dat", bad.content);
        SCOPED_TRACE(bad.content);
        expect_refused(folder, {"mesh", "bad.dat", "-o", "out.su2", "--report", "out.json"}, bad_input, bad.said);
        expect_refused(folder, {"info", "bad.dat"}, bad_input, bad.said);
    }
}

TEST(BadInput, ASelfCrossingOutlineIsRefusedWithCoordinates) {
    const TemporaryFolder folder;
    folder.write("bow.dat", "bow tie\n1 0\n0.5 0.1\n0 0\n0.5 0.2\n0.6 -0.1\n");
    expect_refused(folder, {"mesh", "bow.dat", "-o", "out.su2"}, bad_input, "(at ");
}

TEST(BadInput, FilesThatAreMissing) {
    const TemporaryFolder folder;
    expect_refused(folder, {"mesh", "missing.dat", "-o", "out.su2"}, io_failed, "missing.dat");
    expect_refused(folder, {"mesh", "missing.toml", "-o", "out.su2"}, io_failed, "missing.toml");
    expect_refused(folder, {"info", "missing.dat"}, io_failed, "missing.dat");
    expect_refused(folder, {"check", "missing.su2"}, io_failed, "missing.su2");
    expect_refused(folder, {"plot", "missing.vtu", "-o", "out.png"}, io_failed, "missing.vtu");
}

TEST(BadInput, NumbersOutOfRange) {
    const TemporaryFolder folder;
    const std::vector<std::vector<std::string>> wrong{
        {"--far-field", "0"},     {"--far-field", "-3"},   {"--first-height", "-1e-5"}, {"--first-height", "0"},
        {"--growth", "1"},        {"--growth", "0.8"},     {"--growth", "nan"},         {"--first-height", "inf"},
        {"--thickness", "-1"},    {"--layers", "0"},       {"--layers", "2.5"},         {"--layers", "-4"},
        {"--min-angle", "0"},     {"--min-angle", "33.1"}, {"--gradation", "0"},        {"--wall-size", "-0.1"},
        {"--far-size", "0"},      {"--threads", "-1"},     {"--threads", "many"},       {"--max-ray-angle", "0"},
        {"--max-triangles", "0"}, {"--far-field", ""},     {"--growth", "1.2x"},        {"--layers", "25e-1"},
        {"--threads", "1e"},      {"--threads", "1e400"},
    };
    for (const auto& option : wrong) expect_refused(folder, mesh_naca_with(option), usage, option.front().substr(2));
}

// As those of shell variables that are not set.
TEST(BadInput, EmptyValues) {
    const TemporaryFolder folder;
    folder.write("a.node", "3 2 0 0\n1 0 0\n2 1 0\n3 0 1\n");
    expect_refused(folder, mesh_naca_with({"--first-height", ""}), usage, "--first-height: the value is empty");
    expect_refused(folder, {"mesh", "", "-o", "out.su2"}, usage, "INPUT: the value is empty");
    expect_refused(folder, {"mesh", "naca:0012", "-o", ""}, usage, "--output: the value is empty");
    expect_refused(folder, {"info", ""}, usage, "INPUT: the value is empty");
    expect_refused(folder, {"flow", "naca:0012", "--alpha", ""}, usage, "--alpha: the value is empty");
    expect_refused(folder, {"delaunay", "a.node", "--min-angle", ""}, usage, "--min-angle: the value is empty");
    expect_refused(folder, {"delaunay", "a.node", "--max-area="}, usage, "--max-area");
    expect_refused(folder, {"check", "a.node", "--wall", ""}, usage, "--wall: the value is empty");
    // The word behind is no value: it may be an input, which the report would replace.
    folder.write("b.dat", "b");
    expect_refused(folder, {"mesh", "naca:0012", "-o", "out.su2", "--report=", "b.dat"}, usage,
                   "--report: the value is empty");
    expect_refused(folder, {"mesh", "naca:0012", "--names=", "-o", "out.su2"}, usage, "--names: the value is empty");
    EXPECT_EQ(folder.read("b.dat"), "b");
}

TEST(BadInput, WakesAndSizeSources) {
    const TemporaryFolder folder;
    for (const char* outline : {"", "1,2,3,4", "-9,-9,9,-9,0", "-9,-9,9,-9,0,x", "-9,-9,0,9,9,-9", "2,-1,3,-1,3,1"})
        expect_refused(folder, mesh_naca_with({"--far-field-outline", outline}), usage, "outline");
    expect_refused(folder, mesh_naca_with({"--far-field-outline", "0,10,-5.9,-8.1,9.5,3.1,-9.5,3.1,5.9,-8.1"}), usage,
                   "--far-field-outline: it runs round its middle more than once");
    expect_refused(folder, mesh_naca_with({"--far-field-outline", "-9,-9,9,-9,0,9", "--far-field-shape", "circle"}),
                   usage, "exclude each other");
    for (const char* wake : {"", "x", "10:", "10:0", "10:-1", "10:2:0", "10:2:1:1", "1e9", "nan", "10:inf"})
        expect_refused(folder, mesh_naca_with({"--wake", wake}), usage, "--wake");
    for (const char* shape :
         {"", "box", "box:", "box:0,0,1,1", "box:0,0,1,1,0", "box:0,0,1,1,-1", "box:0,0,1,x,1", "box:0,0,1,1,1,1",
          "circle:0,0,1", "circle:0,0,0,1", "circle:0,0,-1,1", "line:0,0,1,1,", "line:0,0,1,1,nan", "star:0,0,1,1"})
        expect_refused(folder, mesh_naca_with({"--refine", shape}), usage, "--refine");
    folder.write("case.toml", "input = 'naca:0012'\nwake = true\n");
    expect_refused(folder, {"mesh", "case.toml", "-o", "out.su2"}, usage, "case.toml:2: wake");
    folder.write("case.toml", "input = 'naca:0012'\nrefine = ['circle:1']\n");
    expect_refused(folder, {"mesh", "case.toml", "-o", "out.su2"}, usage, "case.toml:2: refine");
}

TEST(BadInput, BackgroundMeshes) {
    const TemporaryFolder folder;
    folder.write("text.vtu", "no mesh\n");
    folder.write("text.msh", "no mesh\n");
    expect_refused(folder, mesh_naca_with({"--background", "text.vtu"}), bad_input, "text.vtu");
    expect_refused(folder, mesh_naca_with({"--background", "text.msh"}), bad_input, "text.msh:1");
    expect_refused(folder, mesh_naca_with({"--background", "missing.vtu"}), io_failed, "missing.vtu");
    expect_refused(folder, mesh_naca_with({"--background", "text.dat"}), usage, "text.dat");
    folder.write("case.toml", "input = 'naca:0012'\nbackground = 'missing.msh'\n");
    expect_refused(folder, {"mesh", "case.toml", "-o", "out.su2"}, io_failed, "missing.msh");
}

TEST(BadInput, OneValueGivenTwice) {
    const TemporaryFolder folder;
    folder.write("a.node", "3 2 0 0\n1 0 0\n2 1 0\n3 0 1\n");
    for (const auto& [option, first, second] :
         std::vector<std::array<std::string, 3>>{{"--alpha", "2", "4"},
                                                 {"--first-height", "1e-5", "1e-4u"},
                                                 {"--preset", "rans", "euler"},
                                                 {"--far-field", "50", "-50"},
                                                 {"--layers", "auto", "30"},
                                                 {"--html", "a.html", "b.html"}})
        expect_refused(folder, mesh_naca_with({option, first, option, second}), usage,
                       option + ": it holds one value and is given two, '" + first + "' and '" + second + "'");
    expect_refused(folder, mesh_naca_with({"--alpha=2", "--growth", "1.2", "--alpha=4"}), usage, "'2' and '4'");
    expect_refused(folder, {"info", "naca:0012", "naca:0012", "-o", "x"}, usage, "");
    expect_refused(folder, {"check", "a.node", "--far", "a", "--far", "b"}, usage, "--far: it holds one value");
    expect_refused(folder, {"delaunay", "a.node", "--min-angle", "20", "--min-angle", "25"}, usage, "'20' and '25'");
    expect_refused(folder, {"flow", "naca:0012", "--alpha", "1", "--alpha", "2"}, usage, "--alpha: it holds one value");
    expect_refused(folder,
                   {"batch", "naca:0012", "-o", "{name}_{alpha}.su2", "--sweep", "alpha=1,2", "--sweep", "alpha=3"},
                   usage, "'alpha' is swept twice");
    expect_refused(folder, mesh_naca_with({"--close", "--close=false"}), usage, "--close: it holds one value");
    // The same value may be given again, however it is written.
    EXPECT_EQ(run_lamina(folder, {"mesh", "naca:0012", "--alpha", "4", "--alpha", "4", "--alpha", "4.0", "--quiet",
                                  "--quiet", "--dump-config"})
                  .exit_code,
              0);
}

TEST(BadInput, AFirstHeightGivenTwiceOrByHalf) {
    const TemporaryFolder folder;
    const auto refuse = [&](const std::vector<std::string>& options, const std::string& said) {
        expect_refused(folder, mesh_naca_with(options), usage, said);
    };
    refuse({"--first-height", "1e-5", "--y-plus", "1", "--reynolds", "1e6"}, "exclude each other");
    refuse({"--y-plus", "1"}, "needs reynolds");
    refuse({"--y-plus", "1", "--velocity", "30"}, "velocity needs viscosity");
    refuse({"--viscosity", "1.5e-5"}, "viscosity needs velocity");
    refuse({"--velocity", "30", "--viscosity", "1.5e-5", "--reynolds", "1e6"}, "exclude each other");
    refuse({"--first-height", "1e-5m"}, "is not a length, such as 0.003 (chords) or 0.003u (units of the input)");
    refuse({"--first-height", "-1u"}, "first-height");
    refuse({"--y-plus", "0", "--reynolds", "1e6"}, "y-plus");
    refuse({"--y-plus", "1", "--reynolds", "-1"}, "reynolds");
    refuse({"--y-plus", "1", "--dump-config"}, "needs reynolds");
}

TEST(BadInput, GrowthLawsThatLackSomething) {
    const TemporaryFolder folder;
    expect_refused(folder, mesh_naca_with({"--layers", "many"}), usage, "layers");
    expect_refused(folder, mesh_naca_with({"--growth-law", "exponential"}), usage, "number of layers");
    expect_refused(folder, mesh_naca_with({"--growth-law", "exponential", "--layers", "30"}), usage, "thickness");
    expect_refused(folder, mesh_naca_with({"--growth-law", "adaptive", "--layers", "auto"}), usage, "adaptive");
    expect_refused(folder, mesh_naca_with({"--growth-law", "exponential", "--layers", "30", "--thickness", "1e-4"}),
                   usage, "thickness");
    expect_refused(folder, mesh_naca_with({"--growth", "1.0001", "--layers", "auto"}), usage, "1000 layers");
}

TEST(BadInput, FarFieldsThatAreTooSmallOrTooLarge) {
    const TemporaryFolder folder;
    expect_refused(folder, mesh_naca_with({"--far-field", "0.2"}), usage, "--far-field: leaves 0 units");
    for (const char* size : {"1e13", "1e15u", "1e30"})
        expect_refused(folder, mesh_naca_with({"--far-field", size}), usage, "--far-field: is more than 1e12 times");
    expect_refused(folder, mesh_naca_with({"--far-field-outline", "-1e15,-1e15,1e15,-1e15,0,1e15"}), usage,
                   "--far-field-outline: is more than 1e12 times");
}

TEST(BadInput, NewPointsWhereTheGivenOnesAreKept) {
    const TemporaryFolder folder;
    for (const std::string option : {"spacing-max", "spacing-le", "spacing-te"})
        expect_refused(folder, mesh_naca_with({"--surface", "keep", "--" + option, "0.01"}), usage, option);
    expect_refused(folder, mesh_naca_with({"--surface", "keep", "--surface-points", "300"}), usage, "surface-points");
    expect_refused(folder, mesh_naca_with({"--surface", "keep", "--exact-points", "300"}), usage, "exact-points");
}

TEST(BadInput, ExactNumbersOfPoints) {
    const TemporaryFolder folder;
    for (const char* value :
         {"many", "200:", ":4", "200:4:4", "200.5", "200:1.5", "200,4", "2", "1e8", "200:0", "-200"})
        expect_refused(folder, mesh_naca_with({"--exact-points", value}), usage, "option --exact-points: ");
    expect_refused(folder, mesh_naca_with({"--exact-points", "200", "--surface-points", "200"}), usage,
                   "exact-points and surface-points exclude each other");
    expect_refused(folder, {"mesh", "naca:0012:blunt", "--exact-points", "6:9", "-o", "out.su2"}, usage,
                   "option --exact-points: exactly 6 are too few");
}

TEST(BadInput, OptionsThatAreNotKnown) {
    const TemporaryFolder folder;
    expect_refused(folder, mesh_naca_with({"--frist-height", "1e-5"}), usage, "--frist-height");
    expect_refused(folder, mesh_naca_with({"--growth-law", "linear"}), usage, "geometric");
    expect_refused(folder, mesh_naca_with({"--surface", "melt"}), usage, "keep");
    expect_refused(folder, mesh_naca_with({"--format", "stl"}), usage, "stl");
    expect_refused(folder, mesh_naca_with({"--first-height"}), usage, "--first-height");
    expect_refused(folder, {"plot", "mesh.vtu", "-o", "a.png", "--color", "red"}, usage, "quality");
    expect_refused(folder, {"plot", "mesh.vtu", "-o", "a.png", "--window", "0,1,2"}, usage, "--window");
    expect_refused(folder, {"fly"}, usage, "'fly'");
    expect_refused(folder, {}, usage, "--help");
    expect_refused(folder, {"mesh", "-o", "out.su2"}, usage, "INPUT");
    expect_refused(folder, {"mesh", "naca:0012"}, usage, "-o");
}

TEST(BadInput, NacaNamesThatNameNoSection) {
    const TemporaryFolder folder;
    for (const char* name : {"naca:12", "naca:abcd", "naca:", "naca:0012:2", "naca:0012:x"}) {
        expect_refused(folder, {"mesh", name, "-o", "out.su2"}, usage, "naca:");
    }
}

TEST(BadInput, OutputsThatCannotBeWritten) {
    const TemporaryFolder folder;
    expect_refused(folder, {"mesh", "naca:0012", "-o", "nowhere/out.su2"}, io_failed, "nowhere");
    expect_refused(folder, {"mesh", "naca:0012", "-o", "out.su2", "-o", "nowhere/out.vtu"}, io_failed, "nowhere");
    expect_refused(folder, {"mesh", "naca:0012", "-o", "out.su2", "--report", "nowhere/r.json"}, io_failed, "nowhere");
    expect_refused(folder, {"mesh", "naca:0012", "-o", "out.unknown"}, usage, "out.unknown");
    expect_refused(folder, {"mesh", "naca:0012", "-o", "/proc/out.su2"}, io_failed, "/proc/out.su2");
}

TEST(BadInput, CaseFiles) {
    const TemporaryFolder folder;
    const auto expect_case_refused = [&](const std::string& content, int exit_code, const std::string& said) {
        folder.write("case.toml", content);
        SCOPED_TRACE(content);
        expect_refused(folder, {"mesh", "case.toml", "-o", "out.su2"}, exit_code, said);
    };
    expect_case_refused("input = 'naca:0012'\n\nfrist_height = 1e-5\n", usage, "case.toml:3: frist_height");
    expect_case_refused("input = 'naca:0012'\nfar_field = -1\n", usage, "case.toml:2: far_field");
    expect_case_refused("input = 'naca:0012'\ngrowth = nan\n", usage, "case.toml:2: growth");
    expect_case_refused("input = 'naca:0012'\nlayers = '30'\n", usage, "case.toml:2: layers");
    expect_case_refused("input = 'naca:0012'\nno_layers = 1\n", usage, "case.toml:2: no_layers");
    expect_case_refused("input = [1, 2]\n", usage, "case.toml:1: input");
    expect_case_refused("input = 'naca:0012'\n[layer]\ngrowth = 2\n", usage, "case.toml:2: layer");
    expect_case_refused("input = 'naca:0012'\ngrowth = \n", bad_input, "case.toml:2");
    expect_case_refused("growth = 1.2\n", usage, "case.toml: no input");
    expect_case_refused("input = 'case.toml'\n", bad_input, "case.toml");

    folder.write("case.toml", "input = 'naca:0012'\n");
    expect_refused(folder, {"mesh", "case.toml", "naca:0012", "-o", "out.su2"}, usage, "only INPUT");
}

}  // namespace
}  // namespace lamina::test
