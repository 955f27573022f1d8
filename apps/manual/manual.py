# SPDX-License-Identifier: MIT
"""Writes man pages and completions for the programs, from what they say with --help-json.

    manual.py OUTPUT_FOLDER tetmend [tetmend-view]

The folder gets the form of /usr/share, one subfolder for each program: tetmend/man/man1/tetmend.1. The date on the pages
is that of the environment variable SOURCE_DATE_EPOCH, or today.
"""

import os
import shutil
import sys
import time
from pathlib import Path

from completions import completions
from description import Failure, describe
from man import pages


def owner(name: str) -> str:
    """The program that a file is about."""
    return "tetmend-view" if "tetmend-view" in name else "tetmend"


def main() -> int:
    if len(sys.argv) < 3:
        print(__doc__, file=sys.stderr)
        return 2
    output = Path(sys.argv[1])
    date = time.strftime("%Y-%m-%d", time.gmtime(int(os.environ.get("SOURCE_DATE_EPOCH", time.time()))))
    try:
        programs = [describe(Path(name).resolve()) for name in sys.argv[2:]]
        files = {f"man/man1/{name}": text for name, text in pages(programs, date).items()}
        files |= completions(programs)
    except (Failure, OSError) as error:
        print(f"manual: {error}", file=sys.stderr)
        return 1
    shutil.rmtree(output, ignore_errors=True)
    for name, text in files.items():
        file = output / owner(name) / name
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text)
    return 0


if __name__ == "__main__":
    sys.exit(main())
