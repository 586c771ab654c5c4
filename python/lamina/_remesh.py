"""Meshes adapted to metrics."""

from __future__ import annotations

import os
from dataclasses import dataclass
from typing import Any

import numpy as np

from . import _lamina
from ._arrays import Values
from ._errors import InputError
from ._mesh import Mesh


@dataclass(frozen=True, eq=False, repr=False)
class RemeshedMesh(Values):
    """The result of `lamina.remesh()`.

    Examples
    --------
    >>> mesh = lamina.mesh("naca:0012", first_height=1e-3, layers=4)
    >>> made = lamina.remesh(mesh, np.full(len(mesh.points), 0.5))
    >>> 0 < made.unit_edges <= 1
    True
    """

    mesh: Mesh  #: vertices that stay come first, in the order that they had
    metric: np.ndarray  #: (n, 3) xx, xy, yy at its vertices: as it was asked for, scaled, graded and limited
    triangles: int  #: number of those that are not of the layer
    unit_edges: float  #: share of their edges whose length in the metric is from 0.7 to 1.4
    mean_quality: float  #: mean of 4 sqrt(3) area / (sum of squared edges), measured in the metric


def read_metric(path: str | os.PathLike[str]) -> np.ndarray:
    """Reads the metric at the vertices of a mesh from a Medit file (.sol) or a VTU file with the point data `metric`.

    Returns (n, 3) tensors xx, xy, yy. Raises IoError, UsageError for other extensions, InputError for malformed files.

    Examples
    --------
    >>> lamina.read_metric("metric.sol").tolist()
    [[4.0, 0.0, 1.0]]
    """
    return _lamina.read_metric(os.fspath(path))


def remesh(mesh: Mesh, metric: Any, *, divide_borders: bool = False, vertices: float | None = None,
           gradation: float | None = None, max_ratio: float | None = None) -> RemeshedMesh:
    """Replaces the triangles beyond the layer by those that a metric asks for, as `lamina remesh` does.

    metric: at each vertex a symmetric positive definite tensor, in units of the mesh to the power of -2, (n, 3) as xx, xy,
    yy or (n, 2, 2); or a size, (n,). A vector e has the length sqrt(e . M e), and edges are to have the length 1.
    divide_borders: edges on straight lines of the boundary may be divided and merged, too. vertices: the metric is scaled to
    ask for about so many beyond the layer. gradation: largest growth of sizes per unit of distance. max_ratio: largest ratio
    of the two lengths that the metric asks for at a place. The result is the same each time; one thread makes it.

    Raises OptionError for options, InputError for metrics and meshes that are none, MeshError for a mesh without triangles
    beyond the layer.

    Examples
    --------
    >>> mesh = lamina.mesh("naca:0012", first_height=1e-3, layers=4)
    >>> made = lamina.remesh(mesh, np.full(len(mesh.points), 0.5))
    >>> made.mesh.quality().valid
    True
    """
    data, tensors, triangles, unit_edges, mean_quality = _lamina.remesh(
        mesh._data, _tensors(metric), divide_borders, vertices, gradation, max_ratio)
    return RemeshedMesh(Mesh._from(data), tensors, triangles, unit_edges, mean_quality)


def _tensors(metric: Any) -> np.ndarray:
    array = np.asarray(metric, dtype=np.float64)
    if array.ndim == 1:
        # As files of sizes are read; a power would be that of the C library.
        sizes = np.where(array > 0, array, np.nan)
        with np.errstate(divide="ignore", over="ignore", under="ignore"):
            eigenvalue = 1 / (sizes * sizes)
        array = np.stack([eigenvalue, np.zeros_like(eigenvalue), eigenvalue], axis=1)
    elif array.ndim == 3 and array.shape[1:] == (2, 2):
        array = np.stack([array[:, 0, 0], 0.5 * (array[:, 0, 1] + array[:, 1, 0]), array[:, 1, 1]], axis=1)
    if array.ndim != 2 or array.shape[1] != 3:
        raise InputError(f"metric must have the shape (n, 3), (n, 2, 2) or (n,), not {array.shape}")
    return np.ascontiguousarray(array)
