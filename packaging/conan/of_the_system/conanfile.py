"""Packages that stand for those of Conan Center, and lead to the libraries of this system: for tests without a network.

`conan create packaging/conan/of_the_system --name fmt --version 9.1.0`
"""

from conan import ConanFile

# Libraries, and the file and the target of CMake that Conan Center's recipe gives them.
PACKAGES = {
    "cairo": (["cairo"], "cairo", "cairo::cairo"),
    "cgns": (["cgns"], "cgns", "cgns::cgns"),
    "cli11": ([], "CLI11", "CLI11::CLI11"),
    "cmake": ([], "cmake", "cmake::cmake"),
    "eigen": ([], "Eigen3", "Eigen3::Eigen"),
    "fmt": (["fmt"], "fmt", "fmt::fmt"),
    "nlohmann_json": ([], "nlohmann_json", "nlohmann_json::nlohmann_json"),
    "onetbb": (["tbb"], "TBB", "TBB::tbb"),
    "pkgconf": ([], "pkgconf", "pkgconf::pkgconf"),
    "tomlplusplus": (["tomlplusplus"], "tomlplusplus", "tomlplusplus::tomlplusplus"),
    "zlib": (["z"], "ZLIB", "ZLIB::ZLIB"),
}
FOLDERS = {"cairo": ["/usr/include/cairo"], "eigen": ["/usr/include/eigen3"]}


class OfTheSystem(ConanFile):
    package_type = "shared-library"

    def package_info(self):
        libraries, file, target = PACKAGES[self.name]
        self.cpp_info.bindirs = self.cpp_info.libdirs = []
        self.cpp_info.includedirs = FOLDERS.get(self.name, [])
        self.cpp_info.system_libs = libraries
        self.cpp_info.set_property("cmake_file_name", file)
        self.cpp_info.set_property("cmake_target_name", target)
        self.cpp_info.set_property("cmake_find_mode", "both")
