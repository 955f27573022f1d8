# SPDX-License-Identifier: MIT
"""A DMPlex of PETSc on 1, 2, 3 and 5 processes: labels, surface and volumes stay, and the bytes are the same.

usage: petsc_test.py PETSC_PLEX|none
"""

import os
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

PROGRAM = sys.argv[1]
SKIPPED = 77
RANKS_MAY_SHARE_CORES = {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
                         "OMPI_MCA_rmaps_base_oversubscribe": "1", "OMPI_MCA_mpi_yield_when_idle": "1",
                         "OMPI_MCA_btl_vader_single_copy_mechanism": "none"}
MISTAKES = {
    "flat": "has cells of dimension 2 in space of 2",
    "hexahedra": "is a hexahedron, and no tet",
    "grid": "is no DMPlex, but da",
    "none": "there is none",
    "lone": "point 5 of rank 0 belongs to no cell",
    "number": "is not a finite number",
    "inverted": "is inverted",
    "values": "label 'Cell Sets': point 0 of rank 0 has two values, 4 and 9",
    "pieces": "at least 2",
    "option": "needs the whole mesh",
    "empty": "has no cells",
}
MISTAKES_OF_MANY = {"overlap": "belongs to another rank", "stale": "lies elsewhere than the rank that owns it says"}


def run(ranks: int, *words: str | Path) -> subprocess.CompletedProcess[str]:
    return subprocess.run(["mpirun", "-n", str(ranks), PROGRAM, *map(str, words)], capture_output=True, text=True,
                          timeout=280, env=dict(os.environ, **RANKS_MAY_SHARE_CORES))


class Improve(unittest.TestCase):
    def improved(self, ranks: int, *options: str) -> bytes:
        """What lies on the ranks afterwards; the program has looked at it already."""
        with tempfile.TemporaryDirectory() as folder:
            out = Path(folder) / "cells"
            done = run(ranks, "improve", out, *options)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
            print(ranks, *options, done.stdout.strip())
            return out.read_bytes()

    def test_neither_ranks_nor_threads_nor_the_order_of_vertices_shows(self) -> None:
        expected = self.improved(1)
        self.assertGreater(len(expected), 2000 * 13 * 8)
        for ranks, options in [(2, ["-threads", "2"]), (3, []), (5, []), (2, ["-turned"])]:
            self.assertEqual(self.improved(ranks, *options), expected, (ranks, options))

    def test_a_mesh_without_faces_and_edges_stays_one(self) -> None:
        self.assertEqual(self.improved(1, "-plain"), self.improved(3, "-plain"))


class Mistakes(unittest.TestCase):
    def test_all_ranks_get_an_error_that_says_what_is_wrong(self) -> None:
        for ranks in (1, 3):
            done = run(ranks, "mistakes")
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
            said = dict(line.split(": ", 1) for line in done.stdout.splitlines() if ": " in line)
            expected = MISTAKES | (MISTAKES_OF_MANY if ranks > 1 else {})
            for mistake, words in expected.items():
                self.assertIn(words, said.get(mistake, ""), f"{mistake}, {ranks} ranks: {done.stdout}")


if __name__ == "__main__":
    if PROGRAM == "none" or shutil.which("mpirun") is None:
        print("tetmend: skipped, there is no PETSc or no MPI")
        sys.exit(SKIPPED)
    unittest.main(argv=sys.argv[:1])
