# SPDX-License-Identifier: MIT
"""What `tetmend check --json` prints is what docs/check.schema.json says.

    check_schema.py PROGRAM SOURCE     status 77: jsonschema is not installed
"""

import json
import subprocess
import sys
from pathlib import Path

try:
    import jsonschema
except ImportError:
    print("skipped: Debian's python3-jsonschema is not installed")
    sys.exit(77)


def main(program: str, source: Path) -> int:
    schema = json.loads((source / "docs/check.schema.json").read_text())
    jsonschema.Draft7Validator.check_schema(schema)
    bracket = source / "assets/meshes/bracket.meshb"
    calls = [[bracket, "--for", "openfoam"], [bracket, bracket],
             [bracket, "--min-dihedral", "15", "--measure", "aspect_ratio=3"]]
    for call in calls:
        run = subprocess.run([program, "check", "--json", *call], capture_output=True, text=True,
                             check=False)
        report = json.loads(run.stdout)
        jsonschema.validate(report, schema)
        if run.returncode != (0 if report["holds"] else 3):
            print(f"status {run.returncode}, but holds is {report['holds']}")
            return 1
    for broken in ({"schema": 2}, {"facts": [{}]}, {"holds": "yes"}):
        try:
            jsonschema.validate({**report, **broken}, schema)
        except jsonschema.ValidationError:
            continue
        print(f"the schema takes {broken}")
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], Path(sys.argv[2])))
