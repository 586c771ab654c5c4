// Measures the wall-clock time of steps.
#pragma once

#include <chrono>
#include <utility>

namespace lamina::app {

class Stopwatch {
public:
    /// Returns the seconds since the last call, or since the object was made.
    double lap() {
        const auto now = std::chrono::steady_clock::now();
        return std::chrono::duration<double>(now - std::exchange(last_, now)).count();
    }

private:
    std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

}  // namespace lamina::app
