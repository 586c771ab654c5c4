# {fmt}, and fast_float where it is wanted: the headers alone, which need no compiled library.
include(${CMAKE_CURRENT_LIST_DIR}/FromDebian.cmake)
headers_of_debian(fmt::fmt fmt fast_float)
target_compile_definitions(fmt::fmt INTERFACE FMT_HEADER_ONLY FMT_STATIC_THOUSANDS_SEPARATOR=44)  # a comma, and no locales
