"""Prints the stub of lamina._meshing, in which the options of the C++ tables have names and types.

    python -m lamina._stubs > python/lamina/_meshing.pyi

`./dev docs` does this, and a test fails where the file is not current.
"""

from __future__ import annotations

import textwrap
from collections.abc import Mapping
from typing import Any

from ._options import default_text, option_rows, type_of

_HEAD = '''"""Meshes round sections. Generated from the option tables: `python -m lamina._stubs` prints this file."""

from collections.abc import Callable, Mapping, Sequence
from os import PathLike
from typing import Any, Literal, TypedDict

from numpy import ndarray
from typing_extensions import Unpack

from . import _lamina
from ._mesh import Mesh
from ._progress import Callback, Progress
from ._sections import Sections

class MeshOptions(TypedDict, total=False):
    """The options of mesh(). None stands for the default."""

'''

_TAIL = '''
class RunArguments:
    sections: list[Any]
    values: list[tuple[str, Any]]
    sizes: tuple[ndarray, ndarray, ndarray] | None

def mesh(sections: Sections, *, progress: Progress = None, **options: Unpack[MeshOptions]) -> Mesh: ...
def run_arguments(sections: Sections, options: Mapping[str, Any], source: str = ...) -> RunArguments: ...
def made_mesh(
    result: tuple[_lamina.Mesh, list[dict[str, Any]], dict[str, Any], tuple[ndarray, ndarray]],
) -> Mesh: ...
def make_mesh(
    sections: Sections,
    progress: Callback | None,
    options: Mapping[str, Any],
    source: str = ...,
    stop: Callable[[], None] | None = None,
) -> Mesh: ...
'''


def _key(row: Mapping[str, Any]) -> str:
    """Returns the key of an option, below comments that describe it."""
    bounds = f"; {row['range']}" if row["range"] else ""
    comment = textwrap.fill(f"{row['help']}{bounds}{default_text(row)}", 112, initial_indent="    # ",
                            subsequent_indent="    # ", break_long_words=False, break_on_hyphens=False)
    return f"{comment}\n    {row['key']}: {type_of(row)} | None\n"


def stub() -> str:
    """Returns the stub."""
    return _HEAD + "".join(_key(row) for row in option_rows().values()) + _TAIL


if __name__ == "__main__":
    print(stub(), end="")
