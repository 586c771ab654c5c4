#include "support/failing_new.hpp"

#include <atomic>
#include <cstdlib>
#include <new>

namespace {

std::atomic<long> calls_left = 0;  // the call that brings this to 0 fails

void* allocate(std::size_t bytes) {
    if (calls_left.load(std::memory_order_relaxed) > 0 && calls_left.fetch_sub(1, std::memory_order_relaxed) == 1)
        throw std::bad_alloc();
    if (void* const memory = std::malloc(bytes > 0 ? bytes : 1)) return memory;
    throw std::bad_alloc();
}

}  // namespace

namespace lamina::test {

FailingNew::FailingNew(long n) { calls_left = n; }
FailingNew::~FailingNew() { calls_left = 0; }
bool FailingNew::disarm() {
    has_failed_ = has_failed_ || calls_left.exchange(0) <= 0;
    return has_failed_;
}

}  // namespace lamina::test

void* operator new(std::size_t bytes) { return allocate(bytes); }
// The library's own would call the operator above; a sanitizer's does not.
void* operator new(std::size_t bytes, const std::nothrow_t&) noexcept {
    try {
        return allocate(bytes);
    } catch (const std::bad_alloc&) {
        return nullptr;
    }
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
