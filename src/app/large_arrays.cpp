// Memory of the program's large arrays, of which a mesh of a million triangles has a dozen: on huge pages where the
// system offers them, since it otherwise takes longer to hand out the pages one by one than to fill them. Standard
// containers allocate with operator new, which a program may replace (C++20, [new.delete.single]); the library does
// not, and leaves the choice to whoever links it.
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
        // Advice only, and none for the last page unless it is full: an array takes no more memory than it is long.
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
