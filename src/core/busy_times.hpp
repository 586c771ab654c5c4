// Who worked on what for how long: seconds of each thread in the kinds of work that share the threads.
#pragma once

#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <vector>

#include "core/parallel.hpp"

namespace lamina {

enum class Work { decomposition, layer_triangulation, refinement };
inline constexpr std::size_t work_kinds = 3;

class BusyTimes {
public:
    using Seconds = std::array<double, work_kinds>;

private:
    struct alignas(64) Thread {
        Seconds seconds{};
        int current = -1;  ///< kind of work, -1: none
        std::chrono::steady_clock::time_point since;

        void turn_to(int work) {
            const auto now = std::chrono::steady_clock::now();
            if (current >= 0)
                seconds[static_cast<std::size_t>(current)] += std::chrono::duration<double>(now - since).count();
            current = work;
            since = now;
        }
    };

public:
    /// For the threads of the enclosing with_threads().
    BusyTimes() : threads_(thread_count()) {}

    /// The calling thread does this kind of work while the object lives. A thread that waits may be handed other work
    /// meanwhile: then only that counts. Without times nothing is measured.
    class Scope {
    public:
        Scope(BusyTimes* times, Work work) : thread_(times ? &times->threads_[thread_index()] : nullptr) {
            if (!thread_) return;
            outer_ = thread_->current;
            thread_->turn_to(static_cast<int>(work));
        }
        ~Scope() {
            if (thread_) thread_->turn_to(outer_);
        }
        Scope(const Scope&) = delete;
        Scope& operator=(const Scope&) = delete;

    private:
        Thread* thread_;
        int outer_ = -1;
    };

    std::size_t threads() const { return threads_.size(); }
    const Seconds& of_thread(std::size_t i) const { return threads_[i].seconds; }
    /// What is left of the thread's time in a stage that took so many seconds.
    double idle(std::size_t i, double elapsed) const {
        for (const double busy : of_thread(i)) elapsed -= busy;
        return std::max(0.0, elapsed);
    }

private:
    std::vector<Thread> threads_;
};

}  // namespace lamina
