// Memory and time stay in proportion to what an input is or announces, whatever it claims besides.
#include <sys/resource.h>
#include <sys/wait.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "app/program.hpp"

namespace lamina::test {
namespace {

constexpr int bad_input = 3;

std::string repeated(const std::string& text, std::size_t count) {
    std::string all;
    all.reserve(text.size() * count);
    for (std::size_t i = 0; i < count; ++i) all += text;
    return all;
}

/// Returns the address space in kB in which the program starts, and not in much less.
std::size_t room_to_start(const TemporaryFolder& folder) {
    std::size_t kilobytes = 16'000;
    while (kilobytes < 1'000'000 && run_lamina_in_memory(folder, {"version"}, kilobytes).exit_code != 0)
        kilobytes += 4'000;
    return kilobytes;
}

/// A VTU file of three points whose array of points is compressed and claims this many bytes.
std::string vtu_that_claims(std::uint64_t bytes, const std::string& block) {
    const std::uint64_t header[] = {1, bytes, 0, block.size()};
    std::string stored(sizeof header, '\0');
    std::memcpy(stored.data(), header, sizeof header);
    return "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\" "
           "compressor=\"vtkZLibDataCompressor\"><UnstructuredGrid><Piece NumberOfPoints=\"3\" NumberOfCells=\"1\">"
           "<Points><DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"appended\" offset=\"0\"/></Points>"
           "</Piece></UnstructuredGrid><AppendedData encoding=\"raw\">_" +
           stored + block + "</AppendedData></VTKFile>\n";
}

TEST(Bounds, MemoryOfReaders) {
    if (LAMINA_SANITIZED) GTEST_SKIP() << "sanitizers take terabytes of address space";
    const TemporaryFolder folder;
    const std::size_t start = room_to_start(folder);
    const std::string poly_count = "1000000000 2 0 0\n1 0 0\n";
    const struct {
        const char *command, *name;
        std::string content;
    } inputs[] = {
        {"info", "newlines.dat", repeated("\n", 1'250'000)},
        {"info", "words.dat", repeated("a\n", 625'000)},
        {"info", "comments.dat", repeated("a\n#\n", 300'000)},
        {"info", "one_line.dat", repeated("1 ", 1'250'000)},
        {"info", "points.dat", repeated("1 1\n", 325'000)},
        {"info", "letters.dat", repeated("a", 5'000'000)},
        {"info", "zigzag.dat", repeated("1 1\n1 2\n2 2\n", 100'000)},
        {"info", "three_columns.dat", repeated("1 1 1\n", 225'000)},
        {"info", "four_columns.dat", repeated("1 1 1 1\n", 175'000)},
        {"info", "six_columns.dat", repeated("1 1 1 1 1 1\n", 125'000)},
        {"info", "labels.dat", repeated("a 1 1\n", 225'000)},
        {"info", "lasting_labels.dat", repeated("a 1 1\na 1 2\na 2 2\nb 3 3\nb 3 4\nb 4 4\n", 37'500)},
        {"info", "remarks.dat", repeated("1 1 a\n", 225'000)},
        {"info", "notes.dat", "1 1\na\n" + repeated("1->2\n", 250'000)},
        {"info", "blank_lines.dat", repeated("1 1\n\n2 1\n\n2 2\n\n", 75'000)},
        {"info", "comment_lines.dat", repeated("1 1\n#\n2 1\n#\n2 2\n#\n", 75'000)},
        {"info", "titles.dat", repeated("1 1\na\n", 225'000)},
        {"info", "separators.dat", repeated("1 1\n999 999\n", 112'500)},
        {"info", "squares.dat", repeated("0 0\n9 0\n9 9\n0 9\n\n", 300'000)},
        {"info", "brackets.dat", repeated("(1,1),", 225'000)},
        {"info", "lines.dxf", "0\nSECTION\n2\nENTITIES\n" + repeated("0\nLINE\n", 175'000)},
        {"info", "arcs.dxf", "0\nSECTION\n2\nENTITIES\n" + repeated("0\nARC\n", 175'000)},
        {"info", "vertices.dxf", "0\nSECTION\n2\nENTITIES\n0\nPOLYLINE\n" + repeated("0\nVERTEX\n10\n1\n", 75'000)},
        {"info", "blocks.dxf", "0\nSECTION\n2\nBLOCKS\n" + repeated("0\nBLOCK\n2\na\n", 75'000)},
        {"info", "groups.dxf", "0\nSECTION\n2\nENTITIES\n0\nLINE\n" + repeated("1\n\n", 375'000)},
        {"info", "lines.svg", "<svg>" + repeated("<line/>", 150'000) + "</svg>"},
        {"info", "moves.svg", "<svg><path d='" + repeated("M0 0", 300'000) + "'/></svg>"},
        {"info", "steps.svg", "<svg><path d='M0 0h" + repeated("1 ", 500'000) + "'/></svg>"},
        {"info", "groups.svg", "<svg>" + repeated("<g></g>", 175'000) + "</svg>"},
        {"info", "names.svg", "<svg " + repeated("a='' ", 250'000) + "/>"},
        {"info", "records.stp", "ISO-10303-21;\nDATA;\n" + repeated("#1=A();\n", 150'000) + "ENDSEC;\n"},
        {"info", "lists.stp", "ISO-10303-21;\nDATA;\n#1=A(" + repeated("(),", 425'000) + "());\n"},
        {"info", "values.stp", "ISO-10303-21;\nDATA;\n#1=A(" + repeated("1,", 625'000) + "1);\n"},
        {"info", "brackets.stp", "ISO-10303-21;\nDATA;\n#1=A" + repeated("(", 1'250'000)},
        {"info", "lists.json", repeated("[", 1'250'000)},
        {"info", "points.json", "[" + repeated("[1,1],", 225'000) + "[1,1]]"},
        {"info", "points.geo", repeated("Point(1)={1,1};\n", 82'500)},
        {"check", "bomb.vtu", vtu_that_claims(std::uint64_t{1} << 31, std::string(4'000'000, 'x'))},
        {"check", "claim.vtu", vtu_that_claims(~std::uint64_t{0}, "x")},
        {"check", "count.su2", "NDIME= 2\nNELEM= 1000000000\n5 0 1 2 0\nNPOIN= 3\n"},
        {"check", "count.msh", "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n1000000000\n1 0 0 0\n"},
        {"check", "count.ugrid", "1000000000 1 0 0 0 0 0\n0 0 0\n"},
        {"check", "newlines.su2", repeated("\n", 1'250'000)},
        {"check", "newlines.msh", repeated("\n", 1'250'000)},
        {"check", "newlines.ugrid", repeated("\n", 1'250'000)},
        {"check", "newlines.vtu", repeated("\n", 1'250'000)},
        {"check", "tags.vtu", repeated("<a>", 425'000)},
        {"delaunay", "count.node", poly_count},
        {"delaunay", "count.poly", poly_count},
        {"check", "elements.ele", "1000000000 3 0\n1 1 2 3\n"},
        {"check", "elements.ele", "500000 3 0\n1 1 2 3\n" + repeated("\n", 1'000'000)},
        {"delaunay", "attributes.node", "3 2 1000000000 0\n1 0 0\n2 1 0\n3 0 1\n"},
        {"delaunay", "segments.poly", "3 2 0 0\n1 0 0\n2 1 0\n3 0 1\n1000000000 0\n1 1 2\n"},
        {"delaunay", "holes.poly", "3 2 0 0\n1 0 0\n2 1 0\n3 0 1\n0 0\n1000000000\n1 .2 .2\n"},
        {"delaunay", "regions.poly", "3 2 0 0\n1 0 0\n2 1 0\n3 0 1\n0 0\n0\n1000000000\n1 .2 .2 1\n"},
        {"delaunay", "newlines.node", repeated("\n", 1'250'000)},
        {"mesh", "newlines.toml", repeated("\n", 1'250'000)},
        {"mesh", "keys.toml", repeated("a.", 40'000) + "a = 1\n"},
        {"mesh", "header.toml", "[" + repeated("a.", 40'000) + "a]\n"},
        {"mesh", "quoted.toml", repeated("\"a\" . ", 40'000) + "a = 1\n"},
        {"mesh", "inline.toml", "x = {" + repeated("a.", 40'000) + "a = 1}\n"},
        {"mesh", "arrays.toml", "x = " + repeated("[", 40'000)},
        {"mesh", "behind_string.toml", "x = '''\n\"'''\n" + repeated("a.", 40'000) + "a = 1\n"}};
    folder.write("elements.node", "3 2 0 0\n1 0 0\n2 1 0\n3 0 1\n");
    for (const auto& input : inputs) {
        folder.write(input.name, input.content);
        const std::size_t room = start + 100'000 + 20 * input.content.size() / 1024;
        std::vector<std::string> words{input.command, input.name};
        if (words.front() == "delaunay") words.insert(words.end(), {"-o", "out"});
        if (words.front() == "mesh") words.insert(words.end(), {"-o", "out.su2"});
        const ProgramRun run = run_lamina_in_memory(folder, words, room);
        EXPECT_TRUE(run.exit_code == bad_input || run.exit_code == 2)
            << input.name << ": " << run.exit_code << ' ' << run.signal << ' ' << run.err;
        EXPECT_EQ(run.err.find("memory"), std::string::npos) << input.name << ": " << run.err;
    }
}

/// A file of a polyMesh.
std::string foam(const std::string& type, const std::string& contents, const std::string& format = "ascii") {
    return "FoamFile { format " + format + "; class " + type + "; }\n" + contents;
}

TEST(Bounds, MemoryOfPolyMeshes) {
    if (LAMINA_SANITIZED) GTEST_SKIP() << "sanitizers take terabytes of address space";
    const TemporaryFolder folder;
    const std::size_t start = room_to_start(folder);
    const std::string lie = "1000000000 (", padding = repeated(" ", 4'000'000);
    const struct {
        const char* name;
        std::string content;
    } files[] = {{"points", foam("vectorField", lie)},
                 {"points", foam("vectorField", lie, "binary")},
                 {"points", foam("vectorField", "4000000 ((0 0 0)" + padding)},
                 {"owner", foam("labelList", lie)},
                 {"owner", foam("labelList", lie, "binary")},
                 {"owner", foam("labelList", "4000000 (0" + padding)},
                 {"neighbour", foam("labelList", lie)},
                 {"boundary", foam("polyBoundaryMesh", lie)},
                 {"boundary", foam("polyBoundaryMesh", "4000000 (a{}" + padding)},
                 {"boundary", foam("polyBoundaryMesh", "1000000 (" + repeated("a{}", 1'000'000) + ")")},
                 {"faces", foam("faceList", lie)},
                 {"faces", foam("faceList", lie, "binary")},
                 {"faces", foam("faceList", "1 (4000000000(0 1 2))")}};
    std::filesystem::create_directory(folder / "polyMesh");
    for (const auto& [name, content] : files) {
        folder.write("polyMesh/points", foam("vectorField", "3 ((0 0 0) (1 0 0) (0 1 0))"));
        folder.write("polyMesh/owner", foam("labelList", "1 (0)"));
        folder.write("polyMesh/neighbour", foam("labelList", "0 ()"));
        folder.write("polyMesh/boundary", foam("polyBoundaryMesh", "1 (a { type empty; nFaces 1; startFace 0; })"));
        folder.write("polyMesh/faces", foam("faceList", "1 (3(0 1 2))"));
        folder.write(std::string("polyMesh/") + name, content);
        const std::size_t room = start + 100'000 + 20 * content.size() / 1024;
        const ProgramRun run = run_lamina_in_memory(folder, {"check", "polyMesh"}, room);
        EXPECT_EQ(run.exit_code, bad_input) << name << ": " << run.signal << ' ' << run.err;
        EXPECT_NE(run.err.find(name), std::string::npos) << run.err;
        EXPECT_EQ(run.err.find("memory"), std::string::npos) << name << ": " << run.err;
    }
}

/// Seconds of processor time of the programs that have ended.
double seconds_of_children() {
    rusage usage{};
    getrusage(RUSAGE_CHILDREN, &usage);
    return static_cast<double>(usage.ru_utime.tv_sec) + 1e-6 * static_cast<double>(usage.ru_utime.tv_usec);
}

/// A file of octagons side by side.
std::string octagons(std::size_t count) {
    constexpr std::size_t corners = 8, per_row = 64;
    constexpr double distance = 3, eighth = 0.78539816339744831;
    std::string text;
    for (std::size_t k = 0; k < count; ++k) {
        text += "octagon\n";
        for (std::size_t i = 0; i <= corners; ++i) {
            const double angle = eighth * static_cast<double>(i % corners);
            text += fmt::format("{:.6f} {:.6f}\n", distance * static_cast<double>(k % per_row) + std::cos(angle),
                                distance * static_cast<double>(k / per_row) + std::sin(angle));
        }
        text += '\n';
    }
    return text;
}

/// A spiral whose points stand alone between such lines. A short step follows each long one.
std::string spiral(std::size_t count, const std::string& line) {
    std::string text;
    for (std::size_t i = 0; i < count; ++i) {
        const double angle = 2.0 * static_cast<double>(i / 2) + (i % 2 == 0 ? 0 : 1e-4),
                     radius = 1 + static_cast<double>(i) / static_cast<double>(count);
        text += fmt::format("{:.6f} {:.6f}\n{}\n", radius * std::cos(angle), radius * std::sin(angle), line);
    }
    return text;
}

/// Expects the seconds that the program needs for `content(n)` to grow about as n does.
void expect_linear_time(std::size_t few, const std::function<std::string(std::size_t)>& content) {
    const TemporaryFolder folder;
    constexpr std::size_t times = 4;
    std::vector<double> seconds;
    for (const std::size_t count : {few, times * few}) {
        folder.write("many.dat", content(count));
        const double before = seconds_of_children();
        const int exit_code = run_lamina(folder, {"info", "many.dat"}).exit_code;
        EXPECT_TRUE(exit_code == 0 || exit_code == bad_input) << exit_code;
        seconds.push_back(seconds_of_children() - before);
    }
    constexpr double start_up = 0.1, allowance = 2;  // a quadratic step made it 16 times
    EXPECT_LT(seconds[1], allowance * times * (seconds[0] + start_up));
}

TEST(Bounds, TimeOfManyElements) { expect_linear_time(500, octagons); }

TEST(Bounds, TimeOfManyCountedElements) {
    expect_linear_time(5'000,
                       [](std::size_t n) { return repeated("3 3\n0 0\n.5 .1\n1 0\n\n0 0\n.5 -.1\n1 0\n\n", n); });
}

TEST(Bounds, TimeOfManyComments) {
    for (const std::string line : {"#", ""}) {
        SCOPED_TRACE(line);
        expect_linear_time(20'000, [&](std::size_t n) { return spiral(n, line); });
        expect_linear_time(
            50'000, [&](std::size_t n) { return repeated(fmt::format("1 1\n{0}\n2 1\n{0}\n2 2\n{0}\n", line), n); });
    }
}

}  // namespace
}  // namespace lamina::test
