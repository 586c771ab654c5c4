// Work that can be given up: a long call of lamina asks now and then whether it is still wanted.
//
// Guarantees:
//  1. Only the thread that calls with_interruption() asks, up to 50 times a second. Asking never changes a result.
//  2. Once the answer is yes, the call ends with Interrupted on all its threads, and leaves no file half-written.
// Example:
//     bool ended = false;
//     try {
//         with_interruption([] { return true; }, [] { generate_mesh({"naca:0012"}); });
//     } catch (const Interrupted&) {
//         ended = true;
//     }
//     assert(ended);
#pragma once

#include <exception>
#include <functional>

#include <lamina/export.hpp>

namespace lamina {

/// A call that is no longer wanted ends with this exception. It is no Error, since nothing is wrong.
class LAMINA_EXPORT Interrupted : public std::exception {
public:
    const char* what() const noexcept override;  ///< "interrupted"
};

/// Calls f(), and lets the long functions of lamina that f calls ask `is_unwanted`. Calls may run side by side and may
/// nest, in which case the inner one alone is asked. Other exceptions of f and of `is_unwanted` pass through.
LAMINA_EXPORT void with_interruption(const std::function<bool()>& is_unwanted, const std::function<void()>& f);

}  // namespace lamina
