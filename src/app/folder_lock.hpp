// A folder that one process at a time works in.
#pragma once

#include <filesystem>

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

}  // namespace lamina::app
