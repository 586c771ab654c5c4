// Memory that is no longer used but not yet freed, given back to the system page by page.
#pragma once

#include <cstddef>

#include <lamina/export.hpp>

namespace lamina::core {

/// Gives the whole pages within [data, data + bytes) back to the system. Their contents are lost and must not be read
/// again; the allocation itself stays valid and is freed as usual. Does nothing on systems without such a call.
LAMINA_EXPORT void give_back_pages(void* data, std::size_t bytes);

}  // namespace lamina::core
