# SPDX-FileCopyrightText: 2026 the swiftlet authors
# SPDX-License-Identifier: BSD-3-Clause
"""Every example runs, says what it says, and draws its picture."""

import importlib.util
import subprocess
import sys

import pytest
from conftest import SOURCE

pytest.importorskip("swiftlet.build")
EXAMPLES = sorted((SOURCE / "python/examples").glob("*.py"))
SAYS = {
    "first_distance": ["distance 2.309401076758, proved to", "check: True"],
    "levels": ["level 0:", "to      0:", "cut for 0.05:"],
    "accuracy": ["relative   0.01:"],
    "ur10_cell": ["15552 configurations", "of 10 pairs in the cell:", "0 undecided"],
    "arm": ["forearm  table", "wrist 2  post"],
}


@pytest.mark.parametrize("example", EXAMPLES, ids=lambda path: path.stem)
def test_an_example_runs_and_draws(example, tmp_path):
    has_matplotlib = importlib.util.find_spec("matplotlib") is not None
    picture = tmp_path / "picture.png"
    command = [sys.executable, str(example), *([str(picture)] if has_matplotlib else [])]
    done = subprocess.run(command, capture_output=True, text=True, timeout=240)
    if "models/fetch has not run" in done.stderr:
        pytest.skip("models/fetch has not run")
    assert done.returncode == 0, done.stderr
    for line in SAYS[example.stem]:
        assert line in done.stdout
    if not has_matplotlib:
        pytest.skip("ran, but matplotlib is not installed: no picture")
    assert picture.read_bytes().startswith(b"\x89PNG") and picture.stat().st_size > 5000
