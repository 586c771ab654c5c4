// The size of a run: how many triangles, how much memory and how much time it takes, by estimate before the work
// begins, and the limits that a user sets on it.
//
// Guarantees:
//  1. A run that would exceed a limit by estimate, or 2^32 triangles, ends with a LimitError before the work; one whose
//     estimate was too low ends with one once it has too many triangles.
// Limits:
//  1. Estimates are no bounds: their figures were measured on 26 meshes, on a machine of 2020 or so.
// Example:
//     const RunEstimate estimate = estimate_run(1e6, triangulation_cost, 1);
//     assert(estimate.memory_bytes > 90e6 && estimate.seconds == 0.5);
//     assert(estimate_text(estimate) == "about 1.0 million triangles, 101 MiB of memory and 0.50 s");
#pragma once

#include <filesystem>

#include <lamina/error.hpp>

namespace lamina {

/// Limits on a run. Empty ones do not limit.
struct WorkLimits {
    std::optional<std::size_t> max_triangles{};     ///< largest number of triangles; a quadrilateral counts as two
    std::optional<std::size_t> max_memory_bytes{};  ///< largest memory of the process
};

/// The triangles, memory and time that a run will take, by estimate.
struct RunEstimate {
    double triangles = 0;     ///< number of triangles; a quadrilateral counts as two
    double memory_bytes = 0;  ///< largest memory of the process
    double seconds = 0;       ///< wall-clock time until the mesh is made and checked
};

/// The cost of a kind of run, for each triangle.
struct WorkCost {
    double base_bytes;            ///< memory of the process without any triangle
    double bytes_per_triangle;    ///< memory at the peak
    double seconds_per_triangle;  ///< processor time
};

inline constexpr WorkCost triangulation_cost{15e6, 90, 0.5e-6};      ///< of a triangulation of points and segments
inline constexpr WorkCost refinement_cost{15e6, 70, 0.35e-6};        ///< of refining a triangulation to sizes
inline constexpr WorkCost angle_refinement_cost{15e6, 160, 0.7e-6};  ///< of refining one to an angle bound alone

/// Returns the estimate for a number of triangles, when the work is divided among so many threads. `more_seconds` are
/// those of processor time that do not depend on the number of triangles.
LAMINA_EXPORT RunEstimate estimate_run(double triangles, const WorkCost& cost, unsigned threads,
                                       double more_seconds = 0);
/// Returns the estimate in words: "about 1.2 million triangles, 90 MiB of memory and 0.4 s".
LAMINA_EXPORT std::string estimate_text(const RunEstimate& estimate);

/// A run that would exceed a limit. option() is the option to change.
class LAMINA_EXPORT LimitError : public OptionError {
public:
    /// Makes an error whose what() reads "option: reason".
    LimitError(const std::string& option, const std::string& reason, const RunEstimate& estimate)
        : OptionError(option, reason), estimate_(estimate) {}
    const RunEstimate& estimate() const noexcept { return estimate_; }  ///< what the run would take

private:
    RunEstimate estimate_;
};

/// Throws a LimitError for a run of this size. `option` is the one to change, and `request` its value: the message
/// reads "REQUEST asks for about 4.3 billion triangles, ...".
[[noreturn]] LAMINA_EXPORT void throw_limit_error(const WorkLimits& limits, const RunEstimate& estimate,
                                                  const std::string& option, const std::string& request);
/// Throws this error where the run would exceed a limit, or have more triangles than can be numbered.
LAMINA_EXPORT void require_within(const WorkLimits& limits, const RunEstimate& estimate, const std::string& option,
                                  const std::string& request);
/// Throws LimitError where a run made more triangles than max_triangles, since the estimate was too low.
LAMINA_EXPORT void require_made_within(const WorkLimits& limits, double triangles, const WorkCost& cost,
                                       unsigned threads);
/// Returns the number of triangles that the limits allow at this cost; at most 2^32.
LAMINA_EXPORT double allowed_triangles(const WorkLimits& limits, const WorkCost& cost);
/// Returns the number of vertices of that many triangles, but at least 1 and at most `max_points`.
LAMINA_EXPORT std::size_t allowed_points(const WorkLimits& limits, const WorkCost& cost, std::size_t max_points);
/// Returns the memory that the process could still use without swapping: what the system has available (/proc/meminfo),
/// or what its control groups leave it; empty where the system does not tell. `root` is the root of the file system.
LAMINA_EXPORT std::optional<std::size_t> free_memory(const std::filesystem::path& root = "/");
/// Returns the limits with those that the program sets where the user gives none: 80 % of the memory that is free.
LAMINA_EXPORT WorkLimits with_default_limits(WorkLimits limits);

}  // namespace lamina
