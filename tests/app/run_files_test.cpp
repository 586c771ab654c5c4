// No run replaces its own input, writes two outputs to one file, or leaves temporary files behind.
#include <signal.h>

#include <filesystem>
#include <map>

#include <gtest/gtest.h>

#include "app/program.hpp"

namespace lamina::test {
namespace {

namespace fs = std::filesystem;

/// Returns the contents of all files of a folder and of the folders in it, by their paths.
std::map<std::string, std::string> contents(const TemporaryFolder& folder) {
    std::map<std::string, std::string> contents;
    for (const auto& entry : fs::recursive_directory_iterator(folder.path()))
        if (entry.is_regular_file()) {
            const std::string name = fs::relative(entry.path(), folder.path()).string();
            contents[name] = folder.read(name);
        }
    return contents;
}

/// Expects a usage error that says this, and that no file of the folder changes.
void expect_untouched(const TemporaryFolder& folder, const std::vector<std::string>& arguments,
                      const std::string& said) {
    const auto before = contents(folder);
    expect_refused(folder, arguments, usage, said);
    EXPECT_EQ(contents(folder), before);
}

/// Writes an airfoil that `lamina mesh` reads.
void write_airfoil(const TemporaryFolder& folder, const std::string& name) {
    folder.write(name, "section\n1 0\n0.5 0.06\n0.1 0.04\n0 0\n0.1 -0.04\n0.5 -0.06\n1 0\n");
}

TEST(RunFiles, MeshNeverReplacesAnInput) {
    const TemporaryFolder folder;
    write_airfoil(folder, "a.dat");
    folder.write("case.toml", "input = 'a.dat'\n");
    fs::create_symlink("a.dat", folder / "link.dat");
    fs::create_hard_link(folder / "a.dat", folder / "hard.dat");
    fs::create_directory(folder / "sub");

    expect_untouched(folder, {"mesh", "a.dat", "-o", "a.dat", "--format", "su2"}, "would replace the input");
    expect_untouched(folder, {"mesh", "a.dat", "-o", "sub/../a.dat", "--format", "su2"}, "would replace the input");
    expect_untouched(folder, {"mesh", "a.dat", "-o", "link.dat", "--format", "su2"}, "would replace the input");
    expect_untouched(folder, {"mesh", "a.dat", "-o", "hard.dat", "--format", "su2"}, "would replace the input");
    expect_untouched(folder, {"mesh", "a.dat", "-o", "o.su2", "--report", "a.dat"}, "option --report");
    expect_untouched(folder, {"mesh", "a.dat", "-o", "o.su2", "--wall-data", "a.dat"}, "option --wall-data");
    expect_untouched(folder, {"mesh", "case.toml", "-o", "o.su2", "--report", "case.toml"}, "case.toml");
    expect_untouched(folder, {"mesh", "case.toml", "-o", "o.su2", "--report", "a.dat"}, "a.dat");
}

TEST(RunFiles, NoTwoOutputsAreOneFile) {
    const TemporaryFolder folder;
    const std::string by = "is written by option --output";
    expect_untouched(folder, {"mesh", "naca:0012", "-o", "o.su2", "--report", "o.su2"}, by);
    expect_untouched(folder, {"mesh", "naca:0012", "-o", "o.su2", "-o", "./o.su2"}, by);
    expect_untouched(folder, {"mesh", "naca:0012", "-o", "o.su2", "--wall-data", "o.su2"}, by);
    // Formats of several files: the .mapbc file of UGRID, the four files of Triangle.
    expect_untouched(folder, {"mesh", "naca:0012", "-o", "o.b8.ugrid", "-o", "o.lb8.ugrid"}, by);
    expect_untouched(folder, {"mesh", "naca:0012", "-o", "o.b8.ugrid", "--report", "o.mapbc"}, by);
    expect_untouched(folder, {"mesh", "naca:0012", "-o", "o.node", "-o", "o.ele"}, by);
}

// A polyMesh folder is replaced with all that is in it.
TEST(RunFiles, FoldersThatAreReplacedHoldNoInputs) {
    const TemporaryFolder folder;
    fs::create_directories(folder / "case/constant/polyMesh");
    write_airfoil(folder, "case/constant/polyMesh/a.dat");
    folder.write("case/constant/polyMesh/faces", "");
    expect_untouched(folder, {"mesh", "case/constant/polyMesh/a.dat", "-o", "case", "--format", "openfoam"},
                     "would replace the input");
}

TEST(RunFiles, DevicesMayBeNamedTwice) {
    const TemporaryFolder folder;
    const ProgramRun run = run_lamina(folder, {"mesh", "naca:0012:80", "--far-field", "4", "--quiet", "--format", "su2",
                                               "-o", "/dev/null", "-o", "/dev/null", "--report", "/dev/null"});
    EXPECT_EQ(run.exit_code, 0) << run.err;
}

TEST(RunFiles, OtherCommandsReplaceNoInputEither) {
    const TemporaryFolder folder;
    folder.write("a.node", "3 2 0 0\n1 0 0\n2 1 0\n3 0 1\n");
    folder.write("a.poly", "0 2 0 0\n3 0\n1 1 2\n2 2 3\n3 3 1\n0\n");
    expect_untouched(folder, {"delaunay", "a.node", "-o", "a"}, "a.node");
    expect_untouched(folder, {"delaunay", "a.poly", "-o", "a"}, "a.node");
    expect_untouched(folder, {"delaunay", "a.poly", "-o", "b", "--report", "a.node"}, "option --report");
    expect_untouched(folder, {"delaunay", "a.poly", "-o", "b", "--report", "b.ele"}, "is written by");

    const ProgramRun made =
        run_lamina(folder, {"mesh", "naca:0012:80", "--far-field", "4", "-o", "m.vtu", "-o", "n.node"});
    ASSERT_EQ(made.exit_code, 0) << made.err;
    expect_untouched(folder, {"convert", "m.vtu", "m.vtu"}, "would replace the input");
    expect_untouched(folder, {"convert", "n.node", "n.ele"}, "would replace the input");
    fs::create_symlink("m.vtu", folder / "m.png");
    expect_untouched(folder, {"plot", "m.vtu", "-o", "m.png"}, "would replace the input");

    write_airfoil(folder, "a.dat");
    folder.write("case.toml", "input = 'a.dat'\n");
    expect_untouched(folder, {"flow", "case.toml", "-o", "case.toml"}, "would replace the input");
    expect_untouched(folder, {"flow", "case.toml", "-o", "a.dat"}, "would replace the input");
}

// Formats that consist of several files: none of them may be replaced while the mesh is read.
TEST(RunFiles, NoFileOfAMeshIsReplaced) {
    const TemporaryFolder folder;
    const std::string poly_mesh = "case/constant/polyMesh", replaced = "would replace the input";
    const ProgramRun made = run_lamina(
        folder, {"mesh", "naca:0012:80", "--far-field", "4", "-o", "m.ugrid", "-o", "m.su2", "-o", poly_mesh});
    ASSERT_EQ(made.exit_code, 0) << made.err;
    for (const std::string& mesh : {poly_mesh, std::string("case")}) {
        expect_untouched(folder, {"convert", mesh, poly_mesh + "/points", "--format", "su2"}, replaced);
        expect_untouched(folder, {"plot", mesh, "-o", poly_mesh + "/points", "--format", "png"}, replaced);
    }
    EXPECT_EQ(run_lamina(folder, {"convert", "case", "case/m.su2"}).exit_code, 0);
    EXPECT_EQ(run_lamina(folder, {"convert", "case", "case/m.su2"}).exit_code, 0);  // a second time

    expect_untouched(folder, {"convert", "m.ugrid", "m.mapbc", "--format", "su2"}, replaced);
    fs::rename(folder / "m.ugrid", folder / "m.mesh");
    expect_untouched(folder, {"convert", "m.mesh", "m.mapbc", "--input-format", "ugrid", "--format", "su2"}, replaced);
}

// The folders above a polyMesh folder are created while it is written.
TEST(RunFiles, SignalsRemoveFoldersThatWereCreated) {
    const TemporaryFolder folder;
    const auto moment = [&] { return fs::exists(folder / "case/constant"); };
    EXPECT_EQ(interrupt_lamina(
                  folder,
                  {"mesh", "naca:0012", "--far-field", "4", "--far-size", "0.02", "--format", "openfoam", "-o", "case"},
                  SIGTERM, moment),
              SIGTERM);
    EXPECT_TRUE(folder.names().empty());
}

// While a mesh is being written its temporary files have hidden names.
TEST(RunFiles, SignalsLeaveNothingBehind) {
    const auto writing = [](const TemporaryFolder& folder) {
        for (const std::string& name : folder.names())
            if (name.starts_with(".")) return true;
        return false;
    };
    for (const char* output : {"o.msh", "o.node", "case"}) {
        for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
            const TemporaryFolder folder;
            std::vector<std::string> arguments{"mesh",       "naca:0012", "--far-field", "4",
                                               "--far-size", "0.02",      "-o",          output};
            if (output == std::string("case")) arguments.insert(arguments.end(), {"--format", "openfoam"});
            const bool in_folder = output == std::string("case");
            if (in_folder) {
                fs::create_directories(folder / "case/constant/polyMesh");
                folder.write("case/constant/polyMesh/faces", "an old mesh");
            }
            const auto moment = [&] {
                if (!in_folder) return writing(folder);
                for (const auto& entry : fs::directory_iterator(folder / "case/constant"))
                    if (entry.path().filename().string().starts_with(".")) return true;
                return false;
            };
            EXPECT_EQ(interrupt_lamina(folder, arguments, signal, moment), signal) << output;
            for (const auto& entry : fs::recursive_directory_iterator(folder.path()))
                EXPECT_FALSE(entry.path().filename().string().starts_with(".")) << entry.path();
            if (in_folder) {
                EXPECT_EQ(folder.read("case/constant/polyMesh/faces"), "an old mesh");
            }
        }
    }
}

}  // namespace
}  // namespace lamina::test
