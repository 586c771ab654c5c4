"""What runs report while they go on."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any, Protocol, Union, runtime_checkable

from ._errors import RunEstimate, WrongTypeError

Callback = Callable[[str, Union[RunEstimate, None]], object]


@runtime_checkable
class Bar(Protocol):
    """What is used of a bar of tqdm."""

    def set_description_str(self, desc: str, /) -> object:
        """Shows a text before the bar."""

    def set_postfix_str(self, s: str, /) -> object:
        """Shows a text behind the bar."""

    def update(self) -> object:
        """Counts one step."""


#: A function of stage and estimate; True for a line that names the stage; or a bar of tqdm.
Progress = Union[Callback, bool, Bar, None]


def _on_bar(bar: Bar) -> Callback:
    def show(stage: str, estimate: RunEstimate | None) -> None:
        bar.set_description_str(stage)
        if estimate is not None:
            bar.set_postfix_str(f"about {estimate.triangles:,.0f} triangles")
        bar.update()

    return show


def _print_stage(stage: str, estimate: RunEstimate | None) -> None:
    about = f", about {estimate.triangles:,.0f} triangles" if estimate is not None else ""
    print(f"lamina: {stage}{about}", file=sys.stderr)


def _tqdm() -> Any:
    """Returns the class of bars; None where tqdm is not installed."""
    try:
        from tqdm.auto import tqdm  # type: ignore[import-not-found, import-untyped, unused-ignore]
    except ImportError:
        return None
    return tqdm


@contextmanager
def callback_of(progress: Progress) -> Iterator[Callback | None]:
    """Yields what the C++ part calls when a stage begins."""
    if progress is None or progress is False:
        yield None
    elif progress is True:
        tqdm = _tqdm()
        if tqdm is None:
            yield _print_stage
            return
        with tqdm(unit=" stages", leave=False) as bar:
            yield _on_bar(bar)
    elif isinstance(progress, Bar):
        yield _on_bar(progress)
    elif callable(progress):
        yield progress
    else:
        raise WrongTypeError(f"progress must be a function, True, or a bar of tqdm, not {type(progress).__name__}")
