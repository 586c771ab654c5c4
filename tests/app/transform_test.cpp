// --transform: from the command line and case files to the mesh.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "app/program.hpp"
#include "support/geometry_fixtures.hpp"

namespace lamina::test {
namespace {

using Json = nlohmann::json;

/// Makes a mesh with these arguments, expects it to be valid, and returns its report.
Json mesh_with(const TemporaryFolder& folder, const std::vector<std::string>& arguments) {
    std::vector<std::string> all{"mesh",     "--far-field", "5",        "--layers", "auto",
                                 "--strict", "-o",          "made.vtu", "--report", "made.json"};
    all.insert(all.begin() + 1, arguments.begin(), arguments.end());
    const ProgramRun mesh = run_lamina(folder, all);
    EXPECT_EQ(mesh.exit_code, 0) << mesh.err;
    if (mesh.exit_code != 0) return {};
    const ProgramRun check = run_lamina(folder, {"check", "made.vtu", "--min-angle", "20.7"});
    EXPECT_EQ(check.exit_code, 0) << check.out << check.err;
    return Json::parse(folder.read("made.json"));
}

TEST(Transform, TheSameSectionTwiceMakesAMainElementAndAFlap) {
    const TemporaryFolder folder;
    const Json report =
        mesh_with(folder, {"naca:23012", "naca:23012", "--names", "main,flap", "--transform", "flap:scale:0.3",
                           "--transform", "flap:rotate:-30", "--transform", "flap:shift:1.02,-0.03"});
    ASSERT_TRUE(report.is_object());
    EXPECT_EQ(report["input"][0]["transformations"], Json::array());
    EXPECT_EQ(report["input"][1]["transformations"],
              (Json{"scaled by 0.3 about (0, 0)", "rotated by -30 degrees about (0, 0)", "shifted by (1.02, -0.03)"}));
}

TEST(Transform, PlainFlapsAreMeshed) {
    const TemporaryFolder folder;
    for (const char* input : {"naca:0012", "naca:4412:blunt"})
        for (const char* flap :
             {"airfoil:flap:2:0.75,0.01", "airfoil:flap:20:0.75,0.01", "airfoil:flap:-45:0.8,0.01"}) {
            SCOPED_TRACE(std::string(input) + " " + flap);
            EXPECT_TRUE(mesh_with(folder, {input, "--transform", flap}).is_object());
        }
}

TEST(Transform, UnitsDoNotChangeTheMesh) {
    const TemporaryFolder folder;
    // A factor of two keeps all digits.
    const Json report = mesh_with(folder, {"naca:0012:100", "--first-height", "1e-4"}),
               doubled = mesh_with(folder, {"naca:0012:100", "--transform", "all:scale:2", "--first-height", "1e-4"});
    ASSERT_TRUE(report.is_object() && doubled.is_object());
    EXPECT_EQ(report["triangles"], doubled["triangles"]);
    EXPECT_NE(report["hash"], doubled["hash"]);
}

TEST(Transform, ASectionForFlowFromTheRightIsTurnedToTheMeshOfTheOneThatStandsRight) {
    const TemporaryFolder folder;
    const std::string straight =
                          "1 0\n0.75 0.0625\n0.5 0.125\n0.25 0.125\n0.0625 0.0625\n0 0\n0.0625 -0.0625\n"
                          "0.25 -0.09375\n0.5 -0.0625\n0.75 -0.03125\n1 0\n",
                      reversed =
                          "0 0\n0.25 0.0625\n0.5 0.125\n0.75 0.125\n0.9375 0.0625\n1 0\n0.9375 -0.0625\n"
                          "0.75 -0.09375\n0.5 -0.0625\n0.25 -0.03125\n0 0\n";
    folder.write("straight.dat", straight);
    folder.write("reversed.dat", reversed);
    const Json right = mesh_with(folder, {"straight.dat"}),
               turned = mesh_with(folder,
                                  {"reversed.dat", "--transform", "all:rotate:180:0.5,0", "--transform", "all:mirror"});
    ASSERT_TRUE(right.is_object() && turned.is_object());
    EXPECT_EQ(right["hash"], turned["hash"]);
}

TEST(Transform, BodiesOfAnyShapeArePlaced) {
    const TemporaryFolder folder;
    folder.write("c.dat", "0 0\n2 0\n2 0.8\n1.8 0.8\n1.8 0.2\n0.2 0.2\n0.2 1.8\n1.8 1.8\n1.8 1.2\n2 1.2\n2 2\n0 2\n");
    folder.write("hexagon.dat", "1 0\n0.5 0.75\n-0.5 0.75\n-1 0\n-0.5 -0.75\n0.5 -0.75\n");
    // One hexagon lies inside the C, and one in its mouth.
    const Json report =
        mesh_with(folder, {"c.dat", "hexagon.dat", "hexagon.dat", "--transform", "hexagon_1:scale:0.3", "--transform",
                           "hexagon_1:shift:1,1", "--transform", "hexagon_2:rotate:30", "--transform",
                           "hexagon_2:scale:0.1", "--transform", "hexagon_2:shift:1.9,1"});
    ASSERT_TRUE(report.is_object());
    EXPECT_EQ(report["input"].size(), 3u);
}

TEST(Transform, IsDumpedAndReadFromCaseFiles) {
    const TemporaryFolder folder;
    const ProgramRun dump = run_lamina(folder, {"mesh", "naca:0012", "--transform", "all:mirror", "--transform",
                                                "airfoil:rotate:-5:0.25,0", "--dump-config"});
    ASSERT_EQ(dump.exit_code, 0) << dump.err;
    EXPECT_NE(dump.out.find("\ntransform = [ 'all:mirror:0', 'airfoil:rotate:-5:0.25,0' ]\n"), std::string::npos)
        << dump.out;
    folder.write("case.toml", dump.out);
    EXPECT_EQ(run_lamina(folder, {"mesh", "case.toml", "--dump-config"}).out, dump.out);
    folder.write("short.toml", "input = 'naca:0012:100'\ntransform = 'all:scale:1000'\n");
    const ProgramRun info = run_lamina(folder, {"info", "short.toml"});
    EXPECT_NE(info.out.find("x 0 to 1000,"), std::string::npos) << info.out << info.err;
    const ProgramRun turned = run_lamina(folder, {"info", "naca:0012:100", "--transform", "all:rotate:180",
                                                  "--transform", "all:shift:1,0", "--transform", "all:mirror"});
    EXPECT_NE(turned.out.find("rotated by 180 degrees about (0, 0)"), std::string::npos) << turned.out << turned.err;
    EXPECT_NE(turned.out.find("x 0 to 1,"), std::string::npos) << turned.out << turned.err;
    expect_refused(folder, {"info", "naca:0012", "--transform", "all:rotate"}, usage,
                   "option --transform: 'all:rotate'");
}

TEST(Transform, ErrorsNameTheOptionOrThePlace) {
    const TemporaryFolder folder;
    const auto refused = [&](const std::string& text, int code, const std::string& said) {
        expect_refused(folder, {"mesh", "naca:0012", "-o", "a.su2", "--transform", text}, code, said);
    };
    refused("airfoil:rotate", usage, "option --transform: 'airfoil:rotate': a transformation is ELEMENT:scale:S");
    refused("airfoil:scale:-2", usage, "option --transform: 'airfoil:scale:-2': the factor must be > 0");
    refused("flap:mirror", usage, "option --transform: element 'flap' is not known (known: all, airfoil)");
    refused("airfoil:flap:20:1.5,0", bad_input, "the flap of 'airfoil' cannot be deflected about its hinge");
    refused("all:scale:1e80", bad_input, "coordinates outside the exact range");
    expect_refused(folder, {"mesh", "naca:0012", "-o", "a.su2", "--rotate", "5"}, usage, "--transform ELEMENT:rotate");
    folder.write("a.toml", "input = 'naca:0012'\ntransform = ['all:mirror', 'all:shift:1']\n");
    expect_refused(folder, {"mesh", "a.toml"}, usage,
                   "a.toml:2: transform: 'all:shift:1': '1': two coordinates X,Y belong here");
}

}  // namespace
}  // namespace lamina::test
