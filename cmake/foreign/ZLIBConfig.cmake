# zlib, from Debian's source (./dev puts it into build/foreign/zlib): compressing and decompressing memory is all that lamina
# needs of it.
set(zlib_folder ${CMAKE_SOURCE_DIR}/build/foreign/zlib)
set(zlib_sources adler32.c compress.c crc32.c deflate.c inffast.c inflate.c inftrees.c trees.c uncompr.c zutil.c)
list(TRANSFORM zlib_sources PREPEND ${zlib_folder}/)
enable_language(C)
add_library(zlib_from_source STATIC ${zlib_sources})
set_target_properties(zlib_from_source PROPERTIES C_VISIBILITY_PRESET hidden POSITION_INDEPENDENT_CODE ON UNITY_BUILD OFF)
target_include_directories(zlib_from_source PUBLIC ${zlib_folder})
target_compile_options(zlib_from_source PRIVATE -w)
add_library(ZLIB::ZLIB ALIAS zlib_from_source)
