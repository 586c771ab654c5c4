// What the C++ library of Debian's Emscripten (libc++ 13) lacks of C++20, and lamina uses. The compiler includes this
// header in front of every source (-include), and only where it compiles for browsers. The functions stand in the
// namespace std, as those of later versions of the library do, so that the sources need not know.
//
// Numbers must become the same text as in the native program (libstdc++), and text the same numbers:
// standard_library.cpp takes the digits from {fmt} and reads with fast_float, from which the reader of libstdc++
// descends.
#pragma once

#include <atomic>
#include <charconv>
#include <cstddef>
#include <memory>
#include <type_traits>

#include "landing_pad.hpp"

namespace std {

#if !__has_builtin(__builtin_bit_cast) || __cpp_lib_bit_cast
#error "web/standard_library was written for libc++ 13: leave out what this version of it has"
#endif

template <class To, class From>
constexpr To bit_cast(const From& from) noexcept {
    return __builtin_bit_cast(To, from);
}

/// On the operations of Clang, which need no lock for numbers of 1, 2, 4 and 8 bytes. The order is always the
/// strictest.
template <class T>
class atomic_ref {
public:
    explicit atomic_ref(T& value) : value_(value) {}
    T load(memory_order = memory_order_seq_cst) const { return __atomic_load_n(&value_, __ATOMIC_SEQ_CST); }
    void store(T value, memory_order = memory_order_seq_cst) const {
        __atomic_store_n(&value_, value, __ATOMIC_SEQ_CST);
    }
    T fetch_or(T bits, memory_order = memory_order_seq_cst) const {
        return __atomic_fetch_or(&value_, bits, __ATOMIC_SEQ_CST);
    }
    bool compare_exchange_strong(T& expected, T desired, memory_order = memory_order_seq_cst) const {
        constexpr bool may_fail_for_nothing = false;
        return __atomic_compare_exchange_n(&value_, &expected, desired, may_fail_for_nothing, __ATOMIC_SEQ_CST,
                                           __ATOMIC_SEQ_CST);
    }

private:
    T& value_;
};

template <class T>
unique_ptr<T> make_unique_for_overwrite(size_t size) {
    return unique_ptr<T>(new remove_extent_t<T>[size]);
}

to_chars_result to_chars(char* first, char* last, double value);
to_chars_result to_chars(char* first, char* last, double value, chars_format format, int precision);
from_chars_result from_chars(const char* first, const char* last, double& value);
from_chars_result from_chars(const char* first, const char* last, float& value);

}  // namespace std
