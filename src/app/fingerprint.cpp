#include "app/fingerprint.hpp"

#include <filesystem>
#include <system_error>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <lamina/error.hpp>
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

bool read_record(const std::filesystem::path& file, const std::string& kind, const std::string& digits,
                 const std::function<void(const Json&)>& read) {
    const std::filesystem::path folder = file.parent_path();
    std::error_code ignored;
    if (!std::filesystem::exists(folder, ignored)) return false;
    const auto refuse = [&](const std::string& reason) {
        throw UsageError(fmt::format("{}: {}: give another folder, or remove it", folder.string(), reason));
    };
    if (!std::filesystem::exists(file, ignored)) refuse(fmt::format("exists, and is no {} of this command", kind));
    const Json json = Json::parse(read_file(file), nullptr, false);
    try {
        if (json.at("fingerprint") != digits) refuse("was made with other options or inputs");
        read(json);
    } catch (const Json::exception&) {
        throw InputError({file.string(), 0, {}}, fmt::format("is no record of this {}", kind));
    }
    return true;
}

}  // namespace lamina::app
