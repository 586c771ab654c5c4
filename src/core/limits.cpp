// The one place where numbers of triangles become memory, time and refusals.
#include "core/limits.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <string_view>
#include <utility>

#include "core/text.hpp"

namespace lamina::core {

namespace {

constexpr double kibi = 1024;

/// Returns a number with up to `decimals` digits behind the point.
std::string fixed_text(double value, int decimals) {
    std::array<char, 64> digits{};
    const auto end =
        std::to_chars(digits.data(), digits.data() + digits.size(), value, std::chars_format::fixed, decimals).ptr;
    return {digits.data(), end};
}

/// Returns a number with two or three digits that count: "0.25", "3.7", "190".
std::string short_text(double value) { return fixed_text(value, value < 1 ? 2 : value < 10 ? 1 : 0); }

std::string count_text(double count) {
    if (!(count < 1e15)) return rounded_text(count);
    for (const auto& [size, name] : {std::pair{1e9, " billion"}, {1e6, " million"}})
        if (count >= size) return short_text(count / size) + name;
    return fixed_text(count, 0);
}

std::string bytes_text(double bytes) {
    constexpr double mebi = kibi * kibi;
    for (const auto& [size, name] : {std::pair{mebi * mebi, " TiB"}, {mebi * kibi, " GiB"}})
        if (bytes >= size)
            return bytes / size < 1e6 ? short_text(bytes / size) + name : rounded_text(bytes / size) + name;
    return fixed_text(std::ceil(bytes / mebi), 0) + " MiB";
}

std::string seconds_text(double seconds) {
    if (!(seconds < 1e7)) return rounded_text(seconds) + " s";
    if (seconds < 120) return short_text(seconds) + " s";
    if (seconds < 7200) return short_text(seconds / 60) + " min";
    return short_text(seconds / 3600) + " h";
}

/// Returns which limit an estimate exceeds, in words; empty where it exceeds none.
std::string exceeded_limit(const WorkLimits& limits, const RunEstimate& estimate) {
    if (limits.max_triangles && estimate.triangles > static_cast<double>(*limits.max_triangles))
        return concat(*limits.max_triangles, " triangles are allowed (--max-triangles)");
    if (limits.max_memory_bytes && estimate.memory_bytes > static_cast<double>(*limits.max_memory_bytes))
        return bytes_text(static_cast<double>(*limits.max_memory_bytes)) + " of memory are allowed (--max-memory)";
    if (estimate.triangles > max_numbered_triangles)
        return count_text(max_numbered_triangles) + " triangles can be numbered";
    return {};
}

}  // namespace

std::size_t parse_memory(const std::string& text) {
    const UsageError error("'" + text + "' is no number of bytes, such as 500M or 2G");
    const std::size_t length = std::min(text.find_first_not_of("0123456789."), text.size());
    std::string unit = lower_case(text.substr(length));
    if (unit.ends_with("b")) unit.pop_back();
    if (unit.ends_with("i")) unit.pop_back();
    double bytes = 0;
    const auto [end, code] = std::from_chars(text.data(), text.data() + length, bytes);
    if (code != std::errc{} || end != text.data() + length) throw error;
    if (!unit.empty()) {
        const std::size_t power = std::string_view("kmgt").find(unit);
        if (unit.size() != 1 || power == std::string::npos) throw error;
        bytes *= std::pow(kibi, static_cast<double>(power + 1));
    }
    if (!(bytes >= 1 && bytes < 0x1p63)) throw error;
    // Where addresses have 32 bits, more bytes than these limit nothing.
    constexpr auto most = std::numeric_limits<std::size_t>::max();
    return bytes < static_cast<double>(most) ? static_cast<std::size_t>(bytes) : most;
}

std::string memory_text(std::size_t bytes) {
    std::string unit;
    for (const char letter : std::string_view("KMGT")) {
        if (bytes % 1024 != 0 || bytes == 0) break;
        bytes /= 1024;
        unit = letter;
    }
    return std::to_string(bytes) + unit;
}

}  // namespace lamina::core

namespace lamina {

using namespace core;

RunEstimate estimate_run(double triangles, const WorkCost& cost, unsigned threads, double more_seconds) {
    // Two threads are 1.7 times as fast as one, as measured; further ones are assumed to add as much.
    constexpr double further_thread = 0.7;
    return {
        triangles, cost.base_bytes + cost.bytes_per_triangle * triangles,
        (cost.seconds_per_triangle * triangles + more_seconds) / (1 + further_thread * (std::max(threads, 1u) - 1))};
}

std::string estimate_text(const RunEstimate& estimate) {
    return concat("about ", count_text(estimate.triangles), " triangles, ", bytes_text(estimate.memory_bytes),
                  " of memory and ", seconds_text(estimate.seconds));
}

void throw_limit_error(const WorkLimits& limits, const RunEstimate& estimate, const std::string& option,
                       const std::string& request) {
    throw LimitError(option,
                     concat(request, " asks for ", estimate_text(estimate), ", by estimate, and no more than ",
                            exceeded_limit(limits, estimate)),
                     estimate);
}

void require_within(const WorkLimits& limits, const RunEstimate& estimate, const std::string& option,
                    const std::string& request) {
    if (!exceeded_limit(limits, estimate).empty()) throw_limit_error(limits, estimate, option, request);
}

double allowed_triangles(const WorkLimits& limits, const WorkCost& cost) {
    double allowed = max_numbered_triangles;
    if (limits.max_triangles) allowed = std::min(allowed, static_cast<double>(*limits.max_triangles));
    if (limits.max_memory_bytes)
        allowed = std::min(allowed,
                           (static_cast<double>(*limits.max_memory_bytes) - cost.base_bytes) / cost.bytes_per_triangle);
    return std::max(allowed, 0.0);
}

std::size_t allowed_points(const WorkLimits& limits, const WorkCost& cost, std::size_t max_points) {
    // A triangulation has twice as many triangles as vertices.
    const auto points = static_cast<std::size_t>(0.5 * allowed_triangles(limits, cost));
    return std::max<std::size_t>(1, std::min(max_points, points));
}

void require_made_within(const WorkLimits& limits, double triangles, const WorkCost& cost, unsigned threads) {
    if (limits.max_triangles && triangles > static_cast<double>(*limits.max_triangles))
        throw LimitError("max_triangles",
                         concat(*limits.max_triangles, " triangles are allowed, and ", fixed_text(triangles, 0),
                                " were made, more than was estimated"),
                         estimate_run(triangles, cost, threads));
}

WorkLimits with_default_limits(WorkLimits limits) {
    constexpr double share_of_free = 0.8;
    if (limits.max_memory_bytes) return limits;
    if (const auto free = free_memory())
        limits.max_memory_bytes = static_cast<std::size_t>(share_of_free * static_cast<double>(*free));
    return limits;
}

}  // namespace lamina
