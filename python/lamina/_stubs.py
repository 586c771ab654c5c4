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

from collections.abc import Callable, Sequence
from os import PathLike
from typing import Any, Literal

from ._errors import RunEstimate
from ._mesh import Mesh
from ._sections import Sections

'''


def _parameter(row: Mapping[str, Any]) -> str:
    """Returns the parameter of an option, below comments that describe it."""
    bounds = f"; {row['range']}" if row["range"] else ""
    comment = textwrap.fill(f"{row['help']}{bounds}{default_text(row)}", 112, initial_indent="    # ",
                            subsequent_indent="    # ", break_long_words=False, break_on_hyphens=False)
    return f"{comment}\n    {row['key']}: {type_of(row)} | None = None,\n"


def stub() -> str:
    """Returns the stub."""
    options = "".join(_parameter(row) for row in option_rows().values())
    return (f"{_HEAD}def mesh(\n    sections: Sections,\n    *,\n"
            "    progress: Callable[[str, RunEstimate | None], object] | None = None,\n"
            f"{options}) -> Mesh: ...\n"
            "def make_mesh(\n    sections: Sections,\n"
            "    progress: Callable[[str, RunEstimate | None], object] | None,\n    "
            "options: dict[str, Any],\n    source: str = ...,\n) -> Mesh: ...\n")


if __name__ == "__main__":
    print(stub(), end="")
