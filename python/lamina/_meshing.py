"""Meshes round sections."""

from __future__ import annotations

import os
import warnings
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from . import _lamina
from ._arrays import index_array, points_array
from ._errors import MeshWarning, UsageError
from ._mesh import Mesh
from ._options import option_values, with_options
from ._progress import Callback, Progress, callback_of
from ._sections import Sections, section_list


def _background_arrays(background: tuple[Any, Any, Any]):
    points, triangles, sizes = background
    return (points_array(points, "background points"), index_array(triangles, 3, "background triangles"),
            np.ascontiguousarray(sizes, dtype=np.float64))


@with_options
def mesh(sections: Sections, *, progress: Progress = None, **options: Any) -> Mesh:
    """Makes a viscous mesh round sections, as `lamina mesh` does.

    sections: a file of coordinates, a name ("naca:0012", "naca:23012:blunt"), an (n, 2) array of coordinates in the
    order of the outline, a list of these, or a dictionary from names of markers to these. Arrays may be open or closed
    and run in either direction; they are repaired as files are.

    progress(stage, estimate) is called when a stage begins; the estimate comes once. True shows the stages, by tqdm where
    it is installed, and a bar of tqdm may be given. What it raises ends the run, and so does Ctrl-C, within a fraction of
    a second.

    Lengths are numbers of chords, or of units of the input as a text with the suffix u: "0.003u". Positions are in
    units of the input, angles in degrees. None stands for the default. The mesh does not depend on the number of
    threads, and is that of the program with the same options. Any number of threads may call this function at once.

    Raises OptionError and UsageError for options, InputError and IoError for sections, LimitError for a run that would
    need too much, MeshError where no mesh of the promised standard can be made. Issues a MeshWarning for each of
    `Mesh.warnings`.

    Examples
    --------
    >>> mesh = lamina.mesh("naca:0012", first_height=1e-3, layers=4)
    >>> sorted(mesh.markers), int(mesh.layer.max())
    (['airfoil', 'farfield'], 4)
    """
    with callback_of(progress) as callback:
        result = make_mesh(sections, callback, options)
    for warning in result.warnings:
        warnings.warn(warning, stacklevel=2)
    return result


@dataclass(frozen=True)
class RunArguments:
    """The arguments of a run as the C++ part takes them."""

    sections: list[Any]
    values: list[tuple[str, Any]]
    sizes: tuple[np.ndarray, np.ndarray, np.ndarray] | None  #: a background of arrays


def run_arguments(sections: Sections, options: Mapping[str, Any], source: str = "array") -> RunArguments:
    """Returns the arguments of a run. Errors call an array without a name `source`."""
    options = dict(options)
    given, names = section_list(sections, source)
    if names:
        if options.get("names") is not None:
            raise UsageError("names: the dictionary of sections says them already")
        options["names"] = names
    sizes = None
    if options.get("background") is not None and not isinstance(options["background"], (str, os.PathLike)):
        sizes = _background_arrays(options.pop("background"))
    return RunArguments(given, option_values(options), sizes)


def made_mesh(result: tuple[_lamina.Mesh, list[dict[str, Any]], dict[str, Any], tuple[np.ndarray, np.ndarray]]) -> Mesh:
    """Returns the mesh that a run of the C++ part made."""
    data, found, facts, columns = result
    return Mesh._from(data, [MeshWarning._from(warning) for warning in found], facts, columns)


def make_mesh(sections: Sections, progress: Callback | None,
              options: Mapping[str, Any], source: str = "array", stop: Callable[[], None] | None = None) -> Mesh:
    """Does what mesh() does, without issuing warnings. Errors call an array without a name `source`. What `stop`, which
    is called up to 50 times a second, raises ends the run."""
    arguments = run_arguments(sections, options, source)
    return made_mesh(_lamina.generate(arguments.sections, arguments.values, arguments.sizes, progress, stop))
