// Files appear as a whole or not at all, whoever else writes them, and whoever is killed meanwhile.
#include "core/atomic_file.hpp"

#include <signal.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include <lamina/files.hpp>

#include "support/temporary_folder.hpp"

namespace lamina::core {
namespace {

namespace fs = std::filesystem;
using test::TemporaryFolder;

void write_text(const fs::path& file, const std::string& text) { std::ofstream(file) << text; }

mode_t mode_of(const fs::path& file) {
    struct stat status {};
    EXPECT_EQ(::stat(file.c_str(), &status), 0) << file;
    return status.st_mode & 0777;
}

/// Starts a process that writes to `target` and stands still while it does so. Returns its number once it stands.
pid_t write_and_stand(const fs::path& target, bool folder) {
    std::array<int, 2> pipe{};
    EXPECT_EQ(::pipe(pipe.data()), 0);
    const pid_t process = ::fork();
    if (process == 0) {
        const auto stand = [&](const fs::path& temporary) {
            write_text(folder ? temporary / "part" : temporary, "half of it");
            EXPECT_EQ(::write(pipe[1], "s", 1), 1);
            for (;;) ::pause();
        };
        folder ? write_folder_atomically(target, stand) : write_atomically(target, stand);
    }
    char stands = 0;
    EXPECT_EQ(::read(pipe[0], &stands, 1), 1);
    ::close(pipe[0]);
    ::close(pipe[1]);
    return process;
}

void kill_process(pid_t process) {
    ::kill(process, SIGKILL);
    EXPECT_EQ(::waitpid(process, nullptr, 0), process);
}

TEST(AtomicFile, KeepsPermissions) {
    const TemporaryFolder folder;
    const mode_t mask = ::umask(022);
    write_file(folder / "new", "text");
    EXPECT_EQ(mode_of(folder / "new"), 0644u);
    for (const mode_t mode : {0600u, 0640u, 0664u, 0755u}) {
        ASSERT_EQ(::chmod((folder / "new").c_str(), mode), 0);
        write_file(folder / "new", "another text");
        EXPECT_EQ(mode_of(folder / "new"), mode);
    }
    const auto write_parts = [](const fs::path& made) {
        write_text(made / "a", "1");
        write_text(made / "b", "2");
    };
    write_folder_atomically(folder / "parts", write_parts);
    ASSERT_EQ(::chmod((folder / "parts" / "a").c_str(), 0600), 0);
    ASSERT_EQ(::chmod((folder / "parts").c_str(), 0700), 0);
    write_folder_atomically(folder / "parts", write_parts);
    EXPECT_EQ(mode_of(folder / "parts"), 0700u);
    EXPECT_EQ(mode_of(folder / "parts" / "a"), 0600u);
    EXPECT_EQ(mode_of(folder / "parts" / "b"), 0644u);
    ::umask(mask);
}

TEST(AtomicFile, KeepsOwnersWhereItMay) {
    if (::getuid() != 0) GTEST_SKIP() << "only root may give files away";
    const TemporaryFolder folder;
    constexpr uid_t nobody = 65534;
    const fs::path file = folder.write("a", "old");
    ASSERT_EQ(::chown(file.c_str(), nobody, nobody), 0);
    write_file(file, "new");
    struct stat status {};
    ASSERT_EQ(::stat(file.c_str(), &status), 0);
    EXPECT_EQ(status.st_uid, nobody);
    EXPECT_EQ(status.st_gid, nobody);
}

TEST(AtomicFile, TakesTheLongestNames) {
    const TemporaryFolder folder;
    for (const std::size_t length : {248, 250, 255}) {
        const std::string name = std::string(length - 4, 'n') + ".su2";
        write_file(folder / name, "text");
        EXPECT_EQ(read_file(folder / name), "text");
        write_folder_atomically(folder / std::string(length, 'f'),
                                [](const fs::path& made) { write_text(made / "a", "1"); });
        EXPECT_EQ(read_file(fs::path(folder / std::string(length, 'f')) / "a"), "1");
    }
    EXPECT_EQ(folder.names().size(), 6u);
}

TEST(AtomicFile, ReplacesWhatALinkStandsFor) {
    const TemporaryFolder folder;
    fs::create_directory(folder / "sub");
    fs::create_symlink("sub/real", folder / "link");
    write_file(folder / "link", "text");
    EXPECT_TRUE(fs::is_symlink(folder / "link"));
    EXPECT_EQ(read_file(fs::path(folder / "sub") / "real"), "text");
}

// Nothing that lies in a folder beforehand is written to, whatever its name.
TEST(AtomicFile, WritesIntoAFolderOfItsOwn) {
    const TemporaryFolder folder;
    write_atomically(folder / "out", [&](const fs::path& temporary) {
        EXPECT_EQ(mode_of(temporary.parent_path()), 0700u);
        EXPECT_TRUE(fs::is_empty(temporary.parent_path()));
        write_text(temporary, "text");
        write_file(folder / "out", "text of another run that is faster");
    });
    EXPECT_EQ(read_file(folder / "out"), "text");
    EXPECT_EQ(folder.names(), std::vector<std::string>{"out"});
}

TEST(AtomicFile, ClearsWhatKilledProcessesLeave) {
    for (const bool is_folder : {false, true}) {
        const TemporaryFolder folder;
        const pid_t living = write_and_stand(folder / "a", is_folder), dead = write_and_stand(folder / "a", is_folder);
        kill_process(dead);
        EXPECT_EQ(folder.names().size(), 2u);
        write_file(folder / "b", "text");
        EXPECT_EQ(folder.names().size(), 2u) << "one of the process that lives, and the file";
        kill_process(living);
        write_file(folder / "b", "text");
        EXPECT_EQ(folder.names(), std::vector<std::string>{"b"});
    }
}

// A process was killed between the two steps that exchange a folder where the file system cannot exchange it at once.
TEST(AtomicFile, GivesAnOldFolderItsNameBack) {
    const TemporaryFolder folder;
    kill_process(write_and_stand(folder / "mesh", true));
    ASSERT_EQ(folder.names().size(), 1u);
    fs::create_directories(fs::path(folder / folder.names().front()) / "old" / "mesh");
    write_text(fs::path(folder / folder.names().front()) / "old" / "mesh" / "part", "old");
    write_file(folder / "b", "text");
    EXPECT_EQ(folder.names(), (std::vector<std::string>{"b", "mesh"}));
    EXPECT_EQ(read_file(fs::path(folder / "mesh") / "part"), "old");
}

TEST(AtomicFile, LeavesWhatMayBeThatOfOtherMachines) {
    const TemporaryFolder folder;
    const std::string name = ".lamina-0123456789ab-00000000-01234567";
    fs::create_directory(folder / name);
    folder.write(".lamina-file", "text");
    write_file(folder / "b", "text");
    EXPECT_EQ(folder.names(), (std::vector<std::string>{name, ".lamina-file", "b"}));
}

// Of several that write the same files at once, all files are those of one of them.
TEST(AtomicFile, TheLastWriterWinsWhole) {
    const TemporaryFolder folder;
    const std::vector<fs::path> set{folder / "m.node", folder / "m.ele", folder / "m.poly"};
    constexpr int rounds = 40, writers = 3;
    for (int round = 0; round < rounds; ++round) {
        std::vector<std::thread> threads;
        for (int writer = 0; writer < writers; ++writer)
            threads.emplace_back([&, writer] {
                const std::string text(10'000, static_cast<char>('a' + writer));
                write_files_atomically(set, [&](std::span<const fs::path> temporaries) {
                    for (const fs::path& temporary : temporaries) write_text(temporary, text);
                });
                write_folder_atomically(folder / "parts", [&](const fs::path& made) {
                    for (const char* part : {"points", "faces", "owner"}) write_text(made / part, text);
                });
            });
        for (std::thread& thread : threads) thread.join();
        const std::string first = read_file(set[0]), points = read_file(fs::path(folder / "parts") / "points");
        EXPECT_EQ(first, std::string(10'000, first.front()));
        for (const fs::path& file : set) EXPECT_EQ(read_file(file), first);
        for (const char* part : {"faces", "owner"}) EXPECT_EQ(read_file(fs::path(folder / "parts") / part), points);
    }
    EXPECT_EQ(folder.names(), (std::vector<std::string>{"m.ele", "m.node", "m.poly", "parts"}));
}

}  // namespace
}  // namespace lamina::core
