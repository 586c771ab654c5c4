"""Many meshes, on several threads of one process."""

from __future__ import annotations

import itertools
import os
import threading
import time
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _lamina
from ._arrays import Values
from ._errors import Error, UsageError
from ._mesh import Mesh
from ._meshing import make_mesh
from ._options import option_values
from ._sections import Sections

if TYPE_CHECKING:
    from concurrent.futures import Future

    from typing_extensions import Unpack

    from ._meshing import MeshOptions


@dataclass(frozen=True, eq=False, repr=False)
class BatchResult(Values):
    """What became of one job of `lamina.batch()`: `mesh` or `error` is None.

    Examples
    --------
    >>> [result] = lamina.batch(["naca:0012"], first_height=1e-3)
    >>> result.name, result.error
    ('naca_0012', None)
    >>> len(result.mesh) > 1000
    True
    """

    name: str  #: of the input
    options: dict[str, Any]  #: the values of the sweep
    mesh: Mesh | None  #: with its warnings
    error: Exception | None  #: a lamina.Error, or a MemoryError
    seconds: float  #: wall-clock time
    path: str | None = field(default=None)  #: the file that was written


@dataclass(frozen=True)
class _Job:
    name: str
    sections: Sections
    swept: dict[str, Any]
    path: str | None


def _named_inputs(inputs: Mapping[str, Sections] | Iterable[Sections]) -> list[tuple[str, Sections]]:
    if isinstance(inputs, Mapping):
        return [(str(name), sections) for name, sections in inputs.items()]
    named: list[tuple[str, Sections]] = []
    for number, sections in enumerate(inputs):
        if isinstance(sections, (str, os.PathLike)):
            text = os.fspath(sections)
            stem = text.replace(":", "_") if text.startswith("naca:") else os.path.splitext(os.path.basename(text))[0]
            named.append((stem, sections))
        else:
            named.append((f"section_{number:05d}", sections))
    return named


def _jobs(inputs: Any, sweep: Mapping[str, Sequence[Any]], write: str | None) -> list[_Job]:
    """Returns the jobs in their order. Throws UsageError where two would write the same file."""
    jobs: list[_Job] = []
    paths: set[str] = set()
    for name, sections in _named_inputs(inputs):
        for values in itertools.product(*sweep.values()):
            swept = dict(zip(sweep, values))
            path = None if write is None else _path_of(write, name, swept)
            if path is not None and path in paths:
                raise UsageError(f"write: '{path}' would be written twice; name the input and what is swept in it, "
                                 "such as 'out/{name}_{reynolds:g}.su2'")
            if path is not None:
                paths.add(path)
            jobs.append(_Job(name, sections, swept, path))
    return jobs


def _path_of(template: str, name: str, swept: dict[str, Any]) -> str:
    try:
        return template.format(name=name, **swept)
    except (KeyError, IndexError, ValueError) as error:
        raise UsageError(f"write: '{template}' cannot be filled in: {error!r}") from error


class _Left(Exception):
    """Ends the meshes in hand of a loop that was left. Nobody sees it."""


def _run(job: _Job, options: dict[str, Any], left: threading.Event) -> BatchResult:
    def stop() -> None:
        if left.is_set():
            raise _Left

    start = time.perf_counter()
    try:
        mesh = make_mesh(job.sections, None, {"threads": 1, **options, **job.swept}, job.name, stop)
        if job.path is not None:
            _lamina.create_folders_above(job.path)
            mesh.write(job.path)
    except (Error, MemoryError) as error:
        return BatchResult(job.name, job.swept, None, error, time.perf_counter() - start)
    return BatchResult(job.name, job.swept, mesh, None, time.perf_counter() - start, job.path)


def _keep_freed_memory() -> None:
    """Makes glibc keep the memory that a mesh frees for the next one: once a program has freed a block, it keeps up to
    twice the size of that block. Else it gives most of a mesh back to the system, which clears each page anew: 6 % of
    the time of small meshes. No page of this block is ever used."""
    np.empty(1 << 24, np.uint8)


def batch(inputs: Mapping[str, Sections] | Iterable[Sections], *, jobs: int | None = None,
          sweep: Mapping[str, Sequence[Any]] | None = None, write: str | None = None,
          **options: Unpack[MeshOptions]) -> Iterator[BatchResult]:
    """Makes a mesh for each input, on several threads, and yields the results as they are finished.

    inputs: what `lamina.mesh()` takes as sections, once for each mesh, or a dictionary from names to these. Files and
    names of sections give the name of their result, others are "section_00000" and so on.
    jobs: number of meshes at a time; one per core unless given. Each is made on one thread, unless `threads` is given.
    sweep: values of options to combine: {"reynolds": [1e5, 1e6], "alpha": [0, 4]} makes four meshes for each input.
    write: path of the mesh files, with {name} and the options of the sweep in braces: "out/{name}_{reynolds:g}.su2".
    Folders that are missing are created.
    options: those of `lamina.mesh()`.

    An input that cannot be meshed yields a result with `error`, and the others go on. Wrong options raise at once. No
    more than twice `jobs` meshes are held, besides those that the caller keeps. Leaving the loop, or Ctrl-C in it, ends the
    meshes in hand.

    Examples
    --------
    >>> results = lamina.batch(["naca:0012", "naca:2412"], first_height=1e-3, jobs=1)
    >>> sorted(result.name for result in results)
    ['naca_0012', 'naca_2412']
    """
    swept = dict(sweep or {})
    for values in itertools.product(*swept.values()):
        given = {**options, **dict(zip(swept, values))}
        _lamina.check_options(option_values({k: v for k, v in given.items() if k != "background"}))
    todo = _jobs(inputs, swept, write)
    _keep_freed_memory()
    return _results(todo, dict(options), jobs or os.cpu_count() or 1)


def _results(todo: list[_Job], options: dict[str, Any], workers: int) -> Iterator[BatchResult]:
    # Read here, since it takes a sixth of the time of importing lamina.
    from concurrent.futures import FIRST_COMPLETED, ThreadPoolExecutor, wait

    queue = iter(todo)
    running: set[Future[BatchResult]] = set()
    pool = ThreadPoolExecutor(workers, thread_name_prefix="lamina")
    left = threading.Event()
    try:
        while True:
            for job in itertools.islice(queue, 2 * workers - len(running)):
                running.add(pool.submit(_run, job, options, left))
            if not running:
                return
            done, running = wait(running, return_when=FIRST_COMPLETED)
            while done:
                yield done.pop().result()
    finally:
        left.set()
        pool.shutdown(wait=True, cancel_futures=True)
