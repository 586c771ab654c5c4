"""The errors of lamina, one class for each kind, and the warnings of meshes. They can be pickled."""

from __future__ import annotations

from typing import NamedTuple


class RunEstimate(NamedTuple):
    """What a run will take, by estimate, before the work begins."""

    triangles: float  #: number of triangles; a quadrilateral counts as two
    memory_bytes: float  #: largest memory of the process
    seconds: float  #: wall-clock time, on a machine of 2020 or so


class Error(Exception):
    """The base of all errors that lamina raises."""

    exit_code: int = 1  #: what the program `lamina` returns for this kind of error


class UsageError(Error, ValueError):
    """Arguments that contradict each other or that lamina does not know."""

    exit_code = 2


class OptionError(UsageError):
    """An option whose value is out of range, of the wrong kind, or does not go with the others."""

    option: str = ""  #: name of the option
    reason: str = ""  #: what is wrong with its value


class LimitError(OptionError):
    """A run that would exceed a limit; `option` is the one to change."""

    estimate: RunEstimate  #: what the run would take


class InputError(Error, ValueError):
    """Input that cannot be used."""

    exit_code = 3
    reason: str = ""  #: what is wrong, without the place
    file: str = ""  #: path or name of the input
    line: int = 0  #: line of the file, or number of the point of an array, from 1; 0: not tied to one
    at: tuple[float, float] | None = None  #: coordinates of the place
    element: str = ""  #: name of the body
    points: list[int] = []  #: indices of points handed in
    segments: list[int] = []  #: indices of segments handed in


class MeshError(Error, RuntimeError):
    """A mesh of the promised standard that could not be made."""

    exit_code = 4
    at: tuple[float, float] | None = None  #: the place of the first defect, where it is known


class IoError(Error, OSError):
    """A file that could not be read or written."""

    exit_code = 5
    file: str = ""  #: path of the file
    reason: str = ""  #: why it could not be read or written


class MeshWarning(UserWarning):
    """A valid mesh that is probably not what the user wants.

    `lamina.mesh()` passes these to `warnings.warn()`, and they stay in `Mesh.warnings`. To make them errors:
    `warnings.simplefilter("error", lamina.MeshWarning)`.
    """

    code: str = ""  #: stable name of the kind: "first_layer_lost" (docs/reference/checks.md, "Warnings")
    element: str = ""  #: name of the body; empty where the whole mesh is meant
    at: tuple[float, float] | None = None  #: the worst place, where there is one
    number: float = 0  #: how many or how much
    unit: str = ""  #: of the number: "wall edges", "degrees", "chords"
    message: str = ""  #: one sentence

    @classmethod
    def _from(cls, data: dict) -> MeshWarning:
        warning = cls(data["message"])
        warning.__dict__.update(data)
        return warning
