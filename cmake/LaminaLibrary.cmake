# One folder of src/ is one namespace and one library.
#
#   lamina_library(FOLDER COMPONENT component SOURCES file... [DEPENDS folder...])
#
# makes the target lamina_FOLDER (lamina::FOLDER to users). Its code lives in the namespace lamina::FOLDER, but for what
# include/lamina declares, which lives in lamina. DEPENDS lists the folders whose headers it may include; folders that
# these depend on come along. tools/check_includes.py reads the same lists and fails where a folder includes another one.
# COMPONENT is the part of the package that installs the library: find_package(lamina COMPONENTS component).

add_library(lamina_flags INTERFACE)
target_compile_features(lamina_flags INTERFACE cxx_std_20)
set(lamina_gcc_like "$<CXX_COMPILER_ID:GNU,Clang,AppleClang>")
target_compile_options(lamina_flags INTERFACE
  "$<${lamina_gcc_like}:-Wall;-Wextra;-Wpedantic;-Wshadow>"
  "$<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>"  # wrong alarms of GCC 12 in std::string
)
if(LAMINA_ASSERTIONS)
  target_compile_options(lamina_flags INTERFACE
    "$<${lamina_gcc_like}:-UNDEBUG>"  # comes behind the -DNDEBUG of Release
    "$<$<CXX_COMPILER_ID:GNU>:-Wno-stringop-overflow>"  # wrong alarms of GCC 12 behind assertions of fmt
  )
endif()
if(LAMINA_SANITIZE)
  target_compile_options(lamina_flags INTERFACE
    -fsanitize=${LAMINA_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  target_link_options(lamina_flags INTERFACE -fsanitize=${LAMINA_SANITIZE})
  if(LAMINA_SANITIZE MATCHES address)
    # The sanitizer of addresses stops at null pointers and beyond objects, too, and what x86 reads at any address tests
    # cannot tell from what is aligned: these checks take a third of the time of compiling.
    target_compile_options(lamina_flags INTERFACE -fno-sanitize=null,object-size,vptr,alignment,pointer-overflow)
  endif()
endif()
if(LAMINA_FUZZ)
  target_compile_options(lamina_flags INTERFACE -fsanitize=fuzzer-no-link)
endif()

function(lamina_library folder)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "COMPONENT" "SOURCES;DEPENDS")
  set(target lamina_${folder})
  add_library(${target} ${arg_SOURCES})
  add_library(lamina::${folder} ALIAS ${target})
  set_target_properties(${target} PROPERTIES
    EXPORT_NAME ${folder}
    CXX_EXTENSIONS OFF
    CXX_VISIBILITY_PRESET hidden
    VISIBILITY_INLINES_HIDDEN ON
    POSITION_INDEPENDENT_CODE ON
    VERSION ${PROJECT_VERSION}
    SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
  target_compile_features(${target} PUBLIC cxx_std_20)
  target_include_directories(${target}
    PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include> $<BUILD_INTERFACE:${PROJECT_BINARY_DIR}/include>
           $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>
    PRIVATE ${PROJECT_SOURCE_DIR}/src)
  # Results may not depend on the compiler's liking for fused operations, in headers neither: contraction is off.
  target_compile_options(${target} PUBLIC "$<${lamina_gcc_like}:-ffp-contract=off>")
  # One build serves the program, the tests and the Python module. Nobody replaces single functions of a library, so
  # position-independent code may inline them as other code does; it then costs nothing.
  target_compile_options(${target} PRIVATE "$<${lamina_gcc_like}:-fno-semantic-interposition>")
  target_link_libraries(${target} PRIVATE $<BUILD_INTERFACE:lamina_flags>)
  list(TRANSFORM arg_DEPENDS PREPEND lamina::)
  target_link_libraries(${target} PUBLIC ${arg_DEPENDS})
  if(LAMINA_INSTALL)
    install(TARGETS ${target} EXPORT lamina-${arg_COMPONENT} COMPONENT ${arg_COMPONENT})
  endif()
endfunction()
