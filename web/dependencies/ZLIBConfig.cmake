# zlib for WebAssembly, from Debian's source (./dev puts it into build/browser/zlib): compressing and decompressing memory is
# all that lamina needs of it.
set(zlib_folder ${CMAKE_SOURCE_DIR}/build/browser/zlib)
set(zlib_sources adler32.c compress.c crc32.c deflate.c inffast.c inflate.c inftrees.c trees.c uncompr.c zutil.c)
list(TRANSFORM zlib_sources PREPEND ${zlib_folder}/)
enable_language(C)
add_library(zlib_for_web STATIC ${zlib_sources})
target_include_directories(zlib_for_web PUBLIC ${zlib_folder})
target_compile_options(zlib_for_web PRIVATE -w)
add_library(ZLIB::ZLIB ALIAS zlib_for_web)
