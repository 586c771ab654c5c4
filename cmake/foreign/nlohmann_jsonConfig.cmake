# JSON: headers alone.
include(${CMAKE_CURRENT_LIST_DIR}/FromDebian.cmake)
headers_of_debian(nlohmann_json::nlohmann_json nlohmann)
