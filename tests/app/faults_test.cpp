// Whatever fails or interrupts a run, it ends in one line or by the signal, with the documented exit code, and leaves
// nothing half-written.
#include <signal.h>
#include <sys/mount.h>

#include <array>
#include <filesystem>

#include <gtest/gtest.h>

#include "app/program.hpp"
#include "support/file_size_limit.hpp"

namespace lamina::test {
namespace {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;

constexpr int no_mesh = 4;

const Words mesh_to_all{"mesh", "naca:0012", "--far-field", "4",     "--far-size", "0.05",   "-o",         "o.su2",
                        "-o",   "o.vtu",     "-o",          "o.msh", "--report",   "o.json", "--progress", "always"};

Words with(Words words, const Words& more) {
    words.insert(words.end(), more.begin(), more.end());
    return words;
}

/// Returns the names in a folder that no run may leave: hidden names are those of temporary files.
std::vector<std::string> hidden_names(const TemporaryFolder& folder) {
    std::vector<std::string> hidden;
    for (const auto& entry : fs::recursive_directory_iterator(folder.path()))
        if (entry.path().filename().string().starts_with(".")) hidden.push_back(entry.path());
    return hidden;
}

/// Expects the last line of standard error, and no other, to be an error. Lines of progress may come before it.
void expect_one_error(const ProgramRun& run) {
    const std::string start = "lamina: error: ";
    const std::size_t at = run.err.find(start);
    ASSERT_NE(at, std::string::npos) << run.err;
    EXPECT_EQ(run.err.find(start, at + 1), std::string::npos) << run.err;
    EXPECT_EQ(run.err.find('\n', at), run.err.size() - 1) << run.err;
}

/// Expects a run to have failed like this, and to have left no file in the folder but `names`.
void expect_failed(const TemporaryFolder& folder, const ProgramRun& run, int exit_code,
                   const std::vector<std::string>& names) {
    EXPECT_EQ(run.exit_code, exit_code) << run.err;
    expect_one_error(run);
    EXPECT_EQ(folder.names(), names);
}

void write_square(const TemporaryFolder& folder) {
    folder.write("s.poly", "4 2 0 0\n1 0 0\n2 1 0\n3 1 1\n4 0 1\n4 0\n1 1 2\n2 2 3\n3 3 4\n4 4 1\n0\n");
}

TEST(Faults, AFullDisk) {
    const TemporaryFolder folder;
    write_square(folder);
    const Words refine{"delaunay", "s.poly", "-o", "o", "--min-angle", "25", "--max-area", "1e-4"};
    ASSERT_EQ(run_lamina(folder, {"mesh", "naca:0012:80", "--far-field", "4", "-o", "m.vtu"}).exit_code, 0);
    const auto before = folder.names();
    {
        const FileSizeLimit limit(50'000);
        expect_failed(folder, run_lamina(folder, mesh_to_all), io_failed, before);
        expect_failed(folder, run_lamina(folder, refine), io_failed, before);
        for (const char* name : {"o.su2", "o.vtu"}) {
            const Words stream{"mesh", "naca:0012:80", "--far-field", "4", "--stream", "-o", name};
            expect_failed(folder, run_lamina(folder, stream), io_failed, before);
        }
        expect_failed(folder, run_lamina(folder, {"convert", "m.vtu", "o.cgns"}), io_failed, before);
    }
    const FileSizeLimit limit(1'000);
    for (const char* picture : {"o.png", "o.svg", "o.pdf"})
        expect_failed(folder, run_lamina(folder, {"plot", "m.vtu", "-o", picture}), io_failed, before);
}

TEST(Faults, AFullFileSystem) {
    const TemporaryFolder folder;
    fs::create_directory(folder / "disk");
    if (mount("none", (folder / "disk").c_str(), "tmpfs", 0, "size=256k") != 0)
        GTEST_SKIP() << "only root may mount a file system";
    const auto is_empty = [&] { return fs::is_empty(folder / "disk"); };
    for (const char* name : {"o.su2", "o.vtu", "o.msh", "o.cgns", "o.node"}) {
        const std::string output = std::string("disk/") + name;
        expect_failed(folder, run_lamina(folder, {"mesh", "naca:0012", "--far-field", "4", "-o", output}), io_failed,
                      {"disk"});
        EXPECT_TRUE(is_empty()) << name;
    }
    const Words openfoam{"mesh", "naca:0012", "--far-field", "4", "-o", "disk/a/case", "--format", "openfoam"};
    expect_failed(folder, run_lamina(folder, openfoam), io_failed, {"disk"});
    EXPECT_TRUE(is_empty());
    for (const char* solver : {"openfoam", "su2"}) {
        const Words solve{"case", solver,          "naca:0012",  "--far-field", "4",
                          "-o",   "disk/a/b/case", "--reynolds", "1e6",         "--quiet"};
        expect_failed(folder, run_lamina(folder, solve), io_failed, {"disk"});
        EXPECT_TRUE(is_empty()) << solver;
    }
    EXPECT_EQ(umount2((folder / "disk").c_str(), MNT_DETACH), 0);
}

TEST(Faults, ADeviceThatIsFull) {
    const TemporaryFolder folder;
    const Words mesh{"mesh", "naca:0012:80", "--far-field", "4", "--format", "su2", "-o"};
    expect_failed(folder, run_lamina(folder, with(mesh, {"/dev/full"})), io_failed, {});
    expect_failed(folder, run_lamina(folder, with(mesh, {"/dev/null", "--report", "/dev/full"})), io_failed, {});
    expect_failed(folder, run_lamina(folder, with(mesh, {"/dev/null", "--wall-data", "/dev/full"})), io_failed, {});
}

// Nobody, root included, creates files in /proc.
TEST(Faults, AFolderThatTakesNoFiles) {
    const TemporaryFolder folder;
    const Words mesh{"mesh", "naca:0012:80", "--far-field", "4", "-o"};
    expect_failed(folder, run_lamina(folder, with(mesh, {"/proc/lamina.su2"})), io_failed, {});
    expect_failed(folder, run_lamina(folder, with(mesh, {"/proc/lamina", "--format", "openfoam"})), io_failed, {});
    expect_failed(folder, run_lamina(folder, with(mesh, {"/dev/null", "--format", "su2", "--report", "/proc/l.json"})),
                  io_failed, {});
}

TEST(Faults, AFolderThatVanishes) {
    for (const char* name : {"o.su2", "o.cgns", "o.node"}) {
        const TemporaryFolder folder;
        fs::create_directory(folder / "sub");
        const Words words{"mesh",       "naca:0012", "--far-field", "4",
                          "--progress", "always",    "-o",          std::string("sub/") + name};
        const ProgramRun run = run_lamina_and_act(folder, words, "lamina: layers", [&](int process) {
            kill(process, SIGSTOP);  // the removal comes before the writing on any machine
            fs::remove_all(folder / "sub");
            kill(process, SIGCONT);
        });
        expect_failed(folder, run, io_failed, {});
        EXPECT_NE(run.err.find(std::string("sub/") + name), std::string::npos) << run.err;
    }
}

TEST(Faults, SignalsAtEveryStage) {
    constexpr std::array signals{SIGINT, SIGTERM, SIGHUP};
    std::size_t next = 0;
    for (const std::string stage : {"geometry", "surface", "layers", "sizing", "decoupling",
                                    "layer triangulation and refinement", "assembly", "check", "writing"}) {
        const TemporaryFolder folder;
        const int signal = signals[next++ % signals.size()];
        const ProgramRun run = run_lamina_and_act(folder, mesh_to_all, "lamina: " + stage + "\n",
                                                  [&](int process) { kill(process, signal); });
        // A stage may be over before this program sees it begin; then the signal may come too late.
        EXPECT_TRUE(run.signal == signal || run.exit_code == 0) << stage << ' ' << run.signal << ' ' << run.err;
        EXPECT_TRUE(hidden_names(folder).empty()) << stage;
        EXPECT_EQ(run.err.find("error"), std::string::npos) << run.err;
    }
}

// A signal may also arrive when the last file has just got its name.
TEST(Faults, SignalsAtTheEnd) {
    const TemporaryFolder source;
    ASSERT_EQ(run_lamina(source, {"mesh", "naca:0012:80", "--far-field", "4", "-o", "m.vtu"}).exit_code, 0);
    write_square(source);
    const std::string mesh = source / "m.vtu", square = source / "s.poly";
    const Words runs[] = {{"convert", mesh, "o.su2"},
                          {"convert", mesh, "o.cgns"},
                          {"convert", mesh, "o", "--format", "openfoam"},
                          {"plot", mesh, "-o", "o.svg"},
                          {"delaunay", square, "-o", "o", "--min-angle", "25", "--max-area", "1e-4"}};
    for (const Words& words : runs)
        for (int repeat = 0; repeat < 4; ++repeat) {
            const TemporaryFolder folder;
            // The temporary file appears first, and then the file itself.
            const std::size_t wanted = static_cast<std::size_t>(repeat) % 2;
            const auto moment = [&] {
                const auto names = folder.names();
                return !names.empty() && (wanted == 0 || names.back().starts_with("o"));
            };
            const int ended_by = interrupt_lamina(folder, words, SIGTERM, moment);
            EXPECT_TRUE(ended_by == SIGTERM || ended_by == 0) << words.front() << ' ' << ended_by;
            EXPECT_TRUE(hidden_names(folder).empty()) << words.front();
        }
}

// The libraries alone take most of the address space, and their loader has messages of its own; hence the smallest
// space in which the program starts is found first.
TEST(Faults, TooLittleMemory) {
    if (LAMINA_SANITIZED) GTEST_SKIP() << "sanitizers take terabytes of address space";
    const TemporaryFolder source;
    ASSERT_EQ(run_lamina(source, {"mesh", "naca:0012:80", "--far-field", "4", "-o", "m.vtu"}).exit_code, 0);
    write_square(source);
    const std::string mesh = source / "m.vtu", square = source / "s.poly";
    std::size_t start = 16'000;
    while (run_lamina_in_memory(source, {"version"}, start).exit_code != 0) {
        start += 1'000;
        ASSERT_LT(start, 1'000'000u);
    }
    const Words runs[] = {{"mesh", "naca:0012:80", "--far-field", "4", "--threads", "5", "--quiet", "-o", "o.vtu"},
                          {"delaunay", square, "-o", "o", "--min-angle", "25", "--max-area", "1e-4"},
                          {"check", mesh},
                          {"convert", mesh, "o.su2"}};
    for (const Words& words : runs)
        for (const std::size_t more : {0, 1'000, 2'000, 4'000, 8'000, 14'000, 20'000, 1'000'000}) {
            const TemporaryFolder folder;
            const ProgramRun run = run_lamina_in_memory(folder, words, start + more);
            EXPECT_TRUE(hidden_names(folder).empty());
            if (more == 1'000'000) {
                EXPECT_EQ(run.exit_code, 0) << run.err;
            }
            if (run.exit_code != 0) expect_failed(folder, run, no_mesh, {});
        }
}

}  // namespace
}  // namespace lamina::test
