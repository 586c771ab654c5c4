// Digits that change where the inputs of a run do.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

#include "app/case.hpp"
#include "app/report.hpp"

namespace lamina::app {

/// The hash of no text.
inline constexpr std::uint64_t no_text = 0xcbf29ce484222325u;
/// Adds the bytes of a text to a hash. Source: G. Fowler, L. C. Noll, K.-P. Vo, the FNV-1a hash (RFC 9923).
std::uint64_t hashed(std::uint64_t hash, std::string_view text);
/// Returns a hash as text.
std::string text_of(std::uint64_t hash);
/// Returns digits that change where an input does, or an option that changes the outcome of a run.
std::string fingerprint(MeshCase mesh_case);

/// Calls read() with what a command has recorded in a file of a folder, and returns true; false where there is no such
/// folder. `kind`: what the folder holds, "round" or "angle". Throws UsageError where the folder has no record, or one
/// with other digits ("fingerprint"), and InputError where read() does not find what it looks for.
bool read_record(const std::filesystem::path& file, const std::string& kind, const std::string& digits,
                 const std::function<void(const Json&)>& read);

}  // namespace lamina::app
