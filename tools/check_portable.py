"""Says what built modules need of the machine that loads them, and fails where that is more than glibc 2.28 has.

usage: check_portable.py BUILD_DIR...
"""

import pathlib
import re
import subprocess
import sys

NEWEST_GLIBC = (2, 28)
#: glibc, and GCC's support library, which every system has: of that the modules need what GCC 4.2 had.
OF_THE_SYSTEM = {"libc.so.6", "libm.so.6", "libpthread.so.0", "libgcc_s.so.1", "ld-linux-x86-64.so.2"}


def objdump(option, library):
    return subprocess.run(["objdump", option, library], capture_output=True, text=True, check=True).stdout


def glibc_versions(library):
    """{version: its symbols}."""
    found = {}
    for version, symbol in re.findall(r"\(GLIBC_([0-9.]+)\) +(\S+)$", objdump("-T", library), re.MULTILINE):
        found.setdefault(tuple(map(int, version.split("."))), []).append(symbol)
    return found


def faults(library):
    """What is too new or not the system's, a line each."""
    for version, symbols in sorted(glibc_versions(library).items()):
        if version > NEWEST_GLIBC:
            yield f"glibc {'.'.join(map(str, version))}: {', '.join(symbols)}"
    for needed in re.findall(r"NEEDED +(\S+)", objdump("-p", library)):
        if needed not in OF_THE_SYSTEM:
            yield f"needs {needed}"


def main(build_dirs):
    libraries = [path for folder in build_dirs for path in sorted(pathlib.Path(folder, "python", "atlas_refine").glob("*.so*"))]
    wrong = [f"{library}: {fault}" for library in libraries for fault in faults(library)]
    if wrong or not libraries:
        sys.exit("\n".join(wrong) or "no module is built")
    for library in libraries:
        newest = ".".join(map(str, max(glibc_versions(library))))
        print(f"{library.name}: needs glibc {newest}")


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    main(sys.argv[1:])
