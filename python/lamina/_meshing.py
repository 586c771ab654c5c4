"""Meshes round sections."""

from __future__ import annotations

import os
import warnings
from collections.abc import Callable
from typing import Any

from . import _lamina
from ._arrays import index_array, points_array
from ._errors import MeshWarning, RunEstimate, UsageError
from ._mesh import Mesh
from ._options import option_values, with_options
from ._sections import Sections, section_list

import numpy as np


def _background_arrays(background: tuple[Any, Any, Any]):
    points, triangles, sizes = background
    return (points_array(points, "background points"), index_array(triangles, 3, "background triangles"),
            np.ascontiguousarray(sizes, dtype=np.float64))


@with_options
def mesh(sections: Sections, *, progress: Callable[[str, RunEstimate | None], object] | None = None,
         **options: Any) -> Mesh:
    """Makes a viscous mesh round sections, as `lamina mesh` does.

    sections: a file of coordinates, a name ("naca:0012", "naca:23012:blunt"), an (n, 2) array of coordinates in the
    order of the outline, a list of these, or a dictionary from names of markers to these. Arrays may be open or closed
    and run in either direction; they are repaired as files are.

    progress(stage, estimate) is called when a stage begins; the estimate comes once. What it raises ends the run, and
    so does Ctrl-C, within a fraction of a second.

    Lengths are numbers of chords, or of units of the input as a text with the suffix u: "0.003u". Positions are in
    units of the input, angles in degrees. None stands for the default. The mesh does not depend on the number of
    threads, and is that of the program with the same options. Any number of threads may call this function at once.

    Raises OptionError and UsageError for options, InputError and IoError for sections, LimitError for a run that would
    need too much, MeshError where no mesh of the promised standard can be made. Issues a MeshWarning for each of
    `Mesh.warnings`.
    """
    result = make_mesh(sections, progress, options)
    for warning in result.warnings:
        warnings.warn(warning, stacklevel=2)
    return result


def make_mesh(sections: Sections, progress: Callable[[str, RunEstimate | None], object] | None,
              options: dict[str, Any], source: str = "array", stop: Callable[[], None] | None = None) -> Mesh:
    """Does what mesh() does, without issuing warnings. Errors call an array without a name `source`. What `stop`, which
    is called up to 50 times a second, raises ends the run."""
    options = dict(options)
    given, names = section_list(sections, source)
    if names:
        if options.get("names") is not None:
            raise UsageError("names: the dictionary of sections says them already")
        options["names"] = names
    sizes = None
    if options.get("background") is not None and not isinstance(options["background"], (str, os.PathLike)):
        sizes = _background_arrays(options.pop("background"))
    data, found, facts, columns = _lamina.generate(given, option_values(options), sizes, progress, stop)
    return Mesh._from(data, [MeshWarning._from(warning) for warning in found], facts, columns)
