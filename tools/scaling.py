#!/usr/bin/env python3
"""How runs on many processes would scale: measures what the ranks of real runs do, and replays it on up to 65,536 ranks.

    tools/scaling.py build/release/src/app/lamina build/release/bench/lamina_measure_ranks > out/scaling.json

lamina_measure_ranks makes the same mesh on 1, 2, 4 ... ranks and says how much processor time each rank takes for each
stage. What does not become less with more ranks is repeated by each; what rank 0 alone does is told apart. Runs on a finer
mesh say which part of both grows with the mesh. A file of the same mesh says how many triangles each piece has. The replay deals pieces of the same sizes as ranks ask for them, the
largest estimates first, and adds the rest. docs/scaling.md states the assumptions and shows the result.
"""

import argparse
import heapq
import json
import math
import random
import re
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


def sizes_of(program, gradation):
    """Makes the mesh, and returns the sizes of its pieces."""
    with tempfile.TemporaryDirectory(prefix="lamina-scaling-") as folder:
        mesh = Path(folder) / "mesh.vtu"
        subprocess.run([program, "mesh", *CASE, "--gradation", str(gradation), "--stream", "--quiet", "-o", mesh],
                       check=True)  # fmt: skip
        return piece_sizes(mesh)


def measure(program, gradation, ranks):
    """Returns what the ranks of runs with these numbers of ranks did."""
    runs = json.loads(subprocess.run([program, str(gradation), *ranks],
                                     check=True, capture_output=True, text=True).stdout)  # fmt: skip
    if len({run["hash"] for run in runs}) != 1:
        sys.exit("the ranks have made different meshes")
    return runs


def stage_seconds(run, names):
    """Returns the processor time of each rank in these stages."""
    return [sum(seconds for name, seconds in stages if name in names) for stages in run["stages"]]


def summarize(run):
    """Returns what the busiest rank did in each part of a run, and what rank 0 did alone at the end."""
    names = {name for stages in run["stages"] for name, _ in stages}
    before = names - {PIECES, "decoupling", *AT_END}
    at_end = stage_seconds(run, AT_END)
    return {"ranks": run["ranks"], "before": max(stage_seconds(run, before)),
            "decoupling": max(stage_seconds(run, {"decoupling"})), "pieces": max(stage_seconds(run, {PIECES})),
            "pieces_of_all": sum(stage_seconds(run, {PIECES})), "end_at_rank_0": at_end[0],
            "end_elsewhere": max(at_end[1:], default=0.0),
            "bytes_a_piece": run["bytes"] / run["pieces"], "messages": run["messages"]}  # fmt: skip


def beyond_share(parts, name):
    """Returns what the busiest of the most ranks takes beyond its share of what one rank takes."""
    one, most = parts[0], parts[-1]
    share = 1 / most["ranks"]
    return max(0.0, (most[name] - share * one[name]) / (1 - share))


def calibrate(measured):
    """Returns the processor time of what is divided, per triangle, and of what every rank repeats or rank 0 does alone.

    `measured` has the triangles and the parts of two meshes. What is repeated has a fixed part and one per triangle.
    """
    (triangles, parts), (finer_triangles, finer_parts) = measured
    cost = {"layer": parts[0]["before"], "piece_per_triangle": parts[0]["pieces_of_all"] / triangles}
    for name, what in (("cutting", "decoupling"), ("end", "end_at_rank_0")):
        small, large = beyond_share(parts, what), beyond_share(finer_parts, what)
        per_triangle = max(0.0, (large - small) / (finer_triangles - triangles))
        cost[f"{name}_repeated"] = per_triangle
        cost[f"{name}_fixed"] = max(0.0, small - per_triangle * triangles)
        cost[f"{name}_divided"] = (parts[0][what] - small) / triangles
    return cost


def replay(ranks, triangles, sizes, cost, model):
    """Returns the seconds of a run: pieces are taken one by one by whoever is idle, the largest estimates first."""
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
    repeated, divided = {}, {}
    for name in ("cutting", "end"):
        of_all = cost[f"{name}_fixed"] + triangles * cost[f"{name}_repeated"]
        repeated[name] = of_all * (1 - model["divided_too"])
        divided[name] = triangles * cost[f"{name}_divided"] + of_all * model["divided_too"]
    start = cost["layer"] + repeated["cutting"] + divided["cutting"] / ranks
    end = repeated["end"] + divided["end"] / ranks
    if ranks >= count:
        last = start + model["fetch_seconds"] + max(seconds for _, seconds in work)
    else:
        free = [start] * ranks
        for _, seconds in work:
            heapq.heapreplace(free, free[0] + model["fetch_seconds"] + seconds)
        last = max(free)
    hops = math.ceil(math.log2(ranks)) if ranks > 1 else 0
    # One scan over the pieces, and what each rank tells all others of its cuts, once for each round of cuts.
    told = hops * (model["latency_seconds"] * model["rounds"] + 40 * count / model["bytes_per_second"])
    reductions = 4 * hops * model["latency_seconds"]
    output = triangles * model["bytes_per_triangle"] / model["output_bytes_per_second"]
    return {"seconds": last + end + told + reductions + output, "pieces": count, "start": start}


def tables(sizes, cost, model):
    """Returns weak and strong scaling: efficiencies against one rank."""
    weak, strong = [], []
    per_rank = 2e6
    one = replay(1, per_rank, sizes, cost, model)["seconds"]
    for ranks in (1, 32, 1024):
        run = replay(ranks, per_rank * ranks, sizes, cost, model)
        weak.append({"ranks": ranks, "efficiency": one / run["seconds"], **run})
    whole = replay(1, 1e9, sizes, cost, model)["seconds"]
    for ranks in (1, 2, 8, 64, 512, 4096, 65536):
        run = replay(ranks, 1e9, sizes, cost, model)
        strong.append({"ranks": ranks, "efficiency": whole / ranks / run["seconds"], **run})
    return {"weak": weak, "strong": strong}


MODEL = {
    "piece_scale": 1.0,  # size of pieces, relative to those of the run
    "divided_too": 0.0,  # share of what ranks repeat, and of the end at rank 0, that they would divide as well
    "estimate_error": 0.05,  # of the work of pieces, on either side
    "noise": 0.02,  # of the time of a piece
    "fetch_seconds": 5e-6,  # one atomic fetch from another rank
    "latency_seconds": 5e-6,
    "rounds": 16,  # of cuts, each with a collective exchange
    "bytes_per_second": 5e9,  # between two ranks
    "bytes_per_triangle": 0.0,  # of output; 0: a sink that counts
    "output_bytes_per_second": 1e10,  # of the file system, shared by all ranks
}
VARIANTS = {
    "as now": {},
    "as now, pieces of a quarter": {"piece_scale": 0.25},
    "as now, 24 bytes a triangle to disk": {"bytes_per_triangle": 24.0},
    "ranks divide 90 % of the rest as well": {"divided_too": 0.9},
    "ranks divide all of it": {"divided_too": 1.0},
}


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program", help="lamina")
    parser.add_argument("measure", help="lamina_measure_ranks")
    parser.add_argument("--gradation", type=float, default=0.0026, help="of the runs that are measured")
    parser.add_argument("--finer", type=float, default=0.0013, help="gradation of a finer mesh on one and on most ranks")
    parser.add_argument("--ranks", default="1,2,4,8,16,32", help="of the runs that are measured [%(default)s]")
    parser.add_argument("--set", action="append", default=[], metavar="NAME=VALUE", help="a parameter of the model")
    arguments = parser.parse_args()
    for text in arguments.set:
        name, value = text.split("=")
        if name not in MODEL:
            parser.error(f"no parameter '{name}' (known: {', '.join(MODEL)})")
        MODEL[name] = float(value)
    ranks = arguments.ranks.split(",")
    runs = measure(arguments.measure, arguments.gradation, ranks)
    finer = measure(arguments.measure, arguments.finer, [ranks[0], ranks[-1]])
    triangles = runs[0]["triangles"]
    sizes = sizes_of(arguments.program, arguments.gradation)
    parts = [summarize(run) for run in runs]
    finer_parts = [summarize(run) for run in finer]
    cost = calibrate([(triangles, parts), (finer[0]["triangles"], finer_parts)])
    one = replay(1, triangles, sizes, cost, MODEL)["seconds"]
    for part in parts:
        busiest = part["before"] + part["decoupling"] + part["pieces_of_all"] / part["ranks"] + part["end_at_rank_0"]
        part["speed_up_by_processor_time"] = (parts[0]["before"] + parts[0]["decoupling"] + parts[0]["pieces_of_all"]
                                              + parts[0]["end_at_rank_0"]) / busiest  # fmt: skip
        part["speed_up_of_model"] = one / replay(part["ranks"], triangles, sizes, cost, MODEL)["seconds"]
    result = {
        "triangles": triangles,
        "pieces": runs[0]["pieces"],
        "measured": parts,
        "finer": {"triangles": finer[0]["triangles"], "pieces": finer[0]["pieces"], "measured": finer_parts},
        "cost": cost,
        "model": MODEL,
        "replayed": {name: tables(sizes, cost, {**MODEL, **change}) for name, change in VARIANTS.items()},
    }
    json.dump(result, sys.stdout, indent=1)
    print()


if __name__ == "__main__":
    main()
