"""Reads the mesh in a page: the same steps as share/page/decode.js, written from the description there."""
import base64
import math
import re
import struct
import zlib

NONE, FRESH, BEFORE, BEHIND, CLOSING, DISTANT, QUAD = range(7)
KINDS = ("wall", "far field", "symmetry", "other", "periodic", "internal")


def part_of(page, name):
    """Returns what stands in the element of this name."""
    return re.search(rf'<script type="[^"]*" id="{name}">(.*?)</script>', page, re.DOTALL).group(1)


def arrays_of(page):
    data = zlib.decompress(base64.b64decode(part_of(page, "mesh"), validate=True))
    at, arrays = 0, []
    while at < len(data):
        length, planes = struct.unpack_from("<IB", data, at)
        at += 5
        numbers = [0] * length
        for plane in range(planes):
            numbers = [n + (byte << 8 * plane) for n, byte in zip(numbers, data[at:at + length])]
            at += length
        arrays.append(numbers)
    assert at == len(data)
    return iter(arrays)


def signed(numbers):
    return [n // 2 if n % 2 == 0 else -(n + 1) // 2 for n in numbers]


class Gate:
    def __init__(self, s, t, o, cell):
        self.s, self.t, self.o, self.cell, self.open = s, t, o, cell, True
        self.previous = self.next = None


def link(a, b):
    a.next, b.previous = b, a


class Walk:
    """Follows the symbols. `predictions` gets (a, b, o) per vertex, `cells` (parent, corners) per cell."""

    def __init__(self, symbols, references, count):
        self.symbols, self.references = iter(symbols), iter(references)
        self.predictions, self.cells, self.queue = [], [], []
        head = 0
        while len(self.cells) < count:
            self.begin()
            while head < len(self.queue):
                gate = self.queue[head]
                head += 1
                if gate.open:
                    self.advance(gate)
        assert next(self.symbols, None) is None and next(self.references, None) is None

    def gate(self, s, t, o):
        self.queue.append(Gate(s, t, o, len(self.cells) - 1))
        return self.queue[-1]

    def fresh(self, prediction):
        self.predictions.append(prediction)
        return len(self.predictions) - 1

    def begin(self):
        corners = 4 if next(self.symbols) == QUAD else 3
        v = []
        for i in range(corners):
            back = next(self.references)
            near = v[-1] if v else len(self.predictions) - 1
            v.append(len(self.predictions) - back if back else self.fresh((near, near, near)))
        self.cells.append((None, v))
        ring = [self.gate(v[i], v[(i + 1) % corners], v[(i + 2) % corners]) for i in range(corners)]
        for i in range(corners):
            link(ring[i], ring[(i + 1) % corners])

    def advance(self, gate):
        kind = next(self.symbols)
        gate.open = False
        if kind == NONE:
            return
        s, t = gate.s, gate.t
        self.cells.append((gate.cell, None))
        c, first, second = self.attach(gate, kind % QUAD)
        corners = [t, s, c]
        if kind >= QUAD:
            d, _, last = self.attach(second, next(self.symbols))
            corners.append(d)
            if first:
                first.o = d
            if last:
                last.o = s
        self.cells[-1] = (gate.cell, corners)

    def attach(self, gate, kind):
        s, t, before, behind = gate.s, gate.t, gate.previous, gate.next
        gate.open = False
        if kind in (BEFORE, CLOSING):
            c = before.s
        elif kind == BEHIND:
            c = behind.t
        elif kind == FRESH:
            c = self.fresh((s, t, gate.o))
        else:
            assert kind == DISTANT
            c = len(self.predictions) - next(self.references)
        left, right, first, second = before, behind, None, None
        if kind in (BEFORE, CLOSING):
            before.open, left = False, before.previous
        else:
            first = self.gate(s, c, t)
        if kind in (BEHIND, CLOSING):
            behind.open, right = False, behind.next
        else:
            second = self.gate(c, t, s)
        for added in filter(None, (first, second)):
            link(left, added)
            left = added
        link(left, right)
        return c, first, second


def runs_of(differences, each, sizes):
    differences, runs = iter(differences), []
    for size in sizes:
        last, run = 0, []
        for _ in range(each * size):
            last += next(differences)
            run.append(last)
        runs.append(run)
    return runs


def unpacked(page):
    """Returns the mesh of a page: points (None for vertices of no cell), cells, region, piece, layer (None where the
    mesh has none), markers as {name: (kind, edges)}, walls as (vertices, first heights) per body, growth."""
    arrays = arrays_of(page)
    version, points, triangles, quads = next(arrays)
    assert version == 1
    walk = Walk(next(arrays), next(arrays), triangles + quads)
    exponents, numbers, dx, dy, cells = (signed(next(arrays)) for _ in range(5))

    place, number, exponent = [None] * points, [], []
    for i, (a, b, o) in enumerate(walk.predictions):
        guess = (0.0, 0.0)
        if i > 0:
            guess = [place[number[a]][k] + place[number[b]][k] - place[number[o]][k] for k in (0, 1)]
        number.append(numbers[i] + (number[b] if i > 0 else 0))
        exponent.append(exponents[i] + (exponent[a] if i > 0 else 0))
        step = 2.0 ** exponent[i]
        place[number[i]] = tuple((math.floor(g / step + 0.5) + d[i]) * step for g, d in zip(guess, (dx, dy)))

    def of_cells(differences):
        values = []
        for (parent, _), difference in zip(walk.cells, differences):
            values.append(difference + (values[parent] if parent is not None else 0))
        return values

    order = of_cells(cells)
    corners = [None] * len(order)
    for new, old in enumerate(order):
        corners[old] = [number[v] for v in walk.cells[new][1]]
    data = []
    for _ in range(3):
        differences = signed(next(arrays))
        values = [None] * len(order)
        for new, value in enumerate(of_cells(differences)):
            values[order[new]] = value
        data.append(values if differences or not order else None)

    names = bytes(next(arrays)).decode().split("\0")
    kinds, sizes = next(arrays), next(arrays)
    ends = runs_of(signed(next(arrays)), 2, sizes)
    markers = {name: (KINDS[kind], list(zip(run[::2], run[1::2]))) for name, kind, run in zip(names, kinds, ends)}
    wall = signed(next(arrays))
    bodies, heights = next(arrays), next(arrays)
    wall = runs_of(wall, 1, [len(wall)])[0]
    heights = [struct.unpack("<f", struct.pack("<I", bits))[0] for bits in heights]
    walls, at = [], 0
    for size in bodies:
        walls.append((wall[at:at + size], heights[at:at + size]))
        at += size
    growth = next(arrays)
    assert next(arrays, None) is None
    return {"points": place, "cells": corners, "region": data[0], "piece": data[1], "layer": data[2],
            "markers": markers, "walls": walls, "growth": growth}
