// Digits that change where the inputs of a run do.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "app/case.hpp"

namespace lamina::app {

/// The hash of no text.
inline constexpr std::uint64_t no_text = 0xcbf29ce484222325u;
/// Adds the bytes of a text to a hash. Source: G. Fowler, L. C. Noll, K.-P. Vo, the FNV-1a hash (RFC 9923).
std::uint64_t hashed(std::uint64_t hash, std::string_view text);
/// Returns a hash as text.
std::string text_of(std::uint64_t hash);
/// Returns digits that change where an input does, or an option that changes the outcome of a run.
std::string fingerprint(MeshCase mesh_case);

}  // namespace lamina::app
