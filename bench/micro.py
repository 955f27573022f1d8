# SPDX-License-Identifier: MIT
"""The micro-benchmarks as a table: the parts that a run is made of, one by one.

Options besides --write go to Google Benchmark.
"""

import argparse
import json
import subprocess

import compare
import documents
import report

REPETITIONS = 20
TEXT = (
    f"The least of {REPETITIONS} repetitions, in time of the processor; by the clock where a name "
    "ends in `manual_time`, for the processor also copies the mesh there. Of a covering search, "
    "`floor:1` means that the covering must be better than the tets that are there."
)
SCALES = {"ns": 1e-3, "us": 1.0, "ms": 1e3}  # to microseconds


def micros(benchmark: dict) -> float:
    by_clock = benchmark["name"].endswith("manual_time")
    return benchmark["real_time" if by_clock else "cpu_time"] * SCALES[benchmark["time_unit"]]


def table_of(told: dict) -> documents.Table:
    """@param told  Google Benchmark's JSON"""
    least: dict[str, float] = {}
    for benchmark in told["benchmarks"]:
        if benchmark["run_type"] == "iteration":
            name = benchmark["name"]
            least[name] = min(micros(benchmark), least.get(name, float("inf")))
    rows = [[f"`{name}`", f"{time:.3g}" if time < 1000 else f"{time:,.0f}"]
            for name, time in least.items()]
    return [["part", "microseconds"], *rows]


def page(made: documents.Stamp, table: documents.Table) -> str:
    return documents.document("Parts", made, [TEXT, documents.markdown_table(table)])


def main() -> None:
    parser = argparse.ArgumentParser(prog="script/bench --micro", description=__doc__)
    documents.add_option(parser)
    options, others = parser.parse_known_args()
    program = str(compare.BUILD / "bench" / "micro")
    if not options.write:
        command = [program, "--benchmark_counters_tabular=true", *others]
        raise SystemExit(subprocess.run(command, check=False).returncode)
    command = [program, "--benchmark_format=json", f"--benchmark_repetitions={REPETITIONS}"]
    told = subprocess.run([*command, *others], check=True, stdout=subprocess.PIPE, text=True).stdout
    table = table_of(json.loads(told))
    print(report.text_table(table))
    documents.write(options.write, page(documents.stamp("script/bench --micro"), table))


if __name__ == "__main__":
    main()
