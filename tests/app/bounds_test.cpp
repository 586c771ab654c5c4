// Memory and time stay in proportion to what an input is or announces, whatever it claims besides.
#include <sys/resource.h>
#include <sys/wait.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <string>

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
    } inputs[] = {{"info", "newlines.dat", repeated("\n", 5'000'000)},
                  {"info", "words.dat", repeated("a\n", 2'500'000)},
                  {"info", "comments.dat", repeated("a\n#\n", 1'200'000)},
                  {"info", "one_line.dat", repeated("1 ", 5'000'000)},
                  {"info", "points.dat", repeated("1 1\n", 1'300'000)},
                  {"info", "letters.dat", repeated("a", 20'000'000)},
                  {"check", "bomb.vtu", vtu_that_claims(std::uint64_t{1} << 31, std::string(4'000'000, 'x'))},
                  {"check", "claim.vtu", vtu_that_claims(~std::uint64_t{0}, "x")},
                  {"check", "count.su2", "NDIME= 2\nNELEM= 1000000000\n5 0 1 2 0\nNPOIN= 3\n"},
                  {"check", "count.msh", "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n1000000000\n1 0 0 0\n"},
                  {"check", "count.ugrid", "1000000000 1 0 0 0 0 0\n0 0 0\n"},
                  {"check", "newlines.su2", repeated("\n", 5'000'000)},
                  {"check", "newlines.msh", repeated("\n", 5'000'000)},
                  {"check", "newlines.ugrid", repeated("\n", 5'000'000)},
                  {"check", "newlines.vtu", repeated("\n", 5'000'000)},
                  {"check", "tags.vtu", repeated("<a>", 1'700'000)},
                  {"delaunay", "count.node", poly_count},
                  {"delaunay", "count.poly", poly_count},
                  {"delaunay", "newlines.node", repeated("\n", 5'000'000)},
                  {"mesh", "newlines.toml", repeated("\n", 5'000'000)},
                  {"mesh", "keys.toml", repeated("a.", 40'000) + "a = 1\n"},
                  {"mesh", "header.toml", "[" + repeated("a.", 40'000) + "a]\n"},
                  {"mesh", "quoted.toml", repeated("\"a\" . ", 40'000) + "a = 1\n"},
                  {"mesh", "inline.toml", "x = {" + repeated("a.", 40'000) + "a = 1}\n"},
                  {"mesh", "arrays.toml", "x = " + repeated("[", 40'000)},
                  {"mesh", "behind_string.toml", "x = '''\n\"'''\n" + repeated("a.", 40'000) + "a = 1\n"}};
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

TEST(Bounds, TimeOfManyElements) {
    const TemporaryFolder folder;
    constexpr std::size_t few = 500, times = 4;
    std::vector<double> seconds;
    for (const std::size_t count : {few, times * few}) {
        folder.write("many.dat", octagons(count));
        const double before = seconds_of_children();
        EXPECT_EQ(run_lamina(folder, {"info", "many.dat"}).exit_code, 0);
        seconds.push_back(seconds_of_children() - before);
    }
    constexpr double start_up = 0.1, allowance = 2;  // a quadratic step made it 16 times
    EXPECT_LT(seconds[1], allowance * times * (seconds[0] + start_up));
}

}  // namespace
}  // namespace lamina::test
