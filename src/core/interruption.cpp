#include <lamina/interruption.hpp>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <thread>

#include "core/interruption_point.hpp"

namespace lamina::core {

namespace {

/// Asks a function whether work is still wanted.
class AskedInterruption final : public Interruption {
public:
    explicit AskedInterruption(const std::function<bool()>& is_unwanted) : is_unwanted_(is_unwanted) {}

    void check() const override {
        if (!unwanted_.load(std::memory_order_relaxed) && std::this_thread::get_id() == asking_thread_) ask();
        if (unwanted_.load(std::memory_order_relaxed)) throw Interrupted();
    }

private:
    using Clock = std::chrono::steady_clock;

    void ask() const {
        const Clock::time_point now = Clock::now();
        if (now < next_) return;
        if (is_unwanted_()) unwanted_.store(true, std::memory_order_relaxed);
        // Where the answer takes long, as behind a lock that others hold, questions are rarer.
        constexpr Clock::duration shortest = std::chrono::milliseconds(20), longest = std::chrono::milliseconds(250);
        constexpr int times_the_answer = 50;
        const Clock::time_point answered = Clock::now();
        next_ = answered + std::clamp(times_the_answer * (answered - now), shortest, longest);
    }

    const std::function<bool()>& is_unwanted_;
    const std::thread::id asking_thread_ = std::this_thread::get_id();
    mutable std::atomic<bool> unwanted_ = false;
    mutable Clock::time_point next_{};  ///< when to ask again; for the asking thread alone
};

}  // namespace

}  // namespace lamina::core

namespace lamina {

const char* Interrupted::what() const noexcept { return "interrupted"; }

void with_interruption(const std::function<bool()>& is_unwanted, const std::function<void()>& f) {
    const core::AskedInterruption interruption(is_unwanted);
    const core::InterruptionScope scope(&interruption);
    f();
}

}  // namespace lamina
