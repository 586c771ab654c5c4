// Work looks here whether it is still wanted (with_interruption()). Parallel loops look before each block, so most
// stages have no code for it; long loops on one thread look every few thousand steps.
#pragma once

namespace lamina::core {

/// Knows whether some work is still wanted.
class Interruption {
public:
    Interruption() = default;
    Interruption(const Interruption&) = delete;
    Interruption& operator=(const Interruption&) = delete;
    /// Throws Interrupted where it is not.
    virtual void check() const = 0;

protected:
    ~Interruption() = default;
};

/// The thread works for this call at present; null: for somebody who will wait. InterruptionScope sets it, and sets it
/// back.
inline thread_local const Interruption* current_interruption = nullptr;

/// Throws Interrupted where the work of this thread is no longer wanted. Costs some nanoseconds.
inline void check_interruption() {
    if (current_interruption) current_interruption->check();
}

/// Lets the thread work for somebody for as long as the object lives.
class InterruptionScope {
public:
    explicit InterruptionScope(const Interruption* interruption) : before_(current_interruption) {
        current_interruption = interruption;
    }
    InterruptionScope(const InterruptionScope&) = delete;
    InterruptionScope& operator=(const InterruptionScope&) = delete;
    ~InterruptionScope() { current_interruption = before_; }

private:
    const Interruption* before_;
};

}  // namespace lamina::core
