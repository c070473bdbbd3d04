# SPDX-FileCopyrightText: 2026 the swiftlet authors
# SPDX-License-Identifier: BSD-3-Clause
"""recipes.py SOURCE WORK: the recipes of the package managers say what CMake says, and are of the form that each manager reads.
CMakeLists.txt is the one place of version and description. Nothing is compiled here; tests/packaging/run does."""
import hashlib
import importlib.util
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tarfile
import unittest
import xml.etree.ElementTree

import conan_stand_in

SOURCE, WORK = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
PORT = SOURCE / "packaging/vcpkg/ports/swiftlet"
IDENTIFIER = r"[a-z0-9]+(-[a-z0-9]+)*"


def read(name):
    return (SOURCE / name).read_text(encoding="utf-8")


def found_packages(folder):
    """What a folder's listing asks CMake to find, and the least version of it or ""."""
    return dict(re.findall(r"^ *find_package\((\w+) ?([0-9.]*) REQUIRED", read(f"{folder}/CMakeLists.txt"), re.M))


class Truth:
    listing = read("CMakeLists.txt")
    version, description = re.search(r"^project\(swiftlet VERSION (\S+) .*DESCRIPTION \"(.*)\"\)", listing, re.M).groups()
    licence = re.search(r"SPDX-License-Identifier: (\S+)", listing).group(1)
    options = set(re.findall(r"^option\((SWIFTLET_\w+)", listing, re.M))
    runtime, builder, tool = found_packages("."), found_packages("lod"), found_packages("tool")


# CMake's names of packages, and those of vcpkg, Conan and rosdep.
NAMES = {
    "Eigen3": ("eigen3", "eigen", "eigen"),
    "CGAL": ("cgal", "cgal", "cgal"),
    "CLI11": ("cli11", "cli11", "cli11"),
    "nlohmann_json": ("nlohmann-json", "nlohmann_json", "nlohmann-json-dev"),
}


def named(packages, manager):
    return {NAMES[package][manager] for package in packages}


class Version(unittest.TestCase):
    def test_the_truth_is_read(self):
        self.assertRegex(Truth.version, r"^\d+\.\d+\.\d+$")
        self.assertEqual((set(Truth.runtime), set(Truth.builder), set(Truth.tool)),
                         ({"Eigen3"}, {"CGAL"}, {"CLI11", "nlohmann_json"}))
        self.assertIn("SWIFTLET_LOD", Truth.options)
        self.assertEqual(Truth.licence, "BSD-3-Clause")
        self.assertIn("Neither the name", read("LICENSE"))  # the third clause

    def test_every_page_that_names_one_names_the_same(self):
        self.assertEqual(re.search(r"^version: (.*)$", read("CITATION.cff"), re.M).group(1), Truth.version)
        self.assertEqual(re.search(r"^license: (.*)$", read("CITATION.cff"), re.M).group(1), Truth.licence)
        self.assertEqual(re.search(r"^## ([0-9.]+)", read("CHANGELOG.md"), re.M).group(1), Truth.version)


class Ros(unittest.TestCase):
    """package.xml against REP 149 and its schema."""
    ORDER = [{"name"}, {"version"}, {"description"}, {"maintainer"}, {"license"}, {"url"}, {"author"},
             {"build_depend", "build_export_depend", "buildtool_depend", "buildtool_export_depend", "exec_depend", "depend",
              "doc_depend", "test_depend", "conflict", "replace"}, {"group_depend"}, {"member_of_group"}, {"export"}]

    def setUp(self):
        self.package = xml.etree.ElementTree.parse(SOURCE / "package.xml").getroot()

    def texts(self, *tags):
        return [child.text for child in self.package if child.tag in tags]

    def test_says_what_cmake_says(self):
        self.assertEqual(self.texts("name"), ["swiftlet"])
        self.assertEqual(self.texts("version"), [Truth.version])
        self.assertEqual(self.texts("description"), [Truth.description])
        self.assertEqual(self.texts("license"), [Truth.licence])
        licence = self.package.find("license").attrib
        self.assertTrue((SOURCE / licence["file"]).is_file())

    def test_has_the_tags_of_format_3_in_their_order(self):
        self.assertEqual((self.package.tag, self.package.attrib), ("package", {"format": "3"}))
        places = []
        for child in self.package:
            self.assertIn(child.tag, set().union(*self.ORDER))
            places.append([child.tag in tags for tags in self.ORDER].index(True))
        self.assertEqual(places, sorted(places))
        for once in ("name", "version", "description", "export"):
            self.assertEqual(len(self.texts(once)), 1)
        for child in self.package.findall("maintainer"):
            self.assertRegex(child.attrib["email"], r"^[-\w%+]+(\.[-\w%+]+)*@[-a-zA-Z0-9%]+(\.[-a-zA-Z0-9%]+)*\.[a-zA-Z]{2,}$")
        self.assertGreaterEqual(len(self.texts("maintainer")), 1)
        self.assertRegex(self.texts("name")[0], r"^[a-z](_?[a-z0-9]+)*$")

    def test_depends_on_what_cmake_finds(self):
        self.assertEqual(set(self.texts("depend")), named([*Truth.runtime, *Truth.builder], 2))  # the installed libraries too
        self.assertEqual(set(self.texts("build_depend")), named(Truth.tool, 2))
        self.assertEqual(self.texts("test_depend"), ["gtest"])
        self.assertEqual(self.texts("buildtool_depend"), ["cmake"])
        self.assertEqual(self.package.find("export/build_type").text, "cmake")

    def test_ros_own_parser_takes_it(self):
        # Debian's python3-catkin-pkg, which the python of another place on the path does not see.
        code = "import sys; from catkin_pkg.package import parse_package as p; x = []; p(sys.argv[1], warnings=x); sys.exit(len(x))"
        if subprocess.run(["/usr/bin/python3", "-c", "import catkin_pkg"], capture_output=True).returncode != 0:
            self.skipTest("python3-catkin-pkg is not installed")
        done = subprocess.run(["/usr/bin/python3", "-c", code, str(SOURCE / "package.xml")], capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)


class Vcpkg(unittest.TestCase):
    FIELDS = {"name", "version", "description", "license", "supports", "dependencies", "features", "default-features", "homepage",
              "port-version"}
    DEPENDENCY = {"name", "features", "host", "default-features", "platform", "version>="}

    def setUp(self):
        self.manifest = json.loads((PORT / "vcpkg.json").read_text())

    def needed(self, where):
        """Name and least version of what is not a helper of vcpkg's own."""
        all_of = [{"name": d} if isinstance(d, str) else d for d in where["dependencies"]]
        return {d["name"]: d.get("version>=", "") for d in all_of if not d.get("host")}

    def test_says_what_cmake_says(self):
        self.assertEqual(self.manifest["name"], PORT.name)
        self.assertEqual(self.manifest["version"], Truth.version)
        self.assertEqual(self.manifest["description"], Truth.description)
        self.assertEqual(self.manifest["license"], Truth.licence)

    def test_depends_on_what_cmake_finds(self):
        for where, packages in ((self.manifest, Truth.runtime), (self.manifest["features"]["builder"], Truth.builder),
                                (self.manifest["features"]["tool"], Truth.tool)):
            self.assertEqual(set(self.needed(where)), named(packages, 0))
            for package, version in packages.items():
                self.assertTrue(self.needed(where)[NAMES[package][0]].startswith(version))

    def test_is_of_the_form_of_its_schema(self):
        self.assertLessEqual(set(self.manifest), self.FIELDS)
        for feature, content in self.manifest["features"].items():
            self.assertRegex(feature, f"^{IDENTIFIER}$")
            self.assertNotIn(feature, ("core", "default"))
            self.assertLessEqual(set(content), {"description", "dependencies", "supports"})
            self.assertTrue(content["description"])
        for where in (self.manifest, *self.manifest["features"].values()):
            names = [d if isinstance(d, str) else d["name"] for d in where["dependencies"]]
            self.assertEqual(names, sorted(names))  # as `vcpkg format-manifest` leaves it
            for d in where["dependencies"]:
                self.assertRegex(d if isinstance(d, str) else d["name"], f"^{IDENTIFIER}$")
                self.assertLessEqual(set(d if isinstance(d, dict) else ()), self.DEPENDENCY)
        self.assertNotIn("default-features", self.manifest)  # without a word from the user nothing comes under the GPL

    def run_port(self, features, digest):
        """Of an archive with nothing but the licence in it."""
        work = WORK / "vcpkg"
        shutil.rmtree(work, ignore_errors=True)
        shutil.copytree(PORT, work / "swiftlet")
        folder = f"swiftlet-{Truth.version}"
        archive = work / f"{folder}.tar.gz"
        with tarfile.open(archive, "w:gz") as tar:
            tar.add(SOURCE / "LICENSE", f"{folder}/LICENSE")
        portfile = work / "swiftlet/portfile.cmake"
        text = portfile.read_text()
        self.assertEqual(text.count("SHA512 0\n"), 1)
        if digest:
            portfile.write_text(text.replace("SHA512 0\n", f"SHA512 {hashlib.sha512(archive.read_bytes()).hexdigest()}\n"))
        done = subprocess.run(["cmake", f"-DPORT_DIR={work}/swiftlet", f"-DDOWNLOADS={work}", f"-DWORK={work}", "-DDRY=ON",
                               f"-DFEATURES={';'.join(features)}", "-P", SOURCE / "tests/packaging/vcpkg.cmake"],
                              capture_output=True, text=True)
        return done, dict(re.findall(r"-D(\w+)=(\w+)", (work / "options").read_text())) if done.returncode == 0 else {}

    def test_the_portfile_runs_and_its_options_are_cmakes(self):
        for features in ([], ["builder"], ["tool"], ["builder", "tool"]):
            done, options = self.run_port(features, True)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertLessEqual(set(options), Truth.options)
            self.assertEqual([options["SWIFTLET_LOD"], options["SWIFTLET_TOOL"]],
                             ["ON" if f in features else "OFF" for f in ("builder", "tool")])
            # All that is not asked for is off, whatever the defaults are; what installs is on.
            self.assertEqual({k for k in Truth.options if options.get(k, "") != "OFF"} - {"SWIFTLET_LOD", "SWIFTLET_TOOL"},
                             {"SWIFTLET_INSTALL", "SWIFTLET_FUZZ", "SWIFTLET_PYTHON", "SWIFTLET_BVH", "SWIFTLET_SCENE"})

    def test_an_archive_of_another_digest_is_refused(self):
        done, _ = self.run_port([], False)
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("and the port wants 0", done.stderr)

    def test_usage_names_what_is_exported(self):
        usage = (PORT / "usage").read_text()
        for target in re.findall(r"swiftlet::(\w+)", usage):
            self.assertIn(f"swiftlet_library({target} ", read(f"{target}/CMakeLists.txt"))
        self.assertIn("find_package(swiftlet CONFIG REQUIRED COMPONENTS march)", usage)


class Conan(unittest.TestCase):
    def recipe(self, folder="packaging/conan", **options):
        conan_stand_in.install()
        spec = importlib.util.spec_from_file_location("conanfile", SOURCE / folder / "conanfile.py")
        module = importlib.util.module_from_spec(spec)
        sys.dont_write_bytecode = True
        spec.loader.exec_module(module)
        (kind,) = [v for v in vars(module).values() if isinstance(v, type) and issubclass(v, conan_stand_in.ConanFile)
                   and v is not conan_stand_in.ConanFile]
        work = WORK / "conan"
        shutil.rmtree(work, ignore_errors=True)
        return kind(SOURCE / folder, work, **options)

    def test_says_what_cmake_says(self):
        recipe = self.recipe()
        recipe.set_version()
        self.assertEqual((recipe.name, recipe.version), ("swiftlet", Truth.version))
        self.assertEqual((recipe.description, recipe.license), (Truth.description, Truth.licence))
        self.assertEqual(set(recipe.default_options), set(recipe.options.__dict__))
        self.assertFalse(any(recipe.default_options.values()))

    def test_requires_what_cmake_finds(self):
        for options, packages in (({}, Truth.runtime), ({"builder": True}, Truth.runtime | Truth.builder),
                                  ({"tool": True}, Truth.runtime | Truth.tool)):
            recipe = self.recipe(**options)
            recipe.requirements()
            self.assertEqual(set(recipe.required), named(packages, 1))
            for package, version in packages.items():
                self.assertIn(version, recipe.required[NAMES[package][1]])

    def test_its_options_are_cmakes(self):
        for on in (False, True):
            recipe = self.recipe(builder=on, tool=on)
            recipe.generate()
            self.assertEqual(Truth.options - set(recipe.cache_variables),
                             {"SWIFTLET_INSTALL", "SWIFTLET_FUZZ", "SWIFTLET_PYTHON", "SWIFTLET_BVH", "SWIFTLET_SCENE"})
            self.assertEqual({k for k, v in recipe.cache_variables.items() if v}, {"SWIFTLET_LOD", "SWIFTLET_TOOL"} if on else set())

    def test_what_it_exports_can_be_configured(self):
        recipe = self.recipe(tool=True)
        recipe.validate()
        recipe.layout()
        recipe.export_sources()
        recipe.generate()
        conan_stand_in.CMake(recipe).configure()
        exported = WORK / "conan/source"
        self.assertFalse((exported / "bench").exists())
        for folder in ("lut", "march", "bvh", "scene", "lod", "tool"):
            files = [{p.relative_to(root) for p in (root / folder).rglob("*") if p.is_file()} for root in (SOURCE, exported)]
            self.assertEqual(*files)

    def test_conan_itself_takes_it(self):
        if not shutil.which("conan"):
            self.skipTest("conan is not installed: the recipe runs with a stand-in alone")
        environment = {**os.environ, "CONAN_HOME": str(WORK / "conan-home")}
        done = subprocess.run(["conan", "export", str(SOURCE / "packaging/conan")], env=environment, capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)

    def test_names_the_libraries_and_the_configuration_that_are_installed(self):
        recipe = self.recipe(builder=True)
        recipe.package_info()
        self.assertEqual(recipe.cpp_info.libs, ["swiftlet_lod", "swiftlet_scene", "swiftlet_bvh", "swiftlet_march", "swiftlet_lut"])
        in_pc = re.findall(r"-l(\w+)", re.search(r"^Libs:.*$", read("swiftlet.pc.in"), re.M).group(0))
        plain = self.recipe()
        plain.package_info()
        self.assertEqual(plain.cpp_info.libs, ["swiftlet_scene", "swiftlet_bvh", *in_pc])
        self.assertEqual(plain.cpp_info.builddirs, ["lib/cmake/swiftlet"])
        self.assertIn("set(config_dir ${CMAKE_INSTALL_LIBDIR}/cmake/swiftlet)", read("CMakeLists.txt"))

    def test_its_own_test_builds_the_consumer(self):
        test = self.recipe("packaging/conan/test_package")
        test.requirements()
        self.assertEqual(set(test.required), {"swiftlet"})
        listing = SOURCE / "packaging/conan/test_package/CMakeLists.txt"
        main = re.search(r"add_executable\(app (\S+)\)", listing.read_text()).group(1)
        self.assertTrue((listing.parent / main).is_file())


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
