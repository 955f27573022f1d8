# SPDX-License-Identifier: MIT
"""Runs a file of tests with pytest, on the package of a build.

    run.py SOURCE BUILD FILE [ARGUMENTS OF PYTEST...]

Exit status 77: pytest or numpy is not installed, or every test was skipped.
"""

import importlib.util
import os
import sys
from pathlib import Path

SKIPPED = 77


class AllSkipped:
    """Counts what ran."""

    def __init__(self) -> None:
        self.ran = 0

    def pytest_runtest_logreport(self, report) -> None:
        self.ran += report.when == "call" and not report.skipped


def main() -> int:
    for module in ("pytest", "numpy"):
        if importlib.util.find_spec(module) is None:
            print(f"skipped: {module} is not installed for {sys.executable}")
            return SKIPPED
    import pytest

    source, build = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve()
    os.environ.update(TETMEND_SOURCE=str(source), TETMEND_BUILD=str(build))
    sys.path.insert(0, str(build / "python"))
    count = AllSkipped()
    status = pytest.main(["-q", "-rs", "-p", "no:cacheprovider", str(source / "tests/python" / sys.argv[3]), *sys.argv[4:]], [count])
    return SKIPPED if status == 0 and count.ran == 0 else int(status)


if __name__ == "__main__":
    sys.exit(main())
