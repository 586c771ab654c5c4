// The mark of functions and classes that lamina's libraries export. Everything else is hidden in shared libraries.
#pragma once

#if defined(__GNUC__)
#define LAMINA_EXPORT __attribute__((visibility("default")))
#else
#define LAMINA_EXPORT
#endif
