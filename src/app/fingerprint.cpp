#include "app/fingerprint.hpp"

#include <filesystem>
#include <system_error>

#include <fmt/format.h>

#include <lamina/files.hpp>

#include "app/case_file.hpp"
#include "app/run_files.hpp"

namespace lamina::app {

std::uint64_t hashed(std::uint64_t hash, std::string_view text) {
    for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
    return hash;
}

std::string text_of(std::uint64_t hash) { return fmt::format("{:016x}", hash); }

std::string fingerprint(MeshCase mesh_case) {
    mesh_case.quiet = false;
    mesh_case.progress = ProgressShown::automatic;
    mesh_case.options.threads = 0;
    std::uint64_t hash = hashed(no_text, dump_case(mesh_case));
    for (const RunFile& file : files_of_case(mesh_case)) {
        std::error_code ignored;
        if (std::filesystem::is_regular_file(file.path, ignored)) hash = hashed(hash, read_file(file.path));
    }
    return text_of(hash);
}

}  // namespace lamina::app
