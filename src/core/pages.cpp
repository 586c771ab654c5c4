#include "core/pages.hpp"

#include <cstdint>

#ifdef __linux__
#include <sys/mman.h>
#include <unistd.h>
#endif

namespace lamina::core {

#ifdef __linux__
void give_back_pages(void* data, std::size_t bytes) {
    const auto page = static_cast<std::uintptr_t>(::sysconf(_SC_PAGESIZE));
    const auto address = reinterpret_cast<std::uintptr_t>(data);
    const std::uintptr_t begin = (address + page - 1) / page * page, end = (address + bytes) / page * page;
    if (begin >= end) return;
    // The call is only advice; where the system refuses it, the memory becomes free later.
    (void)::madvise(static_cast<char*>(data) + (begin - address), end - begin, MADV_DONTNEED);
}
#else
void give_back_pages(void*, std::size_t) {}
#endif

}  // namespace lamina::core
