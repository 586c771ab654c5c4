# Gives all targets what the C++ library of Debian's Emscripten lacks: standard_library.hpp says what and why.
add_library(lamina_standard_library STATIC ${CMAKE_CURRENT_LIST_DIR}/standard_library.cpp)
target_compile_features(lamina_standard_library PRIVATE cxx_std_20)
target_link_libraries(lamina_standard_library PRIVATE fmt::fmt)
set(header ${CMAKE_CURRENT_LIST_DIR}/standard_library.hpp)
add_compile_options($<$<COMPILE_LANGUAGE:CXX>:-include$<SEMICOLON>${header}>)
link_libraries(lamina_standard_library)
