# SPDX-FileCopyrightText: 2026 the swiftlet authors
# SPDX-License-Identifier: BSD-3-Clause
"""What the recipe uses of Conan 2, after its documentation, so that the recipe runs where there is no Conan. It notes what the
recipe asks for; CMake is the real one. An attribute or property that Conan does not have is an error."""
import fnmatch
import os
import pathlib
import shutil
import subprocess
import sys
import types

PROPERTIES = {"cmake_find_mode", "cmake_file_name", "cmake_target_name", "pkg_config_name", "cmake_build_modules"}


class Options:
    def __init__(self, values):
        self.__dict__.update(values)


class CppInfo:
    __slots__ = ("libs", "builddirs", "system_libs", "properties")

    def __init__(self):
        self.libs, self.builddirs, self.system_libs, self.properties = [], [], [], {}

    def set_property(self, name, value):
        assert name in PROPERTIES, name
        self.properties[name] = value


class ConanFile:
    default_options = {}

    def __init__(self, recipe_folder, work, **options):
        self.recipe_folder = str(recipe_folder)
        self.export_sources_folder = self.source_folder = str(work / "source")
        self.build_folder, self.package_folder = str(work / "build"), str(work / "package")
        self.options = Options({**self.default_options, **options})
        self.settings = types.SimpleNamespace(os="Linux", arch="x86_64", build_type="Release")
        self.cpp_info, self.required, self.cache_variables, self.laid_out = CppInfo(), {}, {}, False
        self.tested_reference_str, self.cpp = "swiftlet/0", types.SimpleNamespace()

    def requires(self, reference, *, transitive_headers=None, transitive_libs=None, visible=True):
        name, version = reference.split("/")
        self.required[name] = version

    def run(self, command, env=None):
        subprocess.run(command, shell=True, check=True)


class CMake:
    def __init__(self, conanfile):
        self.conanfile = conanfile

    def configure(self):
        c = self.conanfile
        subprocess.run(["cmake", "-S", c.source_folder, "-B", c.build_folder, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
                        f"-DCMAKE_INSTALL_PREFIX={c.package_folder}", "-DCMAKE_INSTALL_LIBDIR=lib",
                        *(f"-D{k}={'ON' if v else 'OFF'}" for k, v in c.cache_variables.items())], check=True)

    def build(self):
        subprocess.run(["cmake", "--build", self.conanfile.build_folder, "--parallel"], check=True)

    def install(self):
        subprocess.run(["cmake", "--install", self.conanfile.build_folder], check=True)


class CMakeToolchain:
    def __init__(self, conanfile):
        self.conanfile, self.cache_variables = conanfile, {}

    def generate(self):
        self.conanfile.cache_variables = self.cache_variables


class CMakeDeps:
    def __init__(self, conanfile):
        pass

    def set_property(self, dependency, name, value):
        assert name in PROPERTIES, name

    def generate(self):
        pass


def cmake_layout(conanfile):
    conanfile.laid_out = True


def copy(conanfile, pattern, src, dst):
    """The pattern is matched against whole paths below src, as Conan does: its star passes slashes."""
    src, copied = pathlib.Path(src), []
    head = src / pattern.split("*")[0].rpartition("/")[0]
    for path in [p for p in head.rglob("*") if p.is_file()] if "/" in pattern else [p for p in src.iterdir() if p.is_file()]:
        name = path.relative_to(src).as_posix()
        if fnmatch.fnmatch(name, pattern):
            to = pathlib.Path(dst) / name
            to.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(path, to)
            copied.append(name)
    assert copied, f"{pattern} is in no file's name"
    return copied


def load(conanfile, path):
    return pathlib.Path(path).read_text(encoding="utf-8")


def module(name, **contents):
    made = types.ModuleType(name)
    made.__dict__.update(contents)
    sys.modules[name] = made


def install():
    module("conan", ConanFile=ConanFile)
    module("conan.tools")
    module("conan.tools.build", check_min_cppstd=lambda conanfile, standard: None, can_run=lambda conanfile: True)
    module("conan.tools.cmake", CMake=CMake, CMakeDeps=CMakeDeps, CMakeToolchain=CMakeToolchain, cmake_layout=cmake_layout)
    module("conan.tools.files", copy=copy, load=load)
