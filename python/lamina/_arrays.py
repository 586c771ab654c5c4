"""Arguments as arrays of the types that the C++ part takes."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import fields
from typing import Any

import numpy as np

from ._errors import InputError, WrongTypeError


def _equal(one: Any, other: Any) -> bool:
    """Whether two values are equal. They may hold arrays, and errors, which Python compares by identity."""
    if isinstance(one, np.ndarray) or isinstance(other, np.ndarray):
        one, other = np.asarray(one), np.asarray(other)
        return np.array_equal(one, other, equal_nan=one.dtype.kind == other.dtype.kind == "f")
    if isinstance(one, BaseException) and type(one) is type(other):
        return _equal(one.args, other.args) and _equal(one.__dict__, other.__dict__)
    if isinstance(one, Mapping) and isinstance(other, Mapping):
        return one.keys() == other.keys() and all(_equal(value, other[key]) for key, value in one.items())
    if isinstance(one, (list, tuple)) and type(one) is type(other):
        return len(one) == len(other) and all(map(_equal, one, other))
    return bool(one == other)


def _short(value: Any) -> str:
    if isinstance(value, np.ndarray):
        return "x".join(map(str, value.shape)) + f" {value.dtype}"
    if isinstance(value, (list, tuple, dict)) and len(value) > 4:
        return f"{len(value)} entries"
    if isinstance(value, dict):
        return "{" + ", ".join(f"{key!r}: {_short(entry)}" for key, entry in value.items()) + "}"
    if isinstance(value, (list, tuple)):
        return ("[{}]" if isinstance(value, list) else "({})").format(", ".join(map(_short, value)))
    if isinstance(value, Values):
        return f"{type(value).__name__}(...)"
    return " ".join(repr(value).split())


class Values:
    """What frozen dataclasses need beside their fields, some of which are arrays: equality of all numbers, a hash, and
    a description of one line."""

    def __eq__(self, other: object) -> bool:
        if type(other) is not type(self):
            return NotImplemented
        return all(_equal(getattr(self, f.name), getattr(other, f.name)) for f in fields(self))  # type: ignore[arg-type]

    def __hash__(self) -> int:
        # Of arrays: their shapes, which equal ones have in common, and which cost nothing.
        values = [getattr(self, f.name) for f in fields(self)]  # type: ignore[arg-type]
        return hash((type(self).__name__, *(np.shape(v) for v in values if isinstance(v, np.ndarray)),
                     *(v for v in values if isinstance(v, (str, int, float)))))

    def __repr__(self) -> str:
        parts = (f"{f.name}={_short(getattr(self, f.name))}" for f in fields(self))  # type: ignore[arg-type]
        return f"{type(self).__name__}({', '.join(parts)})"


def coordinates_of(value: Any) -> Any:
    """Returns what holds the coordinates of an object of another package: shapely's polygons and lines, sections of
    AeroSandbox and pymead, data frames; and the rows of a generator. Others are returned as they are."""
    # Columns of data frames, and what labelled arrays say of their axes, may have the names below.
    if hasattr(value, "to_numpy"):
        return value.to_numpy()
    if hasattr(value, "__array__"):
        return value
    if len(_attribute(value, "interiors") or ()):
        raise InputError("a polygon with holes is no section: mesh its exterior, or triangulate its rings")
    for name in ("exterior", "coords", "coordinates"):  # shapely's rings have coords, polygons an exterior
        held = _attribute(value, name)
        if held is not None:
            return coordinates_of(held)
    if hasattr(value, "get_coords_selig_format"):
        return value.get_coords_selig_format()
    return list(value) if isinstance(value, Iterator) else value


def _attribute(value: Any, name: str) -> Any:
    """Returns an attribute; None where there is none. Those of shapely's collections are there, and cannot be read."""
    try:
        return getattr(value, name, None)
    except NotImplementedError:
        return None


def _shown(value: Any) -> str:
    """Returns the type of an argument, and the value of those that are short."""
    name = type(value).__name__
    return name if isinstance(value, (list, tuple, dict, np.ndarray)) else f"{name} {value!r:.40}"


def _numbers(points: Any, name: str) -> np.ndarray:
    """Returns an array of doubles. Raises WrongTypeError for what holds no numbers."""
    array = doubles(points if type(points) in (np.ndarray, list, tuple) else coordinates_of(points), name,
                    "an (n, 2) array of numbers")
    if array.ndim == 0:
        raise WrongTypeError(f"{name} must be an (n, 2) array of numbers, not {_shown(points)}")
    return array


def doubles(values: Any, name: str, wanted: str = "numbers") -> np.ndarray:
    """Returns an array of doubles of any shape. Raises WrongTypeError for what holds no numbers."""
    try:
        return np.asarray(values, dtype=np.float64, order="C")
    except (TypeError, ValueError) as error:
        raise WrongTypeError(f"{name} must be {wanted}, not {_shown(values)}: {error}") from None


def points_array(points: Any, name: str = "points") -> np.ndarray:
    """Returns an (n, 2) array of doubles. Raises WrongTypeError for what holds no numbers."""
    array = _numbers(points, name)
    if array.size == 0:
        return np.empty((0, 2))
    if array.ndim != 2 or array.shape[1] != 2:
        raise InputError(f"{name} must have the shape (n, 2), not {array.shape}")
    return array


def queries_array(points: Any) -> tuple[np.ndarray, bool]:
    """Returns an (n, 2) array of doubles, and whether one point was given, and not an array of them."""
    array = _numbers(points, "points")
    return (array[None, :], True) if array.shape == (2,) else (points_array(array), False)


def index_array(indices: Any, columns: int, name: str) -> np.ndarray:
    """Returns an (n, columns) array of 32-bit indices, or (n,) for columns = 1."""
    try:
        array = np.asarray(list(indices) if isinstance(indices, Iterator) else indices)
    except ValueError as error:  # rows of different lengths
        raise WrongTypeError(f"{name} must be whole numbers, not {_shown(indices)}: {error}") from None
    if array.size == 0:
        return np.empty((0, columns) if columns > 1 else (0,), dtype=np.uint32)
    if array.dtype.kind not in "ui":
        if array.dtype.kind in "OU":
            raise WrongTypeError(f"{name} must be whole numbers, not {_shown(indices)}")
        raise InputError(f"{name} must be whole numbers, not {array.dtype}")
    if (columns > 1 and (array.ndim != 2 or array.shape[1] != columns)) or (columns == 1 and array.ndim != 1):
        wanted = f"(n, {columns})" if columns > 1 else "(n,)"
        raise InputError(f"{name} must have the shape {wanted}, not {array.shape}")
    if array.min() < 0 or array.max() >= 2**32 - 1:
        raise InputError(f"{name} must lie between 0 and 2^32 - 2")
    return unsigned(array)


def signed(indices: np.ndarray) -> np.ndarray:
    """Returns indices of the C++ part, which has unsigned ones, as a view of signed ones: 0 - 1 is -1 then."""
    return indices.view(np.int32) if indices.dtype == np.uint32 else indices


def unsigned(indices: np.ndarray) -> np.ndarray:
    """Returns indices as the C++ part takes them: a view where they are what signed() returned."""
    array = np.ascontiguousarray(indices)
    return array.view(np.uint32) if array.dtype == np.int32 else np.ascontiguousarray(array, dtype=np.uint32)


def immutable(array: np.ndarray) -> np.ndarray:
    """Returns an array of the same numbers that nobody can write to: itself where its memory is that of bytes or of the
    C++ part, and a copy otherwise. An array that is only marked as read-only may be marked as writable again."""
    owner: object = array
    is_marked = True
    while isinstance(owner, np.ndarray):
        is_marked = is_marked and not owner.flags.writeable
        owner = owner.base
    from_cpp = isinstance(owner, memoryview) and type(owner.obj).__module__ == "nanobind"
    if is_marked and (from_cpp or isinstance(owner, bytes)):
        return array
    if array.size == 0:
        return array.copy()
    return np.frombuffer(array.tobytes(), dtype=array.dtype).reshape(array.shape)
