"""The errors of lamina, one class for each kind, and the warnings of meshes. They can be pickled."""

from __future__ import annotations

import errno
import os
import re
from typing import Any, NamedTuple


class RunEstimate(NamedTuple):
    """What a run will take, by estimate, before the work begins.

    Examples
    --------
    >>> lamina.RunEstimate(triangles=1e6, memory_bytes=1e9, seconds=1).triangles
    1000000.0
    """

    triangles: float  #: number of triangles; a quadrilateral counts as two
    memory_bytes: float  #: largest memory of the process
    seconds: float  #: wall-clock time, on a machine of 2020 or so


class Error(Exception):
    """The base of all errors that lamina raises.

    Examples
    --------
    >>> try:
    ...     lamina.naca("12")
    ... except lamina.Error as error:
    ...     print(error.exit_code)
    2
    """

    exit_code: int = 1  #: what the program `lamina` returns for this kind of error


class UsageError(Error, ValueError):
    """Arguments that contradict each other or that lamina does not know.

    Examples
    --------
    >>> try:
    ...     lamina.mesh("naca:0012", groth=1.2)
    ... except lamina.UsageError as error:
    ...     print(error)
    groth: no such option: did you mean 'growth'?
    """

    exit_code = 2


class WrongTypeError(UsageError, TypeError):
    """An argument of a type that lamina cannot use; the message says what was given.

    Examples
    --------
    >>> try:
    ...     lamina.mesh(7)
    ... except TypeError as error:
    ...     print(type(error).__name__)
    WrongTypeError
    """


class OptionError(UsageError):
    """An option whose value is out of range, of the wrong kind, or does not go with the others.

    Examples
    --------
    >>> try:
    ...     lamina.mesh("naca:0012", growth=0.5)
    ... except lamina.OptionError as error:
    ...     print(error.option, error.reason)
    growth 0.5 is out of range: must be > 1
    """

    option: str = ""  #: name of the option
    reason: str = ""  #: what is wrong with its value


class OptionTypeError(OptionError, WrongTypeError):
    """An option with a value of a type that none has."""


class LimitError(OptionError):
    """A run that would exceed a limit; `option` is the one to change.

    Examples
    --------
    >>> try:
    ...     lamina.mesh("naca:0012", max_triangles=1000)
    ... except lamina.LimitError as error:
    ...     print(error.estimate.triangles > 1000)
    True
    """

    estimate: RunEstimate  #: what the run would take


class InputError(Error, ValueError):
    """Input that cannot be used.

    Examples
    --------
    >>> try:
    ...     lamina.delaunay([[0, 0], [1, 0], [0, 0]])
    ... except lamina.InputError as error:
    ...     print(error.points)
    [0, 2]
    """

    exit_code = 3
    reason: str = ""  #: what is wrong, without the place
    file: str = ""  #: path or name of the input
    line: int = 0  #: line of the file, or number of the point of an array, from 1; 0: not tied to one
    at: tuple[float, float] | None = None  #: coordinates of the place
    element: str = ""  #: name of the body
    points: list[int] = []  #: indices of points handed in
    segments: list[int] = []  #: indices of segments handed in


class MeshError(Error, RuntimeError):
    """A mesh of the promised standard that could not be made.

    Examples
    --------
    >>> issubclass(lamina.MeshError, RuntimeError)
    True
    """

    exit_code = 4
    at: tuple[float, float] | None = None  #: the place of the first defect, where it is known


class IoError(Error, OSError):
    """A file that could not be read or written. `errno`, `strerror` and `filename` are those of the system where it says
    why, and then the error is also a FileNotFoundError, a PermissionError, and so on.

    Examples
    --------
    >>> try:
    ...     lamina.read("missing.vtu")
    ... except FileNotFoundError as error:
    ...     print(error.filename)
    missing.vtu
    """

    exit_code = 5
    file: str = ""  #: path of the file
    reason: str = ""  #: why it could not be read or written

    def __str__(self) -> str:
        return f"{self.file}: {self.reason}" if self.file else super().__str__()


class MissingFileError(IoError, FileNotFoundError):
    """A file or folder that is not there."""


class AccessError(IoError, PermissionError):
    """A file that may not be read or written."""


class FolderError(IoError, IsADirectoryError):
    """A folder where a file is needed."""


class NoFolderError(IoError, NotADirectoryError):
    """A file where a folder is needed."""


_OF_ERRNO = {errno.ENOENT: MissingFileError, errno.EACCES: AccessError, errno.EPERM: AccessError,
             errno.EISDIR: FolderError, errno.ENOTDIR: NoFolderError}


def io_error(message: str, file: str, reason: str) -> IoError:
    """Returns the error of a file with the number of the system whose text the reason ends with."""
    text = reason.lower()
    numbers = [number for number in errno.errorcode if text.endswith(os.strerror(number).lower())]
    if reason.endswith("does not exist"):
        numbers = [errno.ENOENT]
    number = max(numbers, key=lambda n: len(os.strerror(n)), default=None)
    error = IoError(message) if number is None else _OF_ERRNO.get(number, IoError)(number, os.strerror(number), file)
    error.file, error.reason = file, reason
    return error


def in_python(text: str) -> str:
    """Returns a message with the names of options as Python has them: "layer_topology", not "--layer-topology". Names of
    files may look like options, but have a folder before or an extension behind."""
    option = r"(?:\boption )?(?<![\w/\\.-])--([a-z][a-z0-9]*(?:-[a-z0-9]+)*)(?!\w|[-/\\.]\w)"
    return re.sub(option, lambda m: m[1].replace("-", "_"), text)


class MeshWarning(UserWarning):
    """A valid mesh that is probably not what the user wants.

    `lamina.mesh()` passes these to `warnings.warn()`, and they stay in `Mesh.warnings`. To make them errors:
    `warnings.simplefilter("error", lamina.MeshWarning)`.

    Examples
    --------
    >>> import warnings
    >>> with warnings.catch_warnings():
    ...     warnings.simplefilter("ignore", lamina.MeshWarning)
    ...     mesh = lamina.mesh("naca:0012", reynolds=6e6)
    """

    code: str = ""  #: stable name of the kind: "first_layer_lost" (docs/reference/checks.md, "Warnings")
    element: str = ""  #: name of the body; empty where the whole mesh is meant
    at: tuple[float, float] | None = None  #: the worst place, where there is one
    number: float = 0  #: how many or how much
    unit: str = ""  #: of the number: "wall edges", "degrees", "chords"
    message: str = ""  #: one sentence

    @classmethod
    def _from(cls, data: dict[str, Any]) -> MeshWarning:
        message = in_python(data["message"])
        warning = cls(message)
        warning.__dict__.update(data, message=message)
        return warning
