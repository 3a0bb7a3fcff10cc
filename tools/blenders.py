"""The Blenders that tests and demo run in: Debian's program, and the official builds as the bpy module of PyPI.

usage: blenders.py VERSION     prints the path of that Python, as 3.13, and fails where there is none
"""

import pathlib
import shutil
import subprocess
import sys
from dataclasses import dataclass, replace

#: Official builds. One is enough for every day; the others are for --all-blenders. The last needs a Python 3.13.
EVERY_DAY = ["4.5.15"]
OTHERS = ["4.2.23", "5.0.1"]
ON_PYTHON_3_13 = ["5.2.3"]


@dataclass(frozen=True)
class Program:
    """A Blender with a window."""

    name: str
    executable: str
    can_be_had = True

    def installed(self, _cache):
        return self

    def script(self, path):
        """The command that runs a script; what follows goes to the script."""
        return [self.executable, "-b", "--factory-startup", "--python-exit-code", "1", "--python", path, "--"]


@dataclass(frozen=True)
class Module:
    """An official build as a Python module in an environment of its own."""

    version: str
    base_python: str = "/usr/bin/python3"
    numpy: str = "numpy<2"  # as in the official builds with Python 3.11; the wheel of 4.2 leaves it open
    python: str = ""

    @property
    def name(self):
        return f"Blender {self.version}"

    @property
    def can_be_had(self):
        return bool(self.base_python)

    def installed(self, cache):
        folder = pathlib.Path(cache) / f"bpy-{self.version}"
        python, done = folder / "bin" / "python", folder / "complete"
        if not done.exists():
            print(f"installing {self.name} from PyPI, some 350 MB", flush=True)
            shutil.rmtree(folder, ignore_errors=True)
            subprocess.run([self.base_python, "-m", "venv", folder], check=True)
            subprocess.run([python, "-m", "pip", "install", "-q", f"bpy=={self.version}", self.numpy], check=True)
            done.touch()
        return replace(self, python=str(python))

    def script(self, path):
        return [self.python, path, "--"]


def debian():
    """Debian 12's Blender 3.4.1."""
    text = subprocess.run(["/usr/bin/blender", "--version"], capture_output=True, text=True, check=True).stdout
    return [Program(text.splitlines()[0], "/usr/bin/blender")]


def python(version):
    """Path of a Python that is not Debian's own, "" where there is none."""
    candidates = [shutil.which(f"python{version}"), *pathlib.Path.home().glob(f".pyenv/versions/{version}.*/bin/python{version}")]
    for candidate in filter(None, candidates):
        if subprocess.run([candidate, "-c", "import venv"], capture_output=True, check=False).returncode == 0:
            return str(candidate)
    return ""


def official(every):
    modules = [Module(version) for version in EVERY_DAY]
    if every:
        modules += [Module(version) for version in OTHERS]
        modules += [Module(version, base_python=python("3.13"), numpy="numpy") for version in ON_PYTHON_3_13]
    return modules


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    found = python(sys.argv[1])
    print(found)
    sys.exit(not found)
