# SPDX-License-Identifier: MIT
"""Writes an SBOM, SPDX 2.3 as JSON: what the files of a release have inside or depend on, with versions and licences of Debian's packages.

    sbom.py VERSION ADDRESS OUTPUT FILE...     FILE: .deb, .whl, .tar.gz of a release

Of a .deb its dependencies are named, of a wheel the libraries inside, of all the libraries of headers that are compiled in.
"""

from __future__ import annotations

import hashlib
import json
import os
import re
import subprocess
import sys
import time
import zipfile
from functools import cache
from pathlib import Path

# Headers alone: a program has of them what it uses, and no dependency tells so.
COMPILED_IN = ["libeigen3-dev", "libfast-float-dev", "nlohmann-json3-dev"]
IN_PROGRAMS = ["libcli11-dev"]
IN_THE_VIEWER = ["libglm-dev", "libstb-dev", "libimgui-dev"]
# Of the names that Debian's copyright files have, those that SPDX spells otherwise.
SPDX_NAMES = {"Expat": "MIT", "BSD-3-clause": "BSD-3-Clause", "BSD-2-clause": "BSD-2-Clause", "Apache-2": "Apache-2.0", "zlib": "Zlib", "BSL-1": "BSL-1.0",
              "MPL-2": "MPL-2.0", "GPL-2": "GPL-2.0-only"}
KNOWN = {"MIT", "BSD-3-Clause", "BSD-2-Clause", "Apache-2.0", "Zlib", "BSL-1.0", "MPL-2.0", "GPL-2.0-only", "curl", "ISC"}


@cache
def version(package: str) -> str:
    done = subprocess.run(["dpkg-query", "-W", "-f", "${Version}", package], capture_output=True, text=True)
    return done.stdout if done.returncode == 0 else ""


@cache
def licence(package: str) -> str:
    """The one of its files in general, if the copyright file of its package says so in a form for programs."""
    file = Path(f"/usr/share/doc/{package}/copyright")
    text = file.read_text(errors="replace") if file.exists() else ""
    found = re.search(r"^Files: *\*\n(?:.+\n)*?License: *(.+)$", text, re.M)
    names = [SPDX_NAMES.get(name, name) for name in re.split(r" or ", found[1].strip())] if found else [""]
    return " OR ".join(names) if set(names) <= KNOWN else "NOASSERTION"


def identifier(*words: str) -> str:
    return "SPDXRef-" + re.sub(r"[^A-Za-z0-9.-]", "-", "-".join(words))


def dependency(package: str) -> dict:
    return {"SPDXID": identifier("Debian", package), "name": package, "versionInfo": version(package) or "NOASSERTION",
            "supplier": "Organization: Debian", "downloadLocation": "NOASSERTION", "filesAnalyzed": False,
            "licenseConcluded": "NOASSERTION", "licenseDeclared": licence(package), "copyrightText": "NOASSERTION",
            "externalRefs": [{"referenceCategory": "PACKAGE-MANAGER", "referenceType": "purl",
                              "referenceLocator": f"pkg:deb/debian/{package}@{version(package)}"}] if version(package) else []}


def depends_of(deb: Path) -> list[str]:
    listed = subprocess.run(["dpkg-deb", "-f", deb, "Depends"], check=True, capture_output=True, text=True).stdout
    names = [each.split("|")[0].split()[0] for each in listed.split(",") if each.strip()]
    return [name for name in names if "tetmend" not in name]


def bundled_in(wheel: Path) -> list[str]:
    """Packages whose licences lie in it."""
    with zipfile.ZipFile(wheel) as archive:
        names = [re.search(r"licenses/(lib.+?)-[0-9a-f]{8}(\.so.*)\.txt$", name) for name in archive.namelist()]
    packages = []
    for found in filter(None, names):
        [file, *_] = [path for folder in ("/usr/lib", "/lib") for path in Path(folder).rglob(f"{found[1]}{found[2]}")] or [None]
        for place in (str(file), str(file).removeprefix("/usr")):
            owner = subprocess.run(["dpkg-query", "-S", place], capture_output=True, text=True)
            if owner.returncode == 0:
                packages.append(owner.stdout.partition(":")[0])
                break
    return packages


def relation(of: str, kind: str, other: str) -> dict:
    return {"spdxElementId": of, "relationshipType": kind, "relatedSpdxElement": other}


def sbom(release: str, address: str, files: list[Path]) -> dict:
    packages: dict[str, dict] = {}
    relations = []
    for file in files:
        made = identifier(file.name)
        packages[made] = {"SPDXID": made, "name": file.name, "versionInfo": release, "supplier": "Organization: The tetmend authors",
                          "packageFileName": file.name, "downloadLocation": f"{address}/{file.name}", "filesAnalyzed": False,
                          "checksums": [{"algorithm": "SHA256", "checksumValue": hashlib.sha256(file.read_bytes()).hexdigest()}],
                          "licenseConcluded": "MIT", "licenseDeclared": "MIT", "copyrightText": "The tetmend authors"}
        relations.append(relation("SPDXRef-DOCUMENT", "DESCRIBES", made))
        outside = depends_of(file) if file.suffix == ".deb" else []
        inside = bundled_in(file) if file.suffix == ".whl" else []
        if file.suffix == ".whl" or file.suffix == ".deb" and not file.name.startswith("libtetmend-dev_"):
            inside = inside + COMPILED_IN
        if file.suffix == ".deb" and file.name.startswith("tetmend"):
            inside = inside + IN_PROGRAMS + (IN_THE_VIEWER if file.name.startswith("tetmend-viewer_") else [])
        for name, kind in [*((each, "DEPENDS_ON") for each in outside), *((each, "CONTAINS") for each in inside)]:
            other = dependency(name)
            packages[other["SPDXID"]] = other
            relations.append(relation(made, kind, other["SPDXID"]))
    when = time.strftime("%Y-%m-%dT%H:%M:%SZ", time.gmtime(int(os.environ.get("SOURCE_DATE_EPOCH", time.time()))))
    content = json.dumps(sorted(packages), sort_keys=True) + json.dumps(relations)
    return {"spdxVersion": "SPDX-2.3", "dataLicense": "CC0-1.0", "SPDXID": "SPDXRef-DOCUMENT", "name": f"tetmend-{release}",
            "documentNamespace": f"{address}/sbom/{release}/{hashlib.sha256(content.encode()).hexdigest()[:16]}",
            "creationInfo": {"created": when, "creators": ["Tool: packaging/sbom.py", "Organization: The tetmend authors"]},
            "packages": [*packages.values()], "relationships": relations}


def main() -> None:
    release, address, output, *files = sys.argv[1:]
    Path(output).write_text(json.dumps(sbom(release, address, [Path(file) for file in files]), indent=1) + "\n")


if __name__ == "__main__":
    main()
