// Work that can be given up: a long call of lamina asks now and then whether it is still wanted.
#pragma once

#include <exception>
#include <functional>

#include <lamina/export.hpp>

namespace lamina {

/// A call that is no longer wanted ends with this exception. It is no Error: nothing is wrong, and nobody who mends errors
/// may take it for one.
class LAMINA_EXPORT Interrupted : public std::exception {
public:
    /// Returns "interrupted".
    const char* what() const noexcept override;
};

/// Calls f(), and lets the long functions of lamina that f calls ask `is_unwanted` up to 50 times a second. Once it
/// returns true, they throw Interrupted on all their threads, and so does this function. Only the thread that calls this
/// function asks, so `is_unwanted` may use what belongs to that thread. Asking never changes a result. Calls may run side
/// by side and may nest, in which case the inner one alone is asked. Other exceptions of f and of `is_unwanted` pass
/// through.
LAMINA_EXPORT void with_interruption(const std::function<bool()>& is_unwanted, const std::function<void()>& f);

}  // namespace lamina
