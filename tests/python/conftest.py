# SPDX-License-Identifier: MIT
"""Meshes and programs that the tests share."""

import os
import subprocess
from pathlib import Path

import numpy as np
import pytest
import tetmend

SOURCE = Path(os.environ["TETMEND_SOURCE"])
BUILD = Path(os.environ["TETMEND_BUILD"])
MATERIALS = SOURCE / "assets/meshes/two_materials.mesh"


@pytest.fixture(scope="session")
def command_line():
    def run(*words: object) -> str:
        return subprocess.run([BUILD / "bin/tetmend", *map(str, words)], check=True, capture_output=True, text=True).stdout
    return run


@pytest.fixture(scope="session")
def materials() -> tetmend.Mesh:
    return tetmend.load(MATERIALS)


@pytest.fixture
def arrays(materials) -> dict:
    return {"points": materials.points.copy(), "tets": materials.tets.astype(np.int64), "labels": materials.labels.copy()}
