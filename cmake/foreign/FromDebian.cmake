# Debian's headers for another C library than Debian's: each folder of them is linked into a folder of its own, since beside
# them in /usr/include stand the headers of the native C library.
#
#   headers_of_debian(TARGET folder...)    the imported target TARGET, with the folders of /usr/include as its headers
function(headers_of_debian target)
  add_library(${target} INTERFACE IMPORTED)
  set(headers ${CMAKE_BINARY_DIR}/headers)
  file(MAKE_DIRECTORY ${headers})
  foreach(folder IN LISTS ARGN)
    file(CREATE_LINK /usr/include/${folder} ${headers}/${folder} SYMBOLIC)
  endforeach()
  target_include_directories(${target} INTERFACE ${headers})
endfunction()
