// How the programs use the memory of the C library.
#pragma once

namespace lamina::app {

/// Makes the C library keep up to 64 MiB of freed memory. By default it gives blocks of 128 KiB and more back to the
/// system at once, and the system clears each page anew when the next mesh of a batch, or the next piece of a process,
/// asks for it: 6 % of the time of small meshes. To be called once, before all else.
void keep_freed_memory();

}  // namespace lamina::app
