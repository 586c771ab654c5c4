# CLI11: headers alone.
include(${CMAKE_CURRENT_LIST_DIR}/FromDebian.cmake)
headers_of_debian(CLI11::CLI11 CLI)
