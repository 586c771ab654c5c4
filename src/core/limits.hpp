// Limits and costs that users of the library need not know.
#pragma once

#include <cstddef>
#include <string>

#include <lamina/export.hpp>
#include <lamina/limits.hpp>

namespace lamina::core {

/// The cost of generate_mesh().
inline constexpr WorkCost mesh_cost{20e6, 45, 0.2e-6};

/// The largest number of triangles that may be requested. Vertices have 32-bit numbers, and there are twice as many
/// triangles as vertices. Half of these leave room for triangles that no estimate foresees.
inline constexpr double max_numbered_triangles = 4294967296.0;

/// Reads a number of bytes: "500M", "2G", "1.5GiB", "1000000". K, M, G and T are powers of 1024. Throws UsageError with
/// the bare reason.
LAMINA_EXPORT std::size_t parse_memory(const std::string& text);
/// Returns a text that parse_memory() reads back.
LAMINA_EXPORT std::string memory_text(std::size_t bytes);

}  // namespace lamina::core
