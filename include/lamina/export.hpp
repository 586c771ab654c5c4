// LAMINA_EXPORT marks the functions and classes that lamina's libraries export; all else is hidden in shared libraries.
#pragma once

#if defined(__GNUC__)
#define LAMINA_EXPORT __attribute__((visibility("default")))
#else
#define LAMINA_EXPORT
#endif
