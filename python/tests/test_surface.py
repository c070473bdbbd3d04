# SPDX-FileCopyrightText: 2026 the swiftlet authors
# SPDX-License-Identifier: BSD-3-Clause
"""Every public C++ name has a Python name, or a reason; and stubs say what modules hold."""

import ast
import importlib
import inspect
import re

import numpy as np
import pytest
from conftest import SOURCE

import swiftlet
import swiftlet.build
import swiftlet.scene

HEADERS = ["march", "bvh", "scene", "lod", "lut"]

# A name in Python, from the package on; or why there is none.
SAME = (
    "Answer Body BodyKind ClosestFeatures Decision Doubt Enclosing Error ErrorCode FeatureKind Level LevelArrays Manifold "
    "MeshModel Method Model PlaneRule Refinement StartPolicy Status Tuning Verdict check closest_features contacts distance "
    "inverse intersects is_mesh_file manifold refine relative signed_distance signed_within tolerance verify within"
).split()
RENAMED = {
    "BodyId": "scene.Scene.add",
    "BuildOptions": "build.build",
    "BuildReport": "build.Built.report",
    "Built": "build.Built",
    "Check": "Check",
    "ClosestOptions": "closest_features",
    "Detail": "Model.cut",
    "FacePlane": "Level.planes",
    "FaceLoop": "Level.faces",
    "FeatureId": "feature_kind",
    "HalfEdge": "Level.half_edges",
    "HullOptions": "build.build_mesh",
    "LevelRecord": "Trace.levels",
    "LevelReport": "build.Built.report",
    "ManifoldOptions": "manifold",
    "ManifoldPoint": "Manifold.points",
    "Mesh": "build.Mesh",
    "MeshBody": "Body",
    "MeshContact": "Contacts.regions",
    "MeshContacts": "Contacts",
    "MeshOptions": "MeshModel.from_arrays",
    "MeshPairQuery": "distance",
    "MeshSeed": "Seeds",
    "MeshTopology": "Topology",
    "ModelOptions": "Model.from_levels",
    "NearestPair": "scene.Scene.nearest",
    "Options": "distance",
    "OverlapProof": "Trace.proof",
    "PairQuery": "distance",
    "PairSeed": "Pair.seed",
    "Pose": "matrix",
    "Progress": "build.build",
    "Resolution": "Resolution",
    "SalvagedMesh": "MeshModel.salvage",
    "Salvaged": "Model.salvage",
    "Scene": "scene.Scene",
    "SceneContact": "scene.Scene.contacts",
    "ScenePair": "scene.Scene.overlapping",
    "SourceFeature": "Sources",
    "SourceMap": "Model.source_face",
    "TableSpec": "Model.with_table",
    "Vertex": "Level.vertices",
    "Within": "Answers.decision",
    "build": "build.build",
    "build_mesh": "build.build_mesh",
    "kMeshFileVersion": "MESH_FILE_VERSION",
    "kModelFileVersion": "MODEL_FILE_VERSION",
    "kMostFlatness": "MOST_FLATNESS",
    "kMostManifoldPoints": "MOST_MANIFOLD_POINTS",
    "kMostTriangles": "MOST_TRIANGLES",
    "kNone": "NONE",
    "kPosesPerChunk": "POSES_PER_CHUNK",
    "load": "Model.load",
    "load_mesh": "MeshModel.load",
    "map": "Model.map",
    "map_mesh": "MeshModel.map",
    "read_mesh": "build.read_mesh",
    "rebuild_hulls": "build.rebuild_hulls",
    "refit": "MeshModel.refit",
    "salvage": "Model.salvage",
    "salvage_mesh": "MeshModel.salvage",
    "save": "Model.save",
    "Budget": "distance",
    "Effort": "intersects",
}
ABSENT = {
    "MeshFront": "spares microseconds of one query between small steps; a call from Python takes as many",
    "MeshVisitor": "of visit_triangles",
    "visit_triangles": "a call for each box; in Python the triangles are arrays, for a tree of the caller's",
    "ConvexView": "a view of a model's memory for marches in C++; its arrays are Level's",
    "Question": "check's exact=",
    "Executor": "runs C++ tasks; Python says threads=",
    "on_threads": "as Executor",
    "Run": "a C++ executor and stop function; Python says threads=, and Ctrl-C stops",
    "MarchResult": "of march",
    "MarchRule": "of march",
    "MarchStart": "of march",
    "MarchStatus": "of march",
    "march": "the atomic kernel of a hierarchy in C++: a call from Python costs more than a march",
    "table_start": "where a march starts",
    "decompose": "its patches are for hull trees and builders, which are C++'s; the tool's word decompose counts and draws them",
    "Decomposition": "of decompose",
    "DecomposeOptions": "of decompose",
    "Growth": "of decompose",
    "Patch": "of decompose",
    "HullTree": "SWIFT++ as the paper has it, for comparison in C++; MeshModel answers the same questions",
    "build_hull_tree": "of HullTree",
    "HullTreeOptions": "of HullTree",
    "HullSplit": "of HullTree",
    "HullNode": "of HullTree",
    "HullRange": "of HullTree",
    "HullArrays": "of HullTree",
    "FaceClass": "of HullTree",
    "HullPair": "of HullTree",
    "HullSearch": "of HullTree",
    "HullStart": "of HullTree",
    "HullAnswer": "of HullTree",
    "tag": "tags are a C++ caller's, whose views have them",
    "Mat3": "Eigen's; Python has arrays",
    "Vec3": "Eigen's; Python has arrays",
    "Result": "Python raises Error",
    "kSpareRegions": "an addend of a C++ span's size",
    "nearest": "of lut.h: how a start table is read",
    "sample": "of lut.h",
    "sample_count": "of lut.h: the length of Model.table",
}

# Members, class by class: what Python calls them where that is not the same name.
MEMBERS = {
    "Model": ("Model", {"from_level": "from_arrays", "source": "source_vertex"}),
    "MeshModel": ("MeshModel", {"from_triangles": "from_arrays", "vertex": "vertices", "triangle": "faces", "vertex_count": "vertices",
                                "triangle_count": "faces"}),
    "MeshTopology": ("Topology", {}),
    "Body": ("Body", {"corner": "corners"}),
    "MeshBody": ("Body", {"convex": "model", "is_solid": "kind"}),
    "Answer": ("Answer", {}),
    "Level": ("Level", {"view": "vertices"}),
    "Options": ("distance()", {"budget": "steps"}),
    "Budget": ("distance()", {}),
    "Tuning": ("Tuning", {"trace": "", "proof": ""}),  #  the function gives both
    "ClosestOptions": ("closest_features()", {}),
    "ManifoldOptions": ("manifold()", {}),
    "BuildOptions": ("build.build()", {"detail": "deviation", "table": "resolution", "executor": "threads"}),
    "HullOptions": ("build.build_mesh()", {"executor": "threads"}),
    "MeshContacts": ("Contacts", {"stored": "regions"}),
    "Scene": ("scene.Scene", {"run_by": "__init__", "size": "__len__", "body": "", "mesh_body": "", "kQuestionsKept": ""}),
    "Manifold": ("Manifold", {"count": "points"}),
    "Check": ("Check", {}),
    "TableSpec": ("Model.with_table()", {}),
    "LevelArrays": ("LevelArrays", {"face_vertices": "faces", "face_sizes": "faces"}),
}  # fmt: skip


def code():
    """Public headers without comments and preprocessor's lines."""
    texts = []
    for folder in HEADERS:
        for header in sorted((SOURCE / folder / "include/swiftlet").glob("*.h")):
            text = re.sub(r"/\*.*?\*/|//[^\n]*|^#[^\n]*", "", header.read_text(), flags=re.S | re.M)
            texts.append(text)
    assert len(texts) > 15
    return "\n".join(texts)


def blocks(text):
    """Statements at one level: (head, body or None)."""
    head, depth, body, found = "", 0, "", []
    for c in text:
        if c == "{":
            depth += 1
            body += c if depth > 1 else ""
        elif c == "}":
            depth -= 1
            if depth == 0:
                found.append((head.strip(), body))
                head, body = head if re.search(r"=\s*$|\(|\w\s*$", head) and not is_block(head) else "", ""
            else:
                body += c
        elif depth:
            body += c
        elif c == ";":
            found.append((head.strip(), None))
            head = ""
        else:
            head += c
    return found


def is_block(head):
    return bool(re.search(r"\b(namespace|class|struct|enum)\b", head)) or bool(
        re.search(r"\)\s*(const)?\s*(noexcept)?\s*(:.*)?$", head, re.S)
    )


def names(text):
    """Names that a namespace declares, and the bodies of its classes."""
    found, classes = set(), {}
    for head, body in blocks(text):
        head = re.sub(r"template\s*<[^>]*>|\[\[\w+\]\]|\binline\b|\bconstexpr\b", "", head).strip()
        if m := re.match(r"(?:class|struct|enum class)\s+(\w+)", head):
            found.add(m[1])
            if body is not None and not head.startswith("enum"):
                classes[m[1]] = body
        elif m := re.match(r"namespace\s*[\w:]*$", head):
            inner, more = names(body)
            found |= inner
            classes.update(more)
        elif m := re.match(r"using\s+(\w+)\s*=", head):
            found.add(m[1])
        elif head.startswith("static_assert") or not head:
            continue
        elif m := re.search(r"(\w+)\s*\(", head):
            found.add(m[1])
        elif m := re.search(r"(\w+)\s*(=.*)?$", head, re.S):
            found.add(m[1])
    return found, classes


def members(body):
    """Public names of a class."""
    found, shown = set(), ""
    for part in re.split(r"\b(public|private):", "public:" + body)[1:]:
        if part in ("public", "private"):
            access = part
        elif access == "public":
            shown += part
    for head, _ in blocks(shown):
        head = re.sub(r"template\s*<[^>]*>|\[\[\w+\]\]|= default|= delete|\bexplicit\b", "", head).strip()
        if not head or "operator" in head or head.startswith(("friend", "static_assert", "class", "struct", "~", "using")):
            continue
        head = re.split(r"=", head)[0] if "(" not in head.split("=")[0] else head
        if m := re.search(r"(\w+)\s*\(", head):
            found.add(m[1])
        else:
            for word in re.sub(r"<.*>", "", head).split(","):
                found.add(re.findall(r"\w+", word)[-1])
    return found


def resolve(path):
    thing = swiftlet
    for part in path.split("."):
        thing = inspect.getattr_static(thing, part) if inspect.isclass(thing) else getattr(thing, part)
    return thing


def test_every_public_name_has_a_python_name_or_a_reason():
    found, _ = names(code())
    assert len(found) > 90
    known = set(SAME) | set(RENAMED) | set(ABSENT)
    assert found - known == set(), "give each a Python name, or a line in the table that says why there is none"
    assert known - found == set(), "the table names what there is not"
    for name in SAME:
        assert hasattr(swiftlet, name), name
    for name, path in RENAMED.items():
        resolve(path)


def test_every_member_has_a_python_name():
    _, classes = names(code())
    looked_at = 0
    for name, (path, renamed) in MEMBERS.items():
        if path.endswith("()"):
            known = (
                set(inspect.signature(resolve(path[:-2])).parameters)
                if "with_table" not in path
                else parameters_of(resolve(path[:-2]))
            )
        else:
            thing = resolve(path)
            known = set(dir(thing)) | set(getattr(thing, "__dataclass_fields__", {})) | set(getattr(thing, "_fields", ()))
        for member in members(classes[name]) - {name}:
            looked_at += 1
            other = renamed.get(member, member)
            assert other == "" or other in known, f"{name}::{member} has no name in swiftlet.{path}"
    assert looked_at > 130


def parameters_of(bound):
    text = (getattr(bound, "__func__", bound)).__doc__
    return set(re.findall(r"(\w+): ", text.splitlines()[0]))


def test_enumerators_are_the_same():
    text = code()
    for match in re.finditer(r"^enum class (\w+)[^{]*\{([^}]*)\}", text, re.M):
        if match[1] in ABSENT:
            continue
        ours = getattr(swiftlet, match[1])
        theirs = re.findall(r"\w+", match[2])
        spelled = [re.sub(r"(?<=[a-z])(?=[A-Z0-9])", "_", name).upper() for name in theirs]
        assert [m.name for m in ours][: len(spelled)] == spelled, match[1]
        assert [m.value for m in ours] == list(range(len(ours)))


# ---- Stubs -----------------------------------------------------------------------------------------------------------------


def stub(module):
    return ast.parse((SOURCE / f"python/swiftlet/{module}.pyi").read_text())


def stub_parameters(function):
    a = function.args
    names = [x.arg for x in a.posonlyargs + a.args if x.arg != "self"]
    names += ["*" + a.vararg.arg] if a.vararg else ["*"] if a.kwonlyargs else []
    return names + [x.arg for x in a.kwonlyargs] + (["**"] if a.kwarg else [])


def module_parameters(function):
    """From the first line of pybind11's docstring, or the text signature of a method in C."""
    if inspect.ismethoddescriptor(function) and getattr(function, "__text_signature__", None):
        parameters = list(inspect.signature(function).parameters.values())[1:]
        names = [p.name for p in parameters if p.kind != p.KEYWORD_ONLY]
        only = [p.name for p in parameters if p.kind == p.KEYWORD_ONLY]
        return names + (["*"] if only else []) + only
    line = function.__doc__.splitlines()[0]
    inner = line[line.index("(") + 1 : line.rindex(") ->")]
    while re.search(r"\[[^\[\]]*\]", inner):
        inner = re.sub(r"\[[^\[\]]*\]", "", inner)
    words = [p.split(":")[0].split("=")[0].strip() for p in inner.split(",")] if inner else []
    return ["**" if w.startswith("**") else w for w in words if w != "self"]


@pytest.mark.parametrize("module", ["_runtime", "_build"])
def test_stubs_say_what_the_module_holds(module):
    loaded, tree = importlib.import_module(f"swiftlet.{module}"), stub(module)
    public = {n for n in vars(loaded) if not n.startswith("_")}
    declared = {n.name: n for n in tree.body if isinstance(n, (ast.FunctionDef, ast.ClassDef))}
    constants = {n.target.id for n in tree.body if isinstance(n, ast.AnnAssign)}
    assert public == set(declared) | constants
    compared = 0
    for name, node in declared.items():
        if isinstance(node, ast.FunctionDef):
            assert stub_parameters(node) == module_parameters(getattr(loaded, name)), name
            compared += 1
            continue
        held = {n for n in vars(getattr(loaded, name)) if not n.startswith("_") or n == "_repr_svg_"}
        methods = {n.name: n for n in node.body if isinstance(n, ast.FunctionDef)}
        assert held == {n for n in methods if not n.startswith("__")}, name
        for method, declaration in methods.items():
            thing = inspect.getattr_static(getattr(loaded, name), method)
            decorators = {d.id for d in declaration.decorator_list if isinstance(d, ast.Name)}
            is_property = isinstance(thing, property) or inspect.isgetsetdescriptor(thing)
            assert is_property == bool(
                {"property"} & decorators or any(isinstance(d, ast.Attribute) for d in declaration.decorator_list)
            )
            assert isinstance(thing, staticmethod) == ("staticmethod" in decorators), method
            if is_property or method.startswith("__"):
                continue
            assert stub_parameters(declaration) == module_parameters(getattr(getattr(loaded, name), method)), f"{name}.{method}"
            compared += 1
    assert compared >= 4


def test_every_public_thing_has_a_docstring_of_its_own():
    for module in (swiftlet, swiftlet.build, swiftlet.scene):
        for name in module.__all__:
            thing = getattr(module, name)
            if not callable(thing) or name.startswith("__"):
                continue
            lines = (thing.__doc__ or "").strip().splitlines()
            assert lines and (len(lines) > 1 or not lines[0].startswith(name + "(")), name
            if inspect.isclass(thing):
                for member, value in vars(thing).items():
                    if not member.startswith("_") and (
                        callable(value) or isinstance(value, property) or inspect.isgetsetdescriptor(value)
                    ):
                        assert inspect.getdoc(getattr(thing, member)), f"{name}.{member}"
    for function in (
        swiftlet.distance,
        swiftlet.signed_distance,
        swiftlet.intersects,
        swiftlet.within,
        swiftlet.signed_within,
        swiftlet.closest_features,
        swiftlet.refine,
        swiftlet.manifold,
    ):
        parameters = inspect.signature(function).parameters
        section = re.search(r"\n *Parameters\n *-+\n(.*?)\n *\n *Returns\n", function.__doc__, re.S)
        lines = re.findall(r"^    (\w+(?:, \w+)*) :", section[1], re.M)
        documented = [name for line in lines for name in line.split(", ")]
        assert sorted(documented) == sorted(parameters), function.__name__
        assert "<" not in function.__doc__.replace("<=", ""), function.__name__


def test_the_version_is_cmakes():
    assert swiftlet.__version__ == re.search(r"project\(swiftlet VERSION ([\d.]+)", (SOURCE / "CMakeLists.txt").read_text())[1]


def test_the_runtime_links_no_cgal():
    with open(swiftlet._runtime.__file__, "rb") as file:
        binary = file.read()
    assert not any(symbol in binary for symbol in (b"CGAL::", b"4CGAL", b"libgmp", b"libmpfr"))
    assert np.dtype(swiftlet._runtime.answer_dtype()).itemsize == 128
