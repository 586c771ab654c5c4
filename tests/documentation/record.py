#!/usr/bin/env python3
"""Looks that the record in the README is that of docs/collection.md.

usage: record.py SOURCE
"""

import pathlib
import re
import sys


def main():
    source = pathlib.Path(sys.argv[1])
    totals = re.search(r"(\d+) cases: (\d+) valid, (\d+) refused, (\d+) failed\.",
                       (source / "docs/collection.md").read_text())
    record = re.search(r"(\d+) real sections and configurations, (\d+) meshed, (\d+)\s+refused with a reason, "
                       r"\*\*(\d+) invalid\*\*", (source / "README.md").read_text())
    if not totals or not record or totals.groups() != record.groups():
        sys.exit(f"README.md says {record and record.groups()}, docs/collection.md {totals and totals.groups()}")


if __name__ == "__main__":
    main()
