// A parallel loop and a task as the threads see them that run them. Nothing here starts a thread.
#pragma once

#include <algorithm>
#include <atomic>
#include <cassert>
#include <cstddef>
#include <exception>
#include <functional>
#include <mutex>

#include <lamina/threads.hpp>

#include "core/interruption_point.hpp"

namespace lamina::core {

/// A parallel_for() whose blocks several threads take. Each of them calls work(), which returns once no block is left
/// to start; rethrow_failure() is called when all of them have returned.
class BlockLoop {
public:
    BlockLoop(std::size_t n, std::size_t grain, const std::function<void(std::size_t, std::size_t)>& f)
        : n_(n), grain_(grain), blocks_((n + grain - 1) / grain), f_(f), failed_block_(blocks_) {
        assert(grain > 0);
        next_.store(0, std::memory_order_relaxed);
    }

    /// Returns how many threads should call work().
    std::size_t workers() const { return std::min<std::size_t>(blocks_, thread_count()); }

    /// Takes blocks in ascending order and calls f for them. Blocks before a failing one have hence started, and which
    /// block fails first in order does not depend on timing. Never throws.
    void work() {
        std::size_t b = 0;
        try {
            for (;;) {
                // No block is taken that does not run: others may wait for it.
                check_interruption();
                b = next_.fetch_add(1);
                if (b >= blocks_) break;
                f_(b * grain_, std::min(n_, (b + 1) * grain_));
            }
        } catch (...) {
            next_ = blocks_;
            const std::lock_guard lock(failure_mutex_);
            if (b < failed_block_) {
                failed_block_ = b;
                failure_ = std::current_exception();
            }
        }
    }

    /// Rethrows the exception of the first block in order that failed, if any did.
    void rethrow_failure() const {
        if (failure_) std::rethrow_exception(failure_);
    }

private:
    const std::size_t n_, grain_, blocks_;
    const std::function<void(std::size_t, std::size_t)>& f_;
    std::atomic<std::size_t> next_;
    std::mutex failure_mutex_;
    std::size_t failed_block_;
    std::exception_ptr failure_;
};

/// A task whose exception waits until the others have ended.
class GuardedTask {
public:
    explicit GuardedTask(const std::function<void()>& task) : task_(task) {}

    /// Calls the task. Never throws.
    void run() {
        try {
            task_();
        } catch (...) {
            failure_ = std::current_exception();
        }
    }

    /// Rethrows what the task has thrown, if anything.
    void rethrow_failure() const {
        if (failure_) std::rethrow_exception(failure_);
    }

private:
    const std::function<void()>& task_;
    std::exception_ptr failure_;
};

}  // namespace lamina::core
