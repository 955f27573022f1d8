# SPDX-License-Identifier: MIT
"""The examples of a solver's loop do what docs/sizes.md says, from outside.

    adapting_test.py SOURCE BUILD EXAMPLE     the name of a file of examples/adapting, without its ending

Exit status 77: numpy, DOLFINx or the Python package is not there.
"""

import os
import re
import subprocess
import sys
from pathlib import Path

SOURCE, BUILD, EXAMPLE = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve(), sys.argv[3]
SKIPPED = 77
PYTHON = "/usr/bin/python3"  # Debian's, which sees the modules of Debian's packages
NEEDS = {"moving_front": ["numpy", "tetmend"], "poisson_peak": ["dolfinx", "tetmend"]}
PACKAGES = {"numpy": "python3-numpy", "dolfinx": "python3-dolfinx", "tetmend": "-DTETMEND_BUILD_PYTHON=ON"}
sys.path.insert(0, str(SOURCE / "bench"))
import documents  # noqa: E402

ENVIRONMENT = dict(os.environ, PYTHONPATH=str(BUILD / "python"), PYTHONDONTWRITEBYTECODE="1", OMP_NUM_THREADS="1")


def numbers(cells: list[str]) -> list[float]:
    return [float(cell.rstrip(" %").replace(",", "")) for cell in cells if cell]


def printed() -> list[list[float]]:
    """The rows of the table that the example prints."""
    ran = subprocess.run([PYTHON, SOURCE / "examples" / "adapting" / f"{EXAMPLE}.py"], env=ENVIRONMENT, check=True,
                         stdout=subprocess.PIPE, text=True)
    print(ran.stdout)
    found = re.findall(r"^ *\d+  .*$", ran.stdout, re.M)
    return [numbers(line.replace(" %", "").split()) for line in found]


def of_the_page() -> list[list[float]]:
    page = (SOURCE / "docs" / "sizes.md").read_text()
    section = page.partition(f"`examples/adapting/{EXAMPLE}.py`")[2]
    [(_, table), *_] = documents.tables(section)
    return [numbers(row) for row in table[1:]]


def wrong_in_front(rows: list[list[float]]) -> list[str]:
    wrong = [f"step {step:g}: {share} % in range" for step, _, _, share, *_ in rows if share < 95]
    wrong += [f"step {step:g}: the total changed by {change}" for step, *_, change in rows if abs(change) > 1e-13]
    wrong += [f"step {step:g}: the field is off by {error}" for step, *_, error, _ in rows if error > 0.05]
    return wrong


def wrong_in_peak(rows: list[list[float]]) -> list[str]:
    """Each step has less error than the one before, and much less than a regular mesh in the end."""
    errors = [row[-5:-3] for row in rows]
    wrong = [f"step {i + 1}: no less error" for i, (old, new) in enumerate(zip(errors, errors[1:], strict=False))
             if new[0] >= old[0] or new[1] >= old[1]]
    last = rows[-1]
    if last[-5] > last[-2] / 10 or last[-4] > last[-1] / 3:
        wrong.append("the regular mesh is about as good")
    return wrong


def differences(now: list[list[float]], page: list[list[float]]) -> list[str]:
    """Other processors round otherwise, which may change a mesh by a few tets; totals change by rounding alone."""
    def alike(mine: float, told: float) -> bool:
        return abs(mine - told) <= max(0.03 * abs(told), 1e-4) or max(abs(mine), abs(told)) < 1e-13

    if [len(row) for row in now] != [len(row) for row in page]:
        return [f"the page has other rows: {page}"]
    return [f"the page says {told}, now it is {mine}" for mine, told in zip(now, page, strict=True)
            if not all(map(alike, mine, told))]


def main() -> int:
    for module in NEEDS[EXAMPLE]:
        if subprocess.run([PYTHON, "-c", f"import {module}"], env=ENVIRONMENT, capture_output=True, check=False).returncode:
            print(f"skipped: {PYTHON} has no module {module} ({PACKAGES[module]})")
            return SKIPPED
    rows = printed()
    wrong = {"moving_front": wrong_in_front, "poisson_peak": wrong_in_peak}[EXAMPLE](rows)
    wrong += differences(rows, of_the_page())
    print("\n".join(wrong) or "as the page says")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
