// The number of threads that lamina uses. Results never depend on it.
#pragma once

#include <functional>

#include <lamina/export.hpp>

namespace lamina {

/// Calls f() and lets every parallel function of lamina that f calls use up to `threads` threads; 0 stands for one
/// thread per core. `threads` may exceed the number of cores. There are fewer where the system cannot start so many.
/// Without this call lamina uses one thread per core; one that was built with LAMINA_THREADS=std then starts and ends
/// them for each parallel loop, so what calls it often should do so in here. A lamina that was built with
/// LAMINA_THREADS=none always uses the calling thread alone. Exceptions of f pass through. Calls may run side by side
/// and may nest.
LAMINA_EXPORT void with_threads(unsigned threads, const std::function<void()>& f);

/// Returns the number of threads that a parallel function of lamina called here would use.
LAMINA_EXPORT unsigned thread_count();

}  // namespace lamina
