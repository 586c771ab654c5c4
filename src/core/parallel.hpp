// Parallel loops and tasks. parallel_tbb.cpp implements them on a thread library, which no other code knows,
// parallel_std.cpp on the standard library alone, and parallel_none.cpp without threads. Callers divide work into
// blocks and combine the results in the order of the blocks, so that no result depends on the number of threads or on
// their timing.
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <type_traits>
#include <vector>

#include <lamina/export.hpp>
#include <lamina/threads.hpp>

namespace lamina::core {

/// Calls f(begin, end) for the blocks [0, grain), [grain, 2 grain), ... of [0, n). The blocks depend on n and grain
/// alone. They are started in ascending order, each on the next free thread, so callers put the largest jobs first.
/// Once a call throws, no further block is started, and the exception of the first block in order that failed is
/// rethrown. Calls may nest. Precondition: grain > 0.
LAMINA_EXPORT void parallel_for(std::size_t n, std::size_t grain,
                                const std::function<void(std::size_t, std::size_t)>& f);

/// Calls f(begin, end) for the blocks of parallel_for() and returns the results in the order of the blocks, in which
/// callers combine them. Precondition: the result type is default-constructible. It is not bool, whose vectors have
/// many elements in one byte, which threads cannot write at the same time.
template <class F>
auto parallel_blocks(std::size_t n, std::size_t grain, F&& f) {
    using Result = decltype(f(n, n));
    static_assert(!std::is_same_v<Result, bool>);
    std::vector<Result> results((n + grain - 1) / grain);
    parallel_for(n, grain, [&](std::size_t begin, std::size_t end) { results[begin / grain] = f(begin, end); });
    return results;
}

/// Calls f and g, at the same time where a second thread is free, and returns when both have ended. Where both throw,
/// the exception of f is rethrown. Calls may nest: a task that divides itself calls this function for its parts.
LAMINA_EXPORT void parallel_invoke(const std::function<void()>& f, const std::function<void()>& g);

/// Returns the number of the calling thread, which is less than thread_count().
LAMINA_EXPORT unsigned thread_index();

}  // namespace lamina::core
