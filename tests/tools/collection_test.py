#!/usr/bin/env python3
"""Points tools/collection.py at folders of good and bad files, and at a program that misbehaves.

    tests/tools/collection_test.py PROGRAM
"""

import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

REPOSITORY = pathlib.Path(__file__).resolve().parent.parent.parent
DIAMOND = "{0} 0\n{1} 0.1\n{2} 0\n{1} -0.1\n"
COARSE = ["--", "--layers", "3", "--far-field", "3", "--surface", "keep"]
PROGRAM = ""

# Stands in for lamina and behaves as the name of its input says.
UNRULY = """#!/bin/sh
case "$*" in
    info*) exit 3 ;;
    *sleeps*) exec sleep 60 ;;
    *crashes*) kill -SEGV $$ ;;
    *gives_up*) echo "lamina: error: no mesh" >&2; exit 4 ;;
    *no_report*) exit 0 ;;
esac
"""


def diamond(left=0.0):
    """Returns the text of a file with a diamond of unit chord."""
    return DIAMOND.format(left + 1, left + 0.5, left)


class Collection(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.root = pathlib.Path(scratch.name)
        self.folder = self.root / "a folder"
        self.folder.mkdir()

    def add(self, name, content):
        """Writes a file of the folder."""
        file = self.folder / name
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_bytes(content if isinstance(content, bytes) else content.encode())

    def collect(self, *arguments, program=None):
        """Runs the tool on the folder. Returns its exit code, its summary, and the page."""
        page = self.root / "pages/page.md"
        done = subprocess.run([sys.executable, REPOSITORY / "tools/collection.py", self.folder, "--program",
                               program or PROGRAM, "--output", page, *arguments],
                              capture_output=True, text=True, check=False)
        return done.returncode, done.stdout + done.stderr, page.read_text() if page.is_file() else ""

    def row(self, page, name):
        """Returns the row of a case in the table of all cases."""
        rows = [line for line in page.splitlines() if line.startswith("| `") and name in line]
        self.assertTrue(rows, f"{name} is not on the page:\n{page}")
        return rows[-1]

    def test_every_kind_of_file_has_a_row(self):
        self.add("good.dat", diamond())
        self.add("crossing.dat", "0 0\n1 1\n1 0\n0 1\n")
        self.add("empty.dat", "")
        self.add("binary.dat", bytes(range(256)) * 8)
        self.add("-o name with | and `.dat", diamond())
        self.add(os.fsdecode(b"not utf-8 \xff.dat"), diamond())
        self.add("notes.md", "no coordinates")
        code, summary, page = self.collect(*COARSE)
        self.assertEqual(code, 0, summary)
        self.assertIn("6 cases: 3 valid, 3 refused, 0 failed", summary)
        self.assertIn("| valid | ", self.row(page, "good.dat"))
        for name in ("crossing.dat", "empty.dat", "binary.dat"):
            self.assertIn("| refused | ", self.row(page, name))
        self.assertIn("1 of `.md`", page)
        self.assertIn("the outline crosses itself", page)
        self.assertIn("3 are not judged", page)

    def test_failures_do_not_stop_it(self):
        for name in ("sleeps", "crashes", "gives_up", "no_report"):
            self.add(f"{name}.dat", diamond())
        unruly = self.root / "unruly"
        unruly.write_text(UNRULY)
        unruly.chmod(0o755)
        code, summary, page = self.collect("--limit", "3", program=str(unruly))
        self.assertEqual(code, 1)
        self.assertIn("4 cases: 0 valid, 0 refused, 4 failed", summary)
        for reason in ("no end within 3 s", "ended by SIGSEGV", "exit code 4: no mesh", "No such file or directory"):
            self.assertIn(reason, page)

    def test_judgements_hold_for_the_message_they_name(self):
        self.add("sub/open.dat", "0 0\n1 1\n1 0\n0 1\n")
        table = self.root / "table.toml"
        entry = '[[case]]\nfiles = ["sub/open.dat"]\njudgement = "rightful"\nsays = "{}"\nreason = "It is a bow tie."\n'
        table.write_text(entry.format("crosses itself"))
        self.assertIn("rightful: It is a bow tie.", self.collect("--judgements", table, *COARSE)[2])
        table.write_text(entry.format("is open"))
        self.assertIn("**not judged**", self.collect("--judgements", table, *COARSE)[2])
        table.write_text(entry.replace("rightful", "mended").format("crosses itself"))
        page = self.collect("--judgements", table, *COARSE)[2]
        self.assertIn("**not judged**", page)
        self.assertIn("**again** refused", page)

    def test_files_that_belong_together(self):
        self.add("two_main.dat", diamond())
        self.add("two_flap.dat", diamond(1.5))
        self.add("pair/a.dat", diamond())
        self.add("pair/b.dat", diamond(1.5))
        self.add("own/case.json", '{"inputs": ["a.dat"], "args": ["--no-layers", "--far-field", "2"]}')
        self.add("own/a.dat", diamond())
        self.assertIn("5 cases: 5 valid", self.collect(*COARSE)[1])
        _, summary, page = self.collect("--together", *COARSE)
        self.assertIn("3 cases: 3 valid", summary)
        self.assertIn("`two_main.dat`<br>`two_flap.dat` | valid", page)
        self.assertIn("`pair/a.dat`<br>`pair/b.dat` | valid", page)
        self.assertIn("`own/a.dat` * | valid", page)

    def test_nothing_to_mesh_is_said(self):
        code, text, page = self.collect()
        self.assertEqual((code, page), (1, ""))
        self.assertIn("no cases in", text)


if __name__ == "__main__":
    PROGRAM = str(pathlib.Path(sys.argv.pop(1)).resolve())
    unittest.main()
