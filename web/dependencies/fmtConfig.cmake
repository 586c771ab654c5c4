# {fmt} for WebAssembly, and fast_float: Debian's headers alone, which need no compiled library. They get a folder of their own, since
# beside them in /usr/include stand the headers of the native C library.
add_library(fmt::fmt INTERFACE IMPORTED)
file(MAKE_DIRECTORY ${CMAKE_BINARY_DIR}/headers)
foreach(folder fmt fast_float)
  file(CREATE_LINK /usr/include/${folder} ${CMAKE_BINARY_DIR}/headers/${folder} SYMBOLIC)
endforeach()
target_include_directories(fmt::fmt INTERFACE ${CMAKE_BINARY_DIR}/headers)
target_compile_definitions(fmt::fmt INTERFACE FMT_HEADER_ONLY FMT_STATIC_THOUSANDS_SEPARATOR=44)  # a comma, and no locales
