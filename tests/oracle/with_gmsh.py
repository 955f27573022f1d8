# SPDX-License-Identifier: MIT
"""Finds a Python with Gmsh's module for a test."""

import os
import sys
from pathlib import Path

SKIPPED = 77


def start_with_gmsh() -> None:
    """Goes on in the Python that has the module."""
    sys.path.insert(0, str(Path(sys.argv[1]) / "bench"))
    import competitors
    python = competitors.module("gmsh")
    if python is None:
        print("skipped: install the package python3-gmsh")
        sys.exit(SKIPPED)
    if os.environ.get("TETMEND_TEST_GMSH") is None:
        os.environ["TETMEND_TEST_GMSH"] = "1"
        sys.stdout.flush()
        os.execv(python, [str(python), "-B", *sys.argv])
