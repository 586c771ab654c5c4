// A measure of how long each thread works at each kind of work, where several kinds of work share the threads.
#pragma once

#include <algorithm>
#include <array>
#include <cassert>
#include <chrono>
#include <cstddef>
#include <vector>

#include "core/parallel.hpp"

namespace lamina::core {

/// The times of all threads. Kinds of work are numbers below max_kinds that the caller assigns.
class BusyTimes {
public:
    static constexpr std::size_t max_kinds = 4;

private:
    static constexpr std::size_t no_work = max_kinds;

    /// The clock of one thread. The alignment gives each thread a cache line of its own.
    struct alignas(64) ThreadClock {
        std::array<double, max_kinds> seconds{};  ///< per kind of work
        std::size_t current = no_work;            ///< kind of the work being done
        std::chrono::steady_clock::time_point since;

        /// Ends the current work and starts another kind of work.
        void turn_to(std::size_t kind) {
            const auto now = std::chrono::steady_clock::now();
            if (current != no_work) seconds[current] += std::chrono::duration<double>(now - since).count();
            current = kind;
            since = now;
        }
    };

public:
    /// Measures the threads that with_threads() allows where the object is made.
    BusyTimes() : threads_(thread_count()) {}

    /// Counts the calling thread as busy with one kind of work while the object lives. A thread that waits inside this
    /// work may be given other work; then only the other work counts. A null pointer measures nothing.
    class Scope {
    public:
        Scope(BusyTimes* times, std::size_t kind) : thread_(times ? &times->threads_[thread_index()] : nullptr) {
            assert(kind < max_kinds);
            if (!thread_) return;
            outer_ = thread_->current;
            thread_->turn_to(kind);
        }
        ~Scope() {
            if (thread_) thread_->turn_to(outer_);
        }
        Scope(const Scope&) = delete;
        Scope& operator=(const Scope&) = delete;

    private:
        ThreadClock* thread_;
        std::size_t outer_ = no_work;
    };

    std::size_t threads() const { return threads_.size(); }
    /// Returns the seconds that a thread was busy with a kind of work.
    double seconds(std::size_t thread, std::size_t kind) const { return threads_[thread].seconds[kind]; }
    /// Returns the seconds out of `elapsed` that a thread was not busy with any kind of work.
    double idle(std::size_t thread, double elapsed) const {
        for (const double busy : threads_[thread].seconds) elapsed -= busy;
        return std::max(0.0, elapsed);
    }

private:
    std::vector<ThreadClock> threads_;
};

}  // namespace lamina::core
