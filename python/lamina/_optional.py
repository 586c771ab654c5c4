"""Packages that are asked for by what needs them alone."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager


@contextmanager
def packages_of(extra: str) -> Iterator[None]:
    """Where a package is missing that is imported in this block, the error says how to get it."""
    try:
        yield
    except ModuleNotFoundError as error:
        message = f"the package {error.name} is missing: pip install 'lamina-mesh[{extra}]'"
        raise ModuleNotFoundError(message, name=error.name) from None
