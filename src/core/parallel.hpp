// The one place that knows the thread library. Everything else asks for blocks of work and combines their results in
// the order of the blocks, so that no result depends on the number of threads or on their timing.
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <vector>

namespace lamina {

/// Calls f(begin, end) for the blocks [0, grain), [grain, 2 grain), ... of [0, n). Blocks depend on n and grain alone
/// and are started in ascending order, each on whichever thread is free: put the largest jobs first. Where calls
/// throw, no further block is started and the exception of the lowest block is rethrown. Calls may nest.
void parallel_for(std::size_t n, std::size_t grain, const std::function<void(std::size_t, std::size_t)>& f);

/// The results of f(begin, end) for the same blocks, in their order: reduce them from front to back.
/// Result must be default-constructible.
template <class F>
auto parallel_blocks(std::size_t n, std::size_t grain, F&& f) {
    std::vector<decltype(f(n, n))> results((n + grain - 1) / grain);
    parallel_for(n, grain, [&](std::size_t begin, std::size_t end) { results[begin / grain] = f(begin, end); });
    return results;
}

/// Runs f and g, at the same time where a thread is free. Where both throw, the exception of f is rethrown. Calls may
/// nest: a task that divides itself calls this for its parts.
void parallel_invoke(const std::function<void()>& f, const std::function<void()>& g);

/// Runs f with at most `threads` threads (0 = one for each core) in every parallel_for below it. More threads than
/// cores are started if asked for.
void with_threads(unsigned threads, const std::function<void()>& f);

/// Threads that a parallel_for started here would use.
unsigned thread_count();

/// Number of the calling thread, below thread_count() of the enclosing with_threads().
unsigned thread_index();

}  // namespace lamina
