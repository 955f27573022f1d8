# SPDX-License-Identifier: MIT
"""Meshes in pieces by several processes: memory, traffic and time that were measured, and what they
make of a billion tets on up to 1,024 processes.

A lattice (bench/lattice.cpp) is improved in pieces by 1, 2, 4... processes, whose outputs must have
the same bytes. The seconds of each piece, as one process with one thread needs them, are then played
again: each simulated process works on its pieces one after another, and all wait for the slowest
after each division. What else runs on the machine does not enter: seconds are those of the processor.
With --mesh, what pieces make of the time of that mesh is told as well.
"""

import argparse
import hashlib
import json
import os
import resource
import subprocess
import time
from dataclasses import dataclass
from pathlib import Path

import compare
import documents
import report

PROGRAM = 40e6  # bytes that a process may take besides its share
MOST_TRAFFIC = 35.0  # bytes a tet and division, wanted
MOST_PRICE = 1.8  # of pieces, in times of a run without, wanted
MOST_OF_TWO = 0.62  # of the time of one process, wanted
MEMORY, MOST_MEMORY = "200M", 240e6  # of a run out of core: what it is told, what it may take
PROCESSES = (1, 4, 16, 64, 256, 1024)  # that are simulated
MOST_BALLS = 10_000  # zones are made around so many tets at most, however large the mesh is
RANKS_MAY_SHARE_CORES = {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
                         "OMPI_MCA_rmaps_base_oversubscribe": "1",
                         "OMPI_MCA_mpi_yield_when_idle": "1",
                         "OMPI_MCA_btl_vader_single_copy_mechanism": "none"}


@dataclass(frozen=True)
class Cluster:
    """What is assumed of a machine that was not measured."""

    cores: int = 16  # of a process
    efficiency: float = 0.75  # of its threads, within a piece
    network: float = 5e9  # bytes a second into a process
    files: float = 10e9  # bytes a second, of all processes together
    bytes_in_file: float = 41.0  # a tet in a file of HDF5: 36, and its share of a vertex


@dataclass(frozen=True)
class Step:
    """A division or a round of zones, as it was measured."""

    is_zones: bool
    tets: int  # of the mesh
    seconds: list[float]  # of each piece, in order; one thread
    dividing: float  # seconds that dividing took, of one process
    bad_before: int


# --- what was measured


def steps_of(told: dict) -> list[Step]:
    """@param told  the report of a run of one process"""
    ranks, steps, share = told["ranks"], [], told["processor_share"]
    bad = told["before"]["n_bad"]
    for number, made in enumerate(told["passes"]):
        parts = sorted((part["part"], part["seconds"] * share) for part in ranks["parts"]
                       if part["step"] == number)
        divided = ranks["divisions"][number]
        steps.append(Step(made["name"] == "zones", divided["tets"], [s for _, s in parts],
                          divided["seconds"] * share, bad))
        bad = made["n_bad"]
    return steps


def checking_of(told: dict) -> float:
    """Seconds a tet of one process to measure the mesh before and after, dividing apart."""
    divisions = told["ranks"]["divisions"]
    seconds = told["seconds"]["measuring"] - divisions[0]["seconds"] - divisions[-1]["seconds"]
    return max(0.0, seconds) * told["processor_share"] / told["before"]["tets"]


def traffic_table(runs: dict[int, dict], whole: dict) -> documents.Table:
    """@param whole  the report of a run without pieces"""
    table = [["processes", "largest MB", "smallest MB", "bound MB", "bytes a tet and division",
              "reading s", "improving s", "seconds in all"]]
    for count, told in runs.items():
        peaks = told["ranks"]["peak_memory_bytes"]
        bound = bound_of(count, whole)
        seconds = told["seconds"]
        table.append([f"{count}", f"{max(peaks) / 1e6:.0f}", f"{min(peaks) / 1e6:.0f}",
                      f"{bound / 1e6:.0f}" if count > 1 else "",
                      f"{told['ranks']['bytes_a_tet_and_division']:.1f}",
                      f"{seconds['building']:.1f}", f"{seconds['improving']:.1f}",
                      f"{seconds['total']:.1f}"])
    return table


def bound_of(count: int, whole: dict) -> float:
    return 1.3 / count * whole["peak_memory_bytes"] + PROGRAM


def kept_or_missed(runs: dict[int, dict], whole: dict) -> str:
    """Each bound with what was measured, and what one process works on at once."""
    several = {count: told["ranks"] for count, told in runs.items() if count > 1}
    if not several:
        return "Bounds are for several processes: none ran."
    said = []
    for count, ranks in several.items():
        peak, bound = max(ranks["peak_memory_bytes"]), bound_of(count, whole)
        said.append(f"{count} processes {'keep' if peak <= bound else 'miss'} the bound for memory, with "
                    f"{peak / 1e6:.0f} of {bound / 1e6:.0f} MB")
    traffic = max(ranks["bytes_a_tet_and_division"] for ranks in several.values())
    said.append(f"traffic is at most {traffic:.1f} bytes a tet and division, "
                f"{'within' if traffic <= MOST_TRAFFIC else 'more than'} the {MOST_TRAFFIC:.0f} that are wanted")
    told = runs[max(runs)]
    largest = {is_zones: max((part["tets"] for part in told["ranks"]["parts"]
                              if (told["passes"][part["step"]]["name"] == "zones") == is_zones), default=0)
               for is_zones in (False, True)}
    return (f"{'; '.join(said)}. The largest piece has {largest[False]:,} tets, the largest zone "
            f"{largest[True]:,}.")


def out_of_core(told: dict) -> str:
    peak = told["peak_memory_bytes"]
    return (f"`tetmend improve --memory {MEMORY}` of the same mesh took {peak / 1e6:.0f} MB, "
            f"{'within' if peak <= MOST_MEMORY else 'more than'} the {MOST_MEMORY / 1e6:.0f} MB that "
            "it may take.")


def steps_table(steps: list[Step]) -> documents.Table:
    table = [["step", "pieces", "us a tet", "longest / mean", "dividing us a tet"]]
    names = {False: "division", True: "zones"}
    for number, step in enumerate(steps):
        divisions = sum(not each.is_zones for each in steps[:number])
        count = number + 1 - (divisions if step.is_zones else 0)
        if not step.seconds:
            continue
        mean = sum(step.seconds) / len(step.seconds)
        table.append([f"{names[step.is_zones]} {count}", f"{len(step.seconds)}",
                      f"{1e6 * sum(step.seconds) / step.tets:.2f}",
                      f"{max(step.seconds) / mean:.2f}", f"{1e6 * step.dividing / step.tets:.2f}"])
    return table


# --- what follows for other numbers of processes


def loads_of_ranges(seconds: list[float], ranks: int) -> list[float]:
    """Neighbours on the curve are of one process: seconds of each."""
    loads = [0.0] * ranks
    for i, each in enumerate(seconds):
        loads[i * ranks // len(seconds)] += each
    return loads


def loads_of_zones(seconds: list[float], ranks: int) -> list[float]:
    """The largest first, each to the process that has least."""
    loads = [0.0] * ranks
    for each in sorted(seconds, reverse=True):
        loads[loads.index(min(loads))] += each
    return loads


@dataclass(frozen=True)
class Played:
    """Seconds of a run that was played."""

    improving: float
    zones: float
    dividing: float  # and checking
    files: float
    work: float  # of all processes together, without waiting

    def total(self) -> float:
        return self.improving + self.zones + self.dividing + self.files


@dataclass(frozen=True)
class Measured:
    """All that is played again."""

    steps: list[Step]
    checking: float  # seconds a tet
    bytes_a_tet: float  # and division, from other processes


def play(measured: Measured, tets: float, pieces: int, ranks: int, cluster: Cluster) -> Played:
    """A mesh of so many tets. Its piece i takes what piece i of the measured mesh took, from the
    first again behind the last, in proportion to its size."""
    speed = cluster.cores * cluster.efficiency if cluster.cores > 1 else 1.0
    share = tets / ranks
    steps, sent = measured.steps, measured.bytes_a_tet / cluster.network
    # Divided once more than there are steps: for the check at the end.
    dividing = share * (measured.checking + steps[0].dividing / steps[0].tets + sent)
    improving = zones = work = 0.0
    for step in steps:
        dividing += share * (step.dividing / step.tets + sent)
        if not step.seconds:
            continue
        if step.is_zones:
            known = min(step.bad_before, MOST_BALLS)
            wanted = min(step.bad_before * tets / step.tets, MOST_BALLS)
            count = max(1, round(len(step.seconds) * wanted / max(known, 1)))
            seconds = [step.seconds[i % len(step.seconds)] / speed for i in range(count)]
            zones += max(loads_of_zones(seconds, ranks))
        else:
            larger = tets / pieces / (step.tets / len(step.seconds))
            seconds = [step.seconds[i % len(step.seconds)] * larger / speed for i in range(pieces)]
            improving += max(loads_of_ranges(seconds, ranks))
        work += sum(seconds)
    files = 2 * cluster.bytes_in_file * tets / cluster.files
    return Played(improving, zones, dividing, files, work)


def played_row(ranks: int, tets: float, pieces: int, played: Played) -> list[str]:
    waiting = max(0.0, 1 - played.work / ranks / (played.improving + played.zones))
    return [f"{ranks:,}", f"{tets / 1e6:,.0f}", f"{pieces:,}", f"{played.improving:.1f}",
            f"{played.zones:.1f}", f"{played.dividing:.1f}", f"{played.files:.1f}",
            f"{played.total():.1f}", f"{100 * waiting:.0f}"]


PLAYED = ["processes", "million tets", "pieces", "improving s", "zones s", "dividing, checking s", "files s",
          "in all s", "waiting %"]


def strong_table(measured: Measured, piece_tets: float) -> documents.Table:
    tets = 1e9
    pieces = round(tets / piece_tets)
    return [PLAYED, *(played_row(ranks, tets, pieces, play(measured, tets, pieces, ranks, Cluster()))
                      for ranks in PROCESSES)]


def weak_table(measured: Measured) -> documents.Table:
    table = [PLAYED]
    for ranks in PROCESSES:
        tets, pieces = 16e6 * ranks, 4 * ranks
        table.append(played_row(ranks, tets, pieces, play(measured, tets, pieces, ranks, Cluster())))
    return table


# --- the document

MEASURED = (
    "A lattice of moved points, {tets:,} tets, {pieces} pieces, one thread a process. All outputs "
    "have the same bytes. *bound*: 1.3 / n of the {whole:.0f} MB that a run without pieces takes, "
    "and 40 MB. Processes share {cores} cores with each other and with what else ran on this "
    "machine, so these seconds say little."
)
STEPS = (
    "One process: seconds of improving all pieces, for each tet of the mesh, and how uneven pieces "
    "are; of the processor, of which this run had {0:.0f} %. "
    "Dividing is what is not improving: reading pieces, sorting their tets, and sending."
)
ASSUMED = (
    "Not measured, but assumed: a process has {0.cores} cores, whose threads reach {1:.0f} % of "
    "their sum within a piece; {2:.0f} GB a second into each process; files of {0.bytes_in_file:.0f} "
    "bytes a tet are read and written with {3:.0f} GB a second by all together; dividing and packing "
    "is done by one core of each process. Pieces of such a mesh take what those of the measured one "
    "took, in proportion to their tets. Zones are made around {4:,} tets at most, so they do not grow "
    "with the mesh. *waiting %*: of the time of improving, how much processes wait for the slowest."
)


SECONDS = (
    "`{name}`, {tets:,} tets, {pieces} pieces, one thread; seconds of the processor, with reading, "
    "dividing, checking and writing. {kept}"
)


@dataclass(frozen=True)
class Timed:
    """A mesh whose time is looked at: reports of runs without pieces and by one process."""

    name: str
    pieces: int
    whole: dict
    alone: dict


def share_of_two(timed: Timed) -> float:
    """Of the time in which one process improves all pieces, what two take that wait for each other."""
    steps = [step for step in steps_of(timed.alone) if step.seconds]
    slower = sum(max((loads_of_zones if step.is_zones else loads_of_ranges)(step.seconds, 2))
                 for step in steps)
    return slower / sum(sum(step.seconds) for step in steps)


def time_kept(timed: Timed) -> str:
    price = timed.alone["processor_seconds"] / timed.whole["processor_seconds"]
    return (f"Pieces take {price:.1f} times as long as the run without, where {MOST_PRICE} are wanted; "
            f"two processes, played again, take {share_of_two(timed):.2f} of the time that one takes for "
            f"improving, where {MOST_OF_TWO} are wanted.")


def seconds_table(timed: Timed) -> documents.Table:
    table = [["run", "seconds", "bad tets", "smallest angle", "largest angle", "tets"]]
    for name, told in (("without pieces", timed.whole), ("in pieces", timed.alone)):
        after = told["after"]
        table.append([name, f"{told['processor_seconds']:.1f}", f"{after['n_bad']:,}",
                      f"{after['theta_min']:.1f}", f"{after['theta_max']:.1f}", f"{after['tets']:,}"])
    return table


def timed_parts(timed: Timed) -> list[str]:
    return ["## Time", SECONDS.format(name=timed.name, tets=timed.whole["before"]["tets"],
                                      pieces=timed.pieces, kept=time_kept(timed)),
            documents.markdown_table(seconds_table(timed))]


def page(made: documents.Stamp, runs: dict[int, dict], whole: dict, on_disk: dict,
         timed: Timed | None = None) -> str:
    """@param runs  what each run in pieces reported, by the number of processes; 1 is among them"""
    alone, most = runs[1], runs[max(runs)]
    steps = steps_of(alone)
    known = Measured(steps, checking_of(alone), most["ranks"]["bytes_a_tet_and_division"])
    cluster = Cluster()
    measured = MEASURED.format(tets=whole["before"]["tets"], pieces=len(steps[0].seconds),
                               whole=whole["peak_memory_bytes"] / 1e6, cores=os.cpu_count())
    assumed = ASSUMED.format(cluster, 100 * cluster.efficiency, cluster.network / 1e9,
                             cluster.files / 1e9, MOST_BALLS)
    parts = ["## Memory and traffic", measured, documents.markdown_table(traffic_table(runs, whole)),
             kept_or_missed(runs, whole), out_of_core(on_disk), *(timed_parts(timed) if timed else []),
             "## Pieces", STEPS.format(100 * alone["processor_share"]),
             documents.markdown_table(steps_table(steps)),
             "## Played on more processes", assumed,
             "A billion tets in pieces of 4 million:",
             documents.markdown_table(strong_table(known, 4e6)),
             "The same in pieces of a quarter million, so that 1,024 processes have some each:",
             documents.markdown_table(strong_table(known, 0.25e6)),
             "16 million tets for each process, in four pieces:",
             documents.markdown_table(weak_table(known))]
    return documents.document("Pieces on many processes", made, parts)


# --- measuring


def processor_seconds() -> float:
    """Of all programs that were started and have ended."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def told_by(command: list, told: Path, **environment: str) -> dict:
    """The report of a run, and which share of its time it had a processor."""
    used, start = processor_seconds(), time.monotonic()
    subprocess.run([*map(str, command), "--quiet", "--report", str(told)], check=True,
                   env=dict(os.environ, **environment))
    used = processor_seconds() - used
    share = used / (time.monotonic() - start)
    return dict(json.loads(told.read_text()), processor_share=min(share, 1.0), processor_seconds=used)


def peak_of(command: list) -> int:
    """Bytes that a run takes which reports nothing: pictures of bad tets would count, too."""
    with subprocess.Popen([*map(str, command), "--quiet"]) as run:
        _, status, used = os.wait4(run.pid, 0)
        run.returncode = os.waitstatus_to_exitcode(status)
    if run.returncode != 0:
        raise SystemExit(f"ranks: {command[0]} failed")
    return used.ru_maxrss * 1024


def measure(size: float, pieces: int, counts: list[int]) -> tuple[dict[int, dict], dict, dict]:
    """Runs in pieces by their number of processes, one without pieces, one out of core"""
    folder = compare.WORK / "ranks"
    folder.mkdir(parents=True, exist_ok=True)
    mesh, improved, told = (folder / name for name in ("lattice.meshb", "out.meshb", "report.json"))
    subprocess.run([compare.BUILD / "bench" / "lattice", f"{size:.0f}", mesh], check=True)
    alone = [compare.BUILD / "bin" / "tetmend", "improve", mesh, "-o", improved]
    whole = dict(told_by(alone, told), peak_memory_bytes=peak_of(alone))
    on_disk = told_by([compare.BUILD / "bin" / "tetmend", "improve", mesh, "-o", improved, "--memory",
                       MEMORY], told)
    runs, contents = {}, set()
    for count in counts:
        runs[count] = told_by(["mpirun", "-n", count, compare.BUILD / "bin" / "tetmend-mpi", "improve",
                               mesh, "-o", improved, "--pieces", pieces, "--threads", 1], told,
                              **RANKS_MAY_SHARE_CORES)
        with improved.open("rb") as made:
            contents.add(hashlib.file_digest(made, "md5").hexdigest())
        peaks = runs[count]["ranks"]["peak_memory_bytes"]
        compare.progress(f"{count} processes: {runs[count]['seconds']['total']:.0f} s, at most "
                         f"{max(peaks) / 1e6:.0f} MB")
    if len(contents) != 1:
        raise SystemExit("ranks: the number of processes shows in the result")
    mesh.unlink()
    improved.unlink()
    return runs, whole, on_disk


def measure_time(mesh: Path, pieces: int) -> Timed:
    folder = compare.WORK / "ranks"
    folder.mkdir(parents=True, exist_ok=True)
    improved, told = folder / "out.meshb", folder / "report.json"
    name, mesh = mesh.name.split(".")[0], compare.plain(mesh)
    whole = told_by([compare.BUILD / "bin" / "tetmend", "improve", mesh, "-o", improved], told)
    alone = told_by(["mpirun", "-n", 1, compare.BUILD / "bin" / "tetmend-mpi", "improve", mesh, "-o",
                     improved, "--pieces", pieces, "--threads", 1], told, **RANKS_MAY_SHARE_CORES)
    improved.unlink()
    return Timed(name, pieces, whole, alone)


def main() -> None:
    parser = argparse.ArgumentParser(prog="script/bench --ranks", description=__doc__)
    parser.add_argument("--size", type=float, default=1e7, metavar="N",
                        help="tets of the lattice (default: 10 million)")
    parser.add_argument("--pieces", type=int, default=32, metavar="P", help="(default: 32)")
    parser.add_argument("--processes", default="1,2,4,8", metavar="N,N,...",
                        help="numbers of processes, 1 among them (default: 1,2,4,8)")
    parser.add_argument("--mesh", metavar="MESH", help="its time is looked at: a name or a file")
    parser.add_argument("--mesh-pieces", type=int, default=16, metavar="P",
                        help="into which that is divided (default: 16)")
    documents.add_option(parser)
    options = parser.parse_args()
    counts = [int(word) for word in options.processes.split(",")]
    if 1 not in counts:
        parser.error("--processes: 1 must be among them")
    runs, whole, on_disk = measure(options.size, options.pieces, counts)
    timed = measure_time(compare.named_mesh(options.mesh), options.mesh_pieces) if options.mesh else None
    print(report.text_table(traffic_table(runs, whole)))
    print(kept_or_missed(runs, whole))
    print(out_of_core(on_disk))
    print(report.text_table(steps_table(steps_of(runs[1]))))
    if timed:
        print(time_kept(timed))
        print(report.text_table(seconds_table(timed)))
    if options.write:
        documents.write(options.write,
                        page(documents.stamp("script/bench --ranks"), runs, whole, on_disk, timed))


if __name__ == "__main__":
    main()
