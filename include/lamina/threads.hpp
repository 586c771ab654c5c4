// The number of threads that lamina uses.
//
// Guarantees:
//  1. Results never depend on the number of threads, down to the last bit.
//  2. Calls of all functions of lamina may run side by side on any threads, and nest. There is no global state.
// Limits:
//  1. Without with_threads() lamina uses one thread per core. One that was built with LAMINA_THREADS=std then starts
//     and ends them for each parallel loop: call it often inside with_threads(). One that was built with
//     LAMINA_THREADS=none uses the calling thread alone.
// Example:
//     unsigned used = 0;
//     with_threads(1, [&] { used = thread_count(); });
//     assert(used == 1 && thread_count() >= 1);
#pragma once

#include <functional>

#include <lamina/export.hpp>

namespace lamina {

/// Calls f() and lets every parallel function of lamina that f calls use up to `threads` threads (0: one per core), or
/// fewer where the system cannot start so many. Exceptions of f pass through.
LAMINA_EXPORT void with_threads(unsigned threads, const std::function<void()>& f);
/// Returns the number of threads that a parallel function of lamina called here would use.
LAMINA_EXPORT unsigned thread_count();

}  // namespace lamina
