// Parallel loops and tasks on the threads of the standard library alone (LAMINA_THREADS=std). The module for browsers
// with threads (CMake preset web-threads) needs them, since there is no oneTBB for Debian's Emscripten: 1.26 million
// triangles take 0.14 to 0.17 s on two threads there, and 0.21 to 0.23 s on one. They also serve machines without
// oneTBB.
//
// with_threads() starts the threads of a crew, which take jobs from a list until it ends. The thread that posts a job
// works at it, too; then it withdraws what nobody has taken, and waits for those who work at it still. While it waits
// it takes jobs that were posted within its own job, and no others: those may need what it has begun and cannot go on
// with.
#include "core/parallel.hpp"

#include <algorithm>
#include <condition_variable>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

#include <lamina/threads.hpp>

#include "core/interruption_point.hpp"
#include "core/parallel_work.hpp"

namespace lamina::core {
namespace {

class Crew;

/// Work that other threads than the one that posts it may do. It lives until all who work at it have ended.
struct Job {
    const std::function<void()>& work;  ///< never throws
    const Job* within;                  ///< the job that the posting thread works at; null: none
    const Interruption* interruption;   ///< for whom all work at it
    std::size_t wanted;                 ///< how many threads may yet begin it
    std::size_t busy = 0;               ///< how many threads that did not post it work at it
};

/// Where the calling thread stands.
struct Seat {
    Crew* crew = nullptr;  ///< null: outside of with_threads()
    unsigned index = 0;
    const Job* job = nullptr;  ///< that the thread works at
};
thread_local Seat seat;

/// Gives the calling thread another seat for as long as the object lives.
class SeatScope {
public:
    explicit SeatScope(const Seat& now) : before_(seat) { seat = now; }
    SeatScope(const SeatScope&) = delete;
    SeatScope& operator=(const SeatScope&) = delete;
    ~SeatScope() { seat = before_; }

private:
    Seat before_;
};

/// Returns whether a job was posted by a thread that worked at another one, or at a job within it.
bool is_within(const Job& job, const Job& other) {
    for (const Job* outer = job.within; outer != nullptr; outer = outer->within)
        if (outer == &other) return true;
    return false;
}

/// The threads of one with_threads().
class Crew {
public:
    /// Starts `threads` - 1 threads, or as many as the system lets start.
    explicit Crew(unsigned threads) {
        try {
            while (threads_.size() + 1 < threads)
                threads_.emplace_back([this, index = static_cast<unsigned>(threads_.size()) + 1] { serve(index); });
        } catch (const std::system_error&) {
            // There is no room for more.
        }
        size_ = static_cast<unsigned>(threads_.size()) + 1;
    }
    Crew(const Crew&) = delete;
    Crew& operator=(const Crew&) = delete;
    ~Crew() {
        {
            const std::lock_guard lock(mutex_);
            ended_ = true;
        }
        changed_.notify_all();
        for (std::thread& thread : threads_) thread.join();
    }

    unsigned size() const { return size_; }

    /// Lets other threads work at a job.
    void post(Job& job) {
        {
            const std::lock_guard lock(mutex_);
            jobs_.push_back(&job);
        }
        changed_.notify_all();
    }

    /// Takes a job off the list. Returns how many of the threads that were wanted have not begun it, and will not.
    std::size_t withdraw(const Job& job) {
        const std::lock_guard lock(mutex_);
        std::erase(jobs_, &job);
        return job.wanted;
    }

    /// Returns when nobody works at a job that was withdrawn, and works at what was posted within it meanwhile.
    void wait_for(const Job& job) {
        std::unique_lock lock(mutex_);
        while (job.busy > 0)
            if (Job* const inner = find([&](const Job& other) { return is_within(other, job); })) {
                run(*inner, lock);
            } else {
                changed_.wait(lock);
            }
    }

private:
    /// Returns the oldest job that may be begun and of which wanted(job) is true, or null.
    template <class Wanted>
    Job* find(Wanted wanted) const {
        const auto found =
            std::find_if(jobs_.begin(), jobs_.end(), [&](const Job* job) { return job->wanted > 0 && wanted(*job); });
        return found == jobs_.end() ? nullptr : *found;
    }

    /// Works at a job. The lock is held before and afterwards.
    void run(Job& job, std::unique_lock<std::mutex>& lock) {
        --job.wanted;
        ++job.busy;
        lock.unlock();
        {
            const SeatScope scope({this, seat.index, &job});
            const InterruptionScope interruption(job.interruption);
            job.work();
        }
        lock.lock();
        if (--job.busy == 0) changed_.notify_all();
    }

    /// What a thread of the crew does all its life.
    void serve(unsigned index) {
        const SeatScope scope({this, index, nullptr});
        std::unique_lock lock(mutex_);
        while (!ended_)
            if (Job* const job = find([](const Job&) { return true; })) {
                run(*job, lock);
            } else {
                changed_.wait(lock);
            }
    }

    std::vector<std::thread> threads_;
    unsigned size_ = 1;
    std::mutex mutex_;
    std::condition_variable changed_;  ///< there is a job, somebody has ended one, or the crew ends
    std::vector<Job*> jobs_;           ///< those that are posted and not withdrawn, the oldest first
    bool ended_ = false;
};

}  // namespace

void parallel_for(std::size_t n, std::size_t grain, const std::function<void(std::size_t, std::size_t)>& f) {
    BlockLoop loop(n, grain, f);
    if (const std::size_t workers = loop.workers(); workers <= 1) {
        loop.work();
    } else if (seat.crew == nullptr) {
        with_threads(0, [&] { parallel_for(n, grain, f); });
    } else {
        const std::function<void()> work = [&] { loop.work(); };
        Job job{.work = work, .within = seat.job, .interruption = current_interruption, .wanted = workers - 1};
        seat.crew->post(job);
        {
            const SeatScope scope({seat.crew, seat.index, &job});
            work();
        }
        seat.crew->withdraw(job);
        seat.crew->wait_for(job);
    }
    loop.rethrow_failure();
}

void parallel_invoke(const std::function<void()>& f, const std::function<void()>& g) {
    if (seat.crew == nullptr && thread_count() > 1) return with_threads(0, [&] { parallel_invoke(f, g); });
    GuardedTask first(f), second(g);
    const std::function<void()> work = [&] { second.run(); };
    if (thread_count() == 1) {
        first.run();
        work();
    } else {
        Job job{.work = work, .within = seat.job, .interruption = current_interruption, .wanted = 1};
        seat.crew->post(job);
        first.run();
        if (seat.crew->withdraw(job) > 0) {
            work();
        } else {
            seat.crew->wait_for(job);
        }
    }
    first.rethrow_failure();
    second.rethrow_failure();
}

unsigned thread_index() { return seat.index; }

}  // namespace lamina::core

namespace lamina {

using namespace core;

void with_threads(unsigned threads, const std::function<void()>& f) {
    Crew crew(threads == 0 ? std::max(1u, std::thread::hardware_concurrency()) : threads);
    const SeatScope scope({&crew, 0, nullptr});
    f();
}

unsigned thread_count() {
    return seat.crew != nullptr ? seat.crew->size() : std::max(1u, std::thread::hardware_concurrency());
}

}  // namespace lamina
