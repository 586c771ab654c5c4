// The memory that the system leaves to the process, from files like those of Linux.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include <lamina/limits.hpp>
#include <lamina/warning.hpp>

#include "support/temporary_folder.hpp"

namespace lamina::test {
namespace {

class FreeMemory : public testing::Test {
protected:
    void write(const std::string& file, const std::string& text) {
        std::filesystem::create_directories((root_ / file).parent_path());
        root_.write(file, text);
    }
    std::optional<std::size_t> free() const { return free_memory(root_.path()); }

private:
    TemporaryFolder root_;
};

TEST_F(FreeMemory, IsUnknownWhereTheSystemTellsNothing) { EXPECT_EQ(free(), std::nullopt); }

TEST_F(FreeMemory, IsWhatTheSystemHasAvailable) {
    write("proc/meminfo", "MemTotal:       24000000 kB\nMemFree:   1 kB\nMemAvailable:   20000000 kB\n");
    EXPECT_EQ(free(), std::size_t{20'000'000} * 1024);
}

TEST_F(FreeMemory, IsWhatTheGroupsLeaveIfThatIsLess) {
    write("proc/meminfo", "MemAvailable:   20000000 kB\n");
    write("proc/self/cgroup", "0::/user/job\n");
    write("sys/fs/cgroup/user/job/memory.max", "max\n");
    write("sys/fs/cgroup/user/job/memory.current", "1000000\n");
    EXPECT_EQ(free(), std::size_t{20'000'000} * 1024) << "a group without a limit";
    write("sys/fs/cgroup/user/memory.max", "8000000\n");
    write("sys/fs/cgroup/user/memory.current", "3000000\n");
    EXPECT_EQ(free(), 5'000'000u) << "the limit of an outer group holds for the inner one";
    write("sys/fs/cgroup/user/memory.stat", "anon 2000000\ninactive_file 1000000\n");
    EXPECT_EQ(free(), 6'000'000u) << "the system gives up its cache on demand";
    write("sys/fs/cgroup/user/memory.current", "9500000\n");
    EXPECT_EQ(free(), 0u);
}

TEST_F(FreeMemory, KnowsGroupsOfTheFirstVersion) {
    write("proc/meminfo", "MemAvailable:   20000000 kB\n");
    write("proc/self/cgroup", "5:cpu:/x\n4:memory:/docker/1\n");
    write("sys/fs/cgroup/memory/docker/1/memory.limit_in_bytes", "4000000\n");
    write("sys/fs/cgroup/memory/docker/1/memory.usage_in_bytes", "1500000\n");
    EXPECT_EQ(free(), 2'500'000u);
}

TEST(WarningNames, AreThoseOfTheGuide) {
    EXPECT_EQ(warning_name(WarningCode::first_layer_lost), "first_layer_lost");
    EXPECT_EQ(warning_name(WarningCode::swapped_columns), "swapped_columns");
}

}  // namespace
}  // namespace lamina::test
