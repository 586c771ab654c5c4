"""The recipe of lamina for Conan 2: `conan create packaging/conan --build=missing` in a clone."""

import pathlib
import re

from conan import ConanFile
from conan.tools.build import check_min_cppstd
from conan.tools.cmake import CMake, CMakeDeps, CMakeToolchain, cmake_layout
from conan.tools.files import copy, load, rm, rmdir
from conan.tools.gnu import PkgConfigDeps

required_conan_version = ">=2.0"


class Lamina(ConanFile):
    name = "lamina"
    description = "Two-dimensional meshes for viscous flow round airfoils: boundary layers and Delaunay triangles"
    license = "MIT"
    topics = ("mesh", "delaunay", "triangulation", "cfd", "airfoil")
    package_type = "library"
    settings = "os", "arch", "compiler", "build_type"
    # Without the mesher lamina is the triangulation alone, lamina::delaunay. CGNS is not asked for unless wanted: its
    # recipe in Conan Center is still one for Conan 1.
    options = {"shared": [True, False], "mesher": [True, False], "cgns": [True, False], "tools": [True, False]}
    default_options = {"shared": False, "mesher": True, "cgns": False, "tools": False}

    def set_version(self):
        project = load(self, pathlib.Path(self.recipe_folder, "../../CMakeLists.txt"))
        self.version = re.search(r"project\(lamina VERSION ([0-9.]+)", project)[1]

    def export_sources(self):
        root = pathlib.Path(self.recipe_folder, "../..")
        for pattern in "CMakeLists.txt", "LICENSE", "cmake/*", "include/*", "share/*", "src/*":
            copy(self, pattern, root, self.export_sources_folder)

    def configure(self):
        if not self.options.mesher:
            del self.options.cgns
            del self.options.tools

    def layout(self):
        cmake_layout(self)

    def requirements(self):
        self.requires("onetbb/[>=2021.8]")
        if self.options.mesher:
            self.requires("cairo/[>=1.16]")
            self.requires("eigen/[>=3.4]")
            self.requires("fmt/[>=9]")
            self.requires("zlib/[>=1.2.11]")
        if self.options.get_safe("cgns"):
            self.requires("cgns/[>=3.4]")
        if self.options.get_safe("tools"):  # headers that the program is compiled with, and no library
            for headers in "cli11/[>=2.1]", "nlohmann_json/[>=3.11]", "tomlplusplus/[>=3.3]":
                self.requires(headers, visible=False)

    def build_requirements(self):
        self.tool_requires("cmake/[>=3.25]")
        if self.options.mesher and not self.conf.get("tools.gnu:pkg_config"):
            self.tool_requires("pkgconf/[>=2]")

    def validate(self):
        check_min_cppstd(self, 20)

    def generate(self):
        variables = CMakeToolchain(self)
        variables.cache_variables.update({
            "LAMINA_COMPONENTS": "lamina" if self.options.mesher else "delaunay",
            "LAMINA_CGNS": bool(self.options.get_safe("cgns")),
            "LAMINA_APP": bool(self.options.get_safe("tools")),
            "LAMINA_TESTS": False,
        })
        variables.generate()
        dependencies = CMakeDeps(self)
        dependencies.set_property("cgns", "cmake_find_mode", "module")
        dependencies.set_property("cgns", "cmake_file_name", "CGNS")
        dependencies.set_property("cgns", "cmake_target_name", "CGNS::CGNS")
        dependencies.generate()
        PkgConfigDeps(self).generate()  # cairo

    def build(self):
        cmake = CMake(self)
        cmake.configure()
        cmake.build()

    def package(self):
        CMake(self).install()
        copy(self, "LICENSE", self.source_folder, pathlib.Path(self.package_folder, "licenses"))
        # Conan writes what tells CMake of the package. The other files say below which libraries there are.
        rmdir(self, pathlib.Path(self.package_folder, "lib/cmake"))
        rm(self, "*.la", self.package_folder, recursive=True)

    def package_info(self):
        component = self.cpp_info.components
        self._add("core", [], ["onetbb::onetbb"])
        self._add("sizing", ["core"])
        self._add("delaunay", ["core", "sizing"])
        if self.options.mesher:
            self._add("mesh", ["core"], ["fmt::fmt"])
            self._add("io", ["core", "sizing", "mesh"], ["zlib::zlib", *(["cgns::cgns"] if self.options.cgns else [])])
            below = [name for name in component]
            self._add("lamina", below, ["cairo::cairo", "eigen::eigen"])
            known = {library for name in below for library in component[name].libs}
            component["lamina"].libs = [library for library in self._libraries("lamina") if library not in known]

    def _add(self, name, below, requires=()):
        component = self.cpp_info.components[name]
        component.libs = [f"lamina_{name}"]
        component.requires = [*below, *requires]
        component.cxxflags = ["-ffp-contract=off"]  # as the package of CMake has it: signs must not depend on it

    def _libraries(self, name):
        """Returns the libraries that the file of pkg-config names, each before those it needs."""
        text = load(self, pathlib.Path(self.package_folder, f"lib/pkgconfig/{name}.pc"))
        return re.findall(r"-l(lamina_\w+)", text)
