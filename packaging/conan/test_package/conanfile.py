"""Builds the examples with the package, and runs them and the program."""

import os

from conan import ConanFile
from conan.tools.build import can_run
from conan.tools.cmake import CMake, cmake_layout


class Examples(ConanFile):
    settings = "os", "arch", "compiler", "build_type"
    generators = "CMakeDeps", "CMakeToolchain"
    test_type = "explicit"

    def requirements(self):
        self.requires(self.tested_reference_str, run=True)

    def layout(self):
        cmake_layout(self)

    def build(self):
        cmake = CMake(self)
        cmake.configure(variables={"MESHER": str(self.dependencies["lamina"].options.mesher)})
        cmake.build()

    def test(self):
        if not can_run(self):
            return
        options = self.dependencies["lamina"].options
        self.run(os.path.join(self.cpp.build.bindir, "plate_with_hole"), env="conanrun")
        if options.mesher:
            self.run(f"{os.path.join(self.cpp.build.bindir, 'mesh_naca0012')} naca0012.vtu", env="conanrun")
        if options.get_safe("tools"):
            mesh = "naca0012.cgns" if options.cgns else "naca0012.su2"
            self.run(f"lamina mesh naca:0012 -o {mesh} && lamina check {mesh}", env="conanrun")
