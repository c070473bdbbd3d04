# SPDX-FileCopyrightText: 2026 the swiftlet authors
# SPDX-License-Identifier: BSD-3-Clause
"""names.py LIBRARY: every public function of the runtime has a C name or a line why not, in c/README.md's table, and every C
function stands there; the library shows the functions of the header and nothing else."""
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]


def code(path):
    return re.sub(r"//.*", "", path.read_text())


def functions_of_cpp():
    """Free functions of the headers, and public members of models, meshes and scenes, by name."""
    names = set()
    for header in sorted([*ROOT.glob("march/include/swiftlet/*.h"), *ROOT.glob("bvh/include/swiftlet/*.h"),
                          *ROOT.glob("scene/include/swiftlet/*.h")]):
        text = code(header)
        names |= set(re.findall(r"^(?:\[\[nodiscard\]\] )?[A-Za-z_][\w:<> ]*[ &*]+(\w+)\(", text, re.M))
        for kind in ("Model", "MeshModel", "Scene"):
            found = re.search(rf"^class {kind} {{\n public:\n(.*?)\n private:", text, re.M | re.S)
            if found:
                members = re.findall(r"^  (?:\[\[nodiscard\]\] |static )*[A-Za-z_][\w:<>, ]*[ &*]+(\w+)\(", found.group(1), re.M)
                names |= {f"{kind}::{name}" for name in members} - {f"{kind}::{kind}"}
    return names - {"assert"}


declared = set(re.findall(r"^SWIFTLET_API [^;]*?\b(swiftlet_\w+)\(", code(ROOT / "c/include/swiftlet/swiftlet.h"), re.M))
page = (ROOT / "c/README.md").read_text().split("| C++ | C |")[1]
table = re.findall(r"^\| (`[^|]*) \| ([^|]*) \|$", page, re.M)
cpp = {name for left, _ in table for name in re.findall(r"`([\w:]+)`", left)}
c = set(re.findall(r"`(swiftlet_\w+)`", page))
shown = subprocess.run(["nm", "-D", "--defined-only", sys.argv[1]], check=True, capture_output=True, text=True).stdout.split("\n")
symbols = {line.split()[2].split("@")[0] for line in shown if line} - {"SWIFTLET_C_1"}

wanted = functions_of_cpp()
assert len(wanted) > 80 and {"distance", "Model::from_levels", "Scene::nearest", "tolerance"} <= wanted, sorted(wanted)
wrong = [f"{what}: {' '.join(sorted(names))}" for what, names in (
    ("without a C name or a line why not", wanted - cpp),
    ("named in the table, but not public in C++", cpp - wanted),
    ("named in the table, but not in swiftlet.h", c - declared),
    ("in swiftlet.h, but not in the table", declared - c),
    ("shown by the library, but not in swiftlet.h", symbols - declared),
    ("in swiftlet.h, but not shown by the library", declared - symbols)) if names]
for left, right in table:
    if not re.search(r"`swiftlet_\w+`|\w \w", right):
        wrong.append(f"no C name and no words why not: {left}")
print("\n".join(wrong) or f"{len(wanted)} names of C++, {len(declared)} functions of C")
sys.exit(bool(wrong))
