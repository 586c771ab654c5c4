#!/usr/bin/env python3
"""Draws residuals, lift and drag so far: history.png. Allrun calls it where matplotlib is there.

  ./plot.py
"""
import pathlib

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt


def history(function, file):
    """Returns the columns of a function object's files by name, the files of restarts one behind the other."""
    columns = {}
    folder = pathlib.Path(__file__).parent / "postProcessing" / function
    for part in sorted(folder.iterdir(), key=lambda path: float(path.name)):
        names = []
        for line in (part / file).read_text().splitlines():
            words = line.lstrip("#").split()
            if line.startswith("#"):
                names = words
                continue
            for name, word in zip(names, words):
                columns.setdefault(name, []).append(word)
    return columns


figure, (top, middle, bottom) = plt.subplots(3, 1, figsize=(8, 10), sharex=True)
residuals = history("residuals", "solverInfo.dat")
for name, values in residuals.items():
    if name.endswith("_initial"):
        top.semilogy([float(t) for t in residuals["Time"]], [float(v) for v in values], label=name[: -len("_initial")])
top.set_ylabel("initial residual")
top.legend()
forces = history("forces", "coefficient.dat")
time = [float(t) for t in forces["Time"]]
for axes, name in ((middle, "Cl"), (bottom, "Cd")):
    values = [float(v) for v in forces[name]]
    shown = values[len(values) // 2 :]
    axes.plot(time, values)
    axes.set_ylim(min(shown), max(shown) if max(shown) > min(shown) else min(shown) + 1e-6)
    axes.set_ylabel(name.upper())
bottom.set_xlabel("@TIME_AXIS@")
figure.savefig(pathlib.Path(__file__).parent / "history.png", dpi=120)
