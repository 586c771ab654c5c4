"""The program lamina: `python -m lamina`, and the console script of the package."""

from __future__ import annotations

import os
import signal
import sys

from . import _lamina


def main() -> int:
    """Runs the program with the arguments of the command line, and returns its exit code."""
    # Python would only note that Ctrl-C was pressed, and C++ would go on.
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    return _lamina.run_program(["lamina", *map(os.fsdecode, sys.argv[1:])])


if __name__ == "__main__":
    sys.exit(main())
