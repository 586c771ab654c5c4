#!/usr/bin/env python3
"""Makes a tarball that runs from any folder: the installed program, and every library that it needs but for those of
the C library, found by $ORIGIN.

usage: tools/make_tarball.py PREFIX OUTPUT.tar.gz

PREFIX is what `cmake --install` made. Needs ldd and patchelf; Debian's licences of the libraries come along where dpkg
knows them.
"""
import pathlib
import re
import shutil
import subprocess
import sys
import tarfile

# The C library and what belongs to it are those of the system: they must fit its kernel and its configuration.
SYSTEM = re.compile(r"(ld-linux.*|lib(c|m|dl|rt|pthread|resolv|util))\.so\.\d+")


def libraries_of(program):
    """Yields the names and paths of all libraries that a program is linked to, directly or not."""
    for line in subprocess.run(["ldd", program], check=True, capture_output=True, text=True).stdout.splitlines():
        name, _, found = line.strip().partition(" => ")
        if not found or SYSTEM.fullmatch(name):
            continue
        if found.startswith("not found"):
            raise SystemExit(f"make_tarball.py: {name} is not found")
        yield name, pathlib.Path(found.rsplit(" (", 1)[0])


def copy_licence(library, folder):
    """Copies the licence of the Debian package that a library belongs to."""
    for path in {library, library.resolve(), pathlib.Path("/usr") / library.resolve().relative_to("/")}:
        owner = subprocess.run(["dpkg", "-S", str(path)], capture_output=True, text=True)
        if owner.returncode == 0:
            package = owner.stdout.split(":")[0]
            shutil.copy(f"/usr/share/doc/{package}/copyright", folder / package)
            return
    print(f"make_tarball.py: no package owns {library}: its licence is missing", file=sys.stderr)


def owned_by_root(info):
    info.uid = info.gid = 0
    info.uname = info.gname = "root"
    return info


def main():
    prefix, output = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2])
    program, lib, licences = prefix / "bin/lamina", prefix / "lib", prefix / "share/doc/lamina/licences"
    lib.mkdir(exist_ok=True)
    licences.mkdir(parents=True, exist_ok=True)
    libraries = dict(libraries_of(program))
    for name, path in sorted(libraries.items()):
        shutil.copy(path, lib / name)
        copy_licence(path, licences)
        # Run paths of programs do not count for libraries of libraries.
        subprocess.run(["patchelf", "--set-rpath", "$ORIGIN", lib / name], check=True)
    subprocess.run(["patchelf", "--set-rpath", "$ORIGIN/../lib", program], check=True)
    with tarfile.open(output, "w:gz") as archive:
        archive.add(prefix, output.name.removesuffix(".tar.gz"), filter=owned_by_root)
    print(f"{output}: the program and {len(libraries)} libraries")


if __name__ == "__main__":
    main()
