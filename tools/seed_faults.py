#!/usr/bin/env python3
"""Seeds faults into src/, one at a time, and tells which of the tests beside them notice.

usage: tools/seed_faults.py BUILD [NAME...]
       tools/seed_faults.py --check

BUILD is a folder that `./dev test` has built (build/release). tools/seeded_faults.toml lists the faults: each changes one
line of a file. Only the object that holds the file is compiled anew (at -O1), and the programs that the fault names are
linked with it, so that a fault costs some seconds. Nothing of the build and of the sources is changed.

With --check it looks only whether each line to change is still there, and once.

Prints a row of a table for each fault: what noticed it, or `nothing`. The exit code is 1 if a fault went unnoticed that
the list does not call harmless.
"""

import pathlib
import re
import shlex
import subprocess
import sys
import tempfile
import tomllib

SOURCE = pathlib.Path(__file__).resolve().parents[1]
SECONDS = 300  # of a program; a fault that makes it run forever is noticed, too


def seeded(fault):
    """Returns the text of the file with the fault in it."""
    file = SOURCE / fault["file"]
    text = file.read_text() if file.exists() else ""
    if text.count(fault["old"]) != 1:
        sys.exit(f"{fault['name']}: the line to change is not once in {fault['file']}")
    return text.replace(fault["old"], fault["new"])


def commands(build, target):
    """Returns the commands that make a target, of which the last one makes the target itself."""
    return subprocess.run(["ninja", "-C", build, "-t", "commands", target], check=True, capture_output=True,
                          text=True).stdout.splitlines()


def compile_seeded(build, fault, folder):
    """Compiles the object that holds the file. Returns the object's path in the build, and that of the new one."""
    library = fault["file"].split("/")[1]
    objects = build / f"src/{library}"
    unit, text = SOURCE / fault["file"], seeded(fault)
    include = f'#include "{unit}"'
    for unity in objects.glob("CMakeFiles/*.dir/Unity/*.cxx"):
        if include in (whole := unity.read_text()):
            unit, text = unity, whole.replace(include, text)
            break
    made = f"{unit.relative_to(build)}.o" if unit.is_relative_to(build) else next(
        str(o.relative_to(build)) for o in objects.glob(f"CMakeFiles/*.dir/**/{unit.name}.o"))
    copy = folder / "seeded.cpp"
    copy.write_text(f'#line 1 "{fault["file"]}"\n' + text)
    words = [w for w in shlex.split(commands(build, made)[-1]) if not w.endswith("ccache")]
    words = words[:words.index("-MD")] + ["-w", "-O1", "-I", str((SOURCE / fault["file"]).parent)]
    subprocess.run([*words, "-o", folder / "seeded.o", "-c", copy], check=True, cwd=build)
    return made, folder / "seeded.o"


def link_seeded(build, program, made, compiled, folder):
    """Links a program with the seeded object in its library. Returns the program's path."""
    link = commands(build, program)[-1].split(" && ")[1]
    archive = next(w for w in link.split() if w.startswith(f"src/{made.split('/')[1]}/") and w.endswith(".a"))
    replaced = folder / pathlib.Path(archive).name
    replaced.write_bytes((build / archive).read_bytes())
    member = folder / pathlib.Path(made).name
    member.write_bytes(compiled.read_bytes())
    subprocess.run(["ar", "r", replaced, member], check=True)
    words = [str(replaced) if w == archive else w for w in link.split()]
    words[words.index("-o") + 1] = str(folder / "program")
    subprocess.run(words, check=True, cwd=build)
    return folder / "program"


def noticed_by(program, choice, folder):
    """Runs a test program. Returns which tests noticed, as text; empty if none did."""
    try:
        run = subprocess.run([program, "--gtest_brief=1", f"--gtest_filter={choice}"], capture_output=True, text=True,
                             errors="replace", timeout=SECONDS, cwd=folder)
    except subprocess.TimeoutExpired:
        return "does not end"
    failed = sorted(set(re.findall(r"^\[  FAILED  \] (\w+\.\w+)", run.stdout, flags=re.M)))
    if failed:
        return ", ".join(failed[:2]) + (f" and {len(failed) - 2} more" if len(failed) > 2 else "")
    if run.returncode == 0:
        return ""
    told = (run.stderr.strip() or "no message").splitlines()[-1]
    return f"ends with {run.returncode}: {told[:100]}"


def main():
    faults = tomllib.loads((SOURCE / "tools/seeded_faults.toml").read_text())["fault"]
    if sys.argv[1] == "--check":
        for fault in faults:
            seeded(fault)
        return
    build, names = pathlib.Path(sys.argv[1]).resolve(), set(sys.argv[2:])
    unnoticed, failed = 0, False
    print("| fault | file | noticed by |\n|---|---|---|")
    for fault in faults:
        if names and fault["name"] not in names:
            continue
        with tempfile.TemporaryDirectory() as name:
            folder, found = pathlib.Path(name), ""
            try:
                made, compiled = compile_seeded(build, fault, folder)
                for test in fault["tests"]:
                    program, _, choice = test.partition(":")
                    linked = link_seeded(build, f"tests/{program}/lamina_test_{program}", made, compiled, folder)
                    if found := noticed_by(linked, choice or "*", folder):
                        found = f"test: {found}"
                        break
            except (subprocess.CalledProcessError, StopIteration, ValueError) as error:
                found, failed = f"error of this tool: {error!r}"[:200], True
        if not found and "harmless" not in fault:
            unnoticed += 1
        print(f"| {fault['name']} | {fault['file']} | {found or 'nothing' + fault.get('harmless', '')} |", flush=True)
    sys.exit(unnoticed > 0 or failed)


if __name__ == "__main__":
    main()
