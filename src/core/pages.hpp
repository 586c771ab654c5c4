// Memory that is done with but not yet freed, given back to the system page by page.
#pragma once

#include <cstddef>

#include <lamina/export.hpp>

namespace lamina::core {

/// The whole pages within [data, data + bytes) become free memory; what they held is lost and must not be read again.
/// The allocation itself stays valid and is freed as usual. Does nothing where the system offers no such call.
LAMINA_EXPORT void give_back_pages(void* data, std::size_t bytes);

}  // namespace lamina::core
