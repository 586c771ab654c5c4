// A read-only file is not replaced, and a file without an end is not read.
#include <lamina/files.hpp>

#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>

#include <gtest/gtest.h>

#include <lamina/error.hpp>

#include "support/temporary_folder.hpp"

namespace lamina {
namespace {

// Permissions mean nothing to root, so the check runs in a process of its own that gives that right up.
TEST(CheckFolderWritable, RefusesReadOnlyFiles) {
    namespace fs = std::filesystem;
    const test::TemporaryFolder folder;
    const fs::path file = folder.write("old.su2", "an old mesh");
    fs::permissions(folder.path(), fs::perms::all);
    const auto refused = [&] {
        try {
            check_folder_writable(file);
        } catch (const IoError& error) {
            std::fputs(error.what(), stderr);
            return 5;
        }
        return 0;
    };
    const auto end_as_another_user = [&](fs::perms perms) {
        fs::permissions(file, perms);
        constexpr uid_t nobody = 65534;
        if (::getuid() == 0 && ::setuid(nobody) != 0) std::_Exit(1);
        std::_Exit(refused());
    };
    EXPECT_EXIT(end_as_another_user(fs::perms::owner_read | fs::perms::others_read), testing::ExitedWithCode(5),
                "cannot write: Permission denied");
    EXPECT_EXIT(end_as_another_user(fs::perms::all), testing::ExitedWithCode(0), "");
}

TEST(ReadFile, RefusesWhatIsTooLarge) {
    const test::TemporaryFolder folder;
    const std::string text(3'000'000, 'x');
    const std::filesystem::path file = folder.write("large.dat", text);
    EXPECT_EQ(read_file(file), text);
    EXPECT_EQ(read_file(file, text.size()), text);
    constexpr std::size_t mebibyte = 1 << 20;
    EXPECT_THROW(read_file(file, mebibyte), IoError);
    EXPECT_THROW(read_file("/dev/zero", mebibyte), IoError);
}

}  // namespace
}  // namespace lamina
