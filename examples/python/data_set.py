"""A data set of meshes round perturbed sections, as one NumPy archive (or HDF5 file, where the name ends with .h5).

    python data_set.py --sections 1000 -o data_set.npz

Shapes are a NACA 2412 with random changes of its class-shape coefficients (B. M. Kulfan, Journal of Aircraft 45, 2008).
All meshes have the same wall points, rays and layers by number, so that arrays of walls and layers stack. What lies
outside differs, and stands in one long array each, section s at [first[s]:first[s + 1]].

    name, coefficients    (s,) of the sections in the archive; (s, 2, k) upper and lower surface
    wall                  (s, points, 2) from the trailing edge on, counter-clockwise
    layer                 (s, rays, layers + 1, 2) points on the rays, from the wall on
    points, first_point   vertices of the meshes, each beginning with its wall and its rays
    triangles, quads, first_triangle, first_quad   of the meshes, by the numbers of their own vertices
    failed, reason        sections that could not be meshed, and why
"""
import argparse
import math

import lamina
import numpy as np

POINTS, LAYERS, COEFFICIENTS = 200, 30, 6
OPTIONS = {
    "preset": "none", "first_height": 1e-5, "growth": 1.2, "layers": LAYERS, "layer_topology": "quads",
    "exact_points": POINTS,  # equal numbers on walls and rays
}


def bernstein(x):
    """Returns the class function times each shape function at the stations x: (n, k)."""
    n = COEFFICIENTS - 1
    shape = [math.comb(n, i) * x**i * (1 - x) ** (n - i) for i in range(COEFFICIENTS)]
    return np.sqrt(x)[:, None] * (1 - x)[:, None] * np.column_stack(shape)


def fitted(section):
    """Returns the coefficients of the two surfaces of a section with a sharp trailing edge: (2, k)."""
    nose = np.argmin(section[:, 0])
    surfaces = section[: nose + 1], section[nose:]
    return np.array([np.linalg.lstsq(bernstein(s[:, 0].clip(0, 1)), s[:, 1], rcond=None)[0] for s in surfaces])


def outline(coefficients):
    """Returns the closed outline with these coefficients, from the trailing edge over the upper surface."""
    x = 0.5 + 0.5 * np.cos(np.linspace(0, np.pi, 400))
    basis = bernstein(x)
    upper, lower = (np.column_stack([x, basis @ c]) for c in coefficients)
    return np.concatenate([upper, lower[-2::-1]])


def perturbed(count, seed):
    """Yields names and coefficients, each coefficient changed by up to a fifth of the largest of its surface."""
    base = fitted(lamina.naca("2412", 400))
    generator = np.random.default_rng(seed)
    amplitude = 0.2 * np.abs(base).max(axis=1, keepdims=True)
    for s in range(count):
        yield f"cst{s:05d}", base + amplitude * generator.uniform(-1, 1, base.shape)


def layer_of(mesh):
    """Returns the points on the rays, from the wall on: (rays, layers + 1, 2). They follow those of the wall."""
    origins, first = mesh.points[mesh.column_origin], len(mesh.wall.vertex)
    above = mesh.points[first : first + len(origins) * LAYERS].reshape(len(origins), LAYERS, 2)
    return np.concatenate([origins[:, None], above], axis=1)


def write(path, arrays):
    if not path.endswith((".h5", ".hdf5")):
        np.savez(path, **arrays)
        return
    import h5py

    with h5py.File(path, "w") as file:
        for name, array in arrays.items():
            file[name] = array.astype("S") if array.dtype.kind == "U" else array


def main():
    parser = argparse.ArgumentParser(description="a data set of meshes round perturbed sections")
    parser.add_argument("--sections", type=int, default=1000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--jobs", type=int, help="meshes at a time; one per core unless given")
    parser.add_argument("-o", "--output", default="data_set.npz")
    arguments = parser.parse_args()

    coefficients = dict(perturbed(arguments.sections, arguments.seed))
    meshes, failed = {}, {}
    for result in lamina.batch({n: outline(c) for n, c in coefficients.items()}, jobs=arguments.jobs, **OPTIONS):
        if result.error:
            failed[result.name] = str(result.error)
        else:
            meshes[result.name] = result.mesh

    names = sorted(meshes)
    made = [meshes[n] for n in names]
    arrays = {
        "name": np.array(names), "coefficients": np.array([coefficients[n] for n in names]),
        "failed": np.array(sorted(failed), str), "reason": np.array([failed[n] for n in sorted(failed)], str),
        "wall": np.stack([mesh.points[:POINTS] for mesh in made]), "layer": np.stack([layer_of(mesh) for mesh in made]),
    }
    for key in ("points", "triangles", "quads"):
        parts = [getattr(mesh, key) for mesh in made]
        arrays[key] = np.concatenate(parts)
        arrays[f"first_{key[:-1]}"] = np.cumsum([0] + [len(part) for part in parts])
    write(arguments.output, arrays)
    print(f"{len(names)} meshes, {len(failed)} sections failed; layer {arrays['layer'].shape[1:]}: {arguments.output}")


if __name__ == "__main__":
    main()
