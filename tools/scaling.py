#!/usr/bin/env python3
"""How runs on many processes would scale: measures the pieces of a real run and replays them on up to 65,536 ranks.

    tools/scaling.py build/release/src/app/lamina examples/thesis/fig24.toml > out/scaling.json

The mesh is made once, on one thread. Its file says how many triangles each piece has; the report says how the processor
time of the process is shared among the stages. The replay deals pieces of the same sizes as ranks ask for them, the
largest estimates first, and adds what each rank does by itself, what is fetched and reduced, and the output.
docs/scaling.md states the assumptions and shows the result.
"""

import argparse
import heapq
import json
import math
import random
import re
import resource
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


def measure(program, case, gradation, threads):
    """Makes the mesh, and returns what the model needs to know of it."""
    with tempfile.TemporaryDirectory(prefix="lamina-scaling-") as folder:
        mesh, report = Path(folder) / "mesh.vtu", Path(folder) / "report.json"
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        subprocess.run(
            [program, "mesh", case, "--gradation", str(gradation), "--stream", "--threads", str(threads), "--quiet",
             "-o", mesh, "--report", report], check=True)  # fmt: skip
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        found = json.loads(report.read_text())
        sizes = piece_sizes(mesh) if threads == 1 else []
    cpu = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return {"triangles": found["triangles"], "pieces": sizes, "processor_seconds": cpu, "seconds": found["seconds"],
            "thread_seconds": found["thread_seconds"], "threads": threads}  # fmt: skip


def calibrate(run):
    """Returns the processor time of what every rank repeats and of what is divided, per triangle."""
    seconds = run["seconds"]
    fixed = seconds["geometry"] + seconds["layers"] + seconds["layer_triangulation"] + seconds["decomposition"]
    cutting = seconds["sizing"] + seconds["decoupling"]
    divided = seconds["refinement"] + seconds["check"] + seconds["write"] + seconds["assembly"]
    scale = run["processor_seconds"] / (fixed + cutting + divided)
    return {"layer": scale * fixed, "cutting_per_triangle": scale * cutting / run["triangles"],
            "piece_per_triangle": scale * divided / run["triangles"]}  # fmt: skip


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
    start = cost["layer"] + cost["cutting_per_triangle"] * triangles * (
        1 - model["shared_cutting"] + model["shared_cutting"] / ranks)  # fmt: skip
    if ranks >= count:
        end = start + model["fetch_seconds"] + max(seconds for _, seconds in work)
    else:
        free = [start] * ranks
        for _, seconds in work:
            heapq.heapreplace(free, free[0] + model["fetch_seconds"] + seconds)
        end = max(free)
    hops = math.ceil(math.log2(ranks)) if ranks > 1 else 0
    scan = hops * (model["latency_seconds"] + 16 * count / model["bytes_per_second"]) if ranks > 1 else 0
    reductions = 4 * hops * model["latency_seconds"]
    output = triangles * model["bytes_per_triangle"] / model["output_bytes_per_second"]
    return {"seconds": end + scan + reductions + output, "pieces": count, "start": start}


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
    "shared_cutting": 0.0,  # share of the decomposition that ranks divide among themselves; else each repeats it
    "estimate_error": 0.05,  # of the work of pieces, on either side
    "noise": 0.02,  # of the time of a piece
    "fetch_seconds": 5e-6,  # one atomic fetch from another rank
    "latency_seconds": 5e-6,
    "bytes_per_second": 5e9,  # between two ranks
    "bytes_per_triangle": 0.0,  # of output; 0: a sink that counts
    "output_bytes_per_second": 1e10,  # of the file system, shared by all ranks
}
VARIANTS = {
    "every rank repeats the decomposition": {},
    "ranks divide 99 % of the decomposition": {"shared_cutting": 0.99},
    "ranks divide all of it": {"shared_cutting": 1.0},
    "ranks divide all of it, pieces of a quarter": {"shared_cutting": 1.0, "piece_scale": 0.25},
    "ranks divide all of it, 24 bytes a triangle to disk": {"shared_cutting": 1.0, "bytes_per_triangle": 24.0},
}


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program")
    parser.add_argument("case")
    parser.add_argument("--gradation", type=float, default=0.00597, help="of the run that is measured")
    parser.add_argument("--set", action="append", default=[], metavar="NAME=VALUE", help="a parameter of the model")
    arguments = parser.parse_args()
    for text in arguments.set:
        name, value = text.split("=")
        if name not in MODEL:
            parser.error(f"no parameter '{name}' (known: {', '.join(MODEL)})")
        MODEL[name] = float(value)
    run = measure(arguments.program, arguments.case, arguments.gradation, 1)
    two = measure(arguments.program, arguments.case, arguments.gradation, 2)
    cost = calibrate(run)
    predicted = replay(2, run["triangles"], run["pieces"], cost, {**MODEL, "shared_cutting": 1.0})["seconds"]
    result = {
        "run": {k: run[k] for k in ("triangles", "processor_seconds", "seconds")} | {"pieces": len(run["pieces"])},
        "two_threads": {"total_seconds": two["seconds"]["total"], "one_thread_seconds": run["seconds"]["total"],
                        "processor_seconds": two["processor_seconds"],
                        "predicted_speed_up": run["processor_seconds"] / predicted,
                        "measured_speed_up": run["seconds"]["total"] / two["seconds"]["total"]},  # fmt: skip
        "cost": cost,
        "model": MODEL,
        "replayed": {name: tables(run["pieces"], cost, {**MODEL, **change}) for name, change in VARIANTS.items()},
    }
    json.dump(result, sys.stdout, indent=1)
    print()


if __name__ == "__main__":
    main()
