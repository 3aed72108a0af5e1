# SPDX-License-Identifier: Apache-2.0
"""libkoksma for Conan 2: `conan create packaging/conan`. Random123's headers are the system's, or in RANDOM123_INCLUDE_DIR."""
import os

from conan import ConanFile
from conan.tools.cmake import CMake, CMakeToolchain, cmake_layout
from conan.tools.files import copy, rm, rmdir


class Koksma(ConanFile):
    name = "koksma"
    version = "0.1.0"
    license = "Apache-2.0"
    description = "Sampling patterns for ray tracing and exact discrepancies"
    package_type = "library"
    settings = "os", "arch", "compiler", "build_type"
    options = {"shared": [True, False]}
    default_options = {"shared": False}

    def configure(self):
        self.settings.rm_safe("compiler.cppstd")
        self.settings.rm_safe("compiler.libcxx")

    def export_sources(self):
        for part in ("CMakeLists.txt", "cmake/*", "src/*", "include/*", "tools/*", "*.md", "LICENSE", "docs/*", "examples/*", "ports/*",
                     "studies/README.md"):
            copy(self, part, os.path.join(self.recipe_folder, "..", ".."), self.export_sources_folder)

    def layout(self):
        cmake_layout(self)

    def generate(self):
        tools = CMakeToolchain(self)
        tools.variables["KOKSMA_LAB"] = False
        tools.variables["BUILD_TESTING"] = False
        if "RANDOM123_INCLUDE_DIR" in os.environ:
            tools.variables["RANDOM123_INCLUDE_DIR"] = os.environ["RANDOM123_INCLUDE_DIR"]
        tools.generate()

    def build(self):
        cmake = CMake(self)
        cmake.configure()
        cmake.build()

    def package(self):
        copy(self, "LICENSE", self.source_folder, os.path.join(self.package_folder, "licenses"))
        CMake(self).install()  # both kinds of library, and files for CMake and pkg-config, in whose place Conan writes its own
        libraries = os.path.join(self.package_folder, "lib")
        rm(self, "*.a" if self.options.shared else "*.so*", libraries)
        for folder in ("cmake", "pkgconfig"):
            rmdir(self, os.path.join(libraries, folder))

    def package_info(self):
        self.cpp_info.set_property("cmake_file_name", "koksma")
        self.cpp_info.set_property("cmake_target_name", "koksma::koksma")
        self.cpp_info.libs = ["koksma"]
        if self.settings.os == "Linux":
            self.cpp_info.system_libs = ["m", "pthread", "dl"]
