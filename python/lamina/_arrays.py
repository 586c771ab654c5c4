"""Arguments as arrays of the types that the C++ part takes."""

from __future__ import annotations

import numpy as np

from ._errors import InputError


def points_array(points, name: str = "points") -> np.ndarray:
    """Returns an (n, 2) array of doubles."""
    array = np.ascontiguousarray(points, dtype=np.float64)
    if array.size == 0:
        return np.empty((0, 2))
    if array.ndim != 2 or array.shape[1] != 2:
        raise InputError(f"{name} must have the shape (n, 2), not {array.shape}")
    return array


def index_array(indices, columns: int, name: str) -> np.ndarray:
    """Returns an (n, columns) array of 32-bit indices, or (n,) for columns = 1."""
    array = np.asarray(indices)
    if array.size == 0:
        return np.empty((0, columns) if columns > 1 else (0,), dtype=np.uint32)
    if array.dtype.kind not in "ui":
        raise InputError(f"{name} must be whole numbers, not {array.dtype}")
    if (columns > 1 and (array.ndim != 2 or array.shape[1] != columns)) or (columns == 1 and array.ndim != 1):
        wanted = f"(n, {columns})" if columns > 1 else "(n,)"
        raise InputError(f"{name} must have the shape {wanted}, not {array.shape}")
    if array.min() < 0 or array.max() >= 2**32 - 1:
        raise InputError(f"{name} must lie between 0 and 2^32 - 2")
    return np.ascontiguousarray(array, dtype=np.uint32)


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
