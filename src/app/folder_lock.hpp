// A folder that one process at a time works in.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace lamina::app {

/// Keeps other processes from a folder of rounds or angles. Throws UsageError where one works there.
class FolderLock {
public:
    explicit FolderLock(const std::filesystem::path& folder);
    ~FolderLock();
    FolderLock(const FolderLock&) = delete;
    FolderLock& operator=(const FolderLock&) = delete;

private:
    int file_;
};

/// Returns the paths of a folder whose names begin so, such as what killed processes have left.
std::vector<std::filesystem::path> entries_of(const std::filesystem::path& folder, const std::string& prefix);

}  // namespace lamina::app
