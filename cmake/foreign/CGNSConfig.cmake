# CGNS with HDF5, static, as ./dev wheel builds them of Debian's sources into build/foreign/installed.
set(installed ${CMAKE_SOURCE_DIR}/build/foreign/installed)
add_library(CGNS::CGNS STATIC IMPORTED)
set_target_properties(CGNS::CGNS PROPERTIES
  IMPORTED_LOCATION ${installed}/lib/libcgns.a
  INTERFACE_INCLUDE_DIRECTORIES ${installed}/include
  INTERFACE_LINK_LIBRARIES "${installed}/lib/libhdf5.a;m;dl")
