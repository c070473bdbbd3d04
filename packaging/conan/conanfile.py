# SPDX-FileCopyrightText: 2026 the swiftlet authors
# SPDX-License-Identifier: BSD-3-Clause
"""A recipe for Conan 2 that packs the tree it lies in: packaging/README.md."""
import os
import re

from conan import ConanFile
from conan.tools.build import check_min_cppstd
from conan.tools.cmake import CMake, CMakeDeps, CMakeToolchain, cmake_layout
from conan.tools.files import copy, load

required_conan_version = ">=2.0"


class Swiftlet(ConanFile):
    name = "swiftlet"
    description = "Multi-level-of-detail proximity kernel for convex polyhedra"
    license = "BSD-3-Clause"  # what links swiftlet::lod, and the tool with it, comes under CGAL's GPL
    topics = ("collision-detection", "distance", "convex", "geometry", "robotics")
    package_type = "library"
    settings = "os", "arch", "compiler", "build_type"
    options = {"shared": [True, False], "builder": [True, False], "tool": [True, False]}
    default_options = {"shared": False, "builder": False, "tool": False}

    @property
    def _root(self):
        return os.path.join(self.recipe_folder, "..", "..")

    def set_version(self):
        listing = load(self, os.path.join(self._root, "CMakeLists.txt"))
        self.version = re.search(r"project\(swiftlet VERSION ([0-9.]+)", listing).group(1)

    def export_sources(self):
        for pattern in ("CMakeLists.txt", "packages.cmake", "package.xml", "swiftlet*", "LICENSE", "CHANGELOG.md", "lut/*",
                        "march/*", "bvh/*", "scene/*", "lod/*", "tool/*", "tests/data/models/fat_*.swl"):
            copy(self, pattern, src=self._root, dst=self.export_sources_folder)

    def layout(self):
        cmake_layout(self)

    def requirements(self):
        self.requires("eigen/3.4.0", transitive_headers=True)
        if self.options.builder:
            # The installed configuration asks for CGAL, which the static library links.
            self.requires("cgal/[>=5.5 <6]", transitive_headers=True, transitive_libs=True)
        if self.options.tool:
            self.requires("cli11/[>=2.1 <3]", visible=False)
            self.requires("nlohmann_json/[>=3.11 <4]", visible=False)

    def validate(self):
        check_min_cppstd(self, 20)

    def generate(self):
        toolchain = CMakeToolchain(self)
        toolchain.cache_variables["SWIFTLET_LOD"] = bool(self.options.builder)
        toolchain.cache_variables["SWIFTLET_TOOL"] = bool(self.options.tool)
        for left_out in ("SWIFTLET_ADAPTERS", "SWIFTLET_BENCH", "SWIFTLET_C", "SWIFTLET_TESTS"):
            toolchain.cache_variables[left_out] = False
        toolchain.generate()
        dependencies = CMakeDeps(self)
        dependencies.set_property("cgal", "cmake_file_name", "CGAL")
        dependencies.generate()

    def build(self):
        cmake = CMake(self)
        cmake.configure()
        cmake.build()

    def package(self):
        copy(self, "LICENSE", src=self.source_folder, dst=os.path.join(self.package_folder, "licenses"))
        CMake(self).install()

    def package_info(self):
        # CMake finds the package's own configuration, with its components; the rest is for other build systems.
        self.cpp_info.set_property("cmake_find_mode", "none")
        self.cpp_info.builddirs = [os.path.join("lib", "cmake", "swiftlet")]
        self.cpp_info.set_property("pkg_config_name", "swiftlet")
        self.cpp_info.libs = (["swiftlet_lod"] if self.options.builder else []) + [
            "swiftlet_scene", "swiftlet_bvh", "swiftlet_march", "swiftlet_lut"]
        if self.settings.os in ("Linux", "FreeBSD"):
            self.cpp_info.system_libs = ["pthread"]
