// Parallel loops and tasks without a thread library (LAMINA_THREADS=none): every block and task runs on the calling
// thread, in the order in which several threads would start them. Results are the same, since they never depend on the
// number of threads.
#include "core/parallel.hpp"

#include <cassert>
#include <exception>

#include <lamina/threads.hpp>

#include "core/interruption_point.hpp"

namespace lamina::core {

void parallel_for(std::size_t n, std::size_t grain, const std::function<void(std::size_t, std::size_t)>& f) {
    assert(grain > 0);
    for (std::size_t begin = 0; begin < n; begin += grain) {
        check_interruption();
        f(begin, std::min(n, begin + grain));
    }
}

void parallel_invoke(const std::function<void()>& f, const std::function<void()>& g) {
    std::exception_ptr failure;
    try {
        f();
    } catch (...) {
        failure = std::current_exception();
    }
    g();  // runs even where f failed, as it would on a thread of its own
    if (failure) std::rethrow_exception(failure);
}

unsigned thread_index() { return 0; }

}  // namespace lamina::core

namespace lamina {

void with_threads(unsigned, const std::function<void()>& f) { f(); }

unsigned thread_count() { return 1; }

}  // namespace lamina
