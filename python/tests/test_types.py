# SPDX-FileCopyrightText: 2026 the swiftlet authors
# SPDX-License-Identifier: BSD-3-Clause
"""The package, its stubs and a user's program under mypy's strict rules."""

import subprocess
import sys
from pathlib import Path

import pytest

import swiftlet

pytest.importorskip("mypy")


@pytest.fixture(scope="module")
def mypy(tmp_path_factory):
    cache = tmp_path_factory.mktemp("mypy")

    def run(*arguments):
        command = [sys.executable, "-m", "mypy", "--strict", "--cache-dir", str(cache), *map(str, arguments)]
        return subprocess.run(command, cwd=Path(swiftlet.__file__).parents[1], capture_output=True, text=True).stdout

    return run


def test_types_hold(mypy):
    assert "Success" in (found := mypy("-p", "swiftlet")), found


def test_wrong_types_of_a_user_are_seen(mypy, tmp_path):
    program = tmp_path / "wrong.py"
    program.write_text("import swiftlet\n\nmodel = swiftlet.Model.load(1)\nreveal_type(model)\n")
    found = mypy(program)
    assert "wrong.py:3: error: Argument 1" in found and "wrong.py:4: note: Revealed type" in found and "Model" in found, found
