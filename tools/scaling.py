#!/usr/bin/env python3
"""How runs on many processes would scale: measures what the ranks of real runs do, and replays it on up to 65,536 ranks.

    tools/scaling.py build/release/src/app/lamina build/release/bench/lamina_measure_ranks > out/scaling.json

lamina_measure_ranks makes the same mesh on 1, 2, 4 ... ranks and says how much processor time each rank takes for each
stage, and how long the stage takes with the waiting. Two finer meshes, on two large numbers of ranks each, say what
does not become less on more ranks, how it grows with the mesh, and how long the cuts round the bodies last, which some
ranks make while the others make pieces. Further runs of them, with 2 million triangles a rank, say how much longer the
end takes than what the mean rank does there; of each of its phases the median counts. The finer mesh on one rank says
what a triangle costs. A file of the first mesh says how many triangles each piece has. The replay deals pieces of the
same sizes as ranks ask for them, the largest estimates first, and adds the rest. docs/scaling.md states the assumptions
and shows the result. All of it takes a quarter of an hour and 16 GiB.
"""

import argparse
import heapq
import json
import math
import random
import re
import statistics
import struct
import subprocess
import sys
import tempfile
from collections import Counter
from pathlib import Path


def piece_sizes(vtu):
    """Returns the number of triangles of each piece of the outer region in a VTU file that lamina has written."""
    data = Path(vtu).read_bytes()
    start = data.index(b"<AppendedData")
    start = data.index(b"_", start) + 1
    head = data[:start].decode("ascii", "replace")

    def array(name, width):
        offset = int(re.search(rf'Name="{name}"[^>]*offset="(\d+)"', head).group(1))
        length = struct.unpack_from("<Q", data, start + offset)[0]
        return memoryview(data)[start + offset + 8 : start + offset + 8 + length].cast({1: "B", 4: "I"}[width])

    region, piece = array("region", 1), array("piece", 4)
    return sorted(Counter(p for p, r in zip(piece, region) if r == 1).values())


CASE = ["naca:0012", "--preset", "none", "--first-height", "2.5e-5", "--growth", "1.15", "--layers", "30",
        "--max-ray-angle", "4", "--far-field", "50"]  # that of lamina_measure_ranks
PIECES = "layer triangulation, refinement and check of pieces"
AT_END = ("numbering", "check", "assembly")
WEAK_SHARE = 2e6  # triangles a rank for weak scaling, and with 1e9 triangles on 512 ranks
LARGE_SHARE = 1e7  # triangles a rank of published runs on clusters
LINES_SHARE = 0.15  # of what is divided of the decoupling: lines, which come before the searches


def sizes_of(program, gradation):
    """Makes the mesh, and returns the sizes of its pieces."""
    with tempfile.TemporaryDirectory(prefix="lamina-scaling-") as folder:
        mesh = Path(folder) / "mesh.vtu"
        subprocess.run([program, "mesh", *CASE, "--gradation", str(gradation), "--stream", "--quiet", "-o", mesh],
                       check=True)  # fmt: skip
        return piece_sizes(mesh)


def measure(program, arguments):
    """Returns what lamina_measure_ranks tells with these arguments."""
    runs = json.loads(subprocess.run([program, *map(str, arguments)],
                                     check=True, capture_output=True, text=True).stdout)  # fmt: skip
    if len({run["hash"] for run in runs}) != 1:
        sys.exit("the ranks have made different meshes")
    return runs


def stage_seconds(run, names):
    """Returns the processor time of each rank in these stages."""
    return [sum(seconds for name, seconds in stages if name in names) for stages in run["stages"]]


def summarize(run):
    """Returns what the busiest rank did in each part of a run, and what rank 0 did alone at the end."""
    before = stages_before(run)
    at_end = stage_seconds(run, AT_END)
    return {"ranks": run["ranks"], "before": max(stage_seconds(run, before)),
            "decoupling": max(stage_seconds(run, {"decoupling"})), "pieces": max(stage_seconds(run, {PIECES})),
            "pieces_of_all": sum(stage_seconds(run, {PIECES})), "end_at_rank_0": at_end[0],
            "decoupling_with_waiting": with_waiting(run, {"decoupling"}), "end_with_waiting": with_waiting(run, AT_END),
            "bytes_a_piece": run["bytes"] / run["pieces"], "messages": run["messages"]}  # fmt: skip


def stages_before(run):
    """Returns the names of the stages before the decoupling."""
    return {name for stages in run["stages"] for name, _ in stages} - {PIECES, "decoupling", *AT_END}


def of_all(run, names):
    """Returns the processor time of all ranks together in these stages."""
    return sum(stage_seconds(run, names))


def with_waiting(run, names):
    """Returns the time of these stages where all ranks wait for the busiest one at each exchange."""
    return sum(seconds for name, seconds in run["with_waiting"] if name in names)


def line_through(a, b):
    """Returns the fixed part and the part per triangle of a line through two points (triangles, seconds); neither is
    negative."""
    slope = max(0.0, (b[1] - a[1]) / (b[0] - a[0]))
    return max(0.0, a[1] - slope * a[0]), slope


def power_through(a, b):
    """Returns the seconds of 1e9 triangles and the power, of a power of the triangles through two such points."""
    power = math.log(b[1] / a[1]) / math.log(b[0] / a[0])
    return b[1] * (1e9 / b[0]) ** power, power


def cutting_of(few, many):
    """Returns what each rank repeats of the decoupling, what those divide that do not cut round the bodies, and how long
    these cuts last, from runs of the same mesh on few and on many ranks."""
    of_few, of_many = (of_all(run, {"decoupling"}) - run["pieces_during_cuts"] for run in (few, many))
    repeated = (of_many - of_few) / (many["ranks"] - few["ranks"])
    cutters = cutting_ranks(many["ranks"])
    of_cutters = sum(stage_seconds(many, {"decoupling"})[:cutters])
    return {"triangles": few["triangles"], "repeated": repeated,
            "divided": of_many - of_cutters - (many["ranks"] - cutters) * repeated,
            "critical": many["cuts"],
            "before": of_all(many, stages_before(many)) / many["ranks"]}  # fmt: skip


def beyond_mean(runs):
    """Returns by how much the end takes longer than what the mean rank does there, from runs of the same mesh on the same
    number of ranks. Of each phase the median counts: now and then a rank is held up in one of them by the machine."""
    names = [name for name, _ in runs[0]["with_waiting"]]
    return sum(statistics.median(lasts - mean for _, mean, _, _, lasts in phase_of_runs)
               for phase_of_runs in zip(*(run["phases"] for run in runs))
               if names[phase_of_runs[0][0]] in AT_END)  # fmt: skip


def cutting_ranks(ranks):
    """Returns how many ranks cut the regions round the bodies."""
    return max(ranks // 32, min(ranks // 4, 8)) if ranks >= 4 else ranks


def calibrate(one, triangles, cuts, ends):
    """Returns the times that the replay needs, in seconds.

    `one` is the summary of a run on one rank of a mesh with so many triangles, `cuts` two results of cutting_of(), `ends`
    (triangles, seconds beyond the mean rank) of two meshes.
    """
    cost = {"piece_per_triangle": one["pieces_of_all"] / triangles,
            "cutting_divided": one["decoupling"] / triangles,
            "cutting_divided_on_many": cuts[1]["divided"] / cuts[1]["triangles"],
            "end_divided": one["end_at_rank_0"] / triangles}  # fmt: skip
    cost["cutting_fixed"], cost["cutting_repeated"] = line_through(
        *((cut["triangles"], cut["repeated"]) for cut in cuts))
    # A finer mesh needs more sizes.
    cost["before_of_1e9"], cost["before_power"] = power_through(*((cut["triangles"], cut["before"]) for cut in cuts))
    # The cuts round the bodies go with the edges of borders.
    cost["critical_of_1e9"], cost["critical_power"] = power_through(
        *((cut["triangles"], cut["critical"]) for cut in cuts))
    cost["end_of_1e9"], cost["end_power"] = power_through(*ends)
    return cost


def hops(ranks):
    """Returns how many steps it takes from one rank to all."""
    return math.ceil(math.log2(ranks)) if ranks > 1 else 0


def replay(ranks, triangles, sizes, cost, model):
    """Returns the seconds of a run: pieces are taken one by one by whoever is idle, the largest estimates first. Some
    ranks cut the regions round the bodies before."""
    chance = random.Random(1)
    mean = sum(sizes) / len(sizes)
    count = max(1, round(triangles / (mean * model["piece_scale"])))
    work = []
    for _ in range(count):
        size = chance.choice(sizes) * model["piece_scale"]
        estimate = size * (1 + chance.uniform(-1, 1) * model["estimate_error"])
        noise = 1 + abs(chance.gauss(0, model["noise"]))
        work.append((estimate, size * cost["piece_per_triangle"] * noise))
    work.sort(reverse=True)
    before = cost["before_of_1e9"] * (triangles / 1e9) ** cost["before_power"]
    divided_too = model["divided_too"]
    cutting = (cost["cutting_fixed"] + triangles * cost["cutting_repeated"]) * (1 - divided_too)
    if ranks == 1:
        free = [before + triangles * cost["cutting_divided"]]
        end = triangles * cost["end_divided"]
    else:
        cutters = cutting_ranks(ranks)
        if cutters == ranks:  # all do everything, and wait for each other in the rounds of cuts
            cutters = 0
        share = triangles * cost["cutting_divided_on_many"] / (ranks - cutters)
        critical = cost["critical_of_1e9"] * (triangles / 1e9) ** cost["critical_power"] * model["cuts_scale"]
        start = before + cutting + LINES_SHARE * share
        critical += model["rounds"] * hops(cutters) * model["latency_seconds"]
        free = [start + (1 - LINES_SHARE) * share] * (ranks - cutters) + [start + critical] * cutters
        end = cost["end_of_1e9"] * (triangles / 1e9) ** cost["end_power"] * (1 - divided_too)
        end += triangles * cost["end_divided"] / ranks
    heapq.heapify(free)
    for _, seconds in work:
        heapq.heapreplace(free, free[0] + model["fetch_seconds"] + seconds)
    last = max(free)
    told = hops(ranks) * (model["latency_seconds"] * model["collectives"]
                          + model["bytes_told_of_piece"] * count / model["bytes_per_second"])  # fmt: skip
    output = triangles * model["bytes_per_triangle"] / model["output_bytes_per_second"]
    return {"seconds": last + end + told + output, "pieces": count}


def tables(sizes, cost, model):
    """Returns weak scaling, with two shares of triangles, and strong scaling: efficiencies against one rank."""
    weak, strong = {}, []
    for share in (WEAK_SHARE, LARGE_SHARE):
        one = replay(1, share, sizes, cost, model)["seconds"]
        runs = [{"ranks": ranks, **replay(ranks, share * ranks, sizes, cost, model)} for ranks in (1, 32, 1024)]
        weak[share] = [{"efficiency": one / run["seconds"], **run} for run in runs]
    whole = replay(1, 1e9, sizes, cost, model)["seconds"]
    for ranks in (1, 2, 8, 64, 512, 4096, 65536):
        run = replay(ranks, 1e9, sizes, cost, model)
        strong.append({"ranks": ranks, "efficiency": whole / ranks / run["seconds"], **run})
    return {"weak": weak[WEAK_SHARE], "weak_large": weak[LARGE_SHARE], "strong": strong}


MODEL = {
    "piece_scale": 1.0,  # size of pieces, relative to those of the run
    "divided_too": 0.0,  # share of what ranks repeat, and of the end at rank 0, that they would divide as well
    "cuts_scale": 1.0,  # how long the cuts round the bodies last, relative to those of the runs
    "estimate_error": 0.05,  # of the work of pieces, on either side
    "noise": 0.02,  # of the time of a piece
    "fetch_seconds": 5e-6,  # one atomic fetch from another rank
    "latency_seconds": 5e-6,
    "rounds": 16,  # of cuts, each with an exchange among those who cut
    "collectives": 16,  # calls of functions in which all ranks wait for each other
    "bytes_told_of_piece": 2.0,  # to all ranks: its work, and the numbers of vertices of its lines
    "bytes_per_second": 5e9,  # between two ranks
    "bytes_per_triangle": 0.0,  # of output; 0: a sink that counts
    "output_bytes_per_second": 1e10,  # of the file system, shared by all ranks
}
VARIANTS = {
    "as now": {},
    "as now, pieces of a quarter": {"piece_scale": 0.25},
    "as now, 24 bytes a triangle to disk": {"bytes_per_triangle": 24.0},
    "ranks divide what they repeat": {"divided_too": 1.0},
    "cuts round the bodies take half of the time": {"cuts_scale": 0.5},
}


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program", help="lamina")
    parser.add_argument("measure", help="lamina_measure_ranks")
    parser.add_argument("--gradation", type=float, default=0.0026, help="of the runs that are measured")
    parser.add_argument("--finer", default="0.0004,0.00014", help="gradations of two finer meshes [%(default)s]")
    parser.add_argument("--many", default="104,512", help="two numbers of ranks that cut the finer meshes [%(default)s]")
    parser.add_argument("--ranks", default="1,2,4,8,16,32", help="of the runs that are measured [%(default)s]")
    parser.add_argument("--repeat", type=int, default=3, help="runs for medians of the cuts and of the end [%(default)s]")
    parser.add_argument("--set", action="append", default=[], metavar="NAME=VALUE", help="a parameter of the model")
    arguments = parser.parse_args()
    for text in arguments.set:
        name, value = text.split("=")
        if name not in MODEL:
            parser.error(f"no parameter '{name}' (known: {', '.join(MODEL)})")
        MODEL[name] = float(value)
    ranks, many = arguments.ranks.split(","), arguments.many.split(",")
    runs = measure(arguments.measure, [arguments.gradation, *ranks])
    cuts, ends = [], []
    for gradation in arguments.finer.split(","):
        each = [cutting_of(*measure(arguments.measure, ["--until-pieces", gradation, *many]))
                for _ in range(arguments.repeat)]  # fmt: skip
        cuts.append({name: statistics.median(cut[name] for cut in each) for name in each[0]})
        ranks_at_end = max(2, round(cuts[-1]["triangles"] / WEAK_SHARE))
        ended = measure(arguments.measure, ["--forget", gradation, *arguments.repeat * [ranks_at_end]])
        ends.append((ended[0]["triangles"], beyond_mean(ended)))
    triangles = runs[0]["triangles"]
    sizes = sizes_of(arguments.program, arguments.gradation)
    parts = [summarize(run) for run in runs]
    cost = calibrate(parts[0], triangles, cuts, ends)
    large = measure(arguments.measure, ["--forget", arguments.finer.split(",")[-1], 1])[0]
    cost_of_large = calibrate(summarize(large), large["triangles"], cuts, ends)
    one = replay(1, triangles, sizes, cost, MODEL)["seconds"]
    for part in parts:
        with_waiting_in_all = (part["before"] + part["decoupling_with_waiting"] + part["pieces_of_all"] / part["ranks"]
                               + part["end_with_waiting"])  # fmt: skip
        part["speed_up_with_waiting"] = (parts[0]["before"] + parts[0]["decoupling"] + parts[0]["pieces_of_all"]
                                         + parts[0]["end_at_rank_0"]) / with_waiting_in_all  # fmt: skip
        part["speed_up_of_model"] = one / replay(part["ranks"], triangles, sizes, cost, MODEL)["seconds"]
    result = {
        "triangles": triangles,
        "pieces": runs[0]["pieces"],
        "measured": parts,
        "cuts": cuts,
        "ends": ends,
        "large": {"triangles": large["triangles"], **summarize(large)},
        "cost": cost,
        "cost_of_large": cost_of_large,
        "model": MODEL,
        "replayed": {name: tables(sizes, cost_of_large, {**MODEL, **change}) for name, change in VARIANTS.items()},
    }
    json.dump(result, sys.stdout, indent=1)
    print()


if __name__ == "__main__":
    main()
