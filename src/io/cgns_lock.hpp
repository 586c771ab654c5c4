// The lock of the CGNS library, which keeps its open files, and the kind of the next one, in global variables.
#pragma once

#include <mutex>

namespace lamina::io {

/// Returns the mutex that must be locked while the library is used.
inline std::mutex& cgns_lock() {
    static std::mutex mutex;
    return mutex;
}

}  // namespace lamina::io
