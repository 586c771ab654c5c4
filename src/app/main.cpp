// The program, as one process.
#include <cstdlib>

#ifdef __GLIBC__
#include <malloc.h>
#endif

#include "app/run_program.hpp"

namespace {

/// Makes the C library keep up to 64 MiB of freed memory. By default it gives blocks of 128 KiB and more back to the
/// system at once, and the system clears each page anew when the next mesh of a batch asks for it: 6 % of the time of
/// small meshes.
void keep_freed_memory() {
#ifdef __GLIBC__
    mallopt(M_MMAP_THRESHOLD, 4 << 20);
    mallopt(M_TRIM_THRESHOLD, 64 << 20);
#endif
}

}  // namespace

int main(int argc, char** argv) {
    keep_freed_memory();
    return lamina::app::run_program(argc, argv, nullptr);
}
