// Parallel loops and tasks on oneTBB (LAMINA_THREADS=tbb).
//
// Several places below store an atomic variable with release order before work is handed to the scheduler and load it
// with acquire order in the work, and the other way round at its end. The scheduler itself orders memory like that, but
// the thread sanitizer does not know the scheduler; it does understand these atomics.
#include "core/parallel.hpp"

#include <atomic>
#include <cassert>
#include <latch>
#include <thread>
#include <vector>

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/parallel_invoke.h>
#include <oneapi/tbb/task_arena.h>

#include <lamina/threads.hpp>

#include "core/interruption_point.hpp"
#include "core/parallel_work.hpp"

namespace lamina::core {

void parallel_for(std::size_t n, std::size_t grain, const std::function<void(std::size_t, std::size_t)>& f) {
    BlockLoop loop(n, grain, f);
    if (const std::size_t workers = loop.workers(); workers <= 1) {
        loop.work();
    } else {
        std::atomic<std::size_t> finished;  // for the thread sanitizer
        finished.store(0, std::memory_order_release);
        const Interruption* const interruption = current_interruption;
        const auto run_worker = [&](std::size_t) {
            const InterruptionScope scope(interruption);
            if (finished.load(std::memory_order_acquire) < workers) loop.work();
            finished.fetch_add(1, std::memory_order_release);
        };
        tbb::parallel_for(std::size_t{0}, workers, run_worker, tbb::simple_partitioner{});
        [[maybe_unused]] const std::size_t all = finished.load(std::memory_order_acquire);
        assert(all == workers);
    }
    loop.rethrow_failure();
}

void parallel_invoke(const std::function<void()>& f, const std::function<void()>& g) {
    GuardedTask first(f), second(g);
    if (thread_count() == 1) {
        first.run();
        second.run();
    } else {
        std::atomic<int> finished;  // for the thread sanitizer
        finished.store(0, std::memory_order_release);
        const Interruption* const interruption = current_interruption;
        const auto run = [&](GuardedTask& task) {
            const InterruptionScope scope(interruption);
            if (finished.load(std::memory_order_acquire) <= 1) task.run();
            finished.fetch_add(1, std::memory_order_release);
        };
        tbb::parallel_invoke([&] { run(first); }, [&] { run(second); });
        [[maybe_unused]] const int both = finished.load(std::memory_order_acquire);
        assert(both == 2);
    }
    first.rethrow_failure();
    second.rethrow_failure();
}

unsigned thread_index() {
    const int index = tbb::this_task_arena::current_thread_index();
    return index == tbb::task_arena::not_initialized ? 0u : static_cast<unsigned>(index);
}

}  // namespace lamina::core

namespace lamina {

namespace {

/// Returns how many of the wanted threads can run at once, the calling one included. Limits on memory or on the number
/// of processes may leave fewer. The thread library must not find that out: its threads start one another, and where
/// one of them fails to, the exception ends the process. The system keeps the stacks of threads that have ended for
/// those of the thread library.
unsigned startable_threads(unsigned wanted) {
    std::vector<std::thread> trials;
    std::latch all_started(1);
    try {
        while (trials.size() + 1 < wanted) trials.emplace_back([&] { all_started.wait(); });
    } catch (const std::exception&) {
        // There is no room for more.
    }
    all_started.count_down();
    for (std::thread& trial : trials) trial.join();
    return static_cast<unsigned>(trials.size()) + 1;
}

}  // namespace

void with_threads(unsigned threads, const std::function<void()>& f) {
    const unsigned cores = std::max(1u, std::thread::hardware_concurrency());
    threads = startable_threads(threads == 0 ? cores : threads);
    // Without this the thread library never starts more threads than there are cores.
    const tbb::global_control allow(tbb::global_control::max_allowed_parallelism, std::max(threads, cores));
    tbb::task_arena arena(static_cast<int>(threads));
    std::atomic<bool> handed_over, returned;  // for the thread sanitizer: f may run on another thread
    returned.store(false, std::memory_order_relaxed);
    handed_over.store(true, std::memory_order_release);
    const core::Interruption* const interruption = core::current_interruption;
    arena.execute([&] {
        const core::InterruptionScope scope(interruption);
        if (handed_over.load(std::memory_order_acquire)) f();
        returned.store(true, std::memory_order_release);
    });
    [[maybe_unused]] const bool done = returned.load(std::memory_order_acquire);
    assert(done);
}

unsigned thread_count() { return static_cast<unsigned>(tbb::this_task_arena::max_concurrency()); }

}  // namespace lamina
