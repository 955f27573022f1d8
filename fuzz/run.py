# SPDX-License-Identifier: MIT
"""Fuzzes: bytes of strangers against every door, with address and undefined-behaviour sanitizers.

What is found lies in build/checked/fuzz/found, and makes the exit status 1; the program
build/checked/fuzz/fuzz_TARGET, given such a file, repeats it. The corpus grows in
build/checked/fuzz/corpus from run to run. With --seed no run knows of another: the same program
tries the same inputs in the same order, as far as its seconds go.
"""

import argparse
import json
import os
import re
import shutil
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

SOURCE = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(SOURCE))
sys.path.insert(0, str(SOURCE / "bench"))
import documents  # noqa: E402
from fuzz import seeds  # noqa: E402

BUILD = SOURCE / "build" / "checked"
TARGETS = {
    "mesh": "MEDIT files", "meshb": "binary MEDIT files", "node": "sets of TetGen files", "vtk": "legacy VTK files",
    "vtu": "VTK XML files", "msh": "Gmsh files", "inp": "Abaqus decks", "su2": "SU2 files", "vol": "Netgen files",
    "bdf": "Nastran files", "header": "folders of Elmer", "unv": "universal files", "mfem": "meshes of MFEM",
    "k": "LS-DYNA decks", "feb": "models of FEBio", "e": "Exodus files",
    "med": "MED files, with HDF5 as text", "cgns": "CGNS files, likewise", "xdmf": "XDMF files, with tables likewise",
    "trace": "traces, byte for byte",
    "trace_events": "traces with sound checksums", "lesson": "lessons", "schedule": "Lua scripts",
    "options": "options and regions", "parameters": "settings of operators", "plugin": "descriptions of plugins",
    "improve": "the whole improver, with a judge", "checkpoint": "damaged folders of runs in pieces",
}


def parse(arguments):
    parser = argparse.ArgumentParser(prog="script/fuzz", usage="script/fuzz [TARGET...] [SECONDS] [--jobs N] [--seed N] [--write FILE]",
                                     description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter,
                                     epilog="targets:\n" + "".join(f"  {k:14}{v}\n" for k, v in TARGETS.items()))
    parser.add_argument("words", nargs="*", metavar="TARGET | SECONDS",
                        help="targets (default: all), and the seconds for each (default: 60)")
    parser.add_argument("--jobs", type=int, default=os.cpu_count(), help="targets at the same time (default: all cores)")
    parser.add_argument("--seed", type=int, help="the same inputs each time, from 1 (default: others each time)")
    documents.add_option(parser)
    options = parser.parse_args(arguments)
    if options.jobs < 1:
        parser.error("--jobs is at least 1")
    if options.seed is not None and options.seed < 1:
        parser.error("--seed is at least 1")
    options.seconds = 0
    options.targets = []
    for word in options.words:
        if word.isdigit() and int(word) > 0 and options.seconds == 0:
            options.seconds = int(word)
        elif word.isdigit():
            parser.error("one number of seconds, at least 1")
        elif word in options.targets:
            parser.error(f"'{word}' stands there twice")
        elif word in TARGETS:
            options.targets.append(word)
        else:
            parser.error(f"no target is called '{word}'; valid: {', '.join(TARGETS)}")
    options.seconds = options.seconds or 60
    return options


def prepare(target, seed):
    corpus = BUILD / "fuzz" / ("corpus" if seed is None else "seeded") / target
    if seed is not None and corpus.exists():
        shutil.rmtree(corpus)
    corpus.mkdir(parents=True, exist_ok=True)
    for number, content in enumerate(seeds.seeds(target, BUILD, SOURCE)):
        (corpus / f"seed-{number}").write_bytes(content)
    dictionary = BUILD / "fuzz" / f"{target}.dict"
    dictionary.write_text(seeds.words(target))
    return corpus, dictionary


def fuzz(target, seconds, seed):
    """One run: what it did, as a row."""
    corpus, dictionary = prepare(target, seed)
    found = BUILD / "fuzz" / "found"
    found.mkdir(exist_ok=True)
    log = BUILD / "fuzz" / f"{target}.log"
    command = [BUILD / "fuzz" / f"fuzz_{target}", corpus, f"-max_total_time={seconds}", "-timeout=60",
               "-rss_limit_mb=3000", "-malloc_limit_mb=2000", "-max_len=16384", "-print_final_stats=1", "-len_control=50", "-print_funcs=0",
               f"-artifact_prefix={found}/{target}-"]
    if seed is not None:
        command.append(f"-seed={seed}")
    if dictionary.read_text():
        command.append(f"-dict={dictionary}")
    environment = dict(os.environ, ASAN_OPTIONS="detect_leaks=0:allocator_may_return_null=0",
                       UBSAN_OPTIONS="print_stacktrace=1")
    with open(log, "wb") as out:
        process = subprocess.Popen(list(map(str, command)), stdout=out, stderr=out, env=environment, cwd=BUILD / "fuzz")
        _, status, used = os.wait4(process.pid, 0)
        process.returncode = status
    text = log.read_text(errors="replace")
    runs = re.search(r"stat::number_of_executed_units:\s*(\d+)", text)
    covered = re.findall(r" cov: (\d+)", text)
    return {"target": target, "processor_seconds": round(used.ru_utime + used.ru_stime), "found": int(status != 0),
            "runs": int(runs[1]) if runs else 0, "edges": int(covered[-1]) if covered else 0,
            "reason": "" if status == 0 else reason(text), "commit": documents.commit()}


def reason(text):
    for pattern in (r"^broken: .*", r"^SUMMARY: .*", r"^==\d+==ERROR: .*", r".*runtime error: .*"):
        match = re.search(pattern, text, re.MULTILINE)
        if match:
            return match[0]
    return "see the log"


SUMS = {"all readers": list(TARGETS)[:list(TARGETS).index("trace")],
        "traces and lessons": ["trace", "trace_events", "lesson"],
        "options and settings": ["options", "parameters"], "all": list(TARGETS)}
# What the inputs of a row are called in docs/reliability.md, which quotes it.
QUOTED = {"all readers": "files", "traces and lessons": "traces and lessons", "schedule": "scripts",
          "options and settings": "inputs", "plugin": "descriptions"}


def totals(rows, name):
    """Processor hours, inputs and findings of a target or of a sum, as text."""
    mine = [row for row in rows if row["target"] in SUMS.get(name, [name])]
    hours = sum(row["processor_seconds"] for row in mine) / 3600
    return f"{hours:.2f}", f"{sum(row['runs'] for row in mine):,}", str(sum(row["found"] for row in mine))


def quote(rows, text):
    """The text of docs/reliability.md, with the figures of today."""
    for name, unit in QUOTED.items():
        hours, runs, _ = totals(rows, name)
        text, count = re.subn(rf"\[[\d,]+ {unit} in [\d.]+ processor hours\]",
                              f"[{runs} {unit} in {hours} processor hours]", text)
        if count != 1:
            raise ValueError(f"docs/reliability.md quotes '{unit}' {count} times, not once")
    return text


def page(rows):
    """All runs so far as a document."""
    table = [["Target", "Bytes of", "Processor hours", "Inputs", "Findings"]]
    for target, what in [*TARGETS.items(), *((name, "") for name in SUMS)]:
        table.append([f"`{target}`" if what else target, what, *totals(rows, target)])
    commits = ", ".join(dict.fromkeys(row["commit"] for row in rows))
    return documents.document("Fuzzing", documents.stamp("script/fuzz --write docs/results/fuzzing.md"), [
        "All runs so far, of the commits " + commits + ". libFuzzer of clang 14, with its address and undefined-behaviour "
        "sanitizers. A finding is an input that ended the program or broke a promise that the target checks. What is "
        "not repaired yet, [reliability.md](../reliability.md) says.",
        documents.markdown_table(table)])


def main():
    options = parse(sys.argv[1:])
    os.environ["LLVM_PROFILE_FILE"] = "/dev/null"  # programs with coverage write it at their end
    targets = options.targets or list(TARGETS)
    rows = []
    with ThreadPoolExecutor(options.jobs) as pool:
        for row in pool.map(lambda target: fuzz(target, options.seconds, options.seed), targets):
            rows.append(row)
            print(f"fuzz: {row['target']:13}{row['runs']:10,} inputs {row['edges']:6} edges  "
                  + (f"FOUND {row['reason']}" if row["found"] else "nothing found"), flush=True)
    if options.write:  # beside the document, all runs
        history = options.write.with_suffix(".jsonl")
        with open(history, "a") as out:
            out.writelines(json.dumps(row) + "\n" for row in rows)
        rows_so_far = [json.loads(line) for line in history.read_text().splitlines()]
        documents.write(options.write, page(rows_so_far))
        reliability = SOURCE / "docs" / "reliability.md"
        if options.write.resolve() == SOURCE / "docs" / "results" / "fuzzing.md":
            reliability.write_text(quote(rows_so_far, reliability.read_text()))
    return 1 if any(row["found"] for row in rows) else 0


if __name__ == "__main__":
    sys.exit(main())
