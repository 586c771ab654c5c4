// Replaces operator new, so that large arrays lie on huge pages where the system offers them. A mesh of a million
// triangles has a dozen large arrays, and the system takes longer to hand out their pages one by one than lamina takes
// to fill them. A program may replace operator new (C++20, [new.delete.single]). The library does not: it leaves the
// choice to the program that links it.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <new>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace {

constexpr std::size_t huge_page = std::size_t{1} << 21;

void* allocate(std::size_t bytes) {
#if defined(__linux__) && defined(MADV_HUGEPAGE)
    if (bytes >= 2 * huge_page && bytes < PTRDIFF_MAX - huge_page) {
        void* const memory = std::aligned_alloc(huge_page, (bytes + huge_page - 1) / huge_page * huge_page);
        // The last page is left out unless it is full, so that an array takes no more memory than its length. A refusal
        // does no harm.
        if (memory != nullptr) (void)::madvise(memory, bytes / huge_page * huge_page, MADV_HUGEPAGE);
        return memory;
    }
#endif
    return std::malloc(bytes > 0 ? bytes : 1);
}

}  // namespace

void* operator new(std::size_t bytes) {
    for (;;) {
        if (void* const memory = allocate(bytes)) return memory;
        const std::new_handler handler = std::get_new_handler();
        if (handler == nullptr) throw std::bad_alloc();
        handler();
    }
}

void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
