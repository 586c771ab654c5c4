"""Sections: files, names and arrays."""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping, Sequence
from typing import Any, Union

import numpy as np

from . import _lamina
from ._arrays import coordinates_of, points_array
from ._errors import WrongTypeError

#: One section: a file, a name such as "naca:0012", or an (n, 2) array of coordinates.
Section = Union[str, "os.PathLike[str]", np.ndarray, Sequence[Sequence[float]]]
#: One section, a list of them, or a dictionary from names of markers to them.
Sections = Union[Section, Sequence[Section], Mapping[str, Section]]


def _is_points(value: Any) -> bool:
    """Whether the value is an array of coordinates, or rows of two numbers."""
    if hasattr(value, "__array__"):
        return True
    return isinstance(value, Sequence) and not isinstance(value, str) and len(value) > 0 and all(map(_is_point, value))


def _is_point(row: Any) -> bool:
    if isinstance(row, (str, Mapping)):
        return False
    try:
        return np.shape(row) == (2,) and all(np.isscalar(x) and not isinstance(x, str) for x in row)
    except ValueError:  # its entries have different lengths
        return False


def _section(value: Any, name: str) -> str | tuple[str, np.ndarray]:
    if isinstance(value, (str, os.PathLike)):
        return os.fspath(value)
    return name, points_array(value, name)


def section_list(sections: Any, source: str = "array") -> tuple[list[Any], list[str]]:
    """Returns the sections as the C++ part takes them, and the names of a dictionary. Errors call arrays `source`."""
    if isinstance(sections, Mapping):
        return [_section(value, str(name)) for name, value in sections.items()], [str(name) for name in sections]
    if hasattr(sections, "geoms"):  # several polygons of shapely
        return [_section(polygon, source) for polygon in sections.geoms], []
    if isinstance(sections, (str, os.PathLike)):
        return [_section(sections, source)], []
    coordinates = coordinates_of(sections)
    if coordinates is not sections and not isinstance(sections, Iterator) or _is_points(coordinates):
        return [_section(coordinates, source)], []
    if not isinstance(coordinates, Sequence):
        raise WrongTypeError(f"sections must be a path, a name, an array, or a list or dictionary of these, not "
                             f"{type(sections).__name__} {sections!r:.40}")
    return [_section(value, source) for value in coordinates], []


def _closed(points: np.ndarray) -> np.ndarray:
    return np.concatenate([points, points[:1]])


def naca(digits: str, points: int = 200, *, trailing_edge: str = "sharp") -> np.ndarray:
    """Returns the NACA 4-digit or 5-digit section of unit chord, such as "0012" or "23012".

    (n, 2) coordinates with cosine spacing, from the trailing edge over the upper surface first; the first point is
    repeated at the end. `points` is rounded so that both surfaces get the same number. `trailing_edge` is "sharp",
    "blunt" (the published thickness) or "extended" (that of the NASA Turbulence Modeling Resource).

    Examples
    --------
    >>> lamina.naca("0012", points=6).shape
    (7, 2)
    """
    return _closed(_lamina.naca(str(digits), points, trailing_edge))


def outlines(sections: Sections) -> dict[str, np.ndarray]:
    """Reads and repairs sections as `lamina.mesh()` does, and returns the outline of each by its name.

    Outlines are (n, 2) coordinates, counter-clockwise; the first point is repeated at the end. Raises InputError and
    IoError.

    Examples
    --------
    >>> lamina.outlines("naca:0012")["airfoil"].shape[1]
    2
    """
    given, names = section_list(sections)
    read = _lamina.outlines(given)
    return {name: _closed(points) for name, (_, points, *_) in zip(names or [row[0] for row in read], read)}
