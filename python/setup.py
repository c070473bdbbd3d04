# SPDX-FileCopyrightText: 2026 the swiftlet authors
# SPDX-License-Identifier: BSD-3-Clause
"""Builds the extension modules by CMake: pip install --no-build-isolation . needs no network.

SWIFTLET_CMAKE_ARGS adds to the configuration, for example -DSWIFTLET_LOD=OFF for a package without CGAL, hence without its GPL.
"""

import os
import re
import shlex
import subprocess
import sys
from pathlib import Path

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

SOURCE = Path(__file__).resolve().parent.parent


class ByCMake(build_ext):
    """One configuration for all extensions, installed to where setuptools wants them."""

    def run(self) -> None:
        build = Path(self.build_temp).resolve() / "cmake"
        package = Path(self.get_ext_fullpath("swiftlet._runtime")).resolve().parent
        off = [f"-DSWIFTLET_{what}=OFF" for what in ("TESTS", "BENCH", "ADAPTERS", "TOOL")]
        subprocess.run(
            ["cmake", "-S", SOURCE, "-B", build, "-DCMAKE_BUILD_TYPE=Release", "-DSWIFTLET_PYTHON=ON", *off,
             f"-DPython_EXECUTABLE={sys.executable}", *shlex.split(os.environ.get("SWIFTLET_CMAKE_ARGS", ""))],
            check=True,
        )  # fmt: skip
        subprocess.run(
            ["cmake", "--build", build, "--parallel", str(os.cpu_count()), "--target", "swiftlet_python"], check=True
        )
        package.mkdir(parents=True, exist_ok=True)
        for module in (build / "python/swiftlet").glob("_*.so"):
            self.copy_file(str(module), str(package / module.name))


version = re.search(r"project\(swiftlet VERSION ([\d.]+)", (SOURCE / "CMakeLists.txt").read_text())
setup(version=version[1], ext_modules=[Extension("swiftlet._runtime", [])], cmdclass={"build_ext": ByCMake})
