# toml++, whose headers need no compiled library unless told so.
include(${CMAKE_CURRENT_LIST_DIR}/FromDebian.cmake)
headers_of_debian(tomlplusplus::tomlplusplus toml++)
