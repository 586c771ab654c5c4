// lamina convert, and the promises of every format on the command line.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

#include <lamina/io.hpp>

#include "app/program.hpp"
#include "support/file_size_limit.hpp"
#include "support/sample_meshes.hpp"

namespace lamina {
namespace {

using test::annulus;
using test::expect_refused;
using test::FileSizeLimit;
using test::run_lamina;
using test::TemporaryFolder;

std::string file_name(const MeshFormat& format) {
    const std::string extension = format.extensions.front();
    return extension.starts_with('.') ? "m" + extension : extension;
}

TEST(Convert, AnyFormatToAnyOther) {
    const TemporaryFolder folder;
    const Mesh mesh = annulus();
    write_mesh(mesh, folder / "first.vtu");
    std::string last = "first.vtu";
    int step = 0;
    for (const MeshFormat& format : mesh_formats()) {
        if (!format.readable) continue;
        const std::string name = std::to_string(step++);
        std::filesystem::create_directory(folder / name);
        const std::string next = name + "/" + file_name(format);
        const auto run = run_lamina(folder, {"convert", last, next, "--format", format.name, "--wall", "wall"});
        ASSERT_EQ(run.exit_code, 0) << format.name << ": " << run.err;
        EXPECT_EQ(run.out + run.err, "");
        const Mesh back = read_mesh(folder / next);
        EXPECT_EQ(mesh_hash(back), mesh_hash(mesh)) << format.name;
        last = next;
    }
}

TEST(Convert, SetsKinds) {
    const TemporaryFolder folder;
    Mesh mesh = annulus();
    mesh.markers[0] = {"body", MarkerKind::other, mesh.markers[0].edges};
    mesh.markers[1] = {"outside", MarkerKind::other, mesh.markers[1].edges};
    write_mesh(mesh, folder / "m.su2");
    ASSERT_EQ(run_lamina(folder, {"convert", "m.su2", "m.vtu", "--wall", "body", "--far", "outside"}).exit_code, 0);
    EXPECT_EQ(read_mesh(folder / "m.vtu").markers[0].kind, MarkerKind::wall);
    EXPECT_EQ(read_mesh(folder / "m.vtu").markers[1].kind, MarkerKind::far_field);
    ASSERT_EQ(run_lamina(folder, {"convert", "m.su2", "m.vtu", "--symmetry-marker", "outside"}).exit_code, 0);
    EXPECT_EQ(read_mesh(folder / "m.vtu").markers[1].kind, MarkerKind::symmetry);
}

// Names come from other programs, and must suit those that read the file next.
/// Returns the last point of a polyMesh.
std::string last_point(const TemporaryFolder& folder, const std::string& name) {
    const std::string points = folder.read(name + "/constant/polyMesh/points");
    const std::size_t begin = points.rfind("\n(") + 1;
    return points.substr(begin, points.find('\n', begin) - begin);
}

TEST(Convert, MakesMeshesInSpace) {
    const TemporaryFolder folder;
    write_mesh(annulus(), folder / "m.su2");
    auto run = run_lamina(folder, {"convert", "m.su2", "c", "--format", "openfoam", "--span", "0.25", "--span-cells",
                                   "3", "--span-ends", "periodic"});
    ASSERT_EQ(run.exit_code, 0) << run.err;
    EXPECT_TRUE(last_point(folder, "c").ends_with(" 0.25)")) << last_point(folder, "c");
    EXPECT_NE(folder.read("c/constant/polyMesh/boundary").find("cyclic;"), std::string::npos);
    expect_refused(folder, {"convert", "m.su2", "n.su2", "--span", "1"}, 2, "holds plane meshes");
    expect_refused(folder, {"convert", "m.su2", "n.vtu", "--span-cells", "2"}, 2, "need the span");
    expect_refused(folder, {"convert", "m.su2", "n.vtu", "--span", "-1"}, 2, "--span: must be > 0, not -1");
    expect_refused(folder, {"mesh", "naca:0012:40", "-o", "n.vtu", "--stream", "--span", "1"}, 2, "span");

    // In chords, which --chord says.
    run = run_lamina(folder, {"mesh", "naca:0012:40", "--no-layers", "--far-field", "5", "--quiet", "--chord", "2",
                              "--span", "0.25", "--format", "openfoam", "-o", "d"});
    ASSERT_EQ(run.exit_code, 0) << run.err;
    EXPECT_TRUE(last_point(folder, "d").ends_with(" 0.5)")) << last_point(folder, "d");
}

TEST(Convert, GivesMarkersNamesThatEveryFormatTakes) {
    const TemporaryFolder folder;
    Mesh mesh = annulus();
    mesh.markers[0].name = "1 left wall";
    mesh.markers[1] = {"2", MarkerKind::other, mesh.markers[1].edges};
    write_mesh(mesh, folder / "m.vtu");
    for (const MeshFormat& format : mesh_formats()) {
        if (!format.readable) continue;
        std::filesystem::create_directory(folder / format.name);
        const std::string out = format.name + "/" + file_name(format);
        const auto run = run_lamina(folder, {"convert", "m.vtu", out, "--format", format.name, "--far", "2"});
        ASSERT_EQ(run.exit_code, 0) << run.err;
        EXPECT_EQ(run.err,
                  "lamina: warning: the name '1 left wall' does not begin with a letter: the marker is "
                  "'wall_1_left_wall'\n"
                  "lamina: warning: the name '2' does not begin with a letter: the marker is 'far_2'\n");
        const Mesh back = read_mesh(folder / out, {.format = format.name});
        EXPECT_EQ(back.markers[0].name, "wall_1_left_wall") << format.name;
        EXPECT_EQ(back.markers[1].name, "far_2") << format.name;
        EXPECT_EQ(back.markers[1].kind, MarkerKind::far_field) << format.name;
        // Markers are found by either name.
        for (const char* name : {"wall_1_left_wall", "1 left wall"})
            EXPECT_EQ(run_lamina(folder, {"check", out, "--input-format", format.name, "--wall", name}).exit_code, 0)
                << format.name << " " << name;
    }
}

TEST(Convert, Refuses) {
    const TemporaryFolder folder;
    write_mesh(annulus(), folder / "m.su2");
    folder.write("broken.su2", "NDIME= 2\nNELEM= many\n");
    expect_refused(folder, {"convert", "m.su2"}, 2, "OUT");
    expect_refused(folder, {"convert", "m.su2", "m.xyz"}, 2, "m.xyz");
    expect_refused(folder, {"convert", "m.su2", "m.vtu", "--format", "xyz"}, 2, "'xyz'");
    expect_refused(folder, {"convert", "m.su2", "m.vtu", "--wall", "tail"}, 3, "no marker 'tail'");
    expect_refused(folder, {"convert", "broken.su2", "m.vtu"}, 3, "broken.su2:2:");
    expect_refused(folder, {"convert", "none.su2", "m.vtu"}, 5, "none.su2");
    expect_refused(folder, {"convert", "m.su2", "none/m.vtu"}, 5, "none/m.vtu");
}

TEST(Convert, ADiskThatIsFullLeavesNothingBehind) {
    const TemporaryFolder folder;
    write_mesh(annulus({.around = 400, .rings = 50}), folder / "in.vtu");
    for (const MeshFormat& format : mesh_formats()) {
        std::filesystem::create_directory(folder / format.name);
        const std::string out = format.name + "/" + file_name(format);
        {
            const FileSizeLimit limit(100'000);
            expect_refused(folder, {"convert", "in.vtu", out, "--format", format.name}, 5, "cannot write");
        }
        EXPECT_TRUE(std::filesystem::is_empty(folder / format.name)) << format.name;
        // A mesh that was there before stays.
        ASSERT_EQ(run_lamina(folder, {"convert", "in.vtu", out, "--format", format.name}).exit_code, 0);
        {
            const FileSizeLimit limit(100'000);
            expect_refused(folder, {"convert", "in.vtu", out, "--format", format.name}, 5, "cannot write");
        }
        if (!format.readable) continue;
        EXPECT_EQ(mesh_hash(read_mesh(folder / out)), mesh_hash(read_mesh(folder / "in.vtu")));
    }
}

TEST(Convert, WritesToADevice) {
    const TemporaryFolder folder;
    write_mesh(annulus(), folder / "m.su2");
    expect_refused(folder, {"convert", "m.su2", "/dev/full", "--format", "su2"}, 5, "No space left");
    EXPECT_EQ(run_lamina(folder, {"convert", "m.su2", "/dev/null", "--format", "msh"}).exit_code, 0);
    EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));
    const auto run = run_lamina(folder, {"convert", "m.su2", "/dev/stdout", "--format", "su2"});
    EXPECT_EQ(run.exit_code, 0) << run.err;
    EXPECT_TRUE(run.out.starts_with("NDIME= 2"));
}

TEST(Convert, FollowsLinks) {
    const TemporaryFolder folder;
    write_mesh(annulus(), folder / "m.su2");
    std::filesystem::create_symlink("real.vtu", folder / "link.vtu");
    ASSERT_EQ(run_lamina(folder, {"convert", "m.su2", "link.vtu"}).exit_code, 0);
    EXPECT_TRUE(std::filesystem::is_symlink(folder / "link.vtu"));
    EXPECT_EQ(mesh_hash(read_mesh(folder / "real.vtu")), mesh_hash(annulus()));
}

TEST(Formats, HelpAndReferenceListThemAll) {
    const TemporaryFolder folder;
    std::ifstream in(std::string(LAMINA_SOURCE_DIR) + "/docs/reference/formats.md");
    std::stringstream page;
    page << in.rdbuf();
    const std::string mesh_help = run_lamina(folder, {"mesh", "--help"}).out,
                      convert_help = run_lamina(folder, {"convert", "--help"}).out;
    for (const MeshFormat& format : mesh_formats()) {
        std::string extensions;
        for (const std::string& extension : format.extensions)
            extensions += (extensions.empty() ? "`" : ", `") + extension + "`";
        const std::string row = "| `" + format.name + "` | " + extensions + " | " + format.description + " |";
        EXPECT_NE(page.str().find(row), std::string::npos) << row;
        for (const std::string& help : {mesh_help, convert_help})
            EXPECT_NE(help.find(format.description), std::string::npos) << format.name;
    }
}

TEST(Parts, AreRefusedWhereNoFileHasAny) {
    const TemporaryFolder folder;
    const std::vector<std::string> mesh{"mesh", "naca:0012", "--no-layers", "--far-field",
                                        "3",    "--quiet",   "--parts",     "2"};
    auto with_outputs = [&](std::vector<std::string> words, const std::vector<std::string>& outputs) {
        for (const std::string& output : outputs) words.insert(words.end(), {"-o", output});
        return words;
    };
    expect_refused(folder, with_outputs(mesh, {"m.su2"}), test::usage, "--parts");
    EXPECT_EQ(run_lamina(folder, with_outputs(mesh, {"m.su2", "m.pvtu"})).exit_code, 0) << "the first stays whole";
    EXPECT_EQ(folder.names(), (std::vector<std::string>{"m.pvtu", "m.su2", "m_0.vtu", "m_1.vtu"}));
    expect_refused(folder, {"convert", "m.su2", "n.vtu", "--parts", "2"}, test::usage, "--parts");
    EXPECT_EQ(run_lamina(folder, {"convert", "m.su2", "n.pvtu", "--parts", "2"}).exit_code, 0);
}

}  // namespace
}  // namespace lamina
