// The memory that Linux leaves to this process: https://docs.kernel.org/filesystems/proc.html (meminfo) and
// https://docs.kernel.org/admin-guide/cgroup-v2.html (memory).
#include <lamina/limits.hpp>

#include <algorithm>
#include <fstream>
#include <optional>
#include <sstream>
#include <string>

namespace lamina::core {

namespace {

namespace fs = std::filesystem;

/// Returns the number behind a name in a file of lines "NAME VALUE" or "NAME: VALUE"; the first number of the file
/// where the name is empty.
std::optional<double> number_in(const fs::path& file, const std::string& name) {
    std::ifstream in(file);
    for (std::string line; std::getline(in, line);) {
        std::istringstream words(line);
        std::string word;
        if (!name.empty() && (!(words >> word) || word != name)) continue;
        if (double value = 0; words >> value) return value;
        return std::nullopt;  // "max": there is no limit
    }
    return std::nullopt;
}

/// The files in which one version of control groups keeps the memory of a group.
struct GroupFiles {
    const char* folder;         ///< of all groups
    const char* prefix;         ///< of the line in /proc/self/cgroup that names the group
    const char* limit;          ///< bytes allowed
    const char* usage;          ///< bytes used, the cache of files included
    const char* inactive_file;  ///< name in memory.stat of the cache that the system gives up on demand
};
constexpr GroupFiles group_files[] = {
    {"sys/fs/cgroup", "0::", "memory.max", "memory.current", "inactive_file"},
    {"sys/fs/cgroup/memory", "memory:", "memory.limit_in_bytes", "memory.usage_in_bytes", "total_inactive_file"},
};

/// Returns what a group leaves to the process; empty where it sets no limit.
std::optional<double> left_by_group(const fs::path& group, const GroupFiles& files) {
    const auto limit = number_in(group / files.limit, ""), usage = number_in(group / files.usage, "");
    if (!limit || !usage) return std::nullopt;
    return *limit - (*usage - number_in(group / "memory.stat", files.inactive_file).value_or(0));
}

/// Returns the path of the process's group below the folder of all groups.
fs::path group_of_process(const fs::path& root, const std::string& prefix) {
    std::ifstream in(root / "proc/self/cgroup");
    for (std::string line; std::getline(in, line);)
        if (const std::size_t at = line.find(prefix); at != std::string::npos)
            return fs::path(line.substr(at + prefix.size())).relative_path();
    return {};
}

}  // namespace

}  // namespace lamina::core

namespace lamina {

using namespace core;

std::optional<std::size_t> free_memory(const std::filesystem::path& root) {
    std::optional<double> left = number_in(root / "proc/meminfo", "MemAvailable:");
    if (left) *left *= 1024;
    const auto lower_to = [&](std::optional<double> bytes) {
        if (bytes) left = std::min(left.value_or(*bytes), *bytes);
    };
    for (const GroupFiles& files : group_files) {
        // The limits of a group hold for all groups inside it. In a container its own group may be the root.
        const fs::path all = root / files.folder;
        for (fs::path group = group_of_process(root, files.prefix); !group.empty(); group = group.parent_path())
            lower_to(left_by_group(all / group, files));
        lower_to(left_by_group(all, files));
    }
    if (!left) return std::nullopt;
    return static_cast<std::size_t>(std::max(*left, 0.0));
}

}  // namespace lamina
